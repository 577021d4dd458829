"""Things that move by a script: links on joints that motors drive, as SDF and as a device."""
from dataclasses import dataclass
from functools import cache
from typing import Any, Callable, Mapping, Sequence

from angen_tools.common.catalog import angen_module

LIBRARY = 'situations_puppet.py'
FORCE = 2e4      # N or N m, far more than enough
FASTEST = 8.0    # rad/s or m/s, also while it takes its first posture
MASS = 5.0       # kg, of each link
MOMENT = 0.5     # kg m^2

Vector = tuple[float, float, float]
Joints = Mapping[str, float]            # positions in rad or m by joint; those left out are 0
Script = Callable[[float], Joints]      # a function of the time in s


@dataclass(frozen=True)
class Shape:
    """A box (x, y, z), a cylinder (radius, length) or a sphere (radius,), and how warm it is."""
    size: Sequence[float]
    at: Vector = (0.0, 0.0, 0.0)
    temperature: float | None = None  # K; as the air where not given


@dataclass(frozen=True)
class Segment:
    """A link on a joint. `at` is where the joint is, in the frame of its parent at rest."""
    name: str
    parent: str = 'world'
    at: Vector = (0.0, 0.0, 0.0)
    axis: Vector = (1.0, 0.0, 0.0)
    slides: bool = False
    shapes: tuple[Shape, ...] = ()


@dataclass(frozen=True)
class Puppet:
    """A model of segments, parents first, and the motion of its joints."""
    name: str
    segments: tuple[Segment, ...]
    script: Script
    start: Vector = (0.0, 0.0, 0.0)

    def sdf(self) -> str:
        """The model as SDF text, its origin at 0."""
        places: dict[str, Vector] = {'world': (0.0, 0.0, 0.0)}
        text = ''
        for segment in self.segments:
            base = places[segment.parent]
            place = places[segment.name] = (base[0] + segment.at[0], base[1] + segment.at[1],
                                            base[2] + segment.at[2])
            text += _link(segment, place) + _joint(segment)
        return (f'<sdf version="1.6"><model name="{self.name}">{text}'
                f'<plugin name="puppet" filename="{LIBRARY}"/></model></sdf>')


def shape_xml(number: int, shape: Shape) -> str:
    """A collision and a visual of one name, so that the one is as warm as the other."""
    kind, keys = {3: ('box', ('size',)), 2: ('cylinder', ('radius', 'length')),
                  1: ('sphere', ('radius',))}[len(shape.size)]
    values = [' '.join(map(str, shape.size))] if kind == 'box' else list(map(str, shape.size))
    inner = ''.join(f'<{key}>{value}</{key}>' for key, value in zip(keys, values))
    geometry = (f'<pose>{" ".join(map(str, shape.at))} 0 0 0</pose>'
                f'<geometry><{kind}>{inner}</{kind}></geometry>')
    heat = '' if shape.temperature is None else (
        '<plugin name="gz::sim::systems::Thermal" filename="gz-sim-thermal-system">'
        f'<temperature>{shape.temperature}</temperature></plugin>')
    return (f'<collision name="s{number}">{geometry}</collision>'
            f'<visual name="s{number}">{geometry}{heat}</visual>')


def _link(segment: Segment, place: Vector) -> str:
    shapes = ''.join(shape_xml(i, shape) for i, shape in enumerate(segment.shapes))
    return (f'<link name="{segment.name}"><pose>{" ".join(map(str, place))} 0 0 0</pose>'
            f'<gravity>false</gravity><inertial><mass>{MASS}</mass><inertia><ixx>{MOMENT}</ixx>'
            f'<iyy>{MOMENT}</iyy><izz>{MOMENT}</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz>'
            f'</inertia></inertial>{shapes}</link>')


def _joint(segment: Segment) -> str:
    kind = 'prismatic' if segment.slides else 'revolute'
    return (f'<joint name="{segment.name}_joint" type="{kind}"><parent>{segment.parent}</parent>'
            f'<child>{segment.name}</child><axis><xyz>{" ".join(map(str, segment.axis))}</xyz>'
            '</axis></joint>')


_scripts: dict[str, tuple[list[str], Script]] = {}  # by model, of the worlds of this process


@cache
def _register() -> None:
    angen = angen_module()
    device: Any = angen.Device

    class Puppeteer(device):
        """Moves the joints of a model as its script says."""

        @staticmethod
        def serves(model: str, joints: list[str], lights: list[str]) -> bool:
            return model in _scripts

        def configure(self, params: Any, wiring: Any) -> None:
            names, self.script = _scripts[wiring.model]
            self.joints = [(name, wiring.joint(f'{name}_joint')) for name in names]

        def update(self, view: Any, outputs: Any) -> None:
            targets = self.script(view.time + view.step)
            for name, joint in self.joints:
                rate = (targets.get(name, 0.0) - view.joint(joint)[0]) / view.step
                outputs.motor(joint, min(max(rate, -FASTEST), FASTEST), FORCE)

    angen.register(LIBRARY, LIBRARY.removesuffix('.py'), Puppeteer)


def spawn(world: Any, puppet: Puppet) -> None:
    """Puts the puppet into a world of this process."""
    _register()
    _scripts[puppet.name] = ([segment.name for segment in puppet.segments], puppet.script)
    world.spawn(puppet.sdf(), puppet.name, [*puppet.start, 0, 0, 0])
