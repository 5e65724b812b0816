"""The crew's own certificates: init, show, rotate."""

from typing import Annotated

import typer

from crew.cli.option import AsJson, CrewName, end

app = typer.Typer(help="The crew's own certificates.", no_args_is_help=True, rich_markup_mode=None)


Hosts = Annotated[
    list[str] | None, typer.Option("--host", help="A further name or address of the router's machine; may be repeated.")
]


@app.command("init")
def certs_init(crew: CrewName = "air_ground", host: Hosts = None) -> None:
    """Make the crew's authority and certificates, as far as they are missing."""
    from crew.cli.certs import run_init

    end(run_init(crew, tuple(host or ())))


@app.command("show")
def certs_show(crew: CrewName = "air_ground", as_json: AsJson = False) -> None:
    """Show every certificate of a crew, and until when it is valid."""
    from crew.cli.certs import run_show

    end(run_show(crew, as_json))


@app.command("rotate")
def certs_rotate(crew: CrewName = "air_ground", host: Hosts = None) -> None:
    """Replace the authority and all certificates; the earlier ones are worthless from then on."""
    from crew.cli.certs import run_rotate

    end(run_rotate(crew, tuple(host or ())))
