"""What the command line says of itself."""

from importlib.metadata import version

from typer.testing import CliRunner

from crew.cli.main import app


def test_the_version_is_printed() -> None:
    told = CliRunner().invoke(app, ["--version"])
    assert (told.exit_code, told.stdout.strip()) == (0, f"crew {version('robot-crew')}")
