"""Bodies of residents as SDF: the actor of a person, and a cat."""
from __future__ import annotations

from typing import Sequence

CLOTHES = 299.0  # K, as those of an actor

# name: shape and its size, x y z of its middle, pitch
Part = tuple[str, str, tuple[float, ...], tuple[float, float, float], float]
CAT: tuple[Part, ...] = (
    ('trunk', 'box', (0.34, 0.14, 0.14), (0.0, 0.0, 0.19), 0.0),
    ('head', 'sphere', (0.06,), (0.20, 0.0, 0.27), 0.0),
    ('legs', 'box', (0.26, 0.10, 0.12), (0.0, 0.0, 0.06), 0.0),
)
CAT_MASS, CAT_FORCE = 4.0, 15.0  # kg and N: more force would tip it over


def walker(name: str, speed: float, body: str, posture: str = 'stand',
           stands_at: Sequence[float] = ()) -> str:
    """The person that walks, and gets up to `stands_at`. Only people use doors."""
    seat = f'<posture>{posture}</posture>' + \
        f'<stands_at>{_numbers(stands_at)}</stands_at>' * bool(stands_at)
    plugin = ('<plugin name="person" filename="libperson_controller.so">'
              f'<speed>{speed:g}</speed>{seat * (posture != "stand")}</plugin>')
    if body == 'person':
        return _sdf(f'<actor name="{name}">{plugin}</actor>')
    parts = ''.join(_visual(part[0], '0.45 0.35 0.25', CLOTHES, _shape(*part[1:])) for part in CAT)
    soles = ''.join(_slides(f'sole_{number}', _shape('sphere', (0.06,), (x, y, 0.06), 0.0))
                    for number, (x, y) in enumerate((x, y) for x in (-0.11, 0.11)
                                                    for y in (-0.06, 0.06)))
    plugin = plugin.replace('</plugin>', '<opens_doors>false</opens_doors>'
                            f'<mass>{CAT_MASS:g}</mass>'
                            f'<force_max>{CAT_FORCE:g}</force_max></plugin>')
    return _sdf(f'<model name="{name}"><link name="body"><inertial><pose>0 0 0.12 0 0 0</pose>'
                f'<mass>{CAT_MASS:g}</mass><inertia><ixx>0.02</ixx><iyy>0.045</iyy><izz>0.045</izz>'
                f'</inertia></inertial>{soles}{_slides("trunk", _shape(*CAT[0][1:]))}{parts}</link>'
                f'{plugin}</model>')


def _slides(name: str, shape: str) -> str:
    """A collision that the motor of its body moves, without friction."""
    return (f'<collision name="{name}">{shape}<surface><friction><ode><mu>0</mu><mu2>0</mu2></ode>'
            '</friction></surface></collision>')


def _sdf(text: str) -> str:
    return f'<sdf version="1.6">{text}</sdf>'


def _shape(kind: str, size: Sequence[float], at: tuple[float, float, float], pitch: float) -> str:
    key = {'box': 'size', 'sphere': 'radius'}[kind]
    return (f'<pose>{_numbers(at)} 0 {pitch:g} 0</pose><geometry><{kind}><{key}>{_numbers(size)}'
            f'</{key}></{kind}></geometry>')


def _visual(name: str, color: str, warm: float, shape: str) -> str:
    return (f'<visual name="{name}">{shape}<material><diffuse>{color} 1</diffuse></material>'
            '<plugin name="gz::sim::systems::Thermal" filename="gz-sim-thermal-system">'
            f'<temperature>{warm:g}</temperature></plugin></visual>')


def _numbers(values: Sequence[float]) -> str:
    return ' '.join(f'{value:g}' for value in values)
