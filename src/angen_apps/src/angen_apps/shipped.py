"""The files of this package that a user may copy and change."""
from __future__ import annotations

from pathlib import Path


def shipped(name: str) -> Path:
    """A file of config/."""
    import rospkg
    return Path(rospkg.RosPack().get_path('angen_apps')) / 'config' / name
