"""angen luxcheck: compares closed forms of photometry with small worlds, measured by luminosity
sensors, as any world's are.
"""
import tempfile
from dataclasses import asdict, dataclass
from itertools import product
from math import atan, cos, hypot, log, pi, sin
from pathlib import Path
from typing import Iterator

from angen_tools.common.catalog import angen_module
from angen_tools.common.files import write_text
from angen_tools.common.output import RenderableType, as_json, number, table

NUMBERS = ('THEORY lx', 'MEASURED lx', 'ERROR', 'LIMIT')
DIRECT_LIMIT = 0.01     # relative
MEAN_LIMIT = 0.01
FURNITURE_LIMIT = 0.02
CUBE = 4.0              # m, its side
CUBE_FLUX = 10_000.0    # lm
GRID = 8                # places along a side of each of the cube's faces
GAP = 0.001             # m from a sensor to its wall
WALL = 0.2              # m
CANDELA = 1000.0        # candela of the point lamp, and cd/m^2 of the flat ones

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
    """A sensor's place, m, and along which axis and sign it faces."""
    position: tuple[float, float, float]
    axis: int = 2
    sign: int = 1


def lamp(flux: float, pose: str, shape: str = '') -> str:
    """A lit lamp of `flux` lm; `shape` says what of it shines, and where to, its -z."""
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


def measure(content: str, places: list[Place], seconds: float = 0.0,
            folder: str = '') -> list[float]:
    """Illuminances in lx at the places, in a world with `content`, after `seconds`; its file
    is in `folder` where it names others.
    """
    text = f'<sdf version="1.9"><world name="luxcheck">{content}{sensors(places)}</world></sdf>'
    if folder:
        path = Path(folder) / 'luxcheck.world'
        write_text(path, text)
        world = angen_module().World(str(path))
    else:
        world = angen_module().World.from_text(text)
    if seconds > 0.0:
        world.run(seconds)
    else:
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


def write_ies(path: Path) -> None:
    """Writes a luminaire of 1000 cd ahead that falls off with the cosine."""
    angles = range(0, 91, 5)
    candela = ' '.join(f'{1000 * cos(pi * angle / 180):.3f}' for angle in angles)
    text = (f'IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {len(angles)} 1 1 2 0 0 0\n1 1 10\n'
            f'{" ".join(str(angle) for angle in angles)}\n0\n{candela}\n')
    write_text(path, text)


def source_cases() -> Iterator[Case]:
    """Lamps of other shapes and distributions over a sensor that faces up."""
    def below(flux: float, shape: str, height: float, aside: float = 0.0,
              folder: str = '') -> float:
        return measure(lamp(flux, f'0 0 {height} 0 0 0', shape), [Place((aside, 0.0, 0.0))],
                       folder=folder)[0]

    yield Case('globe of 0.3 m radius, 0.5 m above, 800 lm', 800 / (4 * pi * 0.25),
               below(800.0, '<angen:sphere>0.3</angen:sphere>', 0.5), DIRECT_LIMIT)
    half = atan(0.6 / 0.5)  # the angle to the tube's end
    yield Case('tube of 1.2 m, 0.5 m above, 1000 lm',
               1000 / pi ** 2 / 1.2 / 0.5 * (half + sin(half) * cos(half)),
               below(1000.0, '<angen:tube>1.2 0.008</angen:tube>', 0.5), DIRECT_LIMIT)
    exponent = log(0.5) / log(cos(0.3))
    yield Case('spot of 0.3 rad half angle, 2 m above, 800 lm',
               800 * (exponent + 1) / (2 * pi) / 4,
               below(800.0, '<angen:half_angle>0.3</angen:half_angle>', 2.0), DIRECT_LIMIT)
    with tempfile.TemporaryDirectory() as folder:
        write_ies(Path(folder) / 'lambertian.ies')
        shape = '<angen:ies><uri>lambertian.ies</uri></angen:ies>'
        for aside in (0.0, 2.0):
            yield Case(f'IES file of 1000 cd ahead, 2 m above, {aside:g} m aside',
                       CANDELA * 16 / (4 + aside ** 2) ** 2 / 4,
                       below(pi * CANDELA, shape, 2.0, aside, folder), DIRECT_LIMIT)


def crate(static: bool, yaw: float = 0.0, joint: str = '') -> str:
    """A dark cabinet on the cube's floor that is static, or a loose or a hinged one."""
    box = '<geometry><box><size>0.6 1.2 2</size></box></geometry>'
    return f'''<model name="cabinet"><static>{"true" if static else "false"}</static>
  <pose>-1.6 0.9 -1 0 0 {yaw}</pose><link name="link"><collision name="c">{box}</collision>
  <visual name="v">{box}<material><diffuse>0.2 0.2 0.2 1</diffuse></material></visual></link>
  {joint}</model>'''


def furniture_cases() -> Iterator[Case]:
    """Loose and hinged things at rest, against the same things as static ones."""
    hinge = ('<joint name="hinge" type="revolute"><parent>world</parent><child>link</child>'
             '<axis><xyz>0 0 1</xyz></axis></joint>')
    places = [Place((-1.99, -1.0, 0.0), 0, 1), Place((0.5, 0.5, -1.9)),
              Place((-1.0, 1.99, -1.0), 1, -1)]
    room = cube(0.7) + lamp(800.0, '0 0 1.5 0 0 0')
    for what, yaw, joint in (('loose cabinet', 0.0, ''), ('leaf ajar on a hinge', 0.5, hinge)):
        fixed = measure(room + crate(True, yaw), places)
        moving = measure(room + crate(False, yaw, joint), places, 7.0)
        for i, (expected, lux) in enumerate(zip(fixed, moving)):
            yield Case(f'{what}, place {i + 1}', expected, lux, FURNITURE_LIMIT)


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
    """The area mean of the walls' light on each other in a closed cube: phi rho / (S (1 - rho))."""
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
    return [*direct_cases(), *source_cases(), *cube_cases(), *furniture_cases()]


def list_cases(cases: list[Case], json: bool) -> RenderableType:
    """The cases as a table."""
    if json:
        return as_json([{**asdict(case), 'error': case.error, 'passes': case.passes}
                        for case in cases])
    return table(('CASE', *NUMBERS, 'VERDICT'),
                 [(case.what, f'{case.expected:.2f}', f'{case.measured:.2f}',
                   f'{number(100 * case.error)} %', f'{100 * case.limit:.0f} %',
                   'ok' if case.passes else 'WRONG') for case in cases], right=NUMBERS)
