"""A child process whose behaviour a test chooses."""

import asyncio
import os
import signal
import threading

import msgspec

from crew.bus.link import Link
from crew.bus.port import Body, Qos, Sample
from crew.bus.zenoh import ZenohBus
from crew.errors import UsageError
from crew.process import ChildContext, run_child


class Behaviour(msgspec.Struct, frozen=True):
    """`does`: wait, stuck, never_ready, usage, bug, exit, nonsense or echo."""

    does: str = "wait"
    endpoint: str = ""


async def main(context: ChildContext) -> None:
    behaviour = context.spec(Behaviour)
    print(f"behaves as {behaviour.does}", flush=True)
    match behaviour.does:
        case "usage":
            raise UsageError("crew.yaml:3:1: unknown robot 'irsi'; did you mean 'iris'?")
        case "bug":
            raise ZeroDivisionError("a bug")
        case "never_ready":
            print("still waiting for the vehicle", flush=True)
            await forever()
        case "exit":
            context.ready()
            os.kill(os.getpid(), signal.SIGKILL)
        case "nonsense":
            context._control.sendall(b"{]\n")
            await forever()
        case "stuck":
            context.ready()
            threading.Event().wait()
        case "echo":
            await echo(context, behaviour.endpoint)
        case _:
            context.ready()
            await forever()


async def echo(context: ChildContext, endpoint: str) -> None:
    async with ZenohBus(Link(role="echo", endpoint=endpoint)) as bus:

        async def answer(question: Sample) -> Body:
            return question.payload, question.encoding

        def back(sample: Sample) -> None:
            bus.put("crew/t/pong", (sample.payload, sample.encoding), qos=Qos.ACTUATION)

        bus.queryable("crew/t/echo", answer)
        bus.on_sample("crew/t/ping", back)
        bus.token("crew/t/echo/alive")
        context.ready()
        await forever()


async def forever() -> None:
    await asyncio.get_running_loop().create_future()


if __name__ == "__main__":
    run_child(main)
