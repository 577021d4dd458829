"""Commands of other packages. Each of these modules has add_commands(commands)."""
from importlib import import_module
from typing import Any

MODULES = ('angen_apps.cli.commands', 'angen_bench.commands')


def add_commands(commands: Any) -> None:
    """Adds the commands of the packages that are there."""
    for name in MODULES:
        try:
            module = import_module(name)
        except ModuleNotFoundError as error:
            if error.name != name.partition('.')[0]:
                raise
        else:
            module.add_commands(commands)
