"""One question to an endpoint that speaks the Messages API, through the vendor's client; its failures by kind."""

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import msgspec

from crew.actors.planner.backend import PlannerUnavailable, PlanUnreadable
from crew.actors.planner.endpoint import Endpoint
from crew.contracts.render.prompt import Prompt

if TYPE_CHECKING:
    import anthropic
    from anthropic.types import Message

LONGEST = 200
"""Characters of an endpoint's own words that an error repeats."""
_STATUS = {
    401: "it refuses the key",
    403: "the key may not do this",
    404: "it has no such address or model",
    413: "the request is too long for it",
    429: "it asks to wait: too many requests",
    529: "it is overloaded",
}


class Retry(PlannerUnavailable):
    """It may work a moment later; `after_s` is what the endpoint asks for, or 0."""

    def __init__(self, message: str, after_s: float = 0.0) -> None:
        super().__init__(message)
        self.after_s = after_s


class Reply(msgspec.Struct, frozen=True, kw_only=True):
    """What the model submitted, and what it cost."""

    submitted: Any
    input_tokens: int = 0
    cached_tokens: int = 0
    output_tokens: int = 0


class MessagesClient:
    """A client of one endpoint. The key stays in here. Raises ImportError where the vendor's package lacks."""

    def __init__(self, endpoint: Endpoint, key: str) -> None:
        import anthropic

        self._sdk = anthropic
        self._endpoint, self._key = endpoint, key

    async def ask(self, prompt: Prompt, timeout_s: float) -> Reply:
        """One try. Raises Retry, PlannerUnavailable or PlanUnreadable; the caller bounds the time as a whole."""
        anthropic = self._sdk
        try:
            message = await self._send(self._body(prompt), timeout_s)
        except anthropic.APIStatusError as error:
            raise self._refused(error) from error
        except anthropic.APITimeoutError as error:
            raise Retry(f"{self._name} did not answer within {timeout_s:.0f} s") from error
        except anthropic.APIConnectionError as error:
            raise Retry(f"{self._name} can't be reached: {_cause(error)}; is the address right?") from error
        except (anthropic.AnthropicError, ValueError, TypeError, AttributeError, KeyError, IndexError) as error:
            raise PlannerUnavailable(f"{self._name} did not answer as a Messages API does: {_said(error)}") from error
        return read_reply(message)

    @property
    def _name(self) -> str:
        return f"{self._endpoint.name} ({self._endpoint.base_url}, {self._endpoint.model})"

    def _body(self, prompt: Prompt) -> dict[str, Any]:
        profile = self._endpoint.profile
        system: dict[str, Any] = {"type": "text", "text": prompt.system}
        if profile.cache:
            system["cache_control"] = {"type": "ephemeral"}
        turns = [*prompt.turns, *([{"role": "assistant", "content": profile.prefill}] if profile.prefill else [])]
        choice: dict[str, Any] = {"type": "any"}
        if profile.force_tool:
            choice = {"type": "tool", "name": prompt.tool["name"]}
        return {
            "model": self._endpoint.model,
            "max_tokens": profile.max_tokens,
            "system": [system],
            "tools": [prompt.tool],
            "tool_choice": {**choice, "disable_parallel_tool_use": True},
            "messages": turns,
            "extra_body": dict(profile.extra_body) or None,
        }

    async def _send(self, body: Mapping[str, Any], timeout_s: float) -> "Message":
        profile = self._endpoint.profile
        headers = dict(profile.headers) | ({profile.key_header: self._key} if profile.key_header else {})
        async with self._sdk.AsyncAnthropic(
            api_key=self._key,
            base_url=self._endpoint.base_url,
            max_retries=0,
            timeout=timeout_s,
            default_headers=headers,
        ) as client:
            if not profile.stream:
                answer: Message = await client.messages.create(**body)
                return answer
            async with client.messages.stream(**body) as stream:
                return await stream.get_final_message()

    def _refused(self, error: "anthropic.APIStatusError") -> PlannerUnavailable:
        status = error.status_code
        why = _STATUS.get(status, "it failed" if status >= 500 else "it refuses the question")
        remedy = f"; set {self._endpoint.key_variable}" if status in (401, 403) else ""
        text = f"{self._name}: {why} ({status}: {_said(error)}){remedy}"
        if status in (408, 409, 429) or status >= 500:
            return Retry(text, _retry_after(error))
        return PlannerUnavailable(text)


def read_reply(message: Any) -> Reply:
    """The one tool call of an answer. Raises PlanUnreadable for any other number, or a cut or refused answer."""
    stop = getattr(message, "stop_reason", None)
    content = getattr(message, "content", None)
    if not isinstance(content, list):
        raise PlannerUnavailable(f"the endpoint is no Messages API: its answer is a {type(message).__name__}")
    if stop == "max_tokens":
        raise PlanUnreadable("the model's answer was cut off before its end (max_tokens of the endpoint's profile)")
    if stop == "refusal":
        raise PlanUnreadable("the model refused to plan this")
    calls = [block for block in content if getattr(block, "type", "") == "tool_use"]
    if len(calls) != 1:
        what = "no plan, but words" if not calls else f"{len(calls)} tool calls"
        raise PlanUnreadable(f"the model answered with {what}; exactly one call of submit_plan is read")
    if calls[0].name != "submit_plan":
        raise PlanUnreadable(f"the model called {str(calls[0].name)[:40]!r}, which is no tool of the planner")
    usage = getattr(message, "usage", None)
    return Reply(
        submitted=calls[0].input,
        input_tokens=_count(usage, "input_tokens"),
        cached_tokens=_count(usage, "cache_read_input_tokens"),
        output_tokens=_count(usage, "output_tokens"),
    )


def _count(usage: object, name: str) -> int:
    value = getattr(usage, name, 0)
    return value if isinstance(value, int) else 0


def _retry_after(error: "anthropic.APIStatusError") -> float:
    try:
        return max(0.0, float(error.response.headers.get("retry-after", 0)))
    except ValueError:
        return 0.0


def _said(error: Exception) -> str:
    """An error's own words on one line, cut."""
    body = getattr(error, "body", None)
    inner = body.get("error") if isinstance(body, dict) else None
    message = inner.get("message") if isinstance(inner, dict) else None
    text = message if isinstance(message, str) else str(error) or type(error).__name__
    line = json.dumps(" ".join(text.split()), ensure_ascii=True)[1:-1]
    return line if len(line) <= LONGEST else line[:LONGEST] + "..."


def _cause(error: BaseException) -> str:
    cause: BaseException = error
    while cause.__cause__ is not None:
        cause = cause.__cause__
    return " ".join(str(cause).split())[:LONGEST] or type(cause).__name__
