"""What sensors see of a floor, compared with what the simulator's sensors report."""
from base64 import b64decode
from typing import Any, Callable

import angen
import numpy as np
import pytest
from angen_apps.edit.coverage import CELL, STEP, coverage

WIDE, DEEP, HIGH = 5.0, 4.0, 2.5
BODY = 0.2  # m
WALLS = [((0, DEEP / 2), (0.1, DEEP)), ((WIDE, DEEP / 2), (0.1, DEEP)),
         ((WIDE / 2, 0), (WIDE, 0.1)), ((WIDE / 2, DEEP), (WIDE, 0.1)),
         ((3.0, 1.0), (0.1, 2.0))]  # the last one juts out


def box(name: str, at: tuple[float, ...], size: tuple[float, ...]) -> str:
    shape = f'<geometry><box><size>{" ".join(map(str, size))}</size></box></geometry>'
    pose = f'<pose>{" ".join(map(str, at))} 0 0 0</pose>'
    return f'<collision name="{name}">{pose}{shape}</collision>'


def world_of(sensors: str) -> Any:
    walls = ''.join(box(f'wall{i}', (*at, HIGH / 2), (*size, HIGH))
                    for i, (at, size) in enumerate(WALLS))
    return angen.World.from_text(f'''<sdf version="1.6" xmlns:angen="angen">
      <world name="room"><model name="building"><static>true</static>
      <angen:room name="hall0"><angen:polygon>0.05 0.05  {WIDE - 0.05} 0.05  {WIDE - 0.05}
        {DEEP - 0.05}  0.05 {DEEP - 0.05}</angen:polygon><angen:floor>0</angen:floor>
        <angen:ceiling>{HIGH}</angen:ceiling></angen:room>
      <link name="walls">{walls}{box("floor", (WIDE / 2, DEEP / 2, -0.1), (WIDE, DEEP, 0.2))}
      </link></model>{sensors}</world></sdf>''')


def sensor(model: str, name: str, x: float, y: float, z: float, pitch: float, yaw: float) -> str:
    return (f'<include><uri>model://{model}</uri><name>{name}</name>'
            f'<pose>{x} {y} {z} 0 {pitch} {yaw}</pose></include>')


def mask(found: dict[str, Any], name: str, how: str) -> np.ndarray:
    """The cells (rows, columns) in which a sensor sees somebody."""
    cells = np.zeros((found['rows'], found['columns']), bool)
    seeing = next(each for each in found['sensors'] if each['name'] == name)
    row, column, rows, columns = seeing['box']
    bits = np.unpackbits(np.frombuffer(b64decode(seeing[how]), np.uint8), bitorder='little')
    cells[row:row + rows, column:column + columns] = bits[:rows * columns].reshape(rows, columns)
    return cells


def place(found: dict[str, Any], row: int, column: int) -> tuple[float, float]:
    x, y = found['origin']
    return x + (column + 0.5) * CELL, y + (row + 0.5) * CELL


def inside_walls(x: float, y: float) -> bool:
    return any(abs(x - cx) < wide / 2 + BODY and abs(y - cy) < deep / 2 + BODY
               for (cx, cy), (wide, deep) in WALLS)


def test_who_cuts_a_ray_of_a_pir_is_in_its_map() -> None:
    """A body that takes a step in a cell causes motion if the map has that cell, and else none."""
    pir = sensor('pir', 'p', 0.15, 0.15, 2.2, 0.25, 0.7)
    found = coverage(world_of(pir), 0)
    assert found is not None
    world = world_of(pir)
    cells = mask(found, 'p', 'standing')
    post = '''<sdf version="1.6"><model name="post"><static>true</static><link name="l">
      <collision name="c"><pose>0 0 0.9 0 0 0</pose><geometry><cylinder><radius>0.2</radius>
      <length>1.6</length></cylinder></geometry></collision></link></model></sdf>'''
    world.spawn(post, 'post', [50, 50, 0, 0, 0, 0])
    right, tested = 0, 0
    for row in range(3, found['rows'], 3):
        for column in range(3, found['columns'], 3):
            x, y = place(found, row, column)
            if inside_walls(x, y):
                continue
            moved = False
            for dx, dy in ((0, 0), (STEP, 0), (0, STEP), (-STEP, 0), (0, -STEP)):
                world.set_state('post', [50, 50, 0, 0, 0, 0])
                world.run(0.2)
                world.set_state('post', [x + dx, y + dy, 0, 0, 0, 0])
                for _ in range(3):
                    world.run(0.05)
                    moved = moved or world.sensor('pir', 'p')['motion']
            tested += 1
            right += moved == cells[row, column]
    assert tested > 80
    assert right >= 0.95 * tested, f'{right} of {tested}'
    assert 0.3 < cells.mean() < 0.95


def walked(world: Any, x: float, y: float) -> bool:
    """Whether somebody who walks over a place to and fro is detected."""
    seen = False
    for step in range(60):
        along = 0.25 * np.sin(step / 4)
        world.set_state('ann', [x + along, y, 0.0, 0, 0, 0])
        world.run(0.05)
        seen = seen or bool(world.sensor('pir', 'p')['motion'])
    world.set_state('ann', [50, 50, 0, 0, 0, 0])
    world.run(20.0)  # the filter comes to rest
    return seen


WARM = '''<sdf version="1.6"><model name="ann"><static>true</static><link name="l">
  <collision name="c"><pose>0 0 0.87 0 0 0</pose><geometry><cylinder><radius>0.2</radius>
  <length>1.7</length></cylinder></geometry></collision><visual name="c"><pose>0 0 0.87 0 0 0</pose>
  <geometry><cylinder><radius>0.2</radius><length>1.7</length></cylinder></geometry>
  <plugin name="gz::sim::systems::Thermal" filename="gz-sim-thermal-system">
  <temperature>303</temperature></plugin></visual></link></model></sdf>'''


@pytest.mark.parametrize('model, pose, inside, outside', [
    ('pir_casas', (2.0, 2.0, 2.48, 1.570796, 0.0), [(2.0, 2.0), (2.2, 2.1), (1.8, 1.9)],
     [(0.6, 2.0), (2.0, 3.4), (3.5, 2.0)]),
    ('pir_pyroelectric', (0.1, 3.0, 2.2, 0.0, 0.0), [(1.5, 3.0), (3.0, 2.6), (4.2, 3.2)],
     [(4.4, 0.6), (4.4, 1.0)])])  # behind the wall that juts out
def test_who_crosses_zones_is_in_the_map(
        model: str, pose: tuple[float, ...], inside: list[tuple[float, float]],
        outside: list[tuple[float, float]]) -> None:
    one = sensor(model, 'p', *pose)
    found = coverage(world_of(one), 0)
    assert found is not None
    world = world_of(one)
    cells = mask(found, 'p', 'standing')
    world.spawn(WARM, 'ann', [50, 50, 0, 0, 0, 0])
    world.run(2.0)
    west, south = found['origin']
    for at, expected in [*((at, True) for at in inside), *((at, False) for at in outside)]:
        row, column = int((at[1] - south) / CELL), int((at[0] - west) / CELL)
        assert cells[row, column] == expected, at
        assert walked(world, *at) == expected, at


def test_shares_of_rooms_and_of_who_lies_on_the_floor() -> None:
    level = sensor('pir', 'p', 0.15, 2.0, 1.5, 0.0, 0.0)
    found = coverage(world_of(level + sensor('optical_switch', 's', 0.1, 3.0, 1.0, 0, 0)), 0)
    assert found is not None
    standing, fallen = mask(found, 'p', 'standing'), mask(found, 'p', 'fallen')
    assert 0.2 < found['share'] < 1.0 and found['rooms'] == {'hall0': found['share']}
    assert 0 < fallen.sum() < 0.7 * standing.sum()
    beam = mask(found, 's', 'standing')
    assert beam.any() and not mask(found, 's', 'fallen').any()
    assert beam.sum() < 0.15 * beam.size


@pytest.mark.parametrize('number', [1, None, 'x', [0], {}, 1e300])
def test_a_floor_that_is_none(number: Any) -> None:
    assert coverage(world_of(''), number) is None


def test_people_and_robots_hide_nothing() -> None:
    pir = sensor('pir', 'p', 0.15, 0.15, 2.2, 0.25, 0.7)
    stands: Callable[[str], str] = lambda name: (
        f'<actor name="{name}"><script><trajectory id="0" type="walking"><waypoint><time>0</time>'
        '<pose>0.8 0.8 0 0 0 0</pose></waypoint></trajectory></script></actor>')
    empty, full = (coverage(world_of(more), 0) for more in (pir, pir + stands('ann')))
    assert empty == full and empty is not None
