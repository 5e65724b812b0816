"""Makes the README's picture: a demo's page in a browser, as the rover drives to the person that the drone found."""

import sys
import tempfile
from pathlib import Path

from PIL import Image

from crew.cli.viewer import served, web_viewer
from tests.integration.crew.harness import Desk
from tests.integration.recorder.browser import Viewer

AT = 0.735
"""Where the time cursor stands: a part of the run."""
COLOURS = 192


def main() -> int:
    """Write the picture to the path that is given."""
    target = Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        demo = Desk(Path(folder)).demo()
        assert demo.code == 0, demo
        recording = demo.run / "run.rrd"
        with Viewer.opened() as viewer, served(recording, recording.name) as source, web_viewer(source, 0) as address:
            shot = viewer.look(address, ("run", "hold", "good"), at=AT)
    target.parent.mkdir(parents=True, exist_ok=True)
    shot.image.quantize(COLOURS, dither=Image.Dither.NONE).save(target, optimize=True)
    print(f"{target}: {target.stat().st_size / 1000:.0f} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
