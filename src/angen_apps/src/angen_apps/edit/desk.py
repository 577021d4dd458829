"""The home that is edited: its file, its draft beside it, and who has changed it last."""
import hashlib
import json
import os
import socket
import sys
import tempfile
from pathlib import Path
from typing import Any

from lxml import etree

from angen_apps.data.shapes import check_shape
from angen_apps.edit import build
from angen_apps.edit.habits import write_profiles
from angen_apps.edit.limits import DRAFT
from angen_apps.edit.simulation import STARTS
from angen_apps.edit.worker import Worker
from angen_apps.plan.drawing import from_json, recovered, to_json
from angen_apps.plan.overlays import What
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text
from angen_tools.common.text_file import read_bytes, read_text

LARGEST = 8 << 20  # bytes of a drawing


class Conflict(Exception):
    """Somebody else has changed the home in the meantime."""


def in_use(path: Path) -> socket.socket:
    """What says that this process edits a file, until it is closed; Failure if another one does.
    """
    mark = socket.socket(socket.AF_UNIX)
    digest = hashlib.sha256(str(path.resolve()).encode()).hexdigest()
    try:
        mark.bind(f'\0angen-edit-{os.getuid()}-{digest}')
    except OSError:
        mark.close()
        raise Failure(f'{path}: another angen edit has it open; use its page, or end it') from None
    return mark


class Desk:
    """One file. `version` counts the changes: one that is based on an older version is refused."""

    def __init__(self, path: Path, worker: Worker, imported: dict[str, Any] | None = None) -> None:
        """`imported`: a drawing that is not in the file yet."""
        self.path, self._worker = path, worker
        self.draft = path.with_name(f'{path.name}.draft')
        self.version = 0
        self.reason = ''  # why it cannot be edited
        self.drawing = imported
        self._file = _digest(path)
        if path.exists() and imported is None:
            try:
                self.drawing = worker.run(path, _drawing_in, path)
            except Failure as failure:
                self.reason = str(failure)

    def opened(self) -> dict[str, Any]:
        """What a page that opens needs: the drawing, and the draft if there is one."""
        draft = None if self.reason else self._kept()
        return {'file': self.path.name, 'path': str(self.path.resolve()), 'version': self.version,
                'reason': self.reason, 'drawing': self.drawing, 'draft': draft,
                'saved': bool(self._file)}

    def _kept(self) -> Any:
        """The draft, if there is one. A damaged one is set aside: the next draft would replace it.
        """
        if not self.draft.exists():
            return None
        try:
            draft = json.loads(read_text(self.draft))
            check_shape(str(self.draft), draft, DRAFT)
            from_json(draft['drawing'], str(self.draft))
            return draft
        except (Failure, ValueError, RecursionError) as error:
            why = str(error) if isinstance(error, Failure) else f'{self.draft}: is not JSON'
            print(f'angen edit: {why}{self._set_aside()}', file=sys.stderr, flush=True)
            return None

    def _set_aside(self) -> str:
        """Gives the draft another name; returns what has become of it."""
        aside, number = self.draft.with_name(f'{self.draft.name}.damaged'), 2
        while aside.exists():
            aside, number = aside.with_name(f'{self.draft.name}.damaged{number}'), number + 1
        try:
            os.replace(self.draft, aside)
        except OSError as error:
            return f'; it cannot be set aside: {error.strerror}'
        return f'; it is now {aside.name}'

    def keep(self, drawing: Any, at: float, base: Any) -> None:
        """Writes the draft."""
        self._take(base)
        from_json(drawing, 'the drawing')
        write_text(self.draft, json.dumps({'at': at, 'drawing': drawing}))
        self.version += 1

    def save(self, drawing: Any, base: Any, anyway: bool) -> str:
        """Writes the world, and removes the draft; returns what the world has."""
        self._take(base)
        if _digest(self.path) != self._file and not anyway:
            raise Conflict(f'{self.path.name} was changed by another program since it was opened')
        text: str = self._worker.run(self.path, build.write, drawing, self.path)
        self._file = _digest(self.path)
        self.drawing = drawing
        self.version += 1
        self.draft.unlink(missing_ok=True)
        try:
            self.household(drawing)
        except Failure as failure:  # the world is saved
            return f'{text}; {failure}'
        return text

    def discard(self, base: Any) -> None:
        """Removes the draft: the drawing is that of the file again."""
        self._take(base)
        self.draft.unlink(missing_ok=True)
        self.version += 1

    def picture(self) -> bytes:
        """The plan of the file as SVG; Failure if it cannot be drawn."""
        drawn: bytes = self._worker.run(self.path, _picture, self.path)
        return drawn

    def household(self, drawing: Any) -> dict[str, str]:
        """Names of the people in the file who live by habits, and these, which it writes beside
        the world if they are none of Angen's profiles."""
        names = etree.parse(str(self.path)).xpath('world/actor/@name')
        people = [mover for storey in from_json(drawing, 'the drawing').plan.storeys
                  for mover in storey.movers if mover.kind == 'person']
        return write_profiles(self.path, dict(zip(map(str, names), people)), STARTS)

    def survey(self, drawing: Any, floor: Any = 0) -> dict[str, Any]:
        """See build.survey."""
        found: dict[str, Any] = self._worker.run('the drawing', build.survey, drawing, floor)
        return found

    def _take(self, base: Any) -> None:
        if self.reason:
            raise Failure(self.reason)
        if base != self.version:
            raise Conflict('another window has changed this home since this one opened it')


def _digest(path: Path) -> str:
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError:
        return ''


def _drawing_in(path: Path) -> dict[str, Any]:
    text = read_bytes(path).decode('utf-8', 'replace')
    return to_json(recovered(text, str(path)))


def _picture(path: Path) -> bytes:
    from angen_apps.plan.draw import draw
    with tempfile.TemporaryDirectory() as folder:
        draw(path, Path(folder) / 'plan.svg', What())
        return (Path(folder) / 'plan.svg').read_bytes()
