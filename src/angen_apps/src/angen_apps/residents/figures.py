"""Bodies of residents as SDF: an actor who walks, or a figure of a few parts who sits or lies."""
from __future__ import annotations

from typing import Sequence

SKIN, CLOTHES = 307.0, 299.0  # K, as those of an actor
MASS = 70.0  # kg
COLORS = ('0.20 0.36 0.60', '0.55 0.25 0.22', '0.24 0.45 0.30', '0.50 0.42 0.20', '0.42 0.28 0.52')
FLESH, TROUSERS = '0.85 0.65 0.53', '0.22 0.22 0.26'

# name: shape and its size, x y z of its middle, pitch; z from the seat or bed, x ahead
Part = tuple[str, str, tuple[float, ...], tuple[float, float, float], float]
SITTING: tuple[Part, ...] = (
    ('thighs', 'box', (0.54, 0.34, 0.14), (0.15, 0.0, 0.07), 0.0),
    ('trunk', 'box', (0.22, 0.34, 0.48), (-0.02, 0.0, 0.38), 0.0),
    ('arm_left', 'box', (0.10, 0.08, 0.40), (-0.03, 0.21, 0.40), 0.0),
    ('arm_right', 'box', (0.10, 0.08, 0.40), (-0.03, -0.21, 0.40), 0.0),
    ('head', 'sphere', (0.11,), (-0.02, 0.0, 0.75), 0.0),
    ('shank_left', 'box', (0.10, 0.11, 0.38), (0.37, 0.1, -0.19), 0.0),
    ('shank_right', 'box', (0.10, 0.11, 0.38), (0.37, -0.1, -0.19), 0.0),
)
LYING: tuple[Part, ...] = (  # the head is at +x
    ('legs', 'box', (0.82, 0.30, 0.14), (-0.44, 0.0, 0.07), 0.0),
    ('trunk', 'box', (0.54, 0.36, 0.20), (0.24, 0.0, 0.10), 0.0),
    ('arm_left', 'box', (0.50, 0.08, 0.10), (0.22, 0.22, 0.05), 0.0),
    ('arm_right', 'box', (0.50, 0.08, 0.10), (0.22, -0.22, 0.05), 0.0),
    ('head', 'sphere', (0.11,), (0.64, 0.0, 0.20), 0.0),
)
CAT: tuple[Part, ...] = (
    ('trunk', 'box', (0.34, 0.14, 0.14), (0.0, 0.0, 0.19), 0.0),
    ('head', 'sphere', (0.06,), (0.20, 0.0, 0.27), 0.0),
    ('legs', 'box', (0.26, 0.10, 0.12), (0.0, 0.0, 0.06), 0.0),
)
NAKED = ('head', 'arm_left', 'arm_right')  # area of skin, that of head and hands


def walker(name: str, speed: float, body: str) -> str:
    """The actor that walks: the simulator's person."""
    plugin = ('<plugin name="person" filename="libperson_controller.so">'
              f'<speed>{speed:g}</speed></plugin>')
    if body == 'person':
        return _sdf(f'<actor name="{name}">{plugin}</actor>')
    parts = ''.join(_part(part, '0.45 0.35 0.25', CLOTHES, solid=False) for part in CAT)
    return _sdf(f'<model name="{name}"><link name="body">{_inertial(4.0, 0.2)}'
                '<collision name="trunk"><pose>0 0 0.15 0 0 0</pose><geometry><capsule>'
                '<radius>0.12</radius><length>0.06</length></capsule></geometry><surface><friction>'
                '<ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>'
                f'{parts}</link>{plugin}</model>')


def figure(name: str, posture: str, number: int) -> str:
    """The figure that sits or lies; the resident's `number` chooses the color of the clothes."""
    shirt = COLORS[number % len(COLORS)]
    parts = ''
    for part in SITTING if posture == 'sit' else LYING:
        naked = part[0] in NAKED
        color = FLESH if naked else shirt if part[0] == 'trunk' else TROUSERS
        parts += _part(part, color, SKIN if part[0] == 'head' else CLOTHES)
    middle = 0.28 if posture == 'sit' else 0.1
    return _sdf(f'<model name="{name}"><link name="body">{_inertial(MASS, middle)}{parts}</link>'
                '</model>')


def _sdf(text: str) -> str:
    return f'<sdf version="1.6">{text}</sdf>'


def _inertial(mass: float, middle: float) -> str:
    moment = mass * 0.1
    return (f'<inertial><pose>0.05 0 {middle:g} 0 0 0</pose><mass>{mass:g}</mass><inertia>'
            f'<ixx>{moment:g}</ixx><iyy>{moment:g}</iyy><izz>{moment:g}</izz></inertia></inertial>')


def _part(part: Part, color: str, warm: float, solid: bool = True) -> str:
    name, kind, size, at, pitch = part
    inner = (f'<size>{_numbers(size)}</size>' if kind == 'box' else f'<radius>{size[0]:g}</radius>')
    shape = (f'<pose>{_numbers(at)} 0 {pitch:g} 0</pose><geometry><{kind}>{inner}</{kind}>'
             '</geometry>')
    heat = ('<plugin name="gz::sim::systems::Thermal" filename="gz-sim-thermal-system">'
            f'<temperature>{warm:g}</temperature></plugin>')
    return ((f'<collision name="{name}">{shape}</collision>' if solid else '')
            + f'<visual name="{name}">{shape}<material><diffuse>{color} 1</diffuse></material>'
            f'{heat}</visual>')


def _numbers(values: Sequence[float]) -> str:
    return ' '.join(f'{value:g}' for value in values)
