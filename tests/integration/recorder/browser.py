"""A page as a person sees it: Rerun's web viewer in headless Chromium, looked at by its pixels."""

import os
import shutil
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Self

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Browser, Page, Route, sync_playwright

from crew.actors.recorder.colour import TONES

WIDTH, HEIGHT = 1600, 1000
BUDGET_S = 170.0
"""All looking of one browser together takes no longer: the software renderer is slow, and CI is bounded."""
LANE_SHADE = 0.785
"""The viewer draws a lane's bars somewhat darker than the colour that they were given."""
CLOSE = 14
STILL = 600
"""Pixels that may change in a page that has settled: a blinking cursor, a little noise of the software renderer."""
Box = tuple[float, float, float, float]
SCENE: Box = (0.0, 0.06, 0.34, 0.60)
LANES: Box = (0.0, 0.63, 1.0, 0.81)
"""Left, top, right, bottom, as parts of the page."""
ARGS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]
LOOK = "&renderer=webgl&theme=dark&persist=0&hide_welcome_screen"


class Shot:
    """One screenshot."""

    def __init__(self, png: bytes) -> None:
        self.png = png
        self.image = Image.open(BytesIO(png)).convert("RGB")
        self._pixels = np.asarray(self.image, dtype=np.int16)

    def count(self, rgb: Sequence[float], box: Box) -> int:
        """How many pixels of a part of the page have about this colour."""
        part = self._part(box)
        return int((np.abs(part - np.array(rgb)).max(axis=2) <= CLOSE).sum())

    def lane(self, tone: str) -> int:
        """How many pixels of the lanes are a bar of this tone."""
        return self.count([LANE_SHADE * part for part in rgb(TONES[tone])], LANES)

    def unlike(self, other: "Shot") -> int:
        """How many pixels differ visibly."""
        return int((np.abs(self._pixels - other._pixels).max(axis=2) > CLOSE).sum())

    def colours(self, box: Box) -> int:
        """How many different colours a part of the page has."""
        return len(np.unique(self._part(box).reshape(-1, 3), axis=0))

    def save(self, path: Path) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(self.png)

    def _part(self, box: Box) -> NDArray[np.int16]:
        left, top, right, bottom = box
        return self._pixels[int(top * HEIGHT) : int(bottom * HEIGHT), int(left * WIDTH) : int(right * WIDTH)]


class Viewer:
    """One browser for all pages; nothing outside this machine is reached."""

    def __init__(self, browser: Browser) -> None:
        self._browser = browser
        self._left_s = BUDGET_S

    @classmethod
    @contextmanager
    def opened(cls) -> Iterator[Self]:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=chromium(), args=ARGS)
            try:
                yield cls(browser)
            finally:
                browser.close()

    def look(self, address: str, tones: Sequence[str], *, at: float | None = None) -> Shot:
        """The page once it shows lanes in all these tones and has stopped changing. `at` moves the time cursor there.

        AssertionError with what was missing after a while; the last picture is kept beside the others.
        """
        began = time.monotonic()
        deadline = began + self._left_s
        page = self._browser.new_page(viewport={"width": WIDTH, "height": HEIGHT})
        try:
            page.route(lambda url: not url.startswith(("http://127.0.0.1:", "blob:", "data:")), _refuse)
            page.goto(address + LOOK, wait_until="domcontentloaded")
            shot = _settled(page, tones, deadline)
            if at is not None:
                page.mouse.click((0.179 + at * 0.691) * WIDTH, 0.986 * HEIGHT)
                page.wait_for_timeout(3000)
                shot = Shot(page.screenshot())
            return shot
        finally:
            page.close()
            self._left_s -= time.monotonic() - began


def chromium() -> str:
    """The browser's path. AssertionError saying what to install if there is none."""
    found = os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("google-chrome")
    assert found, "no Chromium here: install it (apt-get install chromium) or name it in the variable CHROMIUM"
    return found


def rgb(colour: int) -> tuple[int, int, int]:
    """The parts of an RGBA number."""
    return colour >> 24 & 0xFF, colour >> 16 & 0xFF, colour >> 8 & 0xFF


def _settled(page: Page, tones: Sequence[str], deadline: float) -> Shot:
    before: Shot | None = None
    missing = list(tones)
    while True:
        shot = Shot(page.screenshot())
        missing = [tone for tone in tones if shot.lane(tone) < 200]
        if not missing and before is not None and shot.unlike(before) < STILL:
            return shot
        if time.monotonic() > deadline and not missing:
            return shot  # all is there; a slow machine had no time to see that it stays
        if time.monotonic() > deadline:
            shot.save(OUTPUT / "unsettled.png")
            raise AssertionError(f"in time the page lacks lanes in {missing}; see {OUTPUT}")
        before = shot
        page.wait_for_timeout(700)


def _refuse(route: Route) -> None:
    route.abort()


OUTPUT = Path(__file__).parents[2] / "output"
"""Screenshots are kept here; the folder is not part of the project."""
