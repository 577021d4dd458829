"""Looks of furniture: OBJ meshes in a home's zip, turned and scaled to a unit box."""
from __future__ import annotations

import hashlib
import zipfile
from pathlib import Path

import numpy as np
from lxml import etree

from angen_apps.imports.source import LARGEST, Xml
from angen_apps.plan.names import slug
from angen_tools.common.failure import Failure

VERTICES = 500_000
ALL = 512 << 20  # bytes of all meshes together
KEPT = ('vt', 'f', 'o', 'g', 's')  # lines of OBJ that stay as they are
# from the file's axes, which are x to the right, y up and z to the front, to x front and z up
AXES = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


class Meshes:
    """The meshes of a home's pieces, each once. `files`: the OBJ texts by their names."""

    def __init__(self, path: Path, xml: Xml) -> None:
        self._xml = xml
        self._archive = zipfile.ZipFile(path) if zipfile.is_zipfile(path) else None
        self._left = ALL
        self._names: dict[str, str] = {}
        self.files: dict[str, str] = {}
        self.missing = 0  # of other formats, or not in the zip

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
        data = self._bytes(model)
        if data is None or not _is_obj(data):
            return ''
        text = unit(data.decode('utf-8', 'replace'), turn, mirrored)
        if text is None:
            raise self._xml.fail(element, f'the mesh {model[:60]} is not an OBJ file that can be '
                                 f'read, of at most {VERTICES} finite vertices')
        stem = slug(Path(model).stem, 'mesh')
        name = f'{stem}_{hashlib.sha256(key.encode()).hexdigest()[:8]}.obj'
        self.files[name] = text
        return name

    def _bytes(self, model: str) -> bytes | None:
        if self._archive is None:
            return None
        try:
            with self._archive.open(model) as file:
                data = file.read(min(LARGEST, self._left) + 1)
        except KeyError:
            return None
        except Exception as error:  # zipfile and zlib raise many kinds for torn files
            raise Failure(f'{self._archive.filename}/{model}: is damaged: {error}') from None
        self._left -= len(data)
        if self._left < 0 or len(data) > LARGEST:
            raise Failure(f'{self._archive.filename}/{model}: its meshes have more than '
                          f'{ALL >> 20} MB')
        return data


def _is_obj(data: bytes) -> bool:
    """Whether a file is OBJ: other formats of Sweet Home 3D are binary or XML."""
    return b'\x00' not in data[:4096] and any(
        line.startswith(b'v ') for line in data.splitlines()[:2000])


def unit(text: str, turn: np.ndarray, mirrored: bool) -> str | None:
    """An OBJ whose vertices are in the box from -0.5 to 0.5, -0.5 to 0.5, 0 to 1; x is its front.

    None where it has no finite vertices, or too many.
    """
    lines: list[str] = []
    points: list[list[str]] = []
    normals: list[list[str]] = []
    for line in text.splitlines():
        word, _, rest = line.strip().partition(' ')
        if word in ('v', 'vn'):
            (points if word == 'v' else normals).append(rest.split()[:3])
            lines.append(word)
        elif word in KEPT:
            lines.append(f'f {" ".join(rest.split()[::-1])}' if word == 'f' and mirrored
                         else f'{word} {rest}')
    to = AXES @ turn
    if mirrored:
        to = np.diag([1.0, -1.0, 1.0]) @ to
    try:
        at, ways = (np.array([[float(word) for word in row] for row in rows]).reshape(-1, 3) @ to.T
                    for rows in (points, normals))
    except ValueError:
        return None
    if not 3 <= len(at) <= VERTICES or not (np.isfinite(at).all() and np.isfinite(ways).all()):
        return None
    low, high = at.min(axis=0), at.max(axis=0)
    at = (at - (low + high) / 2) / np.maximum(high - low, 1e-6) + (0.0, 0.0, 0.5)
    found = {'v': iter(at.tolist()), 'vn': iter(ways.tolist())}
    return '\n'.join(f'{line} {" ".join(f"{v:.5f}" for v in next(found[line]))}'
                     if line in found else line for line in lines) + '\n'
