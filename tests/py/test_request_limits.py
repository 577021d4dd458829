"""Limits of requests: checked before time and memory are spent on them."""
import subprocess
import sys

import pytest

import angen
from sdf_text import sdf_world
from spent import spent_on

LONGEST, LARGEST = 5.0, 500.0  # s of CPU time, MB


def chain(links: int, kind: str = 'fixed') -> str:
    """A robot whose links are in a row."""
    inertial = ('<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" '
                'iyz="0"/></inertial>')
    return '<robot name="r">' + ''.join(
        f'<link name="l{i}">{inertial}</link>' for i in range(links)) + ''.join(
        f'<joint name="j{i}" type="{kind}"><parent link="l{i}"/><child link="l{i + 1}"/>'
        '<axis xyz="0 0 1"/></joint>' for i in range(links - 1)) + '</robot>'


def in_link(part: str) -> str:
    return f'<model name="m"><static>true</static><link name="l">{part}</link></model>'


def camera(width: int, height: int, rate: float, library: str = 'libgazebo_ros_camera.so') -> str:
    kind = 'depth' if 'openni' in library else 'camera'
    return in_link(
        f'<sensor name="c" type="{kind}"><update_rate>{rate}</update_rate><camera><image><width>'
        f'{width}</width><height>{height}</height></image></camera>'
        f'<plugin name="c" filename="{library}"/></sensor>')


def attributes(count: int) -> str:
    return '<model name="m" ' + ' '.join(f'a{i}="1"' for i in range(count)) + '/>'


def robot(parts: list[str], links: int = 1) -> str:
    """A robot with these parts, whose links are one by fixed joints."""
    return chain(links).replace('</robot>', ''.join(parts) + '</robot>')


def plugins(count: int, library: str, inside: str = '') -> list[str]:
    each = [f'<plugin name="p{i}" filename="{library}">{inside}</plugin>' for i in range(count)]
    return ['<gazebo>', *each, '</gazebo>']


COLLISION = '<collision><geometry><box size="1 1 1"/></geometry></collision>'
TRANSMISSIONS = [f'<transmission name="t{i}"><joint name="j{i}"/></transmission>'
                 for i in range(1500)]
TEXTS = {
    'attributes': (attributes(200_000), 'more than 100 attributes'),
    'elements': ('<model name="m">' + '<a/>' * 900_000 + '</model>', 'more than 100000 elements'),
    'comments': ('<model name="m">' + '<!---->' * 500_000 + '</model>', 'elements or comments'),
    'bytes': (in_link('<pose>' + '1 ' * 3_000_000 + '</pose>'), 'a text may have 4 MB'),
    'numbers': (in_link('<pose>' + '1 ' * 1_900_000 + '</pose>'), 'numbers; give 6'),
    'name': (in_link('').replace('"m"', '"' + 'm' * 4_000_000 + '"'), 'name'),
    'depth': ('<model name="m">' * 90_000, 'more than 100 deep'),
    'chain': (chain(900), 'a chain of more than 200 joints'),
    'moving chain': (chain(900, 'continuous'), 'a chain of more than 200 joints'),
    'links': (chain(10_000), 'more than 1000 links'),
    'collisions of a robot': (chain(1).replace('</link>', COLLISION * 10_000 + '</link>'),
                              'more than 10000 elements'),
    'plug-ins of a robot': (
        robot(plugins(10_000, 'libgazebo_ros_p3d.so', '<bodyName>l0</bodyName>')),
        'more than 10000 elements'),
    'plug-ins of a part': (
        robot(plugins(2_000, 'libgazebo_ros_p3d.so', '<bodyName>l198</bodyName>'), 199),
        'their product may be at most 100000'),
    'transmissions': (robot(plugins(1500, 'libgazebo_ros_control.so') + TRANSMISSIONS),
                      'more than 10000 elements'),
    'address': ('<model name="m"><include><uri>model://' + '../' * 300_000
                + 'x</uri></include></model>', "model 'model://"),
    'library': ('<model name="m"><link name="l"/><plugin name="p" filename="' + 'a' * 1_000_000
                + '"/></model>', 'is not found'),
    'pixels': (camera(4000, 4000, 1.0), 'must have at most 3840 x 2160'),
    'pixels a second': (camera(3000, 2000, 100.0), 'pixels a second, must be at most'),
    'points': (camera(4096, 4096, 1.0, 'libgazebo_ros_openni_kinect.so'), 'must have at most 3840'),
}


def spawn(text: str) -> str:
    """The answer to a spawn in a world of its own, with the omissions of a model."""
    world = angen.World.from_text(sdf_world(''))
    try:
        world.spawn(text)
    except Exception as error:
        return str(error)
    return ' '.join(event[4] for event in world.events())


@pytest.mark.parametrize('what', TEXTS)
def test_too_much_is_rejected_at_once(what: str) -> None:
    text, reason = TEXTS[what]
    answer, seconds, megabytes = spent_on(spawn, text)
    assert reason in answer and len(answer) < 2000
    assert seconds < LONGEST and megabytes < LARGEST


def test_as_many_plug_ins_as_are_taken_are_read_at_once() -> None:
    _, seconds, megabytes = spent_on(spawn, robot(plugins(9_900, 'libgazebo_ros_p3d.so')))
    assert seconds < LONGEST and megabytes < LARGEST


def test_what_real_robots_have_is_taken() -> None:
    world = angen.World.from_text(sdf_world(''))
    world.spawn(chain(150))
    world.spawn(camera(3840, 2160, 30.0), name='camera')


PILE = """
import angen
world = angen.World.from_text('''{world}''')
for i in range(40):
    world.spawn('model://{model}', name=f'm{{i}}', pose=[0, 0, 0.5, 0, 0, 0.001 * i])
world.step(3)
print(sum(event[3] == 'crowded' for event in world.events()))
"""


@pytest.mark.parametrize('model', ['chair'])
def test_meshes_in_one_place_do_not_take_all_time(model: str) -> None:
    """Each pair takes 0.5 ms and more in each step: an event reports that some are left out."""
    done = subprocess.run([sys.executable, '-c', PILE.format(world=sdf_world(''), model=model)],
                          capture_output=True, text=True, timeout=300, check=True)
    assert done.stdout == '1\n'
    assert done.stderr.count('\n') <= 1 and 'ODE:' not in done.stderr
