"""Shows a page in a browser or on the screen: Rerun's own program, on loopback only, ended with this process."""

import os
import socket
import subprocess
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from shutil import copyfileobj
from typing import NoReturn
from urllib.parse import quote

from crew.actors.recorder.rrd import die_with_parent, quiet
from crew.actors.recorder.viewer_program import program
from crew.clock import WALL
from crew.errors import CrewError, UsageError

LOOPBACK = "127.0.0.1"
UP_S = 10.0


def show_on_screen(path: Path, environment: Mapping[str, str]) -> NoReturn:
    """Become the native viewer. Raises UsageError where there is no screen."""
    if not (environment.get("DISPLAY") or environment.get("WAYLAND_DISPLAY")):
        raise UsageError("no display here (neither DISPLAY nor WAYLAND_DISPLAY is set); use crew replay RUN --web")
    viewer = program()
    os.execve(viewer, [str(viewer), "--bind", LOOPBACK, "--port", "auto", str(path)], quiet())


@contextmanager
def web_viewer(source: str, port: int) -> Iterator[str]:
    """The web viewer on a port of loopback (0: a free one), showing what `source` gives; its address.

    Raises UsageError if the port is taken.
    """
    port = _checked_port(port)
    command = [str(program()), "--serve-web", "--bind", LOOPBACK, "--web-viewer-port", str(port), source]
    viewer = subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env=quiet(),
        preexec_fn=die_with_parent,
        process_group=0,
    )
    try:
        _await_listening(viewer, port)
        yield f"http://{LOOPBACK}:{port}/?url={quote(source, safe='')}"
    finally:
        viewer.kill()
        viewer.wait()


@contextmanager
def served(path: Path, name: str) -> Iterator[str]:
    """One file over HTTP on a free port of loopback; its address. Nothing else is served."""

    class OneFile(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self._answer(body=True)

        def do_HEAD(self) -> None:
            self._answer(body=False)

        def _answer(self, *, body: bool) -> None:
            if self.path.partition("?")[0] != f"/{name}":
                self.send_error(404)
                return
            with path.open("rb") as file:
                self.send_response(200)
                self.send_header("Content-Type", "application/octet-stream")
                self.send_header("Content-Length", str(path.stat().st_size))
                self.send_header("Access-Control-Allow-Origin", "*")
                self.end_headers()
                if body:
                    copyfileobj(file, self.wfile)

        def log_message(self, format: str, *args: object) -> None:
            """Say nothing."""

    with ThreadingHTTPServer((LOOPBACK, 0), OneFile) as server:
        server.daemon_threads = True
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.1}, daemon=True)
        thread.start()
        try:
            yield f"http://{LOOPBACK}:{server.server_address[1]}/{name}"
        finally:
            server.shutdown()
            thread.join()


def _checked_port(port: int) -> int:
    """The port if it is free, a free one for 0."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((LOOPBACK, port))
        except (OSError, OverflowError) as error:
            raise UsageError(
                f"cannot serve the page on {LOOPBACK}:{port}: {error}; choose another --port, or 0 for a free one"
            ) from error
        return int(probe.getsockname()[1])


def _await_listening(viewer: "subprocess.Popen[bytes]", port: int) -> None:
    deadline_ns = WALL.now_ns() + int(UP_S * 1e9)
    pause = threading.Event()
    while WALL.now_ns() < deadline_ns:
        if viewer.poll() is not None:
            raise CrewError(f"the viewer ended with code {viewer.returncode} before it served on port {port}")
        with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
            if probe.connect_ex((LOOPBACK, port)) == 0:
                return
        pause.wait(0.05)
    raise CrewError(f"the viewer does not serve on {LOOPBACK}:{port} after {UP_S:g} s")
