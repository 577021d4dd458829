"""Looks of furniture: OBJ meshes in a home's zip, turned and scaled to a unit box."""
import hashlib
import io
import tempfile
import zipfile
from pathlib import Path

import numpy as np
from lxml import etree

from angen_apps.imports.source import Xml
from angen_apps.plan.names import slug
from angen_tools.common.catalog import angen_module
from angen_tools.common.text_file import LARGEST, shortened
from angen_tools.world.models import worlds_models

LINES = 1_000_000
LONGEST = 10_000  # characters of a line
HEAD = 1 << 17  # bytes in which an OBJ has a vertex
ALL = 128 << 20  # bytes of all meshes together
TRIAL = ('<sdf version="1.9"><model name="trial"><static>true</static><link name="link">'
         '<visual name="look"><geometry><mesh><uri>{}</uri></mesh></geometry></visual></link>'
         '</model></sdf>')
KEPT = ('vt', 'f', 'o', 'g', 's')  # lines of OBJ that stay as they are
# from the file's axes, which are x to the right, y up and z to the front, to x front and z up
AXES = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


class Meshes:
    """The meshes of a home's pieces, each once. `files`: the OBJ texts by their names. One that
    cannot be read is a remark."""

    def __init__(self, path: Path, xml: Xml, remarks: list[str]) -> None:
        self._remarks = remarks
        self._trial = _Trial()
        self._xml = xml
        self._archive = zipfile.ZipFile(path) if zipfile.is_zipfile(path) else None
        self._left = ALL
        self._names: dict[str, str] = {}
        self.files: dict[str, str] = {}
        self.missing = 0  # meshes of other formats, or not in the zip

    def take(self, element: etree._Element) -> str:
        """The name of a piece's mesh among `files`; '' where it has none that is read."""
        model = element.get('model')
        if not model:
            return ''
        turn = self._rotation(element)
        mirrored = element.get('modelMirrored') == 'true'
        key = f'{model}|{turn.tolist()}|{mirrored}'
        if key not in self._names:
            self._names[key] = self._read(element, model, turn, mirrored, key)
        if not self._names[key]:
            self.missing += 1
        return self._names[key]

    def _rotation(self, element: etree._Element) -> np.ndarray:
        text = element.get('modelRotation')
        if text is None:
            return np.eye(3)
        try:
            values = np.array([float(word) for word in text.split()])
        except ValueError:
            values = np.array([np.nan])
        if len(values) != 9 or not np.isfinite(values).all() or np.abs(values).max() > 1.001:
            raise self._xml.fail(element, 'modelRotation must be the 9 numbers of a rotation')
        return values.reshape(3, 3)

    def _read(self, element: etree._Element, model: str, turn: np.ndarray, mirrored: bool, key: str
              ) -> str:
        try:
            data = self._bytes(model)
            if data is None or not _is_obj(data):
                return ''
            text = unit(data, turn, mirrored)
            self._trial.check(text)
        except Exception as error:  # zipfile and zlib raise many kinds for torn files
            self._remarks.append(str(self._xml.fail(
                element, f'the mesh {shortened(model)}: {error}; it is a box')))
            return ''
        stem = slug(Path(model).stem, 'mesh')
        name = f'{stem}_{hashlib.sha256(key.encode()).hexdigest()[:8]}.obj'
        self.files[name] = text
        return name

    def _bytes(self, model: str) -> bytes | None:
        if self._archive is None:
            return None
        if model not in self._archive.NameToInfo:
            return None
        most = min(LARGEST, self._left)
        with self._archive.open(model) as file:
            data = file.read(most + 1)
        if len(data) > most:
            raise ValueError(f'it has more than {LARGEST >> 20} MB, or all have more than '
                             f'{ALL >> 20} MB')
        self._left -= len(data)
        return data


def _is_obj(data: bytes) -> bool:
    """Whether a file is OBJ: other formats of Sweet Home 3D are binary or XML."""
    head = data[:HEAD]
    return b'\x00' not in head and any(line.startswith(b'v ') for line in head.splitlines())


def unit(data: bytes, turn: np.ndarray, mirrored: bool) -> str:
    """An OBJ whose vertices are in the box from -0.5 to 0.5, -0.5 to 0.5, 0 to 1; x is its front.

    ValueError if it is too large, or has a number that is not finite.
    """
    if data.count(b'\n') > LINES:
        raise ValueError(f'it has more than {LINES} lines')
    lines: list[str] = []
    numbers: dict[str, list[list[float]]] = {'v': [], 'vn': []}
    for line in io.TextIOWrapper(io.BytesIO(data), 'utf-8', 'replace'):
        if len(line) > LONGEST:
            raise ValueError(f'it has a line of more than {LONGEST} characters')
        word, _, rest = line.strip().partition(' ')
        if word in numbers:
            numbers[word].append([float(number) for number in rest.split()[:3]])
            lines.append(word)
        elif word in KEPT:
            lines.append(f'f {" ".join(rest.split()[::-1])}' if word == 'f' and mirrored
                         else f'{word} {rest}')
    to = AXES @ turn
    if mirrored:
        to = np.diag([1.0, -1.0, 1.0]) @ to
    at, ways = (np.array(rows).reshape(-1, 3) @ to.T for rows in numbers.values())
    if len(at) < 3 or not np.isfinite([*at, *ways]).all():
        raise ValueError('it needs three vertices or more, and finite numbers')
    low, high = at.min(axis=0), at.max(axis=0)
    at = (at - (low + high) / 2) / np.maximum(high - low, 1e-6) + (0.0, 0.0, 0.5)
    found = {'v': iter(at.tolist()), 'vn': iter(ways.tolist())}
    return '\n'.join(f'{line} {" ".join(f"{v:.5f}" for v in next(found[line]))}'
                     if line in found else line for line in lines) + '\n'


class _Trial:
    """An empty world, which tells whether the simulator reads a mesh."""

    def __init__(self) -> None:
        self._world = angen_module().World(str(worlds_models().parent / 'empty.world'),
                                           allow_paths=True)

    def check(self, text: str) -> None:
        """ValueError if it does not."""
        with tempfile.NamedTemporaryFile('w', suffix='.obj', encoding='utf-8') as file:
            file.write(text)
            file.flush()
            try:
                self._world.spawn(TRIAL.format(file.name), 'trial', [0.0] * 6)
            except angen_module().Error as error:
                raise ValueError(str(error).partition(file.name)[2].strip()) from None
        self._world.delete('trial')
