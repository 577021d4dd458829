"""angen luxcheck: what photometry has closed forms for, measured in small worlds by luminosity
sensors, as any world's are.
"""
from __future__ import annotations

from dataclasses import asdict, dataclass
from itertools import product
from math import atan, hypot, pi
from typing import TYPE_CHECKING, Iterator

from angen_tools.common.catalog import angen_module
from angen_tools.common.output import as_json, number, table

if TYPE_CHECKING:
    from rich.console import RenderableType

NUMBERS = ('THEORY lx', 'MEASURED lx', 'ERROR', 'LIMIT')
DIRECT_LIMIT = 0.01     # relative
MEAN_LIMIT = 0.02
CUBE = 4.0              # m, its side
CUBE_FLUX = 10_000.0    # lm
GRID = 8                # places along a side of each of the cube's faces
GAP = 0.001             # m from a sensor to its wall
WALL = 0.2              # m
CANDELA = 1000.0        # of the point lamp, and cd/m^2 of the flat ones

# axis, sign: roll, pitch, yaw that turn x there
FACING = {(0, 1): '0 0 0', (0, -1): f'0 0 {pi}', (1, 1): f'0 0 {pi / 2}',
          (1, -1): f'0 0 {-pi / 2}', (2, 1): f'0 {-pi / 2} 0', (2, -1): f'0 {pi / 2} 0'}


@dataclass(frozen=True)
class Case:
    """One comparison: illuminances in lx, and the greatest relative error that passes."""
    what: str
    expected: float
    measured: float
    limit: float

    @property
    def error(self) -> float:
        return self.measured / self.expected - 1.0

    @property
    def passes(self) -> bool:
        return abs(self.error) <= self.limit


@dataclass(frozen=True)
class Place:
    """Where a sensor stands, m, and along which axis and sign it faces."""
    position: tuple[float, float, float]
    axis: int = 2
    sign: int = 1


def lamp(flux: float, pose: str, shape: str = '') -> str:
    """A lit lamp of `flux` lm; `shape` makes it flat, shining along its -z."""
    return f'''<model name="lamp"><static>true</static><pose>{pose}</pose><link name="link">
  <light name="bulb" type="point">{shape}</light></link>
  <plugin name="lamp" filename="libros_plugin.so"><luminous_flux>{flux}</luminous_flux>
  <level>100</level></plugin></model>'''


def sensors(places: list[Place]) -> str:
    """One model with a luminosity sensor without noise at each place."""
    elements = ''.join(f'''<sensor name="s{i}" type="camera">
  <pose>{' '.join(f'{c:.9f}' for c in place.position)} {FACING[place.axis, place.sign]}</pose>
  <plugin name="lux" filename="libluminosity_sensor_controller.so"/></sensor>'''
                       for i, place in enumerate(places))
    return f'<model name="meter"><static>true</static><link name="link">{elements}</link></model>'


def cube(albedo: float) -> str:
    """Six slabs round a closed cube about the origin, all of one diffuse albedo."""
    slabs: list[str] = []
    for axis, sign in product(range(3), (-1, 1)):
        size, at = [CUBE + 2 * WALL] * 3, [0.0] * 3
        size[axis] = WALL
        at[axis] = sign * (CUBE + WALL) / 2
        box = f'<geometry><box><size>{size[0]} {size[1]} {size[2]}</size></box></geometry>'
        slabs.append(f'''<link name="wall{len(slabs)}"><pose>{at[0]} {at[1]} {at[2]} 0 0 0</pose>
  <collision name="c">{box}</collision><visual name="v">{box}<material>
  <diffuse>{albedo} {albedo} {albedo} 1</diffuse></material></visual></link>''')
    return f'<model name="cube"><static>true</static>{"".join(slabs)}</model>'


def measure(content: str, places: list[Place]) -> list[float]:
    """Illuminances in lx at the places, in a world with `content`."""
    world = angen_module().World.from_text(
        f'<sdf version="1.9"><world name="luxcheck">{content}{sensors(places)}</world></sdf>')
    world.step(1)
    name = 'meter' if len(places) == 1 else 'meter_s{}'
    return [world.sensor('luminosity', name.format(i))['illuminance'] for i in range(len(places))]


def direct_cases() -> Iterator[Case]:
    """Lamps in empty space over sensors that face up."""
    places = [Place((aside, 0.0, 0.0)) for aside in (0.0, 1.0, 2.0)]
    for place, lux in zip(places, measure(lamp(4 * pi * CANDELA, '0 0 2 0 0 0'), places)):
        aside = place.position[0]
        yield Case(f'1000 cd, 2 m above, {aside:g} m aside',
                   CANDELA * 2 / hypot(aside, 2.0) ** 3, lux, DIRECT_LIMIT)
    for what, shape, area, height, expected in (
            ('disc of 0.5 m radius, 1 m above', '<angen:disc>0.5</angen:disc>', pi / 4, 1.0,
             pi * CANDELA * 0.25 / 1.25),
            ('square of 2 m, 1 m above', '<angen:rectangle>2 2</angen:rectangle>', 4.0, 1.0,
             under_square(2.0, 1.0)),
            ('square of 1 m, 2 m above', '<angen:rectangle>1 1</angen:rectangle>', 1.0, 2.0,
             under_square(1.0, 2.0))):
        flat = lamp(pi * CANDELA * area, f'0 0 {height} 0 0 0', shape)
        yield Case(f'{what}, 1000 cd/m^2', expected, measure(flat, [Place((0.0, 0.0, 0.0))])[0],
                   DIRECT_LIMIT)


def under_square(side: float, height: float) -> float:
    """lx below the middle of a Lambertian square: four times that of a quarter at its corner,
    whose configuration factor is a / (pi sqrt(1 + a^2)) atan(a / sqrt(1 + a^2)), a = side / 2 h.
    """
    a = side / 2 / height
    slant = hypot(1.0, a)
    return 4 * pi * CANDELA * a / (pi * slant) * atan(a / slant)


def cube_places() -> list[Place]:
    """A grid just before each face of the cube, facing inward."""
    ticks = [CUBE * ((i + 0.5) / GRID - 0.5) for i in range(GRID)]
    places = []
    for axis, sign, u, v in product(range(3), (-1, 1), ticks, ticks):
        at = [0.0] * 3
        at[axis], at[(axis + 1) % 3], at[(axis + 2) % 3] = sign * (CUBE / 2 - GAP), u, v
        places.append(Place((at[0], at[1], at[2]), axis, -sign))
    return places


def cube_cases() -> Iterator[Case]:
    """The area mean of what a closed cube's walls get from each other: phi rho / (S (1 - rho))."""
    places = cube_places()
    direct = sum(CUBE_FLUX / (4 * pi) * abs(p.position[p.axis]) / hypot(*p.position) ** 3
                 for p in places) / len(places)
    for albedo in (0.5, 0.8, 0.9):
        total = measure(cube(albedo) + lamp(CUBE_FLUX, '0 0 0 0 0 0'), places)
        yield Case(f'cube of 4 m, 10,000 lm, albedo {albedo:g}, mean indirect',
                   CUBE_FLUX * albedo / (6 * CUBE ** 2 * (1 - albedo)),
                   sum(total) / len(total) - direct, MEAN_LIMIT)


def check() -> list[Case]:
    """Measures all cases."""
    return [*direct_cases(), *cube_cases()]


def list_cases(cases: list[Case], json: bool) -> RenderableType:
    """The cases as a table."""
    if json:
        return as_json([{**asdict(case), 'error': case.error, 'passes': case.passes}
                        for case in cases])
    return table(('CASE', *NUMBERS, 'VERDICT'),
                 [(case.what, f'{case.expected:.2f}', f'{case.measured:.2f}',
                   f'{number(100 * case.error)} %', f'{100 * case.limit:.0f} %',
                   'ok' if case.passes else 'WRONG') for case in cases], right=NUMBERS)
