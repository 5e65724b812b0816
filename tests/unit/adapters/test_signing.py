"""Signed links: nothing is believed before its signature, a forged frame locks nobody out, a replay is refused."""

from pathlib import Path
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from crew.adapters.mavlink.link import parse_datagram
from crew.adapters.mavlink.signing import SigningState, VerifyingParser, read_key
from crew.errors import AdapterError
from tests.unit.adapters.fake import heartbeat

KEY, OTHER = bytes(range(32)), bytes(range(1, 33))
YEAR = 365 * 24 * 3600 * 100_000


class Sender:
    """A station that signs with a key, in a time that may be off by some ticks."""

    def __init__(self, key: bytes | None, ahead: int = 0) -> None:
        self._encoder: Any = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
        if key is not None:
            SigningState(key).sign(self._encoder)
            self._encoder.signing.timestamp += ahead

    def frame(self) -> bytes:
        return bytes(heartbeat().pack(self._encoder))


class Receiver:
    def __init__(self) -> None:
        self.state = SigningState(KEY)
        self.parser = VerifyingParser(self.state)

    def takes(self, data: bytes) -> bool:
        return parse_datagram(self.parser, data) is not None


def test_frames_of_the_key_are_taken_and_all_others_are_counted() -> None:
    receiver, sender = Receiver(), Sender(KEY)
    assert [receiver.takes(sender.frame()) for _ in range(3)] == [True] * 3
    assert not receiver.takes(Sender(None).frame())
    assert not receiver.takes(Sender(OTHER).frame())
    assert receiver.state.rejected == 2


def test_a_forged_frame_from_the_future_does_not_lock_the_true_sender_out() -> None:
    receiver, sender = Receiver(), Sender(KEY)
    assert receiver.takes(sender.frame())
    assert not receiver.takes(Sender(OTHER, ahead=YEAR).frame())
    assert receiver.takes(sender.frame())


def test_a_replayed_frame_is_refused_also_from_another_address() -> None:
    receiver, sender = Receiver(), Sender(KEY)
    frame = sender.frame()
    assert receiver.takes(frame)
    assert not receiver.takes(frame)
    elsewhere = VerifyingParser(receiver.state)
    assert parse_datagram(elsewhere, frame) is None
    assert receiver.takes(sender.frame())


def test_a_frame_of_long_ago_opens_no_stream() -> None:
    assert not Receiver().takes(Sender(KEY, ahead=-YEAR).frame())


@pytest.mark.parametrize("place", [-1, -6, -13, 10, 15])
def test_a_single_changed_byte_is_noticed(place: int) -> None:
    data = bytearray(Sender(KEY).frame())
    data[place] ^= 1
    assert not Receiver().takes(bytes(data))


def test_the_key_file_is_read_or_refused_in_plain_words(tmp_path: Path) -> None:
    file = tmp_path / "key"
    file.write_text(KEY.hex() + "\n")
    file.chmod(0o600)
    assert read_key("iris", str(file)) == KEY
    file.chmod(0o640)
    with pytest.raises(AdapterError, match="can be read by others: chmod 600"):
        read_key("iris", str(file))
    file.chmod(0o600)
    file.write_text("00ff")
    with pytest.raises(AdapterError, match="does not hold 64 hexadecimal digits"):
        read_key("iris", str(file))
    with pytest.raises(AdapterError, match="signing_key: cannot read"):
        read_key("iris", str(tmp_path / "none"))
