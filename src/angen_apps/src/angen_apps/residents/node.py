"""Residents in the running simulator: a file says who lives there."""
from __future__ import annotations

import datetime
import sys
from pathlib import Path

from angen_apps.maps.gridmap import load_world
from angen_apps.residents.floors import Floors
from angen_apps.residents.household import Household
from angen_apps.residents.live import Live
from angen_apps.residents.profiles import Profile, is_file, read
from angen_apps.residents.resident import make
from angen_apps.residents.truth import HEAD, Interval
from angen_tools.common.failure import Failure
from angen_tools.common.yaml_file import YamlFile

AHEAD = 60.0  # s of simulated time


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
    seed = int(file.number(entry['seed'], 'seed', 0)) if 'seed' in entry else 1
    starts = 7.0
    if 'starts' in entry:
        starts = file.number(entry['starts'], 'starts (hour of the day)', 0.0, 24.0)
    return who, seed, 3600.0 * starts


def run(path: Path, world: str, strict: bool = False) -> None:
    """Lives in the running simulator until it ends; `world`: the file that it was started with;
    `strict`: Failure if residents cannot do all that they do."""
    who, seed, since = read_household(path)
    simulator = Live()
    floors = Floors(load_world(world), simulator.home)
    date = datetime.date.fromisoformat((simulator.home.start or '2026-03-23')[:10])
    household = Household(simulator, floors, seed, 'home', date, since - simulator.now)

    def tell(now: Interval) -> None:
        simulator.publish({key: getattr(now, key) for key in HEAD if key != 'end'})

    for resident in make(household, who, strict):
        resident.diary.changed = tell
    while True:
        household.run(household.now + AHEAD)
        for resident in household.residents:
            resident.diary.closed.clear()


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
