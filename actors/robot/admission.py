"""Whether a dispatch may run here: the robot's own second check, independent of the orchestrator's gate. Pure."""

import msgspec

from crew.contracts.gate.arguments import check_call
from crew.contracts.plan import Call, digest
from crew.contracts.site import Rules
from crew.messages import CancelSkill, Dispatch

MAX_REMEMBERED = 4096


class Refused(msgspec.Struct, frozen=True):
    """Why a dispatch was not taken, for the event and for people."""

    code: str
    detail: str


class Admission:
    """What this robot remembers about dispatches: its boot, the newest epoch, and every sequence that it took."""

    def __init__(self, robot: str, boot_id: str, rules: Rules, *, second_check: bool = True) -> None:
        self.epoch = 0
        self._robot = robot
        self._boot_id = boot_id
        self._rules = rules
        self._second_check = second_check
        self._taken: dict[tuple[int, str], int] = {}

    def hear_epoch(self, epoch: int) -> None:
        """An orchestrator with this epoch lives; dispatches of older ones are refused from now on."""
        self.epoch = max(self.epoch, epoch)

    def admit(self, dispatch: Dispatch, now_ns: int, *, latched: bool, running: str) -> Refused | None:
        """None takes the dispatch and uses up its sequence; a refusal changes nothing."""
        refused = (
            self._check_sender(dispatch)
            or self._check_once(dispatch, now_ns)
            or self._check_call(dispatch)
            or _check_state(latched, running)
        )
        if refused is None:
            self.hear_epoch(dispatch.epoch)
            self._remember(dispatch)
        return refused

    def concerns(self, cancel: CancelSkill) -> bool:
        """Whether a cancel speaks to this robot, this boot and a living orchestrator."""
        return cancel.robot == self._robot and cancel.boot_id == self._boot_id and cancel.epoch >= self.epoch

    def _check_sender(self, dispatch: Dispatch) -> Refused | None:
        if dispatch.robot != self._robot:
            return Refused("wrong_robot", f"addressed to {dispatch.robot}, this is {self._robot}")
        if dispatch.boot_id != self._boot_id:
            return Refused("old_boot", f"meant for boot {dispatch.boot_id}, this is boot {self._boot_id}")
        if dispatch.epoch < self.epoch:
            return Refused("old_epoch", f"epoch {dispatch.epoch} is over, the orchestrator's epoch is {self.epoch}")
        return None

    def _check_once(self, dispatch: Dispatch, now_ns: int) -> Refused | None:
        if now_ns > dispatch.expires_ns:
            late_s = (now_ns - dispatch.expires_ns) / 1e9
            return Refused("expired", f"expired {late_s:.2f} s ago; nothing old is carried out")
        last = self._taken.get((dispatch.epoch, dispatch.mission), 0)
        if dispatch.sequence <= last:
            return Refused("already_consumed", f"sequence {dispatch.sequence} of {dispatch.mission} came after {last}")
        return None

    def _check_call(self, dispatch: Dispatch) -> Refused | None:
        if digest(dict(dispatch.args)) != dispatch.args_digest:
            return Refused("altered", "the arguments do not match their digest")
        if not self._second_check:
            return None
        refusal = check_call(Call(dispatch.robot, dispatch.skill, dispatch.args), self._rules)
        return None if refusal is None else Refused(refusal.code, refusal.message)

    def _remember(self, dispatch: Dispatch) -> None:
        if len(self._taken) >= MAX_REMEMBERED:
            del self._taken[next(iter(self._taken))]
        self._taken[dispatch.epoch, dispatch.mission] = dispatch.sequence


def _check_state(latched: bool, running: str) -> Refused | None:
    if latched:
        return Refused("stopped", "the stop is latched; release it with crew reset")
    if running:
        return Refused("robot_busy", f"still busy with {running}")
    return None
