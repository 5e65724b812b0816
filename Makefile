# The developer's commands. Each sets up .venv by itself when pyproject.toml has changed; CI runs the same ones.

BIN := .venv/bin
CREW ?= air_ground
ARGS ?=

SOURCES := $(shell find actors adapters contracts crew sim -name '*.py')

.PHONY: help demo test check bench hostile mavproxy menagerie soak picture study accuracy sdk smoke clean

help:  ## this list
	@grep -E '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):.*## */make \1\t/' | expand -t 14

demo: .venv/.compiled  ## bring a crew up in simulation, carry out one request (CREW=air_ground ARGS="--seed 3")
	@$(BIN)/crew demo $(CREW) $(ARGS)

test: .venv/.ready  ## unit and integration tests (ARGS="tests/unit -x")
	$(BIN)/python -m pytest $(ARGS)

check: .venv/.ready  ## formatting, lint, types, import layers
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-logo

bench: .venv/.compiled  ## measure speed and latency
	$(BIN)/python -m tests.bench $(ARGS)

hostile: .venv/.ready  ## the twenty hostile cases, against crews that are up (docs/hostile-cases.md)
	$(BIN)/python -m pytest -m hostile $(ARGS)

mavproxy: .venv/.ready  ## the simulated vehicles flown by MAVProxy (CREW_MAVPROXY=its mavproxy.py, docs/decisions/0066)
	$(BIN)/python -m pytest -m mavproxy tests/integration/clients $(ARGS)

menagerie: .venv/.ready  ## the testbed with MuJoCo Menagerie's robots (CREW_MENAGERIE=its folder, docs/decisions/0087)
	$(BIN)/python -m pytest -m menagerie tests/integration/unitree $(ARGS)

soak: .venv/.ready  ## the long tests: those marked soak, and every property with many more examples
	$(BIN)/python -m pytest -m "soak or hypothesis" --hypothesis-profile=soak $(ARGS)

picture: .venv/.ready  ## make the README's picture anew: a run's page in a browser (needs Chromium)
	$(BIN)/python -m tests.integration.recorder.picture docs/images/replay.png

STUDY ?= runs/eval
PLANNER ?= fallible

study: .venv/.ready  ## both testbeds in four arms, RO on five seeds (PLANNER=fallible STUDY=runs/eval); goes on where it was
	@for crew in air_ground humanoid_quadruped; do \
	  $(BIN)/crew eval $$crew --planner $(PLANNER) --out $(STUDY)/$$crew && \
	  $(BIN)/crew eval $$crew --planner $(PLANNER) --arms ro --seeds 5 --out $(STUDY)/$$crew && \
	  $(BIN)/crew eval ablate $$crew --planner $(PLANNER) --arms ro --out $(STUDY)/$$crew-held && \
	  $(BIN)/crew eval substitution $$crew --planner $(PLANNER) --seeds 10 --out $(STUDY)/substitution || exit $$?; \
	done
	$(BIN)/crew eval fuzz --plans 100000 --mutant all --seed 2026 --out docs/study

accuracy: .venv/.ready  ## accuracy and faults of air_ground, deliveries of humanoid_quadruped, by seed, into docs/study
	$(BIN)/python -m crew.study.air_ground --out docs/study --runs runs/study
	$(BIN)/python -m tests.study.humanoid_quadruped --out docs/study

smoke: .venv/.ready  ## ask the Messages API at CREW_PLANNER_URL for a few plans
	@$(BIN)/python -m tests.smoke.local_model

sdk: .venv/.ready  ## the Unitree SDK over DDS, for its tests and the adapter's `sdk` back end
	@.ci/sdk

clean:  ## remove .venv, caches and build output; recorded runs stay
	rm -rf .venv build dist robot_crew.egg-info
	rm -rf .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache .grimp_cache
	find crew actors adapters contracts sim tests -name __pycache__ -type d -prune -exec rm -rf {} +

.venv/.ready: pyproject.toml .ci/venv
	@.ci/venv

# Python keeps bytecode by itself, unless it may not (PYTHONDONTWRITEBYTECODE): then every process would compile.
.venv/.compiled: .venv/.ready $(SOURCES)
	@$(BIN)/python -m compileall -q actors adapters contracts crew sim
	@touch $@
