"""Whether a command may run here: its permit, then the robot's own second check, independent of the gate. Pure."""

import msgspec

from crew.contracts.gate.arguments import check_call
from crew.contracts.plan import Call, digest
from crew.contracts.site import Rules
from crew.messages import CancelSkill, Dispatch
from crew.permit import permit_problem

MAX_REMEMBERED = 4096
"""Missions whose sequences are remembered; older ones have expired long before they are forgotten."""
FUTURE_S = 1.0
"""How far ahead of this robot's clock a command may have been issued."""


class Refused(msgspec.Struct, frozen=True):
    """Why a command was not taken, for the event and for people."""

    code: str
    detail: str
    rightful: bool = False
    """The orchestrator's own word, heard for the first time: the refusal answers it."""


class _Heard(msgspec.Struct):
    """The sequences of one mission in one epoch that were heard."""

    sequences: set[int]
    last: int = 0

    def spend(self, sequence: int) -> None:
        self.sequences.add(sequence)
        self.last = max(self.last, sequence)


class Admission:
    """What this robot remembers about commands: its boot, the newest epoch and lease, every sequence that it heard."""

    def __init__(
        self, robot: str, boot_id: str, rules: Rules, orchestrator_key: bytes, *, second_check: bool = True
    ) -> None:
        self.epoch = 0
        self.refused_permits = 0
        self._robot, self._boot_id, self._rules = robot, boot_id, rules
        self._key = orchestrator_key
        self._second_check = second_check
        self._contracts = {contract.digest for contract in rules.contracts.values()}
        self._fence = 0
        self._spent: dict[tuple[int, str], _Heard] = {}

    def hear_epoch(self, epoch: int) -> None:
        """An orchestrator with this epoch lives; commands of older ones are refused from now on."""
        if epoch > self.epoch:
            self.epoch, self._fence = epoch, 0

    def admit(self, dispatch: Dispatch, now_ns: int, *, latched: bool, running: str) -> Refused | None:
        """None takes the dispatch. Its permit is spent by the first hearing, taken or not; a forgery spends nothing."""
        refused = self._check_sender(dispatch) or self._check_once(dispatch)
        if refused is not None:
            self.refused_permits += 1
            return refused
        self.hear_epoch(dispatch.epoch)
        self._heard(dispatch).spend(dispatch.sequence)
        refused = (
            self._check_lease(dispatch)
            or _check_time(dispatch, now_ns)
            or self._check_call(dispatch)
            or _check_state(latched, running)
        )
        if refused is None:
            self._fence = dispatch.fence
            return None
        return Refused(refused.code, refused.detail, rightful=True)

    def admit_cancel(self, cancel: CancelSkill) -> Refused | None:
        """None if the orchestrator ends this dispatch; one that was not heard yet will not run any more."""
        refused = self._check_sender(cancel)
        if refused is not None:
            self.refused_permits += 1
            return refused
        self._heard(cancel).spend(cancel.sequence)
        return None

    def _check_sender(self, command: Dispatch | CancelSkill) -> Refused | None:
        problem = permit_problem(command, self._rules.crew.name, self._key)
        if problem is not None:
            return Refused(problem.code, problem.detail)
        if command.robot != self._robot:
            return Refused("wrong_robot", f"addressed to {command.robot}, this is {self._robot}")
        if command.boot_id != self._boot_id:
            return Refused("old_boot", f"meant for boot {command.boot_id}, this is boot {self._boot_id}")
        if command.epoch < self.epoch:
            return Refused("old_epoch", f"epoch {command.epoch} is over, the orchestrator's epoch is {self.epoch}")
        return None

    def _check_once(self, dispatch: Dispatch) -> Refused | None:
        heard = self._heard(dispatch)
        if dispatch.sequence in heard.sequences:
            return Refused("replayed", f"sequence {dispatch.sequence} of {dispatch.mission} was heard before")
        if dispatch.sequence < heard.last:
            return Refused("reordered", f"sequence {dispatch.sequence} of {dispatch.mission} came after {heard.last}")
        return None

    def _check_lease(self, dispatch: Dispatch) -> Refused | None:
        if dispatch.fence < self._fence:
            return Refused(
                "old_lease", f"lease {dispatch.fence} of {dispatch.lease} is over, lease {self._fence} holds"
            )
        return None

    def _check_call(self, dispatch: Dispatch) -> Refused | None:
        if digest(dict(dispatch.args)) != dispatch.args_digest:
            return Refused("altered", "the arguments do not match their digest")
        if not self._second_check:
            return None
        if dispatch.contract_digest not in self._contracts:
            shown = dispatch.contract_digest[:12]
            return Refused("unknown_contract", f"decided by a contract {shown!r} that this robot was not started with")
        refusal = check_call(Call(dispatch.robot, dispatch.skill, dispatch.args), self._rules)
        return None if refusal is None else Refused(refusal.code, refusal.message)

    def _heard(self, command: Dispatch | CancelSkill) -> _Heard:
        """What is remembered of a rightful command's mission; the oldest mission makes room for a new one."""
        key = (command.epoch, command.mission)
        if (known := self._spent.get(key)) is not None:
            return known
        if len(self._spent) >= MAX_REMEMBERED:
            del self._spent[next(iter(self._spent))]
        return self._spent.setdefault(key, _Heard(set()))


def _check_time(dispatch: Dispatch, now_ns: int) -> Refused | None:
    late_s, early_s = (now_ns - dispatch.expires_ns) / 1e9, (dispatch.issued_ns - now_ns) / 1e9
    if late_s > 0:
        return Refused("expired", f"expired {late_s:.2f} s ago; nothing old is carried out")
    if early_s > FUTURE_S:
        detail = f"issued {early_s:.1f} s in this robot's future, at most {FUTURE_S:g} s; set both machines' clocks"
        return Refused("clock_skew", detail)
    return None


def _check_state(latched: bool, running: str) -> Refused | None:
    if latched:
        return Refused("stopped", "the stop is latched; release it with crew reset")
    if running:
        return Refused("robot_busy", f"still busy with {running}")
    return None
