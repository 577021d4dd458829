"""angen pid: how a door and an elevator answer a step under P, P + I, PID and Angen's own
controller, each simulated as in any world and compared with the closed form.
"""
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from angen_tools.common.catalog import simulator
from angen_tools.common.files import pyplot, save_figure
from angen_tools.common.output import RenderableType, as_json, number, table

STEP = 0.001            # s
GRAVITY = 9.81          # m/s^2
SPAN = 15.0             # s of each trace
SHOWN = 10.0            # s of the figure
GROWING = 2.5           # s of one that swings up
STILL = 1e-12           # rad or m a step: a joint that its brake holds
LIMIT = 0.01            # share of the step: greatest deviation from the closed form
HEAD = ('CONTROLLER', 'OVERSHOOT', 'SETTLES s', 'DEVIATION')
ROOM = 1e5              # N m or N: limits of integral and command that nothing reaches


@dataclass(frozen=True)
class Plant:
    """A controlled part: its joint, its command, and the parameters of the closed form."""
    kind: str
    device: str
    joint: str
    command: str
    unit: str
    target: float
    inertia: float      # kg m^2 or kg
    weight: float       # m/s^2 against the motion
    band: float         # settled within this
    gains: tuple[float, float, float]
    model: str


@dataclass(frozen=True)
class Answer:
    """One controller's trace; `closed` is the closed form, if it has one."""
    controller: str
    t: np.ndarray
    x: np.ndarray
    closed: np.ndarray | None
    target: float
    band: float
    grows: bool = False

    @property
    def overshoot(self) -> float:
        """As a share of the step; where it grows, at the end of the trace."""
        return max(0.0, float((self.x / self.target).max()) - 1.0)

    @property
    def settles(self) -> float:
        """The time from which it stays within the band, s; infinite if it does not."""
        outside = np.nonzero(np.abs(self.x - self.target) > self.band)[0]
        last = int(outside[-1]) + 1 if len(outside) else 0
        return float(self.t[last]) if last < len(self.t) else math.inf

    @property
    def deviation(self) -> float | None:
        """Greatest, from the closed form, as a share of its greatest distance to the target: until
        the brake holds the joint, near the target."""
        if self.closed is None:
            return None
        size = float(np.abs(self.closed - self.target).max())
        braked = int(np.nonzero(np.abs(np.diff(self.x)) > STILL)[0][-1]) + 1
        return float(np.abs(self.x - self.closed)[:braked].max()) / size

    @property
    def right(self) -> bool:
        return self.deviation is None or self.deviation <= LIMIT


LEAF = '''<model name="test_door"><link name="base"/><link name="leaf"><inertial>
  <pose>0.45 0 1 0 0 0</pose><mass>20</mass><inertia><ixx>6.67</ixx><iyy>8.02</iyy><izz>1.353</izz>
  </inertia></inertial></link>
  <joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
  <joint name="hinge" type="revolute"><parent>base</parent><child>leaf</child>
  <axis><xyz>0 0 1</xyz></axis></joint>
  <plugin name="door" filename="libdoor_world_plugin.so">{parameters}</plugin></model>'''
CABIN = '''<model name="elevator"><link name="body1"><inertial><mass>8</mass></inertial></link>
  <joint name="lift" type="prismatic"><parent>world</parent><child>body1</child>
  <axis><xyz>0 0 1</xyz></axis></joint>
  <plugin name="ros_plugin" filename="libros_plugin.so"><floor_height>4</floor_height>{parameters}
  </plugin></model>'''

PLANTS = {
    'door': Plant('door', 'test0', 'test_door::hinge', 'Set -0.7', 'rad', -0.7,
                  1.353 + 20 * 0.45 ** 2, 0.0, 0.01, (70, 200, 25), LEAF),
    'elevator': Plant('elevator', 'elevator', 'elevator::lift', 'Floor1', 'm', 4.0, 8.0, GRAVITY,
                      0.005, (200, 200, 25), CABIN)}


def closed_form(plant: Plant, gains: tuple[float, float, float], t: np.ndarray) -> np.ndarray:
    """Positions at t: m x'' = P e + I (integral of e) + D e' - m g, e = target - x, from rest at 0.
    """
    p, i, d = (gain / plant.inertia for gain in gains)
    rates = np.array([[0, 1, 0, 0], [0, 0, 1, 0], [-i, -p, -d, plant.weight], [0, 0, 0, 0]])
    step, term = np.eye(4), np.eye(4)
    for k in range(1, 12):  # the exponential of rates * STEP
        term = term @ rates * (STEP / k)
        step = step + term
    state = np.array([0.0, plant.target, 0.0, 1.0])
    errors = []
    for _ in t:
        errors.append(state[1])
        state = step @ state
    return plant.target - np.array(errors)


def simulate(plant: Plant, parameters: str, span: float) -> tuple[np.ndarray, np.ndarray]:
    """Times and positions from the command on."""
    with simulator() as angen:
        world = angen.World.from_text(
            f'<sdf version="1.9"><world name="pid"><physics type="ode"><max_step_size>{STEP}'
            f'</max_step_size></physics>{plant.model.format(parameters=parameters)}</world></sdf>')
    joint = world.joints.index(plant.joint)
    world.step(1)
    world.command(plant.kind, plant.device, plant.command)
    while abs(world.joint_positions[joint]) < 1e-9 and world.time < 1.0:
        world.step(1)
    x = [0.0, float(world.joint_positions[joint])]
    while len(x) < round(span / STEP):
        world.step(1)
        x.append(float(world.joint_positions[joint]))
    return np.arange(len(x)) * STEP, np.array(x)


def answer(plant: Plant, controller: str, terms: str) -> Answer:
    """The trace of a plain PID that has the given terms of the gains: P, PI or PID."""
    gains = tuple(gain if term in terms else 0.0 for term, gain in zip('PID', plant.gains))
    p, i, d = gains
    limits = ''.join(f'<{name}_max>{ROOM}</{name}_max><{name}_min>{-ROOM}</{name}_min>'
                     for name in ('i', 'cmd'))
    grows = d * p <= i * plant.inertia and i > 0
    t, x = simulate(plant, f'<controller>pid</controller><p>{p}</p><i>{i}</i><d>{d}</d>{limits}',
                    GROWING if grows else SPAN)
    return Answer(controller, t, x, closed_form(plant, (p, i, d), t), plant.target, plant.band,
                  grows)


def answers(kind: str) -> list[Answer]:
    """The traces of all four controllers."""
    plant = PLANTS[kind]
    found = [answer(plant, ' + '.join(terms), terms) for terms in ('P', 'PI', 'PID')]
    t, x = simulate(plant, '', SPAN)
    return [*found, Answer('profile', t, x, None, plant.target, plant.band)]


def list_answers(found: list[Answer], json: bool) -> RenderableType:
    """The traces' figures as a table."""
    if json:
        return as_json([{'controller': one.controller, 'overshoot': one.overshoot,
                         'settles_s': one.settles if math.isfinite(one.settles) else None,
                         'deviation': one.deviation, 'right': one.right} for one in found])
    return table(HEAD, [_row(one) for one in found], right=HEAD[1:])


def _row(one: Answer) -> tuple[str, str, str, str]:
    return (one.controller, 'grows' if one.grows else f'{number(100 * one.overshoot, 1)} %',
            number(one.settles) if math.isfinite(one.settles) else 'never',
            '' if one.deviation is None else f'{number(100 * one.deviation)} %')


def draw(path: Path, kind: str, found: list[Answer]) -> None:
    """Writes the figure: a panel for each plain controller, Angen's own over all."""
    plant = PLANTS[kind]
    *plain, own = found
    figure, axes = pyplot().subplots(len(plain), 1, sharex=True, layout='constrained',
                                     figsize=(7, 7))
    p, i, d = plant.gains
    for axis, one in zip(axes, plain):
        gains = ', '.join(f'{term} {gain:g}' for term, gain in zip('PID', (p, i, d))
                          if term in one.controller)
        axis.axhline(plant.target, color='0.6', linewidth=0.8)
        axis.plot(one.t, one.x, color='tab:red', label=gains)
        axis.plot(one.t, one.closed, 'k--', linewidth=0.8, label='closed form')
        axis.plot(own.t, own.x, color='tab:blue', label="Angen's own")
        if not one.grows:
            axis.set_ylim(*sorted((-0.7 * plant.target, 2.4 * plant.target)))
        axis.set(ylabel=plant.unit, xlim=(0, SHOWN))
        axis.grid(alpha=0.3)
        axis.legend(loc='upper right' if plant.target < 0 else 'lower right', ncol=3, fontsize=8)
    axes[0].set_title(f'{kind}, {plant.command}: {plant.inertia:g} '
                      f'{"kg m²" if plant.unit == "rad" else "kg"}', fontsize=10)
    axes[-1].set_xlabel('s')
    save_figure(figure, path, dpi=100)
