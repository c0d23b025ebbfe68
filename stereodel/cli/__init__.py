"""The command `stereodel`.

Each command is a module with a function `command` and an `EXAMPLE`; `_doctor.COMMANDS` says in a line what it writes.
Heavy imports wait until a command runs, so that --help responds at once.
"""

from stereodel._extras import of_extra

with of_extra("cli"):
    from stereodel import _doctor
    from stereodel.cli import (
        contour,
        globe,
        inspect,
        interpolate,
        nearest,
        panorama,
        partition,
        triangulate,
        voronoi,
        web,
    )
    from stereodel.cli.application import Command, app

__all__ = ["app"]

for module in (inspect, triangulate, voronoi, partition, interpolate, contour, nearest, globe, panorama, web, _doctor):
    name = module.__name__.rpartition(".")[2].removeprefix("_")
    app.command(name, cls=Command, epilog=f"Example: {module.EXAMPLE}", short_help=_doctor.COMMANDS[name])(
        module.command
    )
