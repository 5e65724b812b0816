"""A contract as a graph with a fixed place for each step, in the colours of a mission's present."""

from crew.actors.recorder.entry import Graph, Node
from crew.contracts.contract import Contract, Step
from crew.contracts.mission_state import MissionState, StepPhase, StepRecord

STEP_X, STEP_Y = 190.0, 100.0
SLOT_Y = 420.0
"""How far apart the graphs of missions are that run side by side."""
_TONES = {
    StepPhase.PENDING: "pending",
    StepPhase.DECIDING: "hold",
    StepPhase.ASKING: "hold",
    StepPhase.SENT: "run",
    StepPhase.RUNNING: "run",
    StepPhase.CONFIRMING: "run",
    StepPhase.SUCCEEDED: "good",
    StepPhase.REFUSED: "bad",
    StepPhase.FAILED: "bad",
    StepPhase.CANCELLED: "safe",
    StepPhase.UNKNOWN: "bad",
}


def contract_graph(contract: Contract, mission: MissionState, slot: int) -> Graph:
    """Steps from left to right by their order, those of a plan in the colour of how far they are."""
    ranks = _ranks(contract)
    rows: dict[int, int] = {}
    nodes = []
    for step in contract.steps:
        rank = ranks[step.name]
        row = rows[rank] = rows.get(rank, -1) + 1
        record = mission.steps.get(step.name)
        nodes.append(
            Node(
                name=step.name,
                label=_label(step, record),
                x=rank * STEP_X,
                y=row * STEP_Y + slot * SLOT_Y,
                tone="absent" if record is None else _TONES[record.phase],
            )
        )
    edges = tuple((before, step.name) for step in contract.steps for before in step.after)
    return Graph(slot=str(slot), nodes=tuple(nodes), edges=edges)


def _ranks(contract: Contract) -> dict[str, int]:
    """How many steps stand before each on its longest way; a contract's order has no cycle."""
    ranks: dict[str, int] = {}

    def rank(step: Step) -> int:
        if step.name not in ranks:
            before = [found for name in step.after if (found := contract.step(name)) is not None]
            ranks[step.name] = 1 + max((rank(found) for found in before), default=-1)
        return ranks[step.name]

    for step in contract.steps:
        rank(step)
    return ranks


def _label(step: Step, record: StepRecord | None) -> str:
    if record is None:
        return f"{step.name}\n{step.role}"
    return f"{step.name}\n{record.call.robot}.{record.call.skill}"
