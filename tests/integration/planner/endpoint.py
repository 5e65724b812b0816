"""A Messages API on a real socket that answers from a script, one entry a request, and remembers what it was asked."""

import asyncio
import json
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import Any

from crew.clock import WALL

HEADERS = {200: "OK", 401: "Unauthorized", 404: "Not Found", 429: "Too Many Requests", 500: "Internal Server Error"}


@dataclass
class Reply:
    """One scripted answer. `body` is sent as it is if it is bytes; `drop` closes the connection instead."""

    body: Any = b""
    status: int = 200
    headers: Mapping[str, str] = field(default_factory=dict)
    delay_s: float = 0.0
    drop: bool = False
    content_type: str = "application/json"


@dataclass
class Asked:
    """One request as it arrived."""

    path: str
    headers: Mapping[str, str]
    body: Mapping[str, Any]


class ScriptedApi:
    """Serves on loopback. The last reply is repeated; a request during a stream of several counts as one."""

    def __init__(self, replies: Sequence[Reply]) -> None:
        self._replies = list(replies)
        self.asked: list[Asked] = []
        self.url = ""
        self._over = asyncio.Event()
        self._handlers: set[asyncio.Task[None] | None] = set()

    async def close(self) -> None:
        self._over.set()
        await asyncio.gather(*(task for task in self._handlers if task is not None))

    async def handle(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._handlers.add(asyncio.current_task())
        try:
            if (asked := await _read(reader)) is not None:
                reply = self._replies[min(len(self.asked), len(self._replies) - 1)]
                self.asked.append(asked)
                over = await WALL.race(self._over.wait(), reply.delay_s)
                if over or reply.drop:
                    return
                await _write(writer, reply)
        except ConnectionError:
            return
        finally:
            writer.close()


@asynccontextmanager
async def scripted(*replies: Reply) -> AsyncIterator[ScriptedApi]:
    """A server for the time of the block."""
    api = ScriptedApi(replies)
    server = await asyncio.start_server(api.handle, "127.0.0.1", 0, limit=2**20)
    api.url = f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}"
    try:
        yield api
    finally:
        server.close()
        await api.close()


async def _read(reader: asyncio.StreamReader) -> Asked | None:
    try:
        head = (await reader.readuntil(b"\r\n\r\n")).decode()
    except asyncio.IncompleteReadError:
        return None
    first, *lines = head.split("\r\n")
    headers = {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines if line)}
    body = await reader.readexactly(int(headers.get("content-length", "0")))
    return Asked(first.split()[1], headers, json.loads(body or b"{}"))


async def _write(writer: asyncio.StreamWriter, reply: Reply) -> None:
    body = reply.body if isinstance(reply.body, bytes) else json.dumps(reply.body).encode()
    lines = [f"HTTP/1.1 {reply.status} {HEADERS.get(reply.status, 'Scripted')}"]
    lines += [f"content-type: {reply.content_type}", f"content-length: {len(body)}", "connection: close"]
    lines += [f"{name}: {value}" for name, value in reply.headers.items()]
    writer.write("\r\n".join([*lines, "", ""]).encode() + body)
    await writer.drain()


# --- what a model might answer


def tool_use(submitted: Any, name: str = "submit_plan", number: int = 1) -> dict[str, Any]:
    return {"type": "tool_use", "id": f"toolu_{number}", "name": name, "input": submitted}


def message(*content: Mapping[str, Any], stop_reason: str = "tool_use") -> dict[str, Any]:
    usage = {"input_tokens": 1200, "output_tokens": 150, "cache_read_input_tokens": 1000}
    return {
        "id": "msg_1",
        "type": "message",
        "role": "assistant",
        "model": "scripted",
        "content": list(content),
        "stop_reason": stop_reason,
        "stop_sequence": None,
        "usage": usage,
    }


def failure(kind: str, text: str) -> dict[str, Any]:
    return {"type": "error", "error": {"type": kind, "message": text}}


def streamed(submitted: Any) -> Reply:
    """A tool call in pieces, as server-sent events."""
    start: dict[str, Any] = {
        "type": "message_start",
        "message": {**message(stop_reason="tool_use"), "content": [], "stop_reason": None},
    }
    text = json.dumps(submitted)
    pieces = [text[i : i + 7] for i in range(0, len(text), 7)]
    block: list[dict[str, Any]] = [
        {"type": "content_block_start", "index": 0, "content_block": tool_use({})},
        *(_delta(piece) for piece in pieces),
        {"type": "content_block_stop", "index": 0},
    ]
    ends: list[dict[str, Any]] = [
        {"type": "message_delta", "delta": {"stop_reason": "tool_use"}, "usage": {"output_tokens": 150}},
        {"type": "message_stop"},
    ]
    events = [start, *block, *ends]
    body = "".join(f"event: {e['type']}\ndata: {json.dumps(e)}\n\n" for e in events)
    return Reply(body.encode(), content_type="text/event-stream")


def _delta(piece: str) -> dict[str, Any]:
    return {"type": "content_block_delta", "index": 0, "delta": {"type": "input_json_delta", "partial_json": piece}}


def plan(contract: str, *steps: tuple[str, str, Mapping[str, Any]]) -> dict[str, Any]:
    """A submission in the tool's shape."""
    return {"contract": contract, "steps": [_step(*step) for step in steps]}


def _step(robot: str, skill: str, args: Mapping[str, Any]) -> dict[str, Any]:
    return {"robot": robot, "skill": skill, "args": [{"name": n, "value": v} for n, v in args.items()]}


Make = Callable[[], Reply]
AREA = {"x_min": -6, "x_max": 10, "y_min": -6, "y_max": 10}
SEARCH_AND_DISPATCH = plan(
    "search_and_dispatch",
    ("iris", "takeoff", {"altitude": 5}),
    ("iris", "search_target", {**AREA, "altitude": 5}),
    ("iris", "get_coordinates", {}),
    ("tb3", "navigate_to", {"target": "victim"}),
    ("iris", "land", {}),
)
DRIVE = plan("dispatch_only", ("tb3", "navigate_to", {"x": -3, "y": -3}))
