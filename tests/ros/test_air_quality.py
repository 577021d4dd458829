"""A plug-in package of a user, with a message of its own: tests/examples/air_quality.

CTest builds it as its author would, in a workspace of its own; sourcing that workspace is enough.
"""
import os
import re
import subprocess
from typing import Iterator

import pytest
from harness import ROOT, TREE, Cli, Master, own_node, until

PACKAGE = ROOT / 'tests/examples/air_quality'
DEVEL = TREE / 'tests/examples/air_quality/devel'
WORLD = '''<sdf version="1.6"><world name="office">
<model name="ground"><static>true</static><link name="link"><collision name="c">
<geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link></model>
<include><uri>model://co2_sensor</uri><name>air</name><pose>0 0 1.5 0 0 0</pose></include>
<include><uri>model://blind</uri><name>blind0</name><pose>5 0 0.5 0 0 0</pose></include>
<actor name="ann"><script><loop>true</loop><auto_start>true</auto_start>
<trajectory id="0" type="walk">
<waypoint><time>0</time><pose>2 0 0 0 0 0</pose></waypoint>
<waypoint><time>1000</time><pose>2 0 0 0 0 0</pose></waypoint>
</trajectory></script></actor></world></sdf>'''


@pytest.fixture(scope='module')
def office(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Master]:
    """A node 20 times as fast as the wall clock, with the package's workspace sourced."""
    assert (DEVEL / 'lib/libair_quality.so').exists(), 'ctest builds it: ./angen test ctest'
    environment = {}
    for variable, entry in (('CMAKE_PREFIX_PATH', DEVEL), ('ROS_PACKAGE_PATH', PACKAGE),
                            ('LD_LIBRARY_PATH', DEVEL / 'lib'),
                            ('PYTHONPATH', DEVEL / 'lib/python3/dist-packages'),
                            ('ANGEN_MODEL_PATH', PACKAGE / 'models')):
        others = os.environ.get(variable)
        environment[variable] = f'{entry}:{others}' if others else str(entry)
    with own_node(tmp_path_factory.mktemp('ros'), WORLD, environment, rate=20) as node:
        yield node.master


def run(master: Master, *words: str) -> str:
    return subprocess.run(words, env=master.environment, check=True, capture_output=True,
                          text=True, timeout=60).stdout


def command(master: Master, text: str) -> str:
    return run(master, 'rosservice', 'call', '/angen/command',
               f'{{target: blind0, text: "{text}"}}')


def test_its_sensor_publishes_its_own_message(office: Master) -> None:
    assert office.topics()['/angen/co2/air'] == 'air_quality/Co2Msg'

    def risen() -> bool:
        text = run(office, 'rostopic', 'echo', '-n', '1', '/angen/co2/air')
        found = re.search(r'concentration: ([\d.]+)', text)
        assert found, text
        return float(found[1]) > 425.0  # one person adds 10 ppm a minute to 30 m^3
    until(risen, 'the person in view breathes out')


def test_its_device_takes_its_verbs(office: Master) -> None:
    assert 'success: True' in command(office, 'Down')
    until(lambda: '100 %' in command(office, 'Set 100'), 'the blind is down')
    assert 'success: True' in command(office, 'set 30')
    until(lambda: 'still  30 %' in command(office, 'Set 30'), 'the blind is at 30 percent')


def test_a_wrong_command_is_answered_with_the_right_ones(office: Master) -> None:
    answer = command(office, 'Tilt')
    assert 'success: False' in answer and 'a blind takes Up, Down, Set <0 to 100 percent>' in answer
    assert 'out of range' in command(office, 'Set 140')


def test_both_are_in_the_catalog(office: Master) -> None:
    listed = run(office, 'rosservice', 'call', '/angen/list', 'kind: blind')
    assert 'name: "blind0"' in listed and 'angen_msgs/Reading' in listed


def test_the_command_line_knows_both(office: Master) -> None:
    cli = Cli(office)
    assert cli.does('spawn', 'co2', 'c2', '--pose', '1 1 1.5', '--set', 'volume=40') == (
        'spawned the co2 c2, see /angen/co2/c2')
    assert 'ppm  fresh' in cli.does('watch', '--once', 'c2')
    assert cli.does('delete', 'c2') == 'deleted c2'
    assert re.match(r'blind blind0: \w+, \d+ %$', cli.does('set', 'blind', 'blind0', '10'))
    assert 'up, down or 0 to 100 percent' in cli.run('set', 'blind', 'blind0', '140').stderr
    assert 'limit' in cli.does('spawn', 'co2', '--help')
