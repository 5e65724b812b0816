"""One robot on the bus: takes dispatches that pass its own check, runs them on its adapter, tells what it sees."""

import asyncio
import secrets

import msgspec

from crew.access import ACTUATION
from crew.actors.robot.admission import Admission, Refused
from crew.actors.robot.lost import OrchestratorWatch
from crew.actors.robot.neighbours import Neighbours
from crew.actors.robot.report import Reporter
from crew.actors.robot.stop import StopSwitch
from crew.adapter import Adapter, Place
from crew.bus.port import Bus
from crew.clock import WALL, Clock, within
from crew.contracts.gate.guard import Scope
from crew.contracts.mission.effect import unseen_effect
from crew.contracts.mission_state import StepRecord
from crew.contracts.plan import Call
from crew.contracts.site import RobotSpec, Rules
from crew.contracts.skill import Kind, Skill
from crew.errors import AdapterError, Latched
from crew.keys import Keys
from crew.mailbox import CommandRefusal, Commands, Letter, letters
from crew.messages import CancelSkill, Dispatch
from crew.wire import Message

COMMAND_CAPACITY = 8
COMMAND_MAX_AGE_S = 2.0
CONNECT_RETRY_S = 2.0
CONFIRM_S = 3.0
"""How long the effect of a skill may take to show in telemetry after the adapter says that it is done."""
CANCEL_S = 20.0
SAFE_TRIES = 5
SAFE_RETRY_S = 1.0
"""Wall time before a safe behaviour that failed is tried again; telemetry may have been late."""
SUPERSEDED = ("cancelled", "stopped")
"""Codes of a safe behaviour that ended because another one took over."""


class RobotActor:
    """Owns one adapter. `run()` lives until it is cancelled; everything that it starts ends with it."""

    def __init__(
        self,
        bus: Bus,
        keys: Keys,
        spec: RobotSpec,
        rules: Rules,
        adapter: Adapter,
        clock: Clock,
        operator_key: bytes,
        orchestrator_key: bytes,
        *,
        enforced: bool = True,
    ) -> None:
        kind = rules.kind_of(spec.name)
        assert kind is not None, "the crew file was checked against the kinds"
        self.name = spec.name
        self.kind: Kind = kind
        self.boot_id = secrets.token_hex(8)
        self.admission = Admission(spec.name, self.boot_id, rules, orchestrator_key, second_check=enforced)
        self._enforced = enforced
        self.running = ""
        self._bus, self._keys, self._rules = bus, keys, rules
        self._adapter, self._clock = adapter, clock
        self._skill: Skill | None = None
        self._task: asyncio.Task[None] | None = None
        self._begun = False
        self._ending = ""
        self._problem = "connecting to the vehicle"
        self.report = Reporter(bus, keys, spec, self, adapter, clock)
        self._stop = StopSwitch(bus, keys, self, adapter, operator_key)
        self._watch = OrchestratorWatch(bus, keys, self, self._stop, orchestrator_key)
        self._neighbours = Neighbours(bus, keys, spec.name, rules, adapter)
        self._commands: Commands[Letter[Message]] = Commands(
            letters(Dispatch, CancelSkill),
            capacity=COMMAND_CAPACITY,
            max_age_s=COMMAND_MAX_AGE_S,
            on_refused=self._command_refused,
        )
        self._declared = [
            bus.subscribe(keys.acts(spec.name), self._commands, remote_only=True),
            bus.token(keys.alive(spec.name)),
        ]

    @property
    def idle(self) -> bool:
        """Nothing is going on: the simulation need not hurry."""
        return not self.running and not self._problem and not self.making_safe

    @property
    def making_safe(self) -> bool:
        """A declared behaviour, of a stop or of a lost orchestrator, is under way: the robot may move yet."""
        return self._stop.acting or self._watch.acting

    @property
    def latch(self) -> str:
        """Names the newest stop that this boot has heard."""
        return self._stop.latch

    @property
    def told(self) -> tuple[int, int]:
        """Epoch and number of the newest stop that a heartbeat has told of."""
        return self._stop.told

    @property
    def unavailable(self) -> str:
        """Empty if the robot can take a skill, otherwise the reason in a few words."""
        return self._problem or self._watch.problem or self._adapter.health()

    @property
    def dropped(self) -> int:
        """Messages that were dropped since this robot began: unreadable, too late, or too many at once."""
        unreadable = (self._commands.refusals, self._stop.refusals, self._watch.refusals)
        return self.report.dropped_commands + sum(counter.total() for counter in unreadable)

    def behaviour(self, what: str) -> str:
        """What the running skill declares for `on_stop` or `on_link_loss`; the kind's own when nothing runs."""
        holder = self._skill or self.kind
        name = what if self._skill is not None else f"idle_{what}"
        return str(getattr(holder, name))

    async def run(self) -> None:
        """Connect, then serve until cancelled."""
        try:
            async with asyncio.TaskGroup() as group:
                group.create_task(self.report.run())
                group.create_task(self._connect())
                group.create_task(self._stop.run())
                group.create_task(self._watch.run())
                group.create_task(self._neighbours.run())
                await self._commands.each(lambda letter: self._handle(letter.message, group))
        finally:
            for declaration in self._declared:
                declaration.close()
            await self._adapter.close()

    async def interrupt(self, code: str) -> None:
        """End the running skill from within (a stop, a lost orchestrator); its outcome carries `code`."""
        if (task := self._task) is not None:
            self._end_running(code)
            await asyncio.wait({task})

    async def make_safe(self, behaviour: str) -> None:
        """Carry out a declared behaviour on the adapter; a failure is reported and tried again, never raised."""
        for tries in range(SAFE_TRIES):
            if tries:
                await WALL.sleep(SAFE_RETRY_S)
            try:
                await self._adapter.safe(behaviour)
                return
            except AdapterError as error:
                if error.code in SUPERSEDED:
                    return
                self.report.event("safe_failed", code=error.code, detail=f"{behaviour}: {error}")

    async def _connect(self) -> None:
        while True:
            try:
                await self._adapter.connect()
            except AdapterError as error:
                self._problem = str(error)
                self.report.state()
                await WALL.sleep(CONNECT_RETRY_S)
                continue
            self._problem = ""
            self._stop.again()
            self.report.values()  # before it counts as there: the first plan may need them
            self.report.event("ready")
            self.report.state()
            return

    def _command_refused(self, refusal: CommandRefusal) -> None:
        self.report.dropped(refusal.why)

    def _handle(self, message: Message, group: asyncio.TaskGroup) -> None:
        if isinstance(message, CancelSkill):
            self._cancel(message)
        elif isinstance(message, Dispatch):
            self._dispatch(message, group)

    def _dispatch(self, dispatch: Dispatch, group: asyncio.TaskGroup) -> None:
        refused = self.admission.admit(
            dispatch, self._clock.now_ns(), latched=self._adapter.latched, running=self.running
        )
        refused = refused or self._unfit(dispatch)
        if refused is not None:
            self._say_refused(dispatch, refused)
            return
        self.running = f"{dispatch.mission}/{dispatch.sequence}"
        self._skill = self.kind.skill(dispatch.skill)
        self.report.of(dispatch, "accepted")
        self._begun, self._ending = False, ""
        self._task = group.create_task(self._carry_out(dispatch))

    def _unfit(self, dispatch: Dispatch) -> Refused | None:
        """Why the robot takes nothing now. Unenforced it takes whatever it has a skill for while it has a vehicle."""
        problem = self.unavailable if self._enforced else self._problem or self._watch.problem
        if problem:
            return Refused("robot_unavailable", problem, rightful=True)
        if self.kind.skill(dispatch.skill) is None:
            return Refused("unknown_skill", f"{self.name} has no skill {dispatch.skill}", rightful=True)
        return None

    def _say_refused(self, dispatch: Dispatch, refused: Refused) -> None:
        """Answer the orchestrator's own dispatch; tell operators of any other, which is no word about a mission."""
        if refused.rightful:
            self.report.of(dispatch, "refused", refused.code, refused.detail)
        else:
            self._say_permit_refused(dispatch, dispatch.skill, refused)

    def _say_permit_refused(self, command: Dispatch | CancelSkill, what: str, refused: Refused) -> None:
        detail = f"{what} {command.sequence} of {command.mission} in epoch {command.epoch}: {refused.detail}"
        self.report.permit_refused(ACTUATION, refused.code, detail)

    def _cancel(self, cancel: CancelSkill) -> None:
        refused = self.admission.admit_cancel(cancel)
        if refused is not None:
            self._say_permit_refused(cancel, "cancel", refused)
        elif self.running == f"{cancel.mission}/{cancel.sequence}":
            self._end_running("cancelled")

    def _end_running(self, code: str) -> None:
        """Ask the running skill to end, once: a second cancel would cut off the braking and the report of the first."""
        if self._task is None or self._ending:
            return
        self._ending = code
        if self._begun:
            self._task.cancel(code)

    async def _carry_out(self, dispatch: Dispatch) -> None:
        """Run one skill to its end and report it. Being cancelled stops the vehicle first."""
        what, code, detail = "succeeded", "", ""
        try:
            if self._ending:
                what, code, detail = "cancelled", self._ending, "before it began"
            else:
                self._begun = True
                await self._execute(dispatch)
        except Latched as error:
            what, code, detail = "cancelled", error.code, str(error)
        except AdapterError as error:
            what, code, detail = "failed", error.code, str(error)
        except TimeoutError as error:
            what, code, detail = "failed", "timeout", str(error)
            self._ending = code
            await self._halt_motion()
        except asyncio.CancelledError as error:
            reason = str(error.args[0]) if error.args else ""
            if not reason:
                raise
            _uncancel()
            what, code, detail = "cancelled", reason, await self._halt_motion()
        finally:
            self.running, self._skill, self._task = "", None, None
        self.report.values()
        self.report.state()
        self.report.of(dispatch, what, code, detail)

    async def _execute(self, dispatch: Dispatch) -> None:
        skill = self._skill
        assert skill is not None, "an unknown skill was refused"
        try:
            args = msgspec.convert(dict(dispatch.args), skill.args)
        except msgspec.ValidationError as error:
            raise AdapterError(f"{skill.name} can't be called so: {error}", code="bad_argument") from error
        places = {name: self._place(dispatch, name) for name in dispatch.places}
        await within(self._clock, skill.timeout_s, self._adapter.execute(skill.name, args, places))
        self.report.values(skill.reports)
        await self._confirm(dispatch)

    def _place(self, dispatch: Dispatch, argument: str) -> Place:
        """The point that was pinned at dispatch, with the distance to keep from what is there."""
        point = dispatch.places[argument]
        symbol = dispatch.args.get(argument)
        value = self._rules.crew.value(symbol) if isinstance(symbol, str) else None
        return Place(point.x, point.y, point.z, 0.0 if value is None else value.standoff_m)

    async def _confirm(self, dispatch: Dispatch) -> None:
        """Success is what telemetry shows: every declared effect, observed since the dispatch was issued."""
        record = StepRecord(
            call=Call(dispatch.robot, dispatch.skill, dispatch.args),
            dispatched_ns=dispatch.issued_ns,
            places=dispatch.places,
        )
        deadline_ns = self._clock.now_ns() + round(CONFIRM_S * 1e9)
        while missing := unseen_effect(record, self._scope(record)):
            if self._clock.now_ns() >= deadline_ns:
                raise AdapterError(
                    f"the effect of {dispatch.skill} was not observed: {missing}", code="effect_not_observed"
                )
            await self._clock.sleep(0.05)

    def _scope(self, record: StepRecord) -> Scope:
        pins = {str(record.call.args[name]): point for name, point in record.places.items()}
        now_ns = self._clock.now_ns()
        return Scope(rules=self._rules, world=self.report.snapshot(), now_ns=now_ns, pins=pins)

    async def _halt_motion(self) -> str:
        """Stop the vehicle after an interrupted skill; what went wrong with that, if anything."""
        if self._adapter.latched:
            return ""
        try:
            await within(self._clock, CANCEL_S, self._adapter.cancel())
        except (AdapterError, TimeoutError) as error:
            return f"it may still be moving: {error}"
        return ""


def _uncancel() -> None:
    """This task asked for the cancellation itself and goes on to report it."""
    task = asyncio.current_task()
    assert task is not None
    task.uncancel()
