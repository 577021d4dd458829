#!/usr/bin/env python3
"""Physics against closed forms: measures, prints a table, draws figures.

    python3 bench/physics.py --folder out              a minute
    python3 bench/physics.py --folder out --hour       furniture for an hour too

Exit code 1 where a figure is beyond its tolerance.
"""
import argparse
import math
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable

import angen
import numpy as np

GRAVITY = 9.81  # m/s2
STEP = 0.001  # s
WORLDS = Path(__file__).resolve().parent.parent / 'worlds'
Trace = dict[str, np.ndarray]  # arrays over the same instants, 't' in s among them


@dataclass
class Check:
    """A measured number and its expected value; an effect that should be absent has 0."""
    name: str
    measured: float
    unit: str
    tolerance: float  # the largest allowed |measured - expected|
    expected: float = 0.0

    @property
    def ok(self) -> bool:
        return abs(self.measured - self.expected) <= self.tolerance

    def line(self) -> str:
        """Name, measured, expected and tolerance in one line."""
        return (f'{self.name:44} {self.measured:10.5f} {self.expected:10.5f} '
                f'{self.tolerance:9.5f} {self.unit:5} {"ok" if self.ok else "WRONG"}')


@dataclass
class Result:
    """The result of one experiment."""
    checks: list[Check]
    trace: Trace


def world_of(content: str, gravity: str = f'0 0 {-GRAVITY}') -> angen.World:
    """A world of 1 ms steps."""
    return angen.World.from_text(f'''<sdf version="1.6"><world name="w"><gravity>{gravity}</gravity>
      <physics type="ode"><max_step_size>{STEP}</max_step_size></physics>{content}</world></sdf>''')


def box(name: str, at: str, size: tuple[float, float, float], mass: float, extra: str = '',
        static: bool = False) -> str:
    """A box model; `at` is its pose, size in m, mass in kg."""
    x, y, z = (v * v for v in size)
    moments = ''.join(f'<{tag}>{mass / 12 * v}</{tag}>' for tag, v in
                      (('ixx', y + z), ('iyy', x + z), ('izz', x + y)))
    return f'''<model name="{name}"><static>{str(static).lower()}</static><pose>{at}</pose>
      <link name="link"><inertial><mass>{mass}</mass><inertia>{moments}</inertia></inertial>
      <collision name="c"><geometry><box><size>{size[0]} {size[1]} {size[2]}</size></box></geometry>
      {extra}</collision></link></model>'''


def friction(mu: float) -> str:
    """The surface of a collision with that coefficient of friction."""
    return (f'<surface><friction><ode><mu>{mu}</mu><mu2>{mu}</mu2></ode></friction></surface>')


def record(world: angen.World, seconds: float, **values: Callable[[], float]) -> Trace:
    """Runs and takes each value at every tick, also before the first."""
    rows = [[world.time, *(value() for value in values.values())]]
    for _ in range(round(seconds / STEP)):
        world.step()
        rows.append([world.time, *(value() for value in values.values())])
    return dict(zip(['t', *values], np.array(rows).T))


def joint_of(world: angen.World, name: str) -> Callable[[], float]:
    """Reads a joint's position, rad or m."""
    index = world.joints.index(name)
    return lambda: float(world.joint_positions[index])


def link_of(world: angen.World, name: str, axis: int) -> Callable[[], float]:
    """Reads a coordinate of a link's place, m."""
    index = world.links.index(name)
    return lambda: float(world.link_poses[index][axis])


def crossings(t: np.ndarray, x: np.ndarray) -> np.ndarray:
    """The time at which x is 0, s, between instants by a straight line."""
    i = np.nonzero(np.sign(x[:-1]) * np.sign(x[1:]) < 0)[0]
    return t[i] + (t[i + 1] - t[i]) * x[i] / (x[i] - x[i + 1])


def free_fall(height: float = 5.0) -> Result:
    """A box falls: s = g t2 / 2."""
    world = world_of(box('box', f'0 0 {height} 0 0 0', (0.2, 0.2, 0.2), 1.0))
    trace = record(world, 0.9, z=link_of(world, 'box::link', 2))
    trace['way'] = height - trace['z']
    trace['exact'] = GRAVITY * trace['t'] ** 2 / 2
    exact = trace['exact'][-1]
    return Result([Check('free fall, way in 0.9 s', trace['way'][-1], 'm', 0.002 * exact, exact)],
                  trace)


def pendulum(amplitude: float, length: float = 1.0) -> Result:
    """A bob swings: T = 2 pi sqrt(I / m g l) / agm(1, cos(amplitude / 2)).

    The period by the arithmetic-geometric mean: S. Adlaj, An Eloquent Formula for the Perimeter of
    an Ellipse, Notices of the AMS 59 (2012) 1094.
    """
    mass, moment = 2.0, 1e-3
    world = world_of(f'''<model name="p"><link name="bob">
      <inertial><pose>0 0 {-length} 0 0 0</pose><mass>{mass}</mass><inertia><ixx>{moment}</ixx>
      <iyy>{moment}</iyy><izz>{moment}</izz></inertia></inertial></link>
      <joint name="pivot" type="revolute"><parent>world</parent><child>bob</child>
      <axis><xyz>0 1 0</xyz></axis></joint></model>
      <state world_name="w"><model name="p"><joint name="pivot"><angle axis="0">{amplitude}</angle>
      </joint></model></state>''')
    linear = 2 * math.pi * math.sqrt((mass * length ** 2 + moment) / (mass * GRAVITY * length))
    a, b = 1.0, math.cos(amplitude / 2)
    while a - b > 1e-15:
        a, b = (a + b) / 2, math.sqrt(a * b)
    exact = linear / a
    trace = record(world, 4.4 * exact, angle=joint_of(world, 'p::pivot'))
    times = crossings(trace['t'], trace['angle'])
    period = (times[8] - times[0]) / 4
    peaks = np.abs(trace['angle'])
    last = float(peaks[trace['t'] > times[6]].max())
    name = f'pendulum from {amplitude} rad'
    return Result([Check(f'{name}, period', period, 's', 5e-4 * exact, exact),
                   Check(f'{name}, 4th swing', last, 'rad', 1e-3 * amplitude, amplitude)], trace)


def slide(slope: float = 0.4, mu: float = 0.3) -> Result:
    """A crate on a slope slides with g (sin a - mu cos a); a rougher one stays where it is."""
    def on_slope(coefficient: float) -> angen.World:
        up = 0.5 + 0.1 + 1e-4
        at = f'{up * math.sin(slope)} 0 {up * math.cos(slope)} 0 {slope} 0'
        return world_of(box('slope', f'0 0 0 0 {slope} 0', (20, 4, 1), 1, friction(10), static=True)
                        + box('crate', at, (0.3, 0.3, 0.2), 5, friction(coefficient)))

    def way(world: angen.World, seconds: float) -> Trace:
        trace = record(world, seconds, x=link_of(world, 'crate::link', 0),
                       z=link_of(world, 'crate::link', 2))
        trace['way'] = np.hypot(trace['x'] - trace['x'][0], trace['z'] - trace['z'][0])
        return trace

    trace = way(on_slope(mu), 1.5)
    expected = GRAVITY * (math.sin(slope) - mu * math.cos(slope))
    late = trace['t'] > 0.1  # it has come to lie on the slope
    fit = np.polyfit(trace['t'][late], trace['way'][late], 2)
    trace['exact'] = expected * trace['t'] ** 2 / 2
    rough = way(on_slope(1.2 * math.tan(slope)), 5.0)
    return Result([Check('crate on a slope, acceleration', 2 * fit[0], 'm/s2', 0.02 * expected,
                         expected),
                   Check('crate on a slope below its friction, way', rough['way'][-1], 'm', 1e-3)],
                  trace)


def door_swing(damping: float = 0.4) -> Result:
    """A free door under a sideways gravity: what energy it loses is its hinge's b w2 + f |w|."""
    mass, width, dry, pull = 20.0, 0.9, 0.1, 3.0
    arm, moment = width / 2, mass * (width ** 2 + 0.04 ** 2) / 12
    middle = -math.pi / 4
    gravity = f'{pull * math.cos(middle)} {pull * math.sin(middle)} 0'
    world = world_of(f'''<model name="door"><link name="base"/>
      <link name="leaf"><inertial><pose>{arm} 0 1 0 0 0</pose><mass>{mass}</mass><inertia>
      <ixx>7</ixx><iyy>7</iyy><izz>{moment}</izz></inertia></inertial></link>
      <joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
      <joint name="hinge" type="revolute"><parent>base</parent><child>leaf</child><axis>
      <xyz>0 0 1</xyz><limit><lower>-1.57</lower><upper>0.001</upper></limit><dynamics>
      <damping>{damping}</damping><friction>{dry}</friction></dynamics></axis></joint></model>''',
                     gravity)
    trace = record(world, 20.0, angle=joint_of(world, 'door::hinge'))
    t, angle = trace['t'], trace['angle']
    speed = np.gradient(angle, t)
    inertia = moment + mass * arm ** 2
    trace['energy'] = inertia * speed ** 2 / 2 - mass * pull * arm * np.cos(angle - middle)
    trace['energy'] += mass * pull * arm
    loss = damping * speed ** 2 + dry * np.abs(speed)
    trace['lost'] = np.concatenate([[0.0], np.cumsum((loss[1:] + loss[:-1]) / 2 * np.diff(t))])
    start = trace['energy'][0]
    error = np.abs(trace['energy'] + trace['lost'] - start).max() / start
    return Result([Check('door swing, energy not accounted for', 100 * error, '%', 1.0)], trace)


def profile(t: np.ndarray, way: float, speed: float, acceleration: float) -> np.ndarray:
    """A trapezoid of velocity from 0 to `way` (signed), which starts at t = 0."""
    ramp = min(speed / acceleration, math.sqrt(abs(way) / acceleration))
    top = ramp * acceleration
    end = abs(way) / top + ramp
    up = acceleration * np.clip(t, 0, ramp) ** 2 / 2
    flat = top * (np.clip(t, ramp, end - ramp) - ramp)
    down = acceleration * (ramp ** 2 - (end - np.clip(t, end - ramp, end)) ** 2) / 2
    return math.copysign(1.0, way) * (up + flat + down)


def settling(t: np.ndarray, x: np.ndarray, target: float, band: float) -> float:
    """The time from which x stays within `band` of the target, s; infinite if it does not."""
    outside = np.nonzero(np.abs(x - target) > band)[0]
    if len(outside) == 0:
        return 0.0
    return float(t[outside[-1] + 1]) if outside[-1] + 1 < len(t) else math.inf


def step_checks(name: str, trace: Trace, target: float, band: float, unit: str, settles: float,
                rests: float) -> list[Check]:
    """Overshoot (%), settling time into +- band, and where it rests."""
    sign = math.copysign(1.0, target)
    over = max(0.0, float((sign * trace['x']).max()) - abs(target)) / abs(target)
    done = settling(trace['t'], trace['x'], target, band)
    return [Check(f'{name}, overshoot', 100 * over, '%', 1.0),
            Check(f'{name}, settles to {band} {unit}', done, 's', 0.03, settles),
            Check(f'{name}, rests at', trace['x'][-1], unit, rests, target)]


def door_step(target: float = -1.2) -> Result:
    """The kitchen's door is set to an angle away from its stop."""
    world = world_of('''<plugin name="doors" filename="libdoor_world_plugin.so"/>
      <include><uri>model://kitchen_door</uri></include>''')
    world.command('door', 'kitchen0', f'Set {target}')
    trace = record(world, 4.0, x=joint_of(world, 'kitchen_door::hinge'))
    trace['setpoint'] = profile(trace['t'], target, 0.6, 2.0)
    # As its setpoint: the time of the trapezoid, less its braking within the band.
    settles = abs(target) / 0.6 + 0.6 / 2.0 - math.sqrt(2 * 0.01 / 2.0)
    return Result(step_checks('door to -1.2 rad', trace, target, 0.01, 'rad', settles, 0.003),
                  trace)


def elevator_step(load: float = 0.0) -> Result:
    """The elevator is sent a floor up, empty or with a load (kg)."""
    cargo = box('load', '0 0 0.201 0 0 0', (0.8, 0.8, 0.4), load) if load else ''
    world = world_of(f'<include><uri>model://elevator</uri></include>{cargo}')
    world.run(5)  # its doors open, its brake weighs the load
    world.command('elevator', 'elevator', 'Floor1')
    while world.device('elevator', 'elevator')['mode'] != 'UP':
        world.step()
    start = world.time
    trace = record(world, 8.0, x=joint_of(world, 'elevator::lift'))
    trace['t'] -= start
    trace['setpoint'] = profile(trace['t'], 4.0, 1.0, 0.5)
    name = f'elevator with {load:.0f} kg' if load else 'elevator, empty'
    settles = 4.0 / 1.0 + 1.0 / 0.5 - math.sqrt(2 * 0.005 / 0.5)
    return Result(step_checks(name, trace, 4.0, 0.005, 'm', settles, 0.002), trace)


STACK = '''<include><uri>model://kitchen_table</uri><pose>0 0 0.001 0 0 0</pose></include>
  <include><uri>model://table</uri><pose>0 0 0.752 0 0 0</pose></include>
  <include><uri>model://chair</uri><pose>0 0 1.203 0 0 0.3</pose></include>
  <include><uri>model://sitter</uri><pose>0 0 1.675 0 0 0.3</pose></include>
  <include><uri>model://desk</uri><pose>3 0 0.001 0 0 0</pose></include>
  <include><uri>model://chair</uri><name>chair2</name><pose>3 0 0.742 0 0 1</pose></include>'''


def stack_world(sleeps: bool) -> angen.World:
    """Furniture on furniture, and a tower of ten crates; awake all the time unless it sleeps."""
    crates = ''.join(box(f'crate{i}', f'-3 0 {0.1501 + 0.3001 * i} 0 0 {0.1 * i}', (0.4, 0.4, 0.3),
                         4.0) for i in range(10))
    text = box('ground', '0 0 -0.5 0 0 0', (20, 20, 1), 1, static=True) + crates + STACK
    if not sleeps:
        text = text.replace('</model>', '<allow_auto_disable>false</allow_auto_disable></model>')
    return world_of(text)


def drift(name: str, world: angen.World, seconds: float, settle: float = 3.0) -> Result:
    """The largest way of anything but the person within `seconds`, after `settle` s."""
    world.run(settle)
    watched = [i for i, link in enumerate(world.links) if not link.startswith('person::')]
    before = world.link_poses[watched]
    trace: dict[str, list[float]] = {'t': [], 'way': []}
    most = 0.0
    for _ in range(20):
        world.run(seconds / 20)
        ways = np.linalg.norm((world.link_poses[watched] - before)[:, :3], axis=1)
        most = max(most, float(ways.max()))
        trace['t'].append(world.time)
        trace['way'].append(1000 * most)
    return Result([Check(f'{name}, drift in {seconds:.0f} s', 1000 * most, 'mm', 1.0)],
                  {key: np.array(values) for key, values in trace.items()})


def draw(folder: Path, results: dict[str, Result]) -> None:
    """physics.png and steps.png."""
    import matplotlib
    matplotlib.use('Agg')
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(2, 2, figsize=(10, 6.5), constrained_layout=True)

    def panel(at: Any, title: str, ylabel: str) -> Any:
        at.set(title=title, xlabel='s', ylabel=ylabel)
        at.grid(alpha=0.3)
        return at

    fall, slid = results['fall'].trace, results['slide'].trace
    at = panel(axes[0, 0], 'Free fall, crate on a slope', 'm')
    for trace, name in ((fall, 'fall'), (slid, 'slope')):
        at.plot(trace['t'], trace['way'], label=name, lw=2)
        at.plot(trace['t'], trace['exact'], 'k--', lw=1,
                label='closed form' if name == 'slope' else None)
    at.legend()
    at = panel(axes[0, 1], 'Pendulum', 'rad')
    for name in ('small', 'large'):
        at.plot(results[name].trace['t'], results[name].trace['angle'])
    swing = results['swing'].trace
    at = panel(axes[1, 0], 'Door that swings under a sideways gravity', 'J')
    at.plot(swing['t'], swing['energy'], label='energy')
    at.plot(swing['t'], swing['lost'], label='lost in the hinge')
    at.plot(swing['t'], swing['energy'] + swing['lost'], 'k--', lw=1, label='sum')
    at.legend()
    at = panel(axes[1, 1], 'Drift at rest', 'mm')
    for name, result in results.items():
        if name.startswith('drift'):
            at.plot(result.trace['t'], result.trace['way'], '.-', label=name[6:])
    at.axhline(1.0, color='k', ls='--', lw=1)
    at.legend()
    figure.savefig(folder / 'physics.png', dpi=100)

    figure, axes = plt.subplots(2, 2, figsize=(10, 6), sharex='col', constrained_layout=True)
    for column, (title, unit, names) in enumerate((
            ('Door, Set -1.2', 'rad', {'door': 'angle'}),
            ('Elevator, Floor1', 'm', {'empty': 'empty', 'loaded': '300 kg aboard'}))):
        top, low = axes[0, column], axes[1, column]
        for name, label in names.items():
            trace = results[name].trace
            top.plot(trace['t'], trace['x'], label=label)
            low.plot(trace['t'], 1000 * (trace['setpoint'] - trace['x']), label=label)
        top.plot(trace['t'], trace['setpoint'], 'k--', lw=1, label='setpoint')
        top.set(title=title, ylabel=unit)
        top.legend()
        low.set(xlabel='s', ylabel=f'setpoint - {"angle" if unit == "rad" else "height"}, m{unit}')
        for at in (top, low):
            at.grid(alpha=0.3)
    figure.savefig(folder / 'steps.png', dpi=100)


def measure(hour: bool) -> dict[str, Result]:
    """Every experiment, by name."""
    results = {'fall': free_fall(), 'small': pendulum(0.05), 'large': pendulum(2.5),
               'slide': slide(), 'swing': door_swing(), 'door': door_step(),
               'empty': elevator_step(), 'loaded': elevator_step(300.0)}
    rest = 3600.0 if hour else 120.0
    results['drift asleep'] = drift('stacks asleep', stack_world(True), rest)
    results['drift awake'] = drift('stacks awake', stack_world(False), 60.0 if hour else 5.0)
    building = angen.World(str(WORLDS / 'angen.world'))
    results['drift building'] = drift('building', building, rest, settle=10.0)
    return results


def main() -> int:
    """The program."""
    parser = argparse.ArgumentParser(description=__doc__.split('\n', 1)[0])
    parser.add_argument('--folder', type=Path, default=Path('out'), help='for the figures (out)')
    parser.add_argument('--hour', action='store_true', help='watch bodies at rest for an hour')
    options = parser.parse_args()
    results = measure(options.hour)
    print(f'{"":44} {"measured":>10} {"expected":>10} {"within":>9}')
    checks = [check for result in results.values() for check in result.checks]
    for check in checks:
        print(check.line())
    options.folder.mkdir(parents=True, exist_ok=True)
    draw(options.folder, results)
    print(f'wrote {options.folder / "physics.png"} and {options.folder / "steps.png"}')
    return 0 if all(check.ok for check in checks) else 1


if __name__ == '__main__':
    sys.exit(main())
