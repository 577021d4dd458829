"""Plays one situation in a room of its own and reads the detector. Needs no ROS."""
import math
from dataclasses import dataclass
from typing import Any, Mapping, Sequence

from angen_apps.situations import puppet
from angen_apps.situations.cast import BEGINS, Part, part_of
from angen_apps.walktest.command import detector
from angen_apps.walktest.room import room
from angen_tools.common.catalog import angen_module

STEP = 0.005       # s, of the physics
SAMPLE = 0.02      # s between two readings
ARRIVES = 1.0      # s: everything is in its place by then, and the detector starts
LAG = 1.0          # s after the end within which it may still report
ROOM = (12.0, 4.0)  # m: depth from the detector's wall, half of the width
AIR = 22.0         # degrees Celsius where a row does not say otherwise
KELVIN = 273.15
SEED = 1
# x y z roll pitch yaw of the detector.
MOUNTS = {'wall': (0, 0, 2.2, 0, 0, 0), 'low': (0, 0, 1.2, 0, 0, 0),
          'ceiling': (4, 0, 2.9, 0, math.pi / 2, 0),
          'corner': (0.02, -3.9, 2.2, 0, 0, math.pi / 4)}


@dataclass(frozen=True)
class Row:
    """A situation, and the expectation of physics or data sheets for each model of a PIR."""
    group: str
    scene: str
    expect: str                # expectation of the pyroelectric model: motion, still
    why: str
    source: str                # a key of the sources
    cast: tuple[Mapping[str, Any], ...]
    expect_range: str = ''     # expectation of range differences, if that is defined
    mount: str = 'wall'
    air: float = AIR           # degrees Celsius
    settings: tuple[tuple[str, str], ...] = ()
    depth: float = ROOM[0]
    half: float = ROOM[1]

    def expected(self, model: str) -> str:
        return self.expect if model == 'pyroelectric' else self.expect_range


@dataclass(frozen=True)
class Outcome:
    """The outcome of a row with one model of a PIR."""
    row: Row
    model: str
    got: str       # motion, still, early: it fired before anything moved
    signal: float  # V or m: the greatest
    threshold: float

    @property
    def passed(self) -> bool:
        return self.got == self.row.expected(self.model)


def play(row: Row, model: str) -> Outcome:
    """One run of a row's situation."""
    world, parts = furnished(row, model)
    return _watch(world, row, model, parts)


def furnished(row: Row, model: str) -> tuple[Any, list[Part]]:
    """The room of a row with its cast in place and the detector, and the cast."""
    parts = parts_of(row)
    world = world_of(row, parts)
    world.run(ARRIVES)
    tested = detector(model, row.settings if model == 'pyroelectric' else (), 0.0)
    x, y, z, *angles = MOUNTS[row.mount]
    height = tested.height if row.mount == 'wall' else z
    world.spawn(tested.xml, 'detector', [x, y, height, *angles])
    return world, parts


def parts_of(row: Row) -> list[Part]:
    """The cast of a row."""
    return [part_of(entry, f'cast{i}', row.air + KELVIN) for i, entry in enumerate(row.cast)]


def world_of(row: Row, parts: Sequence[Part]) -> Any:
    """The room of a row with its cast, without a detector."""
    text = room(row.depth, row.half, row.air + KELVIN, STEP)
    world = angen_module().World.from_text(text, seed=SEED)
    for part in parts:
        for each in part.puppets:
            puppet.spawn(world, each)
        for model, name, pose in part.models:
            world.spawn(model, name, pose)
    return world


def _watch(world: Any, row: Row, model: str, parts: Sequence[Part]) -> Outcome:
    got, greatest, reading = 'still', 0.0, {}
    while world.time < BEGINS:
        world.run(SAMPLE)
        if world.sensor('pir', 'detector')['motion']:
            got = 'early'
    for part in parts:
        for kind, name, text in part.commands:
            world.command(kind, name, text)
    ends = max(part.ends for part in parts) + LAG
    while world.time < ends:
        world.run(SAMPLE)
        reading = world.sensor('pir', 'detector')
        greatest = max(greatest, abs(reading['signal']))
        if reading['motion'] and got == 'still':
            got = 'motion'
    return Outcome(row, model, got, greatest, reading['signal_threshold'])
