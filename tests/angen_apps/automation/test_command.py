"""Shipped automations over simulated homes: naive ones fail their scenario, good ones pass.
bench/automation/shipped.py runs all of them."""
import sys
from pathlib import Path

import pytest
from lxml import etree

from angen_apps.automation.bench import Record
from angen_apps.automation.command import run_scenario, test as run_test
from angen_apps.automation.judge import FAILED, PASSED, Verdict
from angen_apps.automation.scenario import read_scenario
from angen_tools.cli import main
from angen_tools.common.failure import WrongWords

FOLDER = Path(__file__).resolve().parents[3] / 'examples/automation'


def run(name: str, variant: str) -> tuple[Record, list[Verdict]]:
    return run_scenario(read_scenario(FOLDER / f'{name}.yaml'), [FOLDER / f'{name}_{variant}.yaml'])


def test_a_radiator_and_an_open_window() -> None:
    """The good one waits a minute, so that a look out of the window changes nothing; a window
    takes a second to open. The same run has the same bytes."""
    (_, found), (good, verdicts) = run('open_window', 'naive'), run('open_window', 'good')
    assert [each.outcome for each in found] == [PASSED, FAILED, PASSED]
    assert {each.outcome for each in verdicts} == {PASSED}
    assert [done.what for done in good.done] == ['climate.set_temperature temperature: 8',
                                                 'climate.set_temperature temperature: 21']
    assert 20 * 60 + 60 < good.done[0].time < 20 * 60 + 65 < 50 * 60 < good.done[1].time
    again, _ = run('open_window', 'good')
    assert again.done == good.done and again.lines.values == good.lines.values
    assert again.house.site.world.fingerprint == good.house.site.world.fingerprint


def test_weather_is_that_of_the_whole_home(tmp_path: Path) -> None:
    path = tmp_path / 'cold.yaml'
    path.write_text("""lasts: 10 s
weather: [{at: 0 s, outside: 3}, {at: 5 s, outside: -7.5}]
expect: [{never: nobody in kitchen0}]
""" + f'automation: {FOLDER / "forgotten_stove_good.yaml"}\n')
    record, _ = run_scenario(read_scenario(path))
    outdoors = {record.house.world.state('climate', name)['outside_temperature']
                for name in record.house.site.world.devices('climate')}
    assert outdoors == {-7.5}


@pytest.mark.parametrize('name', ['forgotten_stove', 'night_light', 'nobody_home', 'reading_light',
                                  'wake_up'])
def test_a_good_one_passes(name: str) -> None:
    _, verdicts = run(name, 'good')
    assert {each.outcome for each in verdicts} == {PASSED}


def test_a_forgotten_stove(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """By the command: exit code, JUnit XML, picture, tables."""
    scenario = [FOLDER / 'forgotten_stove.yaml']
    assert run_test(scenario, [FOLDER / 'forgotten_stove_naive.yaml'], tmp_path, False) == 1
    assert "failed     " in capsys.readouterr().out
    suite = etree.parse(str(tmp_path / 'junit.xml')).getroot()[0]
    assert (suite.get('tests'), suite.get('failures'), suite.get('skipped')) == ('4', '1', '0')
    failed, = suite.iter('failure')
    assert failed.getparent().get('name') == "nobody's soup gets cold"
    assert failed.text.startswith('12:22:00 to')
    assert (tmp_path / 'automation.png').read_bytes()[:4] == b'\x89PNG'
    assert ',button.press,button.kitchen_stove_off,' in (tmp_path / 'commands.csv').read_text()


def test_a_program_on_mqtt(tmp_path: Path) -> None:
    """Time waits for its answers: what it does is exact to its tick of a second."""
    record, verdicts = run_scenario(read_scenario(FOLDER / 'hall_light.yaml'))
    assert {each.outcome for each in verdicts} == {PASSED}
    motion = record.lines.values['binary_sensor.hall_motion_sensor', '']
    on = [time for time, state in motion if state == 'on']
    assert [done.time for done in record.done if 'ON' in done.what] == [on[0], on[-1]]


PROGRAM = """
import sys
import paho.mqtt.client as mqtt

def receive(client, _, message):
    payload = message.payload.decode()
    if message.topic.endswith('barrier'):
        client.publish(message.topic + '/done', payload + ' 100.5')
    else:
        client.publish('angen/notify', sys.argv[2] + ' ' + payload)

client = mqtt.Client()
client.on_message = receive
client.on_connect = lambda *_: client.subscribe([('angen/bridge/barrier', 0),
                                                 ('angen/simulation/simulation/time', 0)])
client.connect('127.0.0.1', int(sys.argv[1]))
client.loop_forever()
"""


def test_a_program_that_says_when_it_needs_the_time(tmp_path: Path) -> None:
    """It is not sent for its own sake before, and each second afterwards. Its words are messages
    to people."""
    (tmp_path / 'program.py').write_text(PROGRAM)
    (tmp_path / 's.yaml').write_text(
        'start: 2026-03-23 21:00\nlasts: 103 s\n'
        f'program: {{run: "{sys.executable} {{folder}}/program.py {{port}} {{start}}"}}\n'
        'expect: [{at_least: 3, notes: "21:00:00"}]\n')
    record, (verdict,) = run_scenario(read_scenario(tmp_path / 's.yaml'))
    assert verdict.outcome == PASSED
    times = [done.what.split()[1] for done in record.done]
    assert [each for each in times if not each.endswith('0.011')] == [  # numbers are read then
        '100.500', '101.000', '102.000', '103.000']
    assert record.done[0].what.startswith('2026-03-23T21:00:00 ')


@pytest.mark.parametrize('program, why', [
    (f'{sys.executable} -c pass', 'has ended with 0'), ('/no/such/program', 'No such file')])
def test_a_program_that_ends(tmp_path: Path, program: str, why: str) -> None:
    path = tmp_path / 's.yaml'
    path.write_text(f'lasts: 10 min\nprogram: {{run: {program}}}\n'
                    'expect: [{never: light.kitchen_lamp is on}]\n')
    try:
        record, verdicts = run_scenario(read_scenario(path))
    except WrongWords as error:
        assert str(error).startswith(f'{path}:2: ') and why in str(error)
    else:
        assert why in record.cut and [each.outcome for each in verdicts] == ['not judged']


@pytest.mark.parametrize('line, words', [
    ('expect: [{never: light.kitchen_lamp is bright}]', "never 'bright'"),
    ('expect: [{never: anna in kitchen0}]', "no person 'anna'"),
    ('script: [{at: 1 s, do: lamp/cellar On}]\nexpect: [{never: nobody home}]',
     "no lamp is named 'cellar'"),
    ('add: [{model: pir, name: p, room: cellar}]\nexpect: [{never: nobody home}]',
     "no room 'cellar'")])
def test_what_the_home_has_not(tmp_path: Path, capsys: pytest.CaptureFixture[str], line: str,
                               words: str) -> None:
    path = tmp_path / 's.yaml'
    path.write_text(f'lasts: 10 min\nautomation: {FOLDER}/open_window_good.yaml\n{line}\n')
    assert main.run(['automation-test', str(path), '--out', str(tmp_path)]) == 2
    error = capsys.readouterr().err
    assert f'{path}:3: ' in error and words in error
