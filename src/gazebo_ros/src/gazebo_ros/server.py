"""gzserver's command line as one of Angen's node."""
import argparse
import os
import sys
import time
from pathlib import Path

from roslib.packages import find_node
from rospkg import RosPack


EMPTY_WORLD = 'worlds/empty.world'


class Failure(Exception):
    """An error for the user, in one line."""


def parser() -> argparse.ArgumentParser:
    """Gazebo's options. Those without a meaning here are taken and not used."""
    made = argparse.ArgumentParser(
        prog='gzserver', description="Angen's simulator instead of Gazebo's server.")
    made.add_argument('-u', '--pause', action='store_true', help='start paused')
    made.add_argument('-r', '--record', action='store_true', help='record the run')
    made.add_argument('--record_path', metavar='FOLDER', help='where to record it')
    made.add_argument('--seed', type=int, default=1, help='of all noise')
    made.add_argument('-e', '--physics', default='ode', help='ode')
    made.add_argument('--verbose', action='store_true', help='not used')
    for option in ('-s', '--server-plugin', '-g', '--gui-plugin', '--gui-client-plugin', '-o',
                   '--profile', '--iters', '--initial_sim_time', '--record_encoding',
                   '--record_period', '--record_filter'):
        made.add_argument(option, action='append', help='not used')
    for option in ('-q', '--quiet', '--lockstep', '--minimal_comms', '--record_resources'):
        made.add_argument(option, action='store_true', help='not used')
    made.add_argument('world', nargs='?', default=EMPTY_WORLD,
                      help='SDF file, also below GAZEBO_RESOURCE_PATH')
    return made


def own_folder() -> Path:
    """That of the package gazebo_ros."""
    return Path(RosPack().get_path('gazebo_ros'))


def resource_folders() -> list[Path]:
    """The folders in which a world that is not a path is searched: the last is Angen's."""
    given = os.environ.get('GAZEBO_RESOURCE_PATH', '').split(':')
    return [Path(folder) for folder in given if folder] + [own_folder()]


def find_world(name: str) -> str:
    """The file of a world's name; the empty world if there is none, as in Gazebo."""
    tried = [Path(name)] + [folder / name for folder in resource_folders()]
    for path in tried:
        if path.is_file():
            return str(path.resolve())
    places = ', '.join(str(path.parent) for path in tried[1:])
    print(f'gzserver: no world {name}; searched the current folder, {places}: '
          f'starts {EMPTY_WORLD} in its place', file=sys.stderr)
    return str((own_folder() / EMPTY_WORLD).resolve())


def node_words(words: list[str]) -> list[str]:
    """The command line of Angen's node for gzserver's."""
    remappings = [word for word in words if ':=' in word]
    options, unknown = parser().parse_known_args([word for word in words if ':=' not in word])
    for word in unknown:
        print(f'gzserver: {word} is not known and is left out', file=sys.stderr)
    if options.physics != 'ode':
        print(f'gzserver: physics {options.physics}: ODE is the one engine here', file=sys.stderr)
    found = find_node('angen_sim', 'angen_node')
    if not found:
        raise Failure('there is no angen_node; build Angen and source devel/setup.bash')
    made = [found[0], find_world(options.world), '_odom_parent:=none']
    if not any(word.startswith('_strict:=') for word in remappings):
        made.append('_strict:=false')
    # Each always, because a master that lives on keeps the parameters of the node before.
    record = record_file(options.record_path) if options.record else ''
    made += [f'_paused:={str(options.pause).lower()}', f'_seed:={options.seed}',
             f'_record:={record}']
    return made + remappings


def record_file(folder: str | None) -> Path:
    """A new file for a recorded run, as Gazebo names its folders."""
    where = Path(folder) if folder else Path.home() / '.gazebo' / 'log'
    where.mkdir(parents=True, exist_ok=True)
    return where / time.strftime('%Y-%m-%dT%H%M%S.log')


def run(words: list[str], before: list[str] | None = None) -> None:
    """Become Angen's node, which `before` may run, such as a debugger."""
    try:
        line = (before or []) + node_words(words)
    except Failure as failure:
        sys.exit(f'gzserver: {failure}')
    os.execvp(line[0], line)
