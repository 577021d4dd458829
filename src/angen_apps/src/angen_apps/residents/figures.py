"""Bodies of residents as SDF: an actor who walks, or a figure who sits or lies: boxes for contacts
and rays, and a jointed person of capsules to look at."""
from __future__ import annotations

from typing import Sequence

SKIN, CLOTHES = 307.0, 299.0  # K, as those of an actor
MASS = 70.0  # kg
SHIRT = '0.20 0.36 0.60'  # an actor's shirt
FLESH, TROUSERS = '0.85 0.65 0.53', '0.22 0.22 0.26'
HAIR, SHOES = '0.25 0.18 0.14', '0.12 0.12 0.13'

# name: shape and its size, x y z of its middle, pitch; z from the seat or bed, x ahead
Part = tuple[str, str, tuple[float, ...], tuple[float, float, float], float]
SITTING: tuple[Part, ...] = (  # the arms are in the width of the trunk
    ('thighs', 'box', (0.54, 0.34, 0.14), (0.15, 0.0, 0.07), 0.0),
    ('trunk', 'box', (0.20, 0.48, 0.48), (-0.02, 0.0, 0.38), 0.0),
    ('head', 'sphere', (0.11,), (-0.02, 0.0, 0.75), 0.0),
    ('shanks', 'box', (0.10, 0.31, 0.38), (0.37, 0.0, -0.19), 0.0),
)
LYING: tuple[Part, ...] = (  # the head is at +x
    ('legs', 'box', (0.82, 0.30, 0.14), (-0.44, 0.0, 0.07), 0.0),
    ('trunk', 'box', (0.54, 0.48, 0.18), (0.24, 0.0, 0.09), 0.0),
    ('head', 'sphere', (0.11,), (0.64, 0.0, 0.20), 0.0),
)
CAT: tuple[Part, ...] = (
    ('trunk', 'box', (0.34, 0.14, 0.14), (0.0, 0.0, 0.19), 0.0),
    ('head', 'sphere', (0.06,), (0.20, 0.0, 0.27), 0.0),
    ('legs', 'box', (0.26, 0.10, 0.12), (0.0, 0.0, 0.06), 0.0),
)
CAT_MASS, CAT_FORCE = 4.0, 15.0  # kg and N: more force would tip it over
LEVEL = 1.571  # rad, of a capsule along x

# Their visible parts, as those of an actor: capsules have radius and length without their ends.
# `_s` is on both sides. The first has the temperature of the boxes without a part of their name.
Look = tuple[str, str, str, tuple[float, ...], tuple[float, float, float], float]
LOOKS: dict[str, tuple[Look, ...]] = {
    'sit': (('thigh_s', TROUSERS, 'capsule', (0.075, 0.40), (0.18, 0.09, 0.08), LEVEL),
            ('shank_s', TROUSERS, 'capsule', (0.055, 0.36), (0.40, 0.09, -0.13), -0.04),
            ('foot_s', SHOES, 'box', (0.25, 0.09, 0.07), (0.45, 0.09, -0.36), 0.0),
            ('trunk', '', 'capsule', (0.16, 0.30), (-0.03, 0.0, 0.33), 0.0),
            ('upper_arm_s', '', 'capsule', (0.048, 0.27), (0.015, 0.215, 0.40), -0.31),
            ('forearm_s', FLESH, 'capsule', (0.04, 0.25), (0.18, 0.20, 0.21), 1.966),
            ('neck', FLESH, 'capsule', (0.05, 0.08), (-0.02, 0.0, 0.65), 0.0),
            ('head', FLESH, 'sphere', (0.11,), (-0.02, 0.0, 0.77), 0.0),
            ('hair', HAIR, 'sphere', (0.109,), (-0.04, 0.0, 0.78), 0.0)),
    'lie': (('thigh_s', TROUSERS, 'capsule', (0.075, 0.42), (-0.21, 0.09, 0.09), LEVEL),
            ('shank_s', TROUSERS, 'capsule', (0.055, 0.38), (-0.62, 0.09, 0.07), LEVEL),
            ('foot_s', FLESH, 'box', (0.08, 0.08, 0.22), (-0.85, 0.09, 0.12), 0.0),
            ('trunk', '', 'capsule', (0.14, 0.32), (0.26, 0.0, 0.12), LEVEL),
            ('upper_arm_s', '', 'capsule', (0.048, 0.27), (0.32, 0.21, 0.07), LEVEL),
            ('forearm_s', FLESH, 'capsule', (0.04, 0.25), (0.05, 0.22, 0.06), LEVEL),
            ('head', FLESH, 'sphere', (0.11,), (0.64, 0.0, 0.16), 0.0),
            ('hair', HAIR, 'sphere', (0.109,), (0.66, 0.0, 0.15), 0.0))}


def walker(name: str, speed: float, body: str) -> str:
    """The actor that walks: the simulator's person. Only people use doors."""
    plugin = ('<plugin name="person" filename="libperson_controller.so">'
              f'<speed>{speed:g}</speed></plugin>')
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


def figure(name: str, posture: str) -> str:
    """The figure that sits or lies, in the clothes of an actor."""
    parts = ''.join(f'<collision name="{part[0]}">{_shape(*part[1:])}</collision>'
                    for part in (SITTING if posture == 'sit' else LYING))
    for look, color, kind, size, (x, y, z), pitch in LOOKS[posture]:
        warm = SKIN if look == 'head' else CLOTHES
        for side, word in ((1, 'left'), (-1, 'right')) if look.endswith('_s') else ((1, ''),):
            parts += _visual(look.removesuffix('s') + word if word else look, color or SHIRT, warm,
                             _shape(kind, size, (x, side * y, z), pitch))
    middle = 0.28 if posture == 'sit' else 0.1
    return _sdf(f'<model name="{name}"><link name="body">{_inertial(MASS, middle)}{parts}</link>'
                '</model>')


def _slides(name: str, shape: str) -> str:
    """A collision that the motor of its body moves, without friction."""
    return (f'<collision name="{name}">{shape}<surface><friction><ode><mu>0</mu><mu2>0</mu2></ode>'
            '</friction></surface></collision>')


def _sdf(text: str) -> str:
    return f'<sdf version="1.6">{text}</sdf>'


def _inertial(mass: float, middle: float) -> str:
    moment = mass * 0.1
    return (f'<inertial><pose>0.05 0 {middle:g} 0 0 0</pose><mass>{mass:g}</mass><inertia>'
            f'<ixx>{moment:g}</ixx><iyy>{moment:g}</iyy><izz>{moment:g}</izz></inertia></inertial>')


def _shape(kind: str, size: Sequence[float], at: tuple[float, float, float], pitch: float) -> str:
    inner = {'box': f'<size>{_numbers(size)}</size>',
             'sphere': f'<radius>{size[0]:g}</radius>',
             'capsule': f'<radius>{size[0]:g}</radius><length>{size[-1]:g}</length>'}[kind]
    return (f'<pose>{_numbers(at)} 0 {pitch:g} 0</pose><geometry><{kind}>{inner}</{kind}>'
            '</geometry>')


def _visual(name: str, color: str, warm: float, shape: str) -> str:
    return (f'<visual name="{name}">{shape}<material><diffuse>{color} 1</diffuse></material>'
            '<plugin name="gz::sim::systems::Thermal" filename="gz-sim-thermal-system">'
            f'<temperature>{warm:g}</temperature></plugin></visual>')


def _numbers(values: Sequence[float]) -> str:
    return ' '.join(f'{value:g}' for value in values)
