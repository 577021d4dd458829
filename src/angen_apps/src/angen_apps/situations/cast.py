"""The cast of a situation besides the detector: a row's `cast` as puppets, models, commands."""
import math
from dataclasses import dataclass, field
from typing import Any, Callable, Mapping, Sequence

from angen_apps.situations import figures
from angen_apps.situations.puppet import Joints, Puppet, Segment, Shape, Vector, shape_xml
from angen_tools.common.failure import Failure

BEGINS = 3.0  # s: until then nothing moves
Entry = Mapping[str, Any]


@dataclass
class Part:
    """One member of the cast: its model or command, and when its action has ended."""
    ends: float = BEGINS + 1.0
    puppets: list[Puppet] = field(default_factory=list)
    models: list[tuple[str, str, list[float]]] = field(default_factory=list)  # SDF, name, pose
    commands: list[tuple[str, str, str]] = field(default_factory=list)  # kind, name, text at BEGINS


def part_of(entry: Entry, name: str, air: float) -> Part:
    """The part that an entry of a row's cast describes, in a room of `air` K."""
    if 'who' in entry:
        return _somebody(entry, name, air)
    makers: dict[str, Callable[[Entry, str, float], Part]] = {
        'box': _box, 'slab': _slab, 'leaf': _leaf, 'surface': _surface, 'device': _device,
        'arm': _arm}
    if entry.get('thing') not in makers:
        raise Failure(f"a cast has a <who> or a <thing> of {', '.join(makers)}, not {dict(entry)}")
    return makers[entry['thing']](entry, name, air)


def _point(values: Sequence[float]) -> figures.Point:
    x, y = values
    return x, y


def _place(values: Sequence[float]) -> Vector:
    x, y, z = values
    return x, y, z


def _somebody(entry: Entry, name: str, air: float) -> Part:
    begins = BEGINS + entry.get('after', 0.0)
    if 'to' in entry:
        way = figures.Way(_point(entry['from']), _point(entry['to']), entry['speed'], begins)
        return Part(way.ends, [figures.mover(name, entry['who'], entry['does'], way, air)])
    if entry['who'] in figures.ANIMALS:
        way = figures.Way(_point(entry['at']), _point(entry['at']), 0.0, begins)
        return Part(puppets=[figures.mover(name, entry['who'], 'glide', way, air)])
    yaw = math.radians(entry.get('yaw', 0.0))
    return Part(begins + 3.0, [figures.actor(name, entry['does'], _point(entry['at']), yaw, begins,
                                             air)])


def _shape(entry: Entry, air: float, at: tuple[float, float, float] = (0, 0, 0)) -> Shape:
    warmer = entry.get('warmer')
    return Shape(entry['size'], at, None if warmer is None else air + warmer)


def _static(name: str, shape: Shape, plugin: str = '') -> str:
    return (f'<sdf version="1.6"><model name="{name}"><static>true</static><link name="link">'
            f'{shape_xml(0, shape)}</link>{plugin}</model></sdf>')


def _box(entry: Entry, name: str, air: float) -> Part:
    """Does not move: furniture, a wall, a pane."""
    return Part(models=[(_static(name, _shape(entry, air)), name, [*entry['at'], 0, 0, 0])])


def _slab(entry: Entry, name: str, air: float) -> Part:
    """Slides to and fro: a curtain, leaves; or with `speed` one way, as a robot's load."""
    axis = {'x': (1, 0, 0), 'y': (0, 1, 0)}[entry['slides']]
    if 'speed' in entry:
        way = figures.Way((0, 0), (entry['by'], 0), entry['speed'], BEGINS)

        def script(time: float) -> Joints:
            return {'slide': way.distance(time)}
        ends = way.ends
    else:
        def script(time: float) -> Joints:
            turns = max(time - BEGINS, 0.0) / entry['period']
            return {'slide': entry['amplitude'] * math.sin(2 * math.pi * turns)}
        ends = BEGINS + max(6.0, entry['period'])
    slide = Segment('slide', axis=axis, slides=True, shapes=(_shape(entry, air),))
    return Part(ends, [Puppet(name, (slide,), script, _place(entry['at']))])


def _leaf(entry: Entry, name: str, air: float) -> Part:
    """A leaf of a door, `size` x y z, hinged at its end of least y; it turns by `by` degrees."""
    lasts, by = entry['seconds'], math.radians(entry['by'])

    def script(time: float) -> Joints:
        share = min(max((time - BEGINS) / lasts, 0.0), 1.0)
        return {'hinge': by * share * share * (3 - 2 * share)}
    middle = (0.0, entry['size'][1] / 2, 0.0)
    hinge = Segment('hinge', axis=(0, 0, 1), shapes=(_shape(entry, air, middle),))
    return Part(BEGINS + lasts, [Puppet(name, (hinge,), script, _place(entry['at']))])


def _surface(entry: Entry, name: str, air: float) -> Part:
    """Warms or cools by `to` K over the air, from `warmer`, with a time constant."""
    begins = air + entry.get('warmer', 0.0)
    plugin = ('<plugin name="warm_surface" filename="libwarm_surface.so">'
              f'<temperature>{begins}</temperature><time_constant>{entry["time_constant"]}'
              '</time_constant></plugin>')
    shape = Shape(entry['size'])
    return Part(BEGINS + entry.get('seconds', 10.0),
                models=[(_static(name, shape, plugin), name, [*entry['at'], 0, 0, 0])],
                commands=[('warm_surface', name, f'Temperature {air + entry["to"]}')])


def _device(entry: Entry, name: str, air: float) -> Part:
    """A model of worlds/models, and a command to its device."""
    pose = [*entry['at'], 0, 0, math.radians(entry.get('yaw', 0.0))]
    return Part(BEGINS + entry.get('seconds', 10.0),
                models=[(f'model://{entry["model"]}', entry['name'], pose)],
                commands=[(entry['kind'], entry['device'], entry['command'])])


def _arm(entry: Entry, name: str, air: float) -> Part:
    """The arm of NEMA WD 7: a box of 3 x 3 x 15 in that turns by 90 degrees and back, 90 a second.
    """
    def script(time: float) -> Joints:
        since = min(max(time - BEGINS, 0.0), 2.0)
        return {'elbow': math.pi / 2 * (1 - abs(since - 1.0)) + math.radians(entry['yaw'] - 45)}
    elbow = Segment('elbow', axis=(0, 0, 1), shapes=(
        Shape((0.381, 0.0762, 0.0762), (0.19, 0, 0), figures.skin(air)),))
    return Part(BEGINS + 2.0, [Puppet(name, (elbow,), script, (*_point(entry['at']), 0.914))])
