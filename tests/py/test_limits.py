"""No number, name or size in a world may end the process."""
import multiprocessing
import os
import re
import resource
import signal
import tempfile
from pathlib import Path

import pytest

import angen
from sdf_text import sdf_world

HOSTILE = ['1e19', '1e308', '-1e308', '1e-320', 'nan', 'inf']
NUMBER = re.compile(r'[-+]?\d+(\.\d+)?(e[-+]?\d+)?')

EVERY_NUMBER = Path(__file__).resolve().with_name('every_number.world')


def representative() -> str:
    """A small world with every kind of number that a file can hold."""
    return EVERY_NUMBER.read_text(encoding='utf-8')


def spans_of(text: str) -> list[tuple[int, int]]:
    """The places of the numbers in the texts of elements, alone or in rows."""
    spans = []
    for piece in re.finditer(r'>([^<>]+)<', text):
        at = piece.start(1)
        words = piece.group(1).split()
        if not words or not all(NUMBER.fullmatch(word) for word in words):
            continue
        for word in re.finditer(r'\S+', piece.group(1)):
            spans.append((at + word.start(), at + word.end()))
    return spans


def cases() -> list[tuple[str, str]]:
    """Pairs of a description and a world in which one number is hostile."""
    text = representative()
    found = []
    for begin, end in spans_of(text):
        line = text.count('\n', 0, begin) + 1
        for hostile in HOSTILE:
            name = f'line {line}: {text[max(0, begin - 40):begin].split("<")[-1]}{hostile}'
            found.append((name, text[:begin] + hostile + text[end:]))
    return found


def attempt(text: str) -> str:
    """Loads a world and runs it for 100 ticks; the problem of that run, or ''."""
    try:
        world = angen.World.from_text(text)
        world.step(100)
    except angen.Error as error:
        first = str(error).split('\n')[0]
        return '' if re.match(r'<text>:\d+: ', first) else f'an error without a place: {first}'
    return ''


def work(first: int, path: str) -> None:
    """Runs the cases from `first` on, writing each before it runs and its problem after it."""
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    all_cases = cases()
    with open(path, 'a', encoding='utf-8') as notes:
        for index in range(first, len(all_cases)):
            notes.write(f'{index}\n')
            notes.flush()
            signal.alarm(60)
            wrong = attempt(all_cases[index][1])
            if wrong:
                notes.write(f'! {all_cases[index][0]}: {wrong}\n')


def test_no_number_of_a_world_ends_the_process() -> None:
    """1e19, 1e308, -1e308, 1e-320, nan and inf in the place of every number."""
    all_cases = cases()
    assert len(all_cases) > 900
    wrong = []
    first = 0
    context = multiprocessing.get_context('fork')
    with tempfile.NamedTemporaryFile(mode='r', encoding='utf-8') as notes:
        while first < len(all_cases):
            child = context.Process(target=work, args=(first, notes.name))
            child.start()
            child.join()
            done = [line for line in notes.read().split('\n') if line]
            wrong += [line for line in done if line.startswith('!')]
            last = int([line for line in done if not line.startswith('!')][-1])
            if child.exitcode == 0:
                break
            wrong.append(f'! {all_cases[last][0]}: ended with {child.exitcode}')
            first = last + 1
            assert len(wrong) < 40, '\n'.join(wrong)
    assert not wrong, '\n'.join(wrong)


def test_the_representative_world_itself_is_sound() -> None:
    """The sweep's own world loads, without a warning."""
    world = angen.World.from_text(representative())
    world.step(100)
    assert world.warnings == []
    assert [event for event in world.events() if event[3] == 'stopped'] == []


@pytest.mark.parametrize('pose', [[1e19, 0, 0, 0, 0, 0], [0, 0, -1e308, 0, 0, 0],
                                  [0, 0, float('nan'), 0, 0, 0]])
def test_a_spawn_beyond_the_limits_is_rejected(world, pose) -> None:
    """A pose of Python has the limits that one of a file has."""
    there = world('')
    sphere = ('<model name="m"><link name="l"><collision name="c"><geometry><sphere>'
              '<radius>1</radius></sphere></geometry></collision></link></model>')
    with pytest.raises(angen.Error, match='pos'):
        there.spawn(sphere, 'm', pose)
    there.step(10)
    assert there.models == ['floor']


def test_commands_have_limits_by_their_unit(world) -> None:
    """A verb's number, by text and by values."""
    text = representative()
    door = text[text.index('<model name="hall_door">'):text.index('<model name="arm">')]
    there = world(door)
    with pytest.raises(angen.Error, match='at most 1000000 rad|at most 1e[+]06 rad'):
        there.command('door', 'hall0', 'Set 1e19')
    there.step(100)


def test_what_flies_off_is_stopped_and_warnings(world) -> None:
    """A body that falls sideways for ever ends as an event, and then moves no more."""
    text = ('<model name="hangs"><pose>0 0 1 0 0 0</pose><link name="l"><gravity>0</gravity></link>'
            '</model><model name="falls"><pose>3 0 1 0 0 0</pose><link name="l"/></model>')
    there = angen.World.from_text(
        sdf_world(text).replace('<physics', '<gravity>9000 0 -9.81</gravity><physics'))
    there.step(20000)
    stopped = [event for event in there.events() if event[3] == 'stopped']
    assert [event[1] for event in stopped] == ['falls']
    assert 'its speed would be' in stopped[0][4]
    before = there.link_poses.copy()
    there.step(100)
    assert (there.link_poses == before).all()


def test_real_worlds_are_within_the_limits(world) -> None:
    """Inertias of 1e-9, joint limits of 1e16, kp of 1e12, a body of 1e-6 kg."""
    there = world('''<model name="m"><pose>0 0 1 0 0 0</pose><link name="a"><inertial>
      <mass>1e-6</mass><inertia><ixx>1e-9</ixx><iyy>1e-9</iyy><izz>1e-9</izz></inertia></inertial>
      <collision name="c"><geometry><sphere><radius>0.01</radius></sphere></geometry><surface>
      <contact><ode><kp>1e12</kp><kd>1</kd></ode></contact><friction><ode><mu>1e30</mu></ode>
      </friction></surface></collision></link><link name="b"/><joint name="j" type="revolute">
      <parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz><limit><lower>-1e16</lower>
      <upper>1e16</upper><effort>1e16</effort><velocity>1e16</velocity></limit></axis></joint>
      </model>''')
    assert there.warnings == []
    there.step(1000)
    assert [event for event in there.events() if event[3] == 'stopped'] == []


def test_a_solver_constant_that_is_too_large_is_a_warning() -> None:
    """It is clamped, and the world runs."""
    text = representative().replace('<cfm>1e-9</cfm>', '<cfm>1e300</cfm>')
    there = angen.World.from_text(text.replace('<kp>1e5</kp>', '<kp>1e30</kp>'))
    warnings = '\n'.join(there.warnings)
    assert re.search(r'<text>:\d+: <cfm> is 1e\+300; it is taken as 1e\+06', warnings), warnings
    assert re.search(r'<text>:\d+: <kp> is 1e\+30; it is taken as 1e\+16', warnings), warnings
    there.step(100)


def test_names_of_100000_characters(world) -> None:
    """Wherever they are given, the message is short, and names are the rule's."""
    long = 'n' * 100_000
    one = '<model name="m"><link name="l"/>'
    there = world('')
    attempts = [
        lambda: there.command('door', long, 'Open'),
        lambda: there.command(long, 'a', 'Open'),
        lambda: there.delete(long),
        lambda: there.sensor('pir', long),
        lambda: there.device(long, long),
        lambda: there.spawn(f'<model name="{long}"><link name="l"/></model>'),
        lambda: there.spawn('<model name="m"><link name="l"/></model>', long),
        lambda: there.spawn(f'<model name="m"><link name="{long}"/></model>'),
        lambda: there.spawn(f'{one}<joint name="j" type="{long}"/></model>'),
        lambda: there.spawn(f'{one}<joint name="j" type="fixed"><parent>{long}</parent>'
                            '<child>l</child></joint></model>'),
        lambda: there.spawn(f'<model name="m"><link name="l"><pose>{long}</pose></link></model>'),
        lambda: there.spawn(f'{one}<plugin name="{long}" filename="libros_plugin.so"/></model>'),
        lambda: there.spawn(f'{one}<{long}/></model>'),
        lambda: there.spawn(f'{one}<plugin name="p" filename="{long}"/></model>'),
        lambda: there.spawn(f'<include><uri>model://{long}</uri></include>'),
        lambda: there.spawn('<sensor name="s" type="ray"><plugin name="p" filename='
                            '"libpir_controller.so"/></sensor>', 's', [0] * 6, f'floor::{long}'),
        lambda: angen.World.from_text(sdf_world('').replace('name="test"', f'name="{long}"')),
    ]
    for index, each in enumerate(attempts):
        try:
            each()
        except angen.Error as error:
            assert len(str(error)) < 5000, (index, str(error)[:300])
        assert all(len(warning) < 5000 for warning in there.warnings), index
    there.step(10)


@pytest.mark.parametrize('value', ['0.2:', '0.2 0.3', '', 'x', '1e', '0x10', '1e400', 'nan', '0,2'])
def test_a_mass_of_a_urdf_that_is_not_a_number(world, value) -> None:
    """No message of the standard library comes through."""
    there = world('')
    robot = (f'<robot name="r">\n<link name="l">\n<inertial>\n<mass value="{value}"/>'
             '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>')
    with pytest.raises(angen.Error) as error:
        there.spawn(robot, 'r')
    assert re.match(r'\(text\):[34]: ', str(error.value)), str(error.value)
    assert 'sto' not in str(error.value), str(error.value)


if __name__ == '__main__':
    work(0, os.devnull)
