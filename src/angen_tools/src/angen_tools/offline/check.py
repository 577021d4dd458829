"""angen check: whether the file of a world, a model or a robot loads."""
import os
import re
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from pathlib import Path
from typing import Any, Collection, Iterator

from angen_tools.common.catalog import angen_module, kinds
from angen_tools.common.failure import Failure
from angen_tools.common.text_file import read_bytes
from angen_tools.common.xml_file import parse_xml
from angen_tools.offline import proportion
from angen_tools.world import models

MISSPELLED = re.compile(r' is not known; did you mean <\w+>\?$'
                        r'|plug-in library .* is not found; did you mean \S+\?'
                        r"|(names an unknown link '.*'|joins '.*' to itself); it is left out$"
                        r"|unknown joint type '(?!gearbox'|piston')"  # SDF knows these two
                        r'|a model named .* exists already, at line '
                        r"|; <[^>]*> is left out|(mesh|model|heightmap) '[^']*' is not found")
FOLLOWS = re.compile(' has no collision left, so that nothing would stop its fall')
NOT_INCLUDED = re.compile(r'(.*: )an <include> has no <(\w+)>')
OUR_OWN = re.compile(r': <angen:\w+> in <\w+>$')
INCLUDE = ('uri', 'name', 'pose', 'static', 'plugin')
MISSING = re.compile(r"'model://[^']*'.* is not found| has no <link>| an unknown link ")
SHOWN = 8  # names of a model's devices and sensors


@dataclass(frozen=True)
class Checked:
    """The findings about a file: `found` counts its contents, where there is no error."""
    wrong: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    ignored: list[str] = field(default_factory=list)
    found: str = ''


def check(path: str) -> Checked:
    """Loads a world; or a model (its SDF, URDF, folder or model:// address) into an empty world.

    What a model misses may be in the models beside it, as in a collection of models.
    """
    if not path:
        return Checked(wrong=["'': not a path; give a file, a folder or model://NAME"])
    alone = _checked(path)
    collection = _collection_of(path)
    if collection is None or not any(MISSING.search(line) for line in alone.wrong + alone.warnings):
        return alone
    with _searched(collection):
        among_others = _checked(path)
    if among_others == alone:
        return alone
    note = f'{path}: needs the models beside it; add {collection} to GAZEBO_MODEL_PATH to use it'
    return replace(among_others, warnings=[note, *among_others.warnings])


def _collection_of(path: str) -> Path | None:
    """The folder of the model's folder, which may have other models."""
    if path.startswith('model://'):
        return None
    folder = Path(path) if Path(path).is_dir() else Path(path).parent
    return folder.resolve().parent if (folder / 'model.config').is_file() else None


@contextmanager
def _searched(folder: Path) -> Iterator[None]:
    """The folder is the last one of Gazebo's model path."""
    before = os.environ.get('GAZEBO_MODEL_PATH')
    os.environ['GAZEBO_MODEL_PATH'] = f'{before}:{folder}' if before else str(folder)
    try:
        yield
    finally:
        if before is None:
            del os.environ['GAZEBO_MODEL_PATH']
        else:
            os.environ['GAZEBO_MODEL_PATH'] = before


def _checked(path: str) -> Checked:
    angen = angen_module()
    try:
        if holds_world(path):
            return _checked_world(angen.World(path), path)
        return _checked_model(angen, path)
    except angen.Error as error:
        return Checked(wrong=str(error).splitlines())


def holds_world(path: str) -> bool:
    """Whether a file is to be read as a world: also one that is missing, or is not XML."""
    if path.startswith('model://') or Path(path).is_dir():
        return False
    if not Path(path).is_file():
        return True
    try:
        # Gazebo reads files with a comment before the declaration, or values without quotes.
        root = parse_xml(path, read_bytes(Path(path)), recover=True)
    except Failure:
        return True
    if root is None:
        return True
    return root.tag != 'robot' and all(part.tag not in ('model', 'actor') for part in root)


def _checked_world(world: Any, path: str) -> Checked:
    found = ', '.join((_counted(len(world.models), 'model'),
                       _counted(len(world.devices()), 'device'),
                       _counted(len(world.sensors()), 'sensor')))
    return _right(path, found, world, remarks=[*proportion.remarks(world, path)])


def _checked_model(angen: Any, path: str) -> Checked:
    world = angen.World(str(models.worlds_models().parent / 'empty.world'))
    for name in world.models:
        world.delete(name)
    around = set(world.ignored)
    world.spawn(path)
    known = sorted(kinds())
    devices = [f'{kind} {name}' for kind in known for name in world.devices(kind)]
    sensors = [f'{kind} {name}' for kind in known for name in world.sensors(kind)]
    found = ', '.join((f'model {world.models[0]} with {_counted(len(world.links), "link")}',
                       _counted(len(world.joints), 'joint'), _listed(devices, 'device'),
                       _listed(sensors, 'sensor')))
    return _right(path, found, world, around)


def _right(path: str, found: str, world: Any, around: Collection[str] = (),
           remarks: Collection[str] = ()) -> Checked:
    """`around`: the ignored elements of the world that a model was loaded into; `remarks`: more
    warnings."""
    wrong = [meant for line in world.warnings if (meant := misspelled(line))]
    warnings = [line for line in world.warnings if not misspelled(line)
                and not (wrong and FOLLOWS.search(line))] + [*remarks]
    state = f'loads with {_counted(len(warnings), "warning")}' if warnings else 'no errors'
    found_here = [line for line in world.ignored if line not in around]
    ignored = [line for line in found_here if not OUR_OWN.search(line)]
    wrong += [f'{line} is not known; docs/home.md lists the elements of angen'
              for line in found_here if line not in ignored]
    return Checked(wrong=wrong, warnings=warnings, ignored=ignored,
                   found=f'{path}: {state}; {found}')


def misspelled(warning: str) -> str:
    """The mistake, if a warning of a tolerant world is about a misspelled element or link, a
    missing file, or something left out; else ''."""
    if MISSPELLED.search(warning):
        return warning
    found = NOT_INCLUDED.match(warning)
    meant = get_close_matches(found[2], INCLUDE, 1) if found else []
    return f'{found[1]}<{found[2]}> in <include> is not known; did you mean <{meant[0]}>?' \
        if found and meant else ''


def _counted(count: int, noun: str) -> str:
    return f'{count} {noun}{"s" * (count != 1)}'


def _listed(names: list[str], noun: str) -> str:
    if not names:
        return f'0 {noun}s'
    shown = ', '.join(names[:SHOWN]) + ', …' * (len(names) > SHOWN)
    return f'{_counted(len(names), noun)} ({shown})'
