"""angen walktest: a standard's walk test of a motion detector, without ROS."""
from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping, Sequence

import yaml

from . import models, sdf, walktest_report
from .catalog import angen_module
from .failure import Failure
from .terminal import Progress
from .walktest_arm import ARM_LIBRARY, arm_model, register_arm
from .walktest_plan import Area, Probe, Walk, probes_of, walk

STANDARDS = Path(__file__).resolve().parent / 'standards'
STEP = 0.005      # s, of the physics
LOOK = 0.05       # s between looks at the detector
LAG = 1.0        # s after the end of a movement within which it may answer; less than any stop
FORCE = 2000.0    # N of the person's legs, who keeps to the times
OFF_THE_WAY = 0.2  # m
SETTLE = 8.0      # s from an arm's appearance to its movement
SEED = 1


@dataclass(frozen=True)
class Detector:
    """What is tested: its SDF model, where it hangs and what it is declared to cover."""
    model: str
    xml: str
    height: float  # m
    yaw: float     # rad
    covers: Mapping[str, Area]


@dataclass
class Result:
    """One test of a standard: all that was tried, and how much of it had to be seen."""
    name: str
    area: Area
    probes: list[Probe]
    required: float  # share of the places
    cell: float | None = None  # m, where the places are squares

    @property
    def places(self) -> dict[tuple[float, float], bool]:
        """Whether somebody was seen there, from any direction."""
        seen: dict[tuple[float, float], bool] = {}
        for probe in self.probes:
            seen[probe.place] = seen.get(probe.place, False) or probe.seen
        return seen

    @property
    def share(self) -> float:
        return sum(self.places.values()) / len(self.places)

    @property
    def passed(self) -> bool:
        return self.share >= self.required


def _read(name: str) -> dict[str, Any]:
    return yaml.safe_load((STANDARDS / f'{name}.yaml').read_text(encoding='utf-8'))


def detector(model: str, settings: Sequence[tuple[str, str]], yaw: float) -> Detector:
    """The detector of a model, with parameters set on top of those of the test."""
    entry = _read('detectors')[model]
    values = [('model', model)]
    given = {key for key, _ in settings}
    values += [(key, str(value)) for key, value in entry['settings'].items() if key not in given]
    root = sdf.build_sensor('pir', 'detector', [*values, *settings], False, models.worlds_models())
    covers = {name: Area(**area) for name, area in entry['covers'].items()}
    return Detector(model, sdf.text(root), entry['height'], yaw, covers)


def run(profile: str, tested: Detector, out: Path) -> bool:
    """Tests it, leaves OUT/walktest_PROFILE_MODEL.csv and .png, says what came out; True: PASS."""
    standard = _read(profile)
    results = [_test(standard, test, tested) for test in standard['tests']]
    name = f'walktest_{profile}_{tested.model}'
    walktest_report.write_csv(out / f'{name}.csv', results)
    walktest_report.draw(out / f'{name}.png', f'{standard["title"]}: {tested.model}', results)
    for result in results:
        print(walktest_report.say(result))
    passed = all(result.passed for result in results)
    print(f'{standard["title"]}: {tested.model} {"PASS" if passed else "FAIL"}, '
          f'see {out / name}.png')
    return passed


def _test(standard: Mapping[str, Any], test: Mapping[str, Any], tested: Detector) -> Result:
    area = tested.covers[test['area']]
    all_probes: list[Probe] = []
    for probes in probes_of(test, area):
        if not probes:
            raise Failure(f'{test["name"]}: no cell lies in the area that it is to cover')
        if test['mover'] == 'arm':
            _swing(standard, test, tested, area, probes)
        else:
            _walk(standard, tested, area, walk(probes, test['speed'], test['stop']), test['name'])
        all_probes += probes
    return Result(test['name'], area, all_probes, test['required'], test.get('cell'))


def _world(standard: Mapping[str, Any], tested: Detector, area: Area, content: str) -> Any:
    """The empty room around the area, with the detector on its wall at x = 0."""
    margin = standard['room']['margin']
    text = _room(area.reach + margin, area.half_width + margin, standard['room']['ambient'],
                 content)
    world = angen_module().World.from_text(text, seed=SEED)
    world.spawn(tested.xml, 'detector', [0, 0, tested.height, 0, 0, tested.yaw])
    return world


def _room(depth: float, half: float, ambient: float, content: str) -> str:
    boxes = {'floor': (depth / 2, 0, -0.05, depth + 1, 2 * half + 1, 0.1),
             'ceiling': (depth / 2, 0, 3.05, depth + 1, 2 * half + 1, 0.1),
             'back': (-0.15, 0, 1.5, 0.1, 2 * half, 3), 'front': (depth, 0, 1.5, 0.1, 2 * half, 3),
             'left': (depth / 2, half, 1.5, depth, 0.1, 3),
             'right': (depth / 2, -half, 1.5, depth, 0.1, 3)}
    walls = ''.join(
        f'<collision name="{name}"><pose>{x} {y} {z} 0 0 0</pose><geometry><box>'
        f'<size>{a} {b} {c}</size></box></geometry></collision>'
        for name, (x, y, z, a, b, c) in boxes.items())
    return f'''<sdf version="1.6"><world name="walktest">
  <physics type="ode"><max_step_size>{STEP}</max_step_size></physics>
  <atmosphere type="adiabatic"><temperature>{ambient}</temperature></atmosphere>
  <model name="room"><static>true</static><link name="room">{walls}</link></model>
  {content}</world></sdf>'''


def _walk(standard: Mapping[str, Any], tested: Detector, area: Area, way: Walk, name: str) -> None:
    """Walks the way; marks the probes during which the detector said motion."""
    points = ''.join(f'<waypoint><time>{t}</time><pose>{x} {y} 0 0 0 {yaw}</pose></waypoint>'
                     for t, x, y, yaw in way.waypoints)
    person = standard['person']
    world = _world(standard, tested, area, f'''<actor name="person"><script><loop>false</loop>
      <trajectory id="0" type="walk">{points}</trajectory></script>
      <plugin name="person" filename="libperson_controller.so">
      <skin_temperature>{person["skin"]}</skin_temperature>
      <clothing_temperature>{person["clothing"]}</clothing_temperature>
      <force_max>{FORCE}</force_max></plugin></actor>''')
    body = world.links.index('person::body')
    progress = Progress(f'{name} {way.probes[0].direction}')
    pending = list(way.probes)
    while pending:
        world.run(LOOK)
        while pending and world.time > pending[0].ends + LAG:
            done = pending.pop(0)
            if math.dist(world.link_poses[body][:2], done.end) > OFF_THE_WAY:
                raise Failure(f'{name}: the person does not keep to the way at {done.end}')
            progress.say(1 - len(pending) / len(way.probes))
        if pending and world.time > pending[0].begins and _motion(world):
            pending[0].seen = True
    progress.end()


def _motion(world: Any) -> bool:
    return world.sensor('pir', 'detector')['motion']


def _swing(standard: Mapping[str, Any], test: Mapping[str, Any], tested: Detector, area: Area,
           probes: list[Probe]) -> None:
    """Puts the arm into every place and moves it there and back."""
    register_arm()
    progress = Progress(test['name'])
    world = _world(standard, tested, area, '')
    for count, probe in enumerate(probes):
        world.spawn(arm_model(test, probe.place), 'arm', [*probe.place, test['height'], 0, 0, 0])
        world.run(SETTLE)
        for rate in (test['rate'], -test['rate']):
            world.command(ARM_LIBRARY.removesuffix('.py'), 'arm', values=[rate])
            for _ in range(round(1.2 * test['turn'] / test['rate'] / LOOK)):
                world.run(LOOK)
                probe.seen = probe.seen or _motion(world)
        world.delete('arm')
        world.run(SETTLE / 4)
        progress.say((count + 1) / len(probes))
    progress.end()
