"""Leaves of doors and sashes of windows: how far they open, and their models."""
from dataclasses import dataclass

from lxml import etree

from angen_apps.plan.model import Leaf, Opening
from angen_apps.plan.names import apart
from angen_apps.plan.polygons import rectangle
from angen_models.catalog import REED_GAP, add_reed
from angen_models.sdf import (Part, add_fixed, add_joint, add_link, add_plugin, add_pose, new_model,
                              spanned)
from angen_tools.common.geometry import turned

LEAF_THICK = 0.04  # m
SASH_THICK = 0.03
UNDER = 0.008  # m of air under a door, and above it
SASH_GAP = 0.004
EDGE = 0.004  # m from a leaf's far edge to its jamb
DOOR_MASS = 10.0  # kg/m2
SASH_MASS = 20.0  # kg/m2: two panes of 3 mm and the frame
OAK = (0.62, 0.45, 0.28)
GLASS = (0.55, 0.68, 0.8)
# gains in those of a PID for a leaf of 1 kg m2: of 1 Hz, damped
GAIN = {'p': 40.0, 'i': 40.0, 'd': 8.0}


@dataclass(frozen=True)
class Hung:
    """A leaf of an opening, in the plan, with the angle to which it opens."""

    name: str
    opening: Opening
    leaf: Leaf
    turn: float

    @property
    def opens(self) -> bool:
        return self.turn != 0.0 or self.leaf.slide != 0.0

    @property
    def hinge(self) -> tuple[float, float]:
        return self.opening.point(*self.leaf.hinge)

    @property
    def yaw(self) -> float:
        return self.opening.yaw + self.leaf.shut

    @property
    def thick(self) -> float:
        return SASH_THICK if self.opening.kind == 'window' else LEAF_THICK

    @property
    def width(self) -> float:
        return self.leaf.width - EDGE

    @property
    def heights(self) -> tuple[float, float]:
        gap = SASH_GAP if self.opening.kind == 'window' else UNDER
        return self.opening.bottom + gap, self.opening.top - gap

    def corners(self, angle: float, way: float = 0.0) -> list[tuple[float, float]]:
        """The leaf seen from above, turned by an angle, or moved along itself."""
        low, high = (0.0, self.thick) if self.turn <= 0 else (-self.thick, 0.0)
        return rectangle(*self.hinge, self.yaw + angle, (way, low), (self.width + way, high))


def leaf_model(hung: Hung, reed: bool) -> etree._Element:
    """The <model> of a leaf that turns: its origin is on its hinge at its foot."""
    window = hung.opening.kind == 'window'
    glazed = window or hung.opening.glazed
    bottom, top = hung.heights
    width, height, thick = hung.width, top - bottom, hung.thick
    slides = hung.leaf.slide != 0.0
    side = 1.0 if hung.turn <= 0 else -1.0
    mass = round(max(1.0, (SASH_MASS if glazed else DOOR_MASS) * width * height), 1)
    _, model = new_model(model_name(hung))
    x, y = hung.hinge
    add_pose(model, (round(x, 5), round(y, 5), round(bottom, 5)),
             (0, 0, round(hung.yaw, 6)))
    base = add_link(model, 'base', [_frame(width, thick * side, height)])
    if reed:
        _add_reed(base, hung, height, side)
    add_fixed(model, 'base_to_world', 'world', 'base')
    name = 'pane' if window else 'leaf'
    add_link(model, name, _leaf_parts(glazed, width, height, thick, side, mass))
    far = hung.leaf.slide if slides else hung.turn
    low, high = (far, 0.001) if far <= 0 else (-0.001, far)
    joint = 'sash' if window else 'slide' if slides else 'hinge'
    add_joint(model, joint, 'prismatic' if slides else 'revolute', 'base', name,
              (1, 0, 0) if slides else (0, 0, 1),
              limits={'lower': round(low, 4), 'upper': round(high, 4), 'effort': 200,
                      'velocity': 3},
              dynamics={'damping': 0.2, 'friction': 0.1})
    inertia = mass if slides else mass * width ** 2 / 3
    gains: dict[str, object] = {key: round(gain * max(inertia, 0.2), 2)
                                for key, gain in GAIN.items()}
    if slides and not window:
        gains['joint'] = joint
    add_plugin(model, 'window_controller' if window else 'door_controller',
                      'libdoor_world_plugin.so', device_name=hung.name,
                      open_position=round(far, 4), width=round(width, 3),
                      height=round(height, 3), **gains)
    return model


def model_name(hung: Hung) -> str:
    """The name of a leaf's model: that of its device with its kind before the storey's number."""
    name, number = apart(hung.name)
    return f'{name}_{hung.opening.kind}{number}'


def _frame(width: float, thick: float, height: float) -> Part:
    """The body that carries the reed contact; it hinders no one."""
    low, high = sorted((thick, thick + (0.006 if thick > 0 else -0.006)))
    return spanned('reed', (width - 0.07, low, height - 0.056),
                   (width - 0.03, high, height - 0.044), mass=0.01,
                   collide=False)


def _add_reed(base: etree._Element, hung: Hung, height: float, side: float) -> None:
    x, z = hung.width - 0.05, height - 0.05
    y = side * hung.thick
    gap = side * REED_GAP
    add_reed(base, (round(x, 5), round(y + gap, 5), round(z, 5)),
             'pane' if hung.opening.kind == 'window' else 'leaf',
             (round(x, 5), round(y, 5), round(z, 5)))


def _leaf_parts(glazed: bool, width: float, height: float, thick: float, side: float, mass: float
                ) -> list[Part]:
    low, high = sorted((0.0, thick * side))
    parts = [spanned('pane' if glazed else 'panel', (0.0, low, 0.0), (width, high, height),
                     material=GLASS if glazed else OAK, mass=mass)]
    lever = min(1.0, height / 2)
    for y in (low - 0.04, high + 0.01):
        parts.append(spanned(f'handle_{"front" if y < low else "back"}',
                             (width - 0.14, y, lever), (width - 0.03, y + 0.03,
                                                        lever + 0.025),
                             material=(0.75, 0.75, 0.78), collide=False))
    return parts


def swing(hung: Hung, count: int = 12) -> list[tuple[float, float]]:
    """The area that a leaf sweeps, as a polygon of the plan."""
    x, y = hung.hinge
    return [(x, y), *(turned((x, y), hung.yaw + hung.turn * i / count, hung.width, 0.0)
                      for i in range(count + 1))]
