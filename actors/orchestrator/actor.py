"""The orchestrator on the bus: what it hears, what it answers, and the heartbeat that says that its loop turns."""

import asyncio
from collections import Counter
from collections.abc import Coroutine
from typing import Any

from crew.actors.orchestrator.announcer import Announcer
from crew.actors.orchestrator.flight import Dispatcher
from crew.actors.orchestrator.hold import StopHold
from crew.actors.orchestrator.lease import LeaseTable
from crew.actors.orchestrator.ledger import Ledger
from crew.actors.orchestrator.planning import PlannerDesk
from crew.actors.orchestrator.shell import MissionShell, is_idle
from crew.actors.orchestrator.telling import mission_status
from crew.actors.orchestrator.watch import CrewWatch
from crew.actors.orchestrator.world import WorldFold
from crew.bus.port import Body, Bus, Sample
from crew.clock import Clock
from crew.contracts.decision import Authorizer
from crew.contracts.language.lexicon import build_lexicon
from crew.contracts.language.reading import prepared, read_request
from crew.contracts.mission import event as ev
from crew.contracts.mission_state import MissionState
from crew.contracts.site import Rules
from crew.keys import Keys, is_chunk
from crew.mailbox import Events, KeepLatest, Letter, Mailbox, letters
from crew.messages import (
    ANSWER,
    Answer,
    CancelMission,
    CrewStatus,
    Intake,
    RobotCard,
    RobotEvent,
    RobotState,
    RobotValue,
)
from crew.signing import SigningKey, verify
from crew.wire import Message

MAX_OPEN = 16
MAX_NAME = 80
"""Characters of the name that an answer may be kept under."""
EVENTS_CAPACITY = 4096


class Orchestrator:
    """The only actor that may actuate. `run()` lives until it is cancelled or its journal fails."""

    def __init__(
        self,
        bus: Bus,
        keys: Keys,
        rules: Rules,
        clock: Clock,
        ledger: Ledger,
        authorizer: Authorizer,
        *,
        epoch: int,
        run: str,
        key: SigningKey,
        operator_key: bytes,
        hold: StopHold,
    ) -> None:
        self._operator_key = operator_key
        self._bus, self._keys, self._rules, self._clock = bus, keys, rules, clock
        self._ledger, self._epoch, self._run = ledger, epoch, run
        self._lexicon = prepared(build_lexicon(rules))
        self._world, self._leases = WorldFold(rules, hold), LeaseTable()
        self._announcer = Announcer(bus, keys, rules, clock)
        self._tasks: dict[str, set[asyncio.Task[None]]] = {}
        self._boxes: list[Mailbox[Any]] = []
        self._lost_messages: Counter[str] = Counter()
        self._group: asyncio.TaskGroup
        self.shell = MissionShell(
            rules,
            clock,
            self._world,
            self._leases,
            ledger,
            authorizer,
            self._announcer,
            lambda mission, effect: self._desk.ask(mission, effect),
            self._spawn,
            self._end_tasks,
        )
        self._desk = PlannerDesk(
            bus, keys, clock, rules, self._world, self._leases, self.shell.feed, self._spawn, ledger.note
        )
        self.shell.dispatcher = Dispatcher(
            bus, keys, clock, ledger, self._world, self._leases, rules, epoch, key, self.shell.feed, self._spawn
        )

        self._watch = CrewWatch(bus, keys, rules, self._world, ledger, self.shell, epoch, key)

    @property
    def idle(self) -> bool:
        """No mission is under way, or all of them wait for a person."""
        return all(is_idle(m) for m in self.shell.open)

    async def run(self) -> None:
        """Serve until cancelled."""
        keys, bus = self._keys, self._bus
        robots: KeepLatest[Letter[Message]] = KeepLatest(letters(RobotState, RobotCard))
        values = self._events(RobotValue)
        events = self._events(RobotEvent)
        people = self._events(Intake, Answer, CancelMission)
        bus.subscribe(keys.robot_states, robots)
        bus.subscribe(keys.robot_cards, robots)
        bus.subscribe(keys.robot_values, values)
        bus.subscribe(keys.robot_events, events)
        for key in (keys.intake, keys.mission_confirms, keys.mission_cancels):
            bus.subscribe(key, people)
        bus.watch_liveliness(keys.all_alive, self._on_liveliness)
        bus.queryable(keys.status, self._status)
        self._boxes += [robots, self._desk.box]
        async with asyncio.TaskGroup() as self._group:
            self._group.create_task(self._hear_robots(robots))
            self._group.create_task(self._hear_values(values))
            self._group.create_task(events.each(self._hear_event))
            self._group.create_task(self._hear_people(people))
            self._group.create_task(self._desk.run())
            self._group.create_task(self._watch.run())

    # --- hearing

    async def _hear_robots(self, box: KeepLatest[Letter[Message]]) -> None:
        """States and cards in the order in which they came: a state counts for nothing before its robot's card."""
        async for letter in box:
            match letter.message:
                case RobotState() as state if self._own(letter, state.robot):
                    self._world.take_state(state, self._clock.now_ns())
                    self._watch.lift_stop()
                case RobotCard() as card if self._own(letter, card.robot) and self._world.take_card(card):
                    self._ledger.note("reboot", f"{card.robot} has started anew")
                    self.shell.dispatcher.lose(card.robot, f"{card.robot} has started anew")

    async def _hear_values(self, box: Events[Letter[RobotValue]]) -> None:
        async for letter in box:
            value = letter.message
            if not self._own(letter, value.robot):
                continue
            if not self._world.take_value(value, self._clock.now_ns()):
                self._ledger.note("value_refused", f"{value.robot} may not publish {value.reading.name}")
                continue
            for mission in self.shell.open:
                if mission.instance is not None and value.robot in mission.instance.roles.values():
                    self._announcer.value(mission, value.reading, value.robot)

    def _hear_event(self, letter: Letter[RobotEvent]) -> None:
        event = letter.message
        if not self._own(letter, event.robot):
            return
        self._world.take_event(event)
        if event.mission:
            self.shell.dispatcher.hear(event)
        else:
            self._ledger.note(event.what, f"{event.robot}: {event.what} {event.detail}".strip())

    def _own(self, letter: Letter[Any], robot: str) -> bool:
        """Whether a robot speaks of itself on a key of its own; counted as foreign if not."""
        own = self._world.knows(robot) and self._keys.name_in(letter.key) == robot
        if not own:
            self._lost_messages["foreign"] += 1
        return own

    async def _hear_people(self, box: Events[Letter[Message]]) -> None:
        async for letter in box:
            mission = letter.key.split("/")[3] if "/mission/" in letter.key else ""
            match letter.message:
                case Intake() as intake:
                    self._take_request(intake)
                case Answer() as answer:
                    self._take_answer(mission, answer)
                case CancelMission() as cancel:
                    self.shell.cancel(mission, by=cancel.by or "a person")

    def _take_answer(self, mission: str, answer: Answer) -> None:
        """Only the operator's signature approves a step; a question about the plan takes any answer that comes here."""
        state, signature = self.shell.missions.get(mission), b""
        if state is not None and state.question is not None and state.question.step:
            if not self._is_operators(answer, mission):
                self._ledger.note("answer_refused", f"{mission}: an answer by {answer.by[:80]!r} without the signature")
                self._announcer.refused_answer(state)
                return
            signature = answer.signature
        at_ns, by = self._clock.now_ns(), answer.by[:MAX_NAME]
        answered = ev.Answered(at_ns=at_ns, token=answer.token, yes=answer.yes, by=by, signature=signature)
        self.shell.feed(mission, answered)

    def _is_operators(self, answer: Answer, mission: str) -> bool:
        """Whether the operator signed this answer to this mission, in a name that is kept whole."""
        part = answer.signed_part(self._keys.crew, mission)
        return len(answer.by) <= MAX_NAME and verify(self._operator_key, ANSWER, part, answer.signature)

    def _take_request(self, intake: Intake) -> None:
        if not is_chunk(intake.mission):
            self._lost_messages["foreign"] += 1
            return
        if intake.mission in self.shell.missions:
            return
        reading = read_request(intake.text, self._lexicon)
        mission = MissionState(
            id=intake.mission,
            request=intake.text,
            request_id=intake.request_id,
            reading=reading,
            epoch=self._epoch,
        )
        full = len(self.shell.open) >= MAX_OPEN
        self.shell.begin(mission)
        if full:
            self.shell.cancel(mission.id, by=f"the orchestrator: {MAX_OPEN} missions are open already")

    def _on_liveliness(self, key: str, alive: bool) -> None:
        name = self._keys.name_in(key)
        if name == "simulation":
            for spec in self._rules.crew.robots:
                self._world.take_liveliness(spec.name, alive)
        elif name == "planner":
            self._desk.planner_is_there(alive)
        elif self._world.knows(name):
            self._world.take_liveliness(name, alive)

    # --- telling

    async def _status(self, sample: Sample) -> Body:
        dropped: Counter[str] = Counter(self._lost_messages)
        for box in self._boxes:
            dropped.update({str(reason): count for reason, count in box.refusals.items()})
        dropped.update(self._world.dropped())
        return CrewStatus(
            crew=self._rules.crew.name,
            run=self._run,
            epoch=self._epoch,
            at_ns=self._clock.now_ns(),
            stopped=self._world.stopped,
            robots=self._world.status(self._leases.held),
            missions=tuple(
                mission_status(m, self._rules, self._leases, self._clock.now_ns()) for m in self.shell.missions.values()
            ),
            dropped=dict(dropped),
            stop=self._world.hold.status(self._world.still()) if self._world.hold.held else None,
        )

    # --- tasks

    def _events(self, *types: type[Any]) -> Events[Any]:
        name = types[0].__name__

        def lost(count: int) -> None:
            self._lost_messages[f"lost_{name}"] += count
            self._ledger.note("overflow", f"{count} messages of {name} were lost: too many at once")

        box: Events[Any] = Events(letters(*types), capacity=EVENTS_CAPACITY, on_lost=lost)
        self._boxes.append(box)
        return box

    def _spawn(self, mission: str, work: Coroutine[Any, Any, None]) -> None:
        task = self._group.create_task(work)
        self._tasks.setdefault(mission, set()).add(task)
        task.add_done_callback(self._tasks[mission].discard)

    def _end_tasks(self, mission: str) -> None:
        for task in self._tasks.pop(mission, set()):
            if task is not asyncio.current_task():
                task.cancel()
