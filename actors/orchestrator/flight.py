"""Dispatches in flight: intent first, then the message, then bounded waits for the robot's word and for the effect."""

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any

from crew.actors.orchestrator.judge import Judge
from crew.actors.orchestrator.lease import LeaseTable
from crew.actors.orchestrator.ledger import Ledger
from crew.actors.orchestrator.world import WorldFold
from crew.bus.port import Bus, Qos
from crew.clock import WALL, Clock, seconds_ns, within
from crew.contracts.mission import event as ev
from crew.contracts.mission.record import find
from crew.contracts.mission_state import MissionState
from crew.contracts.plan import digest
from crew.contracts.site import Rules
from crew.errors import JournalError
from crew.journal import Ticket
from crew.keys import CANCEL, Keys, is_chunk
from crew.messages import CancelSkill, Dispatch, RobotEvent
from crew.permit import permit
from crew.signing import SigningKey

ANSWER_S = 2.0
"""Wall time for a robot to say that it took a dispatch; silence is an unknown outcome."""
EXPIRES_S = 2.0
"""Mission time after which a robot refuses a dispatch that arrives late."""
GRACE_S = 15.0
"""Mission time beyond a skill's own timeout before its outcome counts as unknown."""
CANCEL_S = 30.0

Feed = Callable[[str, ev.AnyEvent], None]
Spawn = Callable[[str, Coroutine[Any, Any, None]], None]


class Flight:
    """One dispatch between its decision and its end."""

    def __init__(self, dispatch: Dispatch) -> None:
        self.dispatch = dispatch
        self.answered = asyncio.Event()
        self.ended = asyncio.Event()
        self.void = False


class Dispatcher:
    """The only code of the project that puts on actuation keys."""

    def __init__(
        self,
        bus: Bus,
        keys: Keys,
        clock: Clock,
        ledger: Ledger,
        world: WorldFold,
        leases: LeaseTable,
        rules: Rules,
        epoch: int,
        key: SigningKey,
        feed: Feed,
        spawn: Spawn,
    ) -> None:
        self._bus, self._keys, self._clock = bus, keys, clock
        self._ledger, self._world, self._leases, self._rules = ledger, world, leases, rules
        self._epoch, self._key, self._feed, self._spawn = epoch, key, feed, spawn
        self._flights: dict[tuple[str, int], Flight] = {}

    def send(self, mission: MissionState, effect: ev.Send) -> None:
        """Write the intent; the message follows once the intent is committed."""
        dispatch = self._dispatch(mission, effect)
        ticket = self._ledger.intent(dispatch)
        flight = self._flights[mission.id, effect.sequence] = Flight(dispatch)
        self._spawn(mission.id, self._deliver(flight, ticket))

    def _unaddressable(self, dispatch: Dispatch) -> str:
        """Why a call that no gate has looked at has no key to be put on; empty for one that has."""
        if dispatch.robot not in self._world.cards:
            return "unknown_robot"
        return "" if is_chunk(dispatch.skill) and dispatch.skill != CANCEL else "unknown_skill"

    def cancel(self, mission: MissionState, effect: ev.CancelRunning) -> None:
        """Ask a robot to end a dispatch. One that was not put yet is never put."""
        flight = self._flights.get((mission.id, effect.sequence))
        if flight is None:
            return
        flight.void = True
        self._put_cancel(effect.robot, mission.id, effect.sequence)
        self._spawn(mission.id, self._await_cancelled(flight))

    def end_orphan(self, robot: str, running: str) -> None:
        """Cancel what a robot still carries out for a mission that is over: nobody waits for its end."""
        mission, _, sequence = running.rpartition("/")
        if sequence.isdecimal():
            self._put_cancel(robot, mission, int(sequence))

    def _put_cancel(self, robot: str, mission: str, sequence: int) -> None:
        boot_id = self._world.cards[robot].boot_id
        message = CancelSkill(mission=mission, sequence=sequence, robot=robot, epoch=self._epoch, boot_id=boot_id)
        signed = permit(message, self._keys.crew, self._key)
        self._bus.put(self._keys.act_cancel(robot), signed, qos=Qos.ACTUATION)

    def hear(self, event: RobotEvent) -> None:
        """A robot's word on a dispatch of ours: only its own robot and boot count."""
        flight = self._flights.get((event.mission, event.sequence))
        if flight is None or event.robot != flight.dispatch.robot or event.boot_id != flight.dispatch.boot_id:
            return
        flight.answered.set()
        at_ns = self._clock.now_ns()
        if event.what == "accepted":
            self._feed(event.mission, ev.Accepted(at_ns=at_ns, sequence=event.sequence))
            return
        if event.what in ("succeeded", "failed", "cancelled", "refused"):
            self._end(flight, event.what, event.code, event.detail)

    def lose(self, robot: str, why: str, code: str = "robot_lost") -> None:
        """A robot can't be reached: what it was doing has an unknown outcome."""
        for flight in list(self._flights.values()):
            if flight.dispatch.robot == robot:
                self._end(flight, "unknown", code, why)

    def forget(self, mission: str) -> None:
        """A mission has ended."""
        for key in [key for key in self._flights if key[0] == mission]:
            del self._flights[key]

    async def watch_effect(self, mission: Callable[[], MissionState], sequence: int, judge: Judge) -> None:
        """Feed the effect as seen once telemetry shows it, or the step as failed if it does not in time."""
        subject = mission().id
        missing = await judge.wait(mission, f"effect:{sequence}")
        at_ns = self._clock.now_ns()
        if not missing:
            self._feed(subject, ev.EffectSeen(at_ns=at_ns, sequence=sequence))
            return
        self._feed(
            subject,
            ev.Outcome(at_ns=at_ns, sequence=sequence, result="failed", code="effect_not_observed", detail=missing),
        )

    async def _deliver(self, flight: Flight, ticket: Ticket) -> None:
        dispatch = flight.dispatch
        with self._clock.busy():
            try:
                await ticket.committed()
            except JournalError as error:
                self._end(flight, "failed", "journal_failed", f"not sent: {error}")
                return
            if flight.void:
                self._end(flight, "cancelled", "cancelled", "not sent: the mission ended before")
                return
            if code := self._unaddressable(dispatch):
                self._end(flight, "refused", code, f"nobody can perform {dispatch.robot}.{dispatch.skill}")
                return
            self._bus.put(self._keys.act(dispatch.robot, dispatch.skill), dispatch, qos=Qos.ACTUATION)
            answered = await WALL.race(flight.answered.wait(), ANSWER_S)
        if not answered:
            self._end(flight, "unknown", "no_answer", f"{dispatch.robot} did not answer within {ANSWER_S:g} s")
            return
        try:
            await within(self._clock, self._limit_s(dispatch), flight.ended.wait())
        except TimeoutError:
            self._end(flight, "unknown", "timeout", f"no outcome within {self._limit_s(dispatch):g} s")

    async def _await_cancelled(self, flight: Flight) -> None:
        try:
            await within(self._clock, CANCEL_S, flight.ended.wait())
        except TimeoutError:
            self._end(flight, "unknown", "timeout", f"not cancelled within {CANCEL_S:g} s")

    def _end(self, flight: Flight, result: str, code: str, detail: str) -> None:
        if flight.ended.is_set():
            return
        flight.answered.set()
        flight.ended.set()
        dispatch = flight.dispatch
        self._feed(
            dispatch.mission,
            ev.Outcome(at_ns=self._clock.now_ns(), sequence=dispatch.sequence, result=result, code=code, detail=detail),
        )

    def _limit_s(self, dispatch: Dispatch) -> float:
        kind = self._rules.kind_of(dispatch.robot)
        skill = None if kind is None else kind.skill(dispatch.skill)
        return GRACE_S + (0.0 if skill is None else skill.timeout_s)

    def _dispatch(self, mission: MissionState, effect: ev.Send) -> Dispatch:
        assert mission.instance is not None
        found = find(mission, effect.sequence)
        assert found is not None
        issued_ns = found[1].dispatched_ns
        contract = self._rules.contracts[mission.instance.contract]
        card = self._world.cards.get(effect.call.robot)
        unsigned = Dispatch(
            mission=mission.id,
            step=effect.step,
            purpose="safe" if effect.step.startswith("safe:") else "execute",
            sequence=effect.sequence,
            robot=effect.call.robot,
            skill=effect.call.skill,
            args=effect.call.args,
            places=effect.places,
            epoch=self._epoch,
            lease=mission.id,
            fence=self._leases.number(mission.id),
            boot_id=card.boot_id if card is not None else "",
            issued_ns=issued_ns,
            expires_ns=issued_ns + seconds_ns(EXPIRES_S),
            args_digest=digest(dict(effect.call.args)),
            plan_digest=digest(mission.plan),
            contract_digest=contract.digest,
            request_id=mission.request_id,
            approval=effect.approval,
        )
        return permit(unsigned, self._keys.crew, self._key)
