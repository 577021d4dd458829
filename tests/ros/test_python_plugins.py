"""A sensor and a device in files of Python, which the node runs."""
import json
import subprocess
from pathlib import Path
from typing import Any, Iterator

import pytest
import yaml
from harness import ROOT, Master, own_node, until

ANGEN = str(ROOT / 'src/angen_tools/scripts/angen')
SENSOR = ROOT / 'tests/examples/rangefinder/rangefinder.py'
DEVICE = '''import angen

class Counter(angen.Device):
    """Counts its commands; divides by their numbers."""

    @staticmethod
    def describe(kind):
        kind.verb('Set', 'sets the count', 'commands', min=0, whole=True)
        kind.integer('count', '', 'of commands').shown().number('share', '', 'its inverse')

    @staticmethod
    def serves(model, joints, lights):
        return model == 'box'

    def configure(self, params, wiring):
        self.count = 1

    def command(self, text, values, view):
        if not text.startswith('Set '):
            return 'write Set and a number'
        self.count = int(text[4:])

    def report(self, view):
        return {'count': self.count, 'share': 1 / self.count}

angen.register('counter.py', 'counter', Counter)
'''
WORLD = '''<sdf version="1.6"><world name="w">
<plugin name="counter" filename="counter.py"/>
<model name="box"><static>true</static><pose>3 0 1 0 0 0</pose><link name="link">
<collision name="c"><geometry><box><size>0.2 4 2</size></box></geometry></collision></link></model>
<model name="eye"><static>true</static><pose>0 0 1 0 0 0</pose><link name="link">
<sensor name="s" type="ray"><plugin name="p" filename="rangefinder.py"/></sensor></link></model>
</world></sdf>'''


@pytest.fixture(scope='module')
def node(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Master, Any, Path]]:
    folder = tmp_path_factory.mktemp('scripts')
    (folder / 'rangefinder.py').write_text(SENSOR.read_text())
    (folder / 'counter.py').write_text(DEVICE)
    (folder / 'typo.py').write_text('import angen\n\nangen.register(typo)\n')
    with own_node(folder, WORLD, {'ANGEN_PLUGIN_PATH': str(folder)}, rate=10) as started:
        yield started.master, started.process, folder


def ask(master: Master, *words: str) -> str:
    return subprocess.run(words, env=master.environment, check=True, capture_output=True,
                          text=True, timeout=60).stdout


def test_its_readings_are_a_topic(node: tuple[Master, Any, Path]) -> None:
    master, _, _ = node
    assert master.topics()['/angen/rangefinder/eye'] == 'angen_msgs/Reading'
    text = ask(master, 'rostopic', 'echo', '-n', '1', '/angen/rangefinder/eye')
    assert 'range' in text and '2.9' in text


def test_a_file_with_an_error_is_rejected_with_its_line(node: tuple[Master, Any, Path]) -> None:
    master, process, folder = node
    xml = (WORLD[WORLD.index('<model name="eye">'):WORLD.index('</world>')]
           .replace('eye', 'eye2').replace('rangefinder.py', 'typo.py'))
    answer = ask(master, 'rosservice', 'call', '/angen/spawn',
                 "{name: eye2, xml: '<sdf version=\"1.6\">%s</sdf>'}" % xml.replace('\n', ''))
    assert 'success: False' in answer
    message = yaml.safe_load(answer)['message']
    assert message.endswith(f"{folder}/typo.py:3: NameError: name 'typo' is not defined")
    assert process.poll() is None


def test_its_verbs_and_fields_are_known(node: tuple[Master, Any, Path]) -> None:
    master, _, _ = node
    answer = ask(master, ANGEN, 'set', 'counter', 'box', '4', '--json')
    assert json.loads(answer) | {'text': ''} == {
        'kind': 'counter', 'names': ['box'], 'command': 'Set 4', 'waits': '', 'state': '4',
        'values': {'count': {'unit': '', 'value': 4.0}}, 'text': ''}
    told = subprocess.run([ANGEN, 'set', 'counter', 'box', '-1'], env=master.environment,
                          capture_output=True, text=True, timeout=60)
    assert 'takes 0 or more commands' in told.stderr


def test_a_method_that_fails_ends_its_device_only(node: tuple[Master, Any, Path]) -> None:
    master, process, folder = node
    answer = ask(master, 'rosservice', 'call', '/angen/command', '{target: box, text: "Set 0"}')
    assert 'success: True' in answer
    until(lambda: 'counter.py:24: ZeroDivisionError' in
          ask(master, 'rostopic', 'echo', '-n', '1', '/angen/counter/box'), 'its error is a field')
    text = ask(master, 'rostopic', 'echo', '-n', '2', '/angen/rangefinder/eye')
    assert text.count('2.9') >= 2 and process.poll() is None
    assert 'Traceback' not in (folder / 'log').read_text()
