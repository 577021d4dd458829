"""The files of this package that a user may copy and change."""
from pathlib import Path

from angen_tools.common.installed import share


def shipped(name: str) -> Path:
    """A file of config/."""
    return share('angen_apps') / 'config' / name
