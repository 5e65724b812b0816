"""The gateway's process: takes requests by put and by query, gives each a mission id, and hands them on."""

import secrets

import msgspec

from crew.actors.gateway.request import Unreadable, read_body
from crew.actors.specs import GatewaySpec
from crew.bus.port import Body, Bus, Qos, Sample
from crew.bus.zenoh import ZenohBus
from crew.errors import UsageError
from crew.keys import Keys
from crew.mailbox import Events, raw
from crew.messages import Intake, MissionEvent
from crew.process import ChildContext, run_child
from crew.wire import encode_json

UNREADABLE = "unreadable_request"


class Gateway:
    """Where people come in. It decides nothing; it only refuses what is no request at all."""

    def __init__(self, bus: Bus, keys: Keys) -> None:
        self._bus, self._keys = bus, keys
        self._puts: Events[Sample] = Events(raw, capacity=64, on_lost=lambda _: None)
        bus.subscribe(keys.request, self._puts)
        bus.queryable(keys.request, self._answer)

    async def run(self) -> None:
        """Serve until cancelled."""
        async for sample in self._puts:
            self._take(sample)

    async def _answer(self, query: Sample) -> Body:
        mission, problem = self._take(query)
        if problem:
            raise UsageError(problem)
        return msgspec.json.encode({"mission": mission}), "application/json"

    def _take(self, sample: Sample) -> tuple[str, str]:
        """The new mission's id, and what is wrong with the request, if anything."""
        mission = f"m{secrets.token_hex(4)}"
        body = read_body(sample.payload, sample.encoding)
        if isinstance(body, Unreadable):
            self._reject(mission, body)
            return mission, body.reason
        intake = Intake(mission=mission, request_id=body.request_id, text=body.text)
        self._bus.put(self._keys.intake, intake, qos=Qos.EVENT)
        return mission, ""

    def _reject(self, mission: str, problem: Unreadable) -> None:
        event = MissionEvent(
            mission=mission,
            request_id=problem.request_id,
            number=1,
            at_s=0.0,
            phase="rejected",
            what="end",
            text=f"rejected: {problem.reason}",
            code=UNREADABLE,
            outcome="rejected",
            final=True,
        )
        self._bus.put(self._keys.mission_event(mission), encode_json(event), qos=Qos.EVENT)


async def main(context: ChildContext) -> None:
    """Serve until asked to stop."""
    spec = context.spec(GatewaySpec)
    async with ZenohBus(spec.link) as bus:
        await serve(spec.crew, bus, context)


async def serve(crew: str, bus: Bus, context: ChildContext) -> None:
    """Serve on a bus that is already there."""
    keys = Keys(crew)
    gateway = Gateway(bus, keys)
    token = bus.token(keys.alive("gateway"))
    context.ready()
    try:
        await gateway.run()
    finally:
        token.close()


if __name__ == "__main__":
    run_child(main)
