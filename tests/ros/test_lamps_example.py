"""examples/lamps_by_pir.py in a house of three rooms without walls, where a person walks."""
import re
import subprocess
import sys
from pathlib import Path
from typing import Iterator

import pytest
from harness import Cli, own_node

EXAMPLE = Path(__file__).resolve().parents[2] / 'examples/lamps_by_pir.py'
SECONDS = 22


def include(model: str, name: str, pose: str) -> str:
    return (f'<include><uri>model://{model}</uri><name>{name}</name>'
            f'<pose>{pose}</pose></include>')


def room(name: str, x: float) -> str:
    """A lamp, a PIR that looks at the way along y = 0, and a light sensor below the lamp."""
    return (include('ceiling_lamp', f'{name}_lamp0', f'{x} 0 2.8 0 0 0')
            + include('pir', f'{name}_pir0_a', f'{x} 3 1.2 0 0 -1.5708')
            + include('luminosity_sensor', f'{name}_lux0', f'{x} 1 1.2 0 -1.57 0'))


WORLD = f'''<sdf version="1.6"><world name="rooms">
<model name="ground"><static>true</static><link name="link"><collision name="c">
<geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link></model>
{room('kitchen', 0)}{room('hall', 6)}{room('bedroom', 40)}
{include('ceiling_lamp', 'hall_spare_lamp0', '6 1 2.8 0 0 0')}
<actor name="person"><script><loop>true</loop><auto_start>true</auto_start>
<trajectory id="0" type="walk">
<waypoint><time>0</time><pose>-2 0 0 0 0 0</pose></waypoint>
<waypoint><time>9</time><pose>7 0 0 0 0 0</pose></waypoint>
</trajectory></script></actor></world></sdf>'''


@pytest.fixture
def house(tmp_path: Path) -> Iterator[Cli]:
    """A node of its own, four times as fast as the wall clock."""
    with own_node(tmp_path, WORLD, rate=4) as node:
        yield Cli(node.master)


def test_lamps_follow_the_person_where_it_is_dark(house: Cli) -> None:
    house.does('set', 'lamp', 'hall_spare0', 'on')
    done = subprocess.run([sys.executable, str(EXAMPLE), f'_duration:={SECONDS}'], text=True,
                          env=house.environment, capture_output=True, timeout=120)
    assert done.returncode == 0, done.stderr
    switched = [(float(time), name, to) for time, name, to in re.findall(
        r'\[INFO\].*, (\d+\.\d+)\]: (\w+) (on|off)', done.stdout + done.stderr)]
    assert {name for _, name, _ in switched} == {'kitchen0'}  # the hall is bright
    assert switched[0][2] == 'on'
    found = re.search(r'([\d.]+) lamp-hours instead of ([\d.]+) with all 3 lamps on: (\d+) % saved '
                      r'in (\d+) s', done.stdout)
    assert found, done.stdout
    used, all_on, saved, seconds = map(float, found.groups())
    assert seconds == pytest.approx(SECONDS, abs=2) and all_on == pytest.approx(seconds / 1200,
                                                                                abs=1e-3)
    on = [time for time, _, to in switched if to == 'on']
    off = [time for time, _, to in switched if to == 'off']
    if len(off) == len(on):
        assert 3600 * used == pytest.approx(sum(off) - sum(on), abs=3)
    rounded = 100 * 0.001 / all_on  # lamp-hours have three decimals
    assert saved == pytest.approx(100 * (1 - used / all_on), abs=rounded)
    assert 5 < 3600 * used < seconds
    watched = house.does('watch', '--once').splitlines()
    assert 'on  100 %' in next(line for line in watched if 'hall_spare0' in line)
