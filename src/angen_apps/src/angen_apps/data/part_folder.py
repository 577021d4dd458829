"""The folder in which a home is made before it gets its name. A marker file tells it from a folder
of the user, and its lock from one in which another process works."""
from __future__ import annotations

import fcntl
import os
import shutil
import socket
from contextlib import contextmanager
from pathlib import Path
from typing import Iterator

from angen_tools.common.failure import Failure
from angen_tools.common.files import make_folder

MARKER = '.angen-generate'  # contains the process that makes the home
ELSE = 'or give another folder with --out'


@contextmanager
def part_folder(folder: Path) -> Iterator[Path]:
    """FOLDER.part, empty but for its marker, in which no other process works. It is removed after
    an error. Failure if there is one that angen generate did not make, or that is in use."""
    part = folder.with_name(folder.name + '.part')
    marker = _locked(part)
    try:
        _clear(part)
        os.ftruncate(marker, 0)
        os.pwrite(marker, f'process {os.getpid()} on {socket.gethostname()}'.encode(), 0)
        yield part
    except BaseException:
        shutil.rmtree(part, ignore_errors=True)
        raise
    finally:
        os.close(marker)


def _locked(part: Path) -> int:
    """The descriptor of the locked marker."""
    path = part / MARKER
    if part.is_symlink():
        raise Failure(f'{part}: is a link; remove it, {ELSE}')
    make_folder(part)
    if not path.exists() and any(part.iterdir()):
        raise Failure(f'{part}: was not made by angen generate; move it, {ELSE}')
    try:
        marker = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o666)
    except OSError as error:
        raise Failure(f'{path}: cannot be written: {error.strerror}') from None
    try:
        fcntl.flock(marker, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        who = os.pread(marker, 200, 0).decode(errors='replace') or 'another process'
        os.close(marker)
        raise Failure(f'{part}: {who} makes this home; wait for it, {ELSE}') from None
    return marker


def _clear(part: Path) -> None:
    """Removes what a process has left that was killed."""
    for path in part.iterdir():
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        elif path.name != MARKER:
            path.unlink()
