"""Residents in the running simulator: a file says who lives there."""
from __future__ import annotations

import datetime
import json
import sys
from pathlib import Path

from angen_apps.maps.gridmap import load_world
from angen_apps.residents.floors import Floors
from angen_apps.residents.household import Household
from angen_apps.residents.profiles import Profile, is_file, read
from angen_apps.residents.members import make
from angen_apps.residents.simulator import Simulator
from angen_apps.residents.truth import HEAD, Interval
from angen_tools.common.failure import Failure
from angen_tools.common.yaml_file import YamlFile
from angen_tools.session.live import Live

AHEAD = 60.0  # s of simulated time
START = 120.0  # s of wall time until the simulator has started, which is started beside this


def read_household(path: Path) -> tuple[list[tuple[str, Profile]], int, float]:
    """Names and profiles, the seed, and the time of day (s) at simulated time 0, of a YAML file."""
    file = YamlFile(path)
    entry = file.entries(file.root, 'the household', ('residents', 'seed', 'starts'),
                         ('residents',))
    who = []
    for name, node in file.entries(entry['residents'], 'residents').items():
        text = file.text(node, name)
        beside = path.parent / text
        who.append((name, read(str(beside) if is_file(text) else text)))
    starts = file.number(entry['starts'], 'starts (hour of the day)', 0.0, 24.0) \
        if 'starts' in entry else 7.0
    return who, int(entry.of('seed', file.number, 1, 0)), 3600.0 * starts


def run(path: Path, file: str, strict: bool = False) -> None:
    """Lives in the running simulator until it ends; `file`: the world that it was started with;
    `strict`: Failure if residents cannot do all that they do."""
    from rospy import Publisher
    from std_msgs.msg import String
    who, seed, since = read_household(path)
    world = Live(START)
    world.join()
    truth = Publisher('angen/residents', String, queue_size=50, latch=True)
    simulator = Simulator(world)
    floors = Floors(load_world(file), simulator.home)
    date = datetime.date.fromisoformat((simulator.home.start or '2026-03-23')[:10])
    household = Household(simulator, floors, seed, 'home', date, since - simulator.now)

    def tell(now: Interval) -> None:
        """JSON has no NaN, so an unknown place is null."""
        row = {key: getattr(now, key) for key in HEAD if key != 'end'}
        truth.publish(json.dumps({key: None if value != value else value
                                  for key, value in row.items()}))

    for resident in make(household, who, strict):
        resident.diary.changed = tell
    while True:
        household.run(household.now + AHEAD)
        for resident in household.residents:
            resident.diary.closed.clear()
            resident.talks.clear()


def main() -> None:
    """[--strict] FILE WORLD: the node residents, see docs/data.md."""
    from rospy import myargv
    words = myargv()[1:]
    strict = words[:1] == ['--strict']
    if len(words) != 2 + strict:
        sys.exit('usage: residents [--strict] FILE WORLD')
    try:
        run(Path(words[-2]), words[-1], strict)
    except Failure as failure:
        sys.exit(f'angen: {failure}')
