"""The air-ground study's results never pass for another version's."""

from crew.study.air_ground import missing_of, scenarios
from crew.study.mission import Measured, Scenario
from crew.study.table import Study, page

WANTED = tuple(scenarios(2))
FIRST, SECOND, *REST = WANTED


def measured(scenario: Scenario, version: str) -> Measured:
    return Measured(
        version=version, scenario=scenario, outcome="completed", code=None, question=None, message="", dispatched={},
        moved=(), ends={}, goal_error_m=0.2, fix_error_m=0.1, navigation_error_m=0.1, mission_s=1.0, wall_s=1.0,
    )  # fmt: skip


def test_what_was_never_measured_comes_before_what_another_version_has_measured() -> None:
    study = Study(missions=(measured(FIRST, "1"), measured(SECOND, "2")))
    assert missing_of(study, WANTED, "2") == [*REST, FIRST]
    assert missing_of(study, WANTED, "1") == [*REST, SECOND]
    whole = Study(missions=tuple(measured(scenario, "2") for scenario in WANTED))
    assert missing_of(whole, WANTED, "2") == []
    assert missing_of(whole, WANTED, "3") == list(WANTED)


def test_the_page_says_which_version_measured_what() -> None:
    mixed = page(Study(missions=(measured(FIRST, "1"), measured(SECOND, "2"))))
    assert "Measured with version 1 (map A seeds 0); version 2 (map B seeds 0)." in mixed
    whole = page(Study(missions=tuple(measured(scenario, "2") for scenario in WANTED)))
    assert "Measured with version 2." in whole
