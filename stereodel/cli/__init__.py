"""The command `stereodel`.

Each command is a module with a function `command` and an `EXAMPLE`; `_doctor.COMMANDS` says in a line what it writes.
Heavy imports wait until a command runs, so that --help responds at once.
"""

from importlib import import_module

from stereodel import _doctor
from stereodel._extras import of_extra

with of_extra("cli"):
    from stereodel.cli.application import Command, app

__all__ = ["app"]

for name, said in _doctor.COMMANDS.items():
    module = _doctor if name == "doctor" else import_module(f"stereodel.cli.{name}")
    app.command(name, cls=Command, epilog=f"Example: {module.EXAMPLE}", short_help=said)(module.command)
