"""Reads what a person put on the request key. Pure: bytes in, a request or a sentence about what is wrong out."""

import msgspec

MAX_BYTES = 16_384
"""A request is a sentence or two; anything larger is a mistake."""


class RequestBody(msgspec.Struct, frozen=True):
    """A request as JSON or msgpack."""

    text: str
    request_id: str = ""


class Unreadable(msgspec.Struct, frozen=True):
    """Why a payload is no request, and the id that it carried, if one could be read."""

    reason: str
    request_id: str = ""


def read_body(payload: bytes, encoding: str) -> RequestBody | Unreadable:
    """By the encoding: `application/json`, `application/msgpack`, and UTF-8 text for everything else."""
    if len(payload) > MAX_BYTES:
        return Unreadable(f"the request has {len(payload)} bytes, at most {MAX_BYTES} are read; say it shorter")
    media = encoding.partition(";")[0].strip().lower()
    try:
        if media in ("application/json", "text/json"):
            body = msgspec.json.decode(payload, type=RequestBody)
        elif media in ("application/msgpack", "application/x-msgpack"):
            body = msgspec.msgpack.decode(payload, type=RequestBody)
        else:
            body = RequestBody(payload.decode("utf-8"))
    except UnicodeDecodeError as error:
        return Unreadable(f"the request is not UTF-8 text (byte {error.start}); send text, JSON or msgpack")
    except (msgspec.MsgspecError, RecursionError) as error:
        wanted = '{"text": "...", "request_id": "..."}'
        return Unreadable(f"the {media} is no request: {error}; wanted {wanted}")
    if not body.text.strip():
        return Unreadable("the request is empty; say what the crew shall do", body.request_id[:200])
    return RequestBody(body.text, body.request_id[:200])
