"""A place in a world at which there is room for a model."""
import math
from typing import Any, Iterator

from lxml import etree

from angen_tools.common.catalog import simulator
from angen_tools.common.failure import Failure
from angen_tools.world import sdf

SIDE = 1.0  # m: the edges of the room that is searched for
GRID = 0.5  # m between two places that are tried
FAR = 8.0  # m: no place is farther from the middle of the world's models
CLEAR = 0.02  # m over the ground, from where the probe sinks
STILL = 0.3  # s after which a probe that overlaps has been pushed away, or has fallen
MOVED = 0.01  # m, to the side
NAME = 'angen_free_place'
PROBE = f'''<model name="{NAME}"><link name="link"><inertial><mass>50</mass></inertial>
  <collision name="c"><pose>0 0 {SIDE / 2} 0 0 0</pose><geometry>
  <box><size>{SIDE} {SIDE} {SIDE}</size></box></geometry></collision></link></model>'''


def free_place(world: etree._Element) -> tuple[float, ...]:
    """x y z roll pitch yaw on the ground of a saved world, near the middle of its models. A box is
    put at one place after the other in a copy of the world, until it stays where it is put."""
    with simulator() as angen:
        copy = angen.World.from_text(sdf.text(world), allow_paths=True)
        for x, y in _around(_middle(copy)):
            if _stays(copy, x, y):
                return (x, y, 0.0, 0.0, 0.0, 0.0)
    raise Failure(f'no place is free within {FAR:g} m; give --pose "X Y Z"')


def _middle(world: Any) -> tuple[float, float]:
    """The middle of the models on the lowest floor, m; the origin where there are none."""
    places = [place for name in world.models if -1.0 < (place := world.motion(name)[0])[2] < 3.0]
    if not places:
        return 0.0, 0.0
    x, y = (sorted(place[i] for place in places)[len(places) // 2] for i in (0, 1))
    return round(x / GRID) * GRID, round(y / GRID) * GRID


def _around(middle: tuple[float, float]) -> Iterator[tuple[float, float]]:
    """Places of a grid, the nearest to the middle first."""
    count = int(FAR / GRID)
    steps = sorted(((i, k) for i in range(-count, count + 1) for k in range(-count, count + 1)),
                   key=lambda step: (math.hypot(*step), step))
    for i, k in steps:
        yield middle[0] + i * GRID, middle[1] + k * GRID


def _stays(world: Any, x: float, y: float) -> bool:
    world.spawn(PROBE, NAME, pose=[x, y, CLEAR, 0.0, 0.0, 0.0])
    world.run(STILL)
    at = world.motion(NAME)[0]
    world.delete(NAME)
    return math.dist(at[:2], (x, y)) < MOVED and abs(at[2]) < CLEAR
