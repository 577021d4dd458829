"""angen walktest: a standard's walk test of a motion detector, without ROS."""
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping, Sequence

import yaml

from angen_apps.walktest import report
from angen_apps.walktest.arm import ARM_LIBRARY, arm_model, register_arm
from angen_apps.walktest.plan import Area, Probe, Result, Walk, probes_of, walk
from angen_apps.walktest.room import room
from angen_tools.common.catalog import angen_module
from angen_tools.common.failure import Failure
from angen_tools.common.output import as_json
from angen_tools.common.progress import Progress
from angen_tools.world import sdf, sensor

STANDARDS = Path(__file__).resolve().parent / 'standards'
STEP = 0.005      # s, of the physics
SAMPLE = 0.05     # s between two samples of the detector
LAG = 1.0         # s after a movement within which it may still report it; less than any stop
FORCE = 2000.0    # N of the person's legs, who keeps to the times
OFF_THE_WAY = 0.2  # m
SETTLE = 8.0      # s from an arm's appearance to its movement
SEED = 1


@dataclass(frozen=True)
class Detector:
    """The detector under test: its SDF model, its mounting and its declared coverage."""
    model: str
    xml: str
    height: float  # m
    yaw: float     # rad
    covers: Mapping[str, Area]


def _read(name: str) -> dict[str, Any]:
    return yaml.safe_load((STANDARDS / f'{name}.yaml').read_text(encoding='utf-8'))


def detector(model: str, settings: Sequence[tuple[str, str]], yaw: float) -> Detector:
    """The detector of a model, with parameters set on top of those of the test."""
    entry = _read('detectors')[model]
    values = [('model', model)]
    given = {key for key, _ in settings}
    values += [(key, str(value)) for key, value in entry['settings'].items() if key not in given]
    root = sensor.build('pir', 'detector', [*values, *settings], False)
    covers = {name: Area(**area) for name, area in entry['covers'].items()}
    return Detector(model, sdf.text(root), entry['height'], yaw, covers)


def run(profile: str, tested: Detector, out: Path, json: bool = False) -> bool:
    """Tests it, writes OUT/walktest_PROFILE_MODEL.csv and .png, prints the outcome; True: PASS."""
    standard = _read(profile)
    results = [_test(standard, test, tested) for test in standard['tests']]
    name = f'walktest_{profile}_{tested.model}'
    report.write_csv(out / f'{name}.csv', results)
    report.draw(out / f'{name}.png', f'{standard["title"]}: {tested.model}', results)
    passed = all(result.passed for result in results)
    if json:
        print(as_json([report.as_dict(result) for result in results]))
        return passed
    for result in results:
        print(report.describe(result))
    print(f'{standard["title"]}: {tested.model} {"PASS" if passed else "FAIL"}, '
          f'see {out / name}.png')
    return passed


def _test(standard: Mapping[str, Any], test: Mapping[str, Any], tested: Detector) -> Result:
    area = tested.covers[test['area']]
    all_probes: list[Probe] = []
    for probes in probes_of(test, area):
        if not probes:
            raise Failure(f'{test["name"]}: no cell is in the area that it should cover')
        if test['mover'] == 'arm':
            _swing(standard, test, tested, area, probes)
        else:
            _walk(standard, tested, area, walk(probes, test['speed'], test['stop']), test['name'])
        all_probes += probes
    return Result(test['name'], area, all_probes, test['required'], test.get('cell'))


def _world(standard: Mapping[str, Any], tested: Detector, area: Area, content: str) -> Any:
    """The empty room around the area, with the detector on its wall at x = 0."""
    margin = standard['room']['margin']
    text = room(area.reach + margin, area.half_width + margin, standard['room']['ambient'], STEP,
                content)
    world = angen_module().World.from_text(text, seed=SEED)
    world.spawn(tested.xml, 'detector', [0, 0, tested.height, 0, 0, tested.yaw])
    return world


def _walk(standard: Mapping[str, Any], tested: Detector, area: Area, way: Walk, name: str) -> None:
    """Walks the way; marks the probes during which the detector reported motion."""
    points = ''.join(f'<waypoint><time>{t}</time><pose>{x} {y} 0 0 0 {yaw}</pose></waypoint>'
                     for t, x, y, yaw in way.waypoints)
    person = standard['person']
    world = _world(standard, tested, area, f'''<actor name="person"><script><loop>false</loop>
      <trajectory id="0" type="walk">{points}</trajectory></script>
      <plugin name="person" filename="libperson_controller.so">
      <avoid>false</avoid>
      <skin_temperature>{person["skin"]}</skin_temperature>
      <clothing_temperature>{person["clothing"]}</clothing_temperature>
      <force_max>{FORCE}</force_max></plugin></actor>''')
    body = world.links.index('person::body')
    pending = list(way.probes)
    with Progress(f'{name} {way.probes[0].direction}') as progress:
        while pending:
            world.run(SAMPLE)
            while pending and world.time > pending[0].ends + LAG:
                done = pending.pop(0)
                if math.dist(world.link_poses[body][:2], done.end) > OFF_THE_WAY:
                    raise Failure(f'{name}: the person leaves the way at {done.end}')
                progress.update(1 - len(pending) / len(way.probes))
            if pending and world.time > pending[0].begins and _motion(world):
                pending[0].seen = True


def _motion(world: Any) -> bool:
    return world.sensor('pir', 'detector')['motion']


def _swing(standard: Mapping[str, Any], test: Mapping[str, Any], tested: Detector, area: Area,
           probes: list[Probe]) -> None:
    """Puts the arm into every place and moves it there and back."""
    register_arm()
    world = _world(standard, tested, area, '')
    with Progress(test['name']) as progress:
        for count, probe in enumerate(probes):
            _swing_at(world, test, probe)
            progress.update((count + 1) / len(probes))


def _swing_at(world: Any, test: Mapping[str, Any], probe: Probe) -> None:
    world.spawn(arm_model(test, probe.place), 'arm', [*probe.place, test['height'], 0, 0, 0])
    world.run(SETTLE)
    for rate in (test['rate'], -test['rate']):
        world.command(ARM_LIBRARY.removesuffix('.py'), 'arm', values=[rate])
        for _ in range(round(1.2 * test['turn'] / test['rate'] / SAMPLE)):
            world.run(SAMPLE)
            probe.seen = probe.seen or _motion(world)
    world.delete('arm')
    world.run(SETTLE / 4)
