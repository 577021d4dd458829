"""./angen run: a ROS master where none runs, and the launch file. Ends all that it has started, and
restarts both where the master was lost.
"""
import itertools
import math
import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path
from typing import Any, NoReturn, Self, Sequence

from angen_tools.common.clock import duration
from angen_tools.common.failure import Failure, code_of
from angen_tools.common.watchdog import watchdog
from angen_tools.entry.arguments import check_arguments, check_page, kinds
from angen_tools.entry.machine import has_display, stay_local
from angen_tools.entry.master import call, running_node, start_master
from angen_tools.entry.rescue import Rescue

FILES = ('world', 'record', 'replay', 'residents')  # arguments
TIMES = ('until',)
END_LIMIT = 4.0  # s for an orderly end
SAVE_LIMIT = 30.0  # s that the node has to notice that its master is another, and save the world
TURN = 0.1
READY = 'angen/list'  # a service that the node has once it runs a world
# roslaunch's own progress is left out, which it prints by Python, and its box about a node that has
# ended with an error of its own; other errors and nodes' lines are not.
ROSLAUNCH = '''
import os, sys, roslaunch, roslaunch.pmon
sys.stdout = open(os.devnull, "w")
say = roslaunch.pmon.printerrlog
roslaunch.pmon.printerrlog = lambda text: "exit code 1," in text or say(text)
roslaunch.main()'''
OPTIONS = ('--disable-title', '--no-summary', '--skip-log-check', '--sigint-timeout=1.5',
           '--sigterm-timeout=0.5')
HELP = 'Ctrl-C ends it. To try, in a second terminal{after}:'
BUILDING = (  # arguments of the world without world:=
    'rostopic pub -1 /gazebo/Door_controller std_msgs/String "Open, bathroom1"',
    'rostopic pub -1 /gazebo/Light_controller std_msgs/String "On, kitchen0"',
    'rostopic pub -1 /gazebo/Elevator_controller std_msgs/String "Floor1"')
ANY = ('angen list', 'angen watch', 'angen set KIND NAME VALUE')
# A shell's exit codes of programs that these signals ended.
CODES = {signal.SIGINT: 130, signal.SIGQUIT: 130, signal.SIGTERM: 143, signal.SIGHUP: 129}


def say(text: str) -> None:
    print(f'angen: {text}', file=sys.stderr, flush=True)


def stop(number: int, _: Any) -> NoReturn:
    """At a signal; later ones change nothing."""
    for other in CODES:
        signal.signal(other, signal.SIG_IGN)
    sys.exit(CODES[signal.Signals(number)])


class Session:
    """The master and roslaunch. A context: its end ends them."""

    def __init__(self, uri: str, hints: Sequence[str]) -> None:
        """`hints` are for the user of a world that runs."""
        self._uri = uri
        self._hints = hints
        self.ran = False
        self._master: subprocess.Popen[bytes] | None = None
        self._launch: subprocess.Popen[bytes] | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for process in (self._launch, self._master):
            if process is not None and process.poll() is None:
                # The group has the commands by which roslaunch finds parameters, but no node. By
                # SIGINT Python prints a traceback while it still starts.
                os.killpg(process.pid, signal.SIGTERM)
                try:
                    process.wait(END_LIMIT)
                except subprocess.TimeoutExpired:
                    process.kill()  # the watchdog ends its remaining children

    def launch(self, launch: Path, words: list[str]) -> int:
        """Runs the launch file to its end; roslaunch's exit code."""
        started = start_master(self._uri)
        if started or (self._master is not None and self._master.poll() is not None):
            self._master = started
        self._launch = subprocess.Popen(
            [sys.executable, '-c', ROSLAUNCH, *OPTIONS, str(launch), *words],
            stdin=subprocess.DEVNULL, start_new_session=True,
            env=dict(os.environ, ROSCONSOLE_STDOUT_LINE_BUFFERED='1'))  # also through a pipe
        return self._wait(self._launch)

    def _wait(self, launch: subprocess.Popen[bytes]) -> int:
        lost = math.inf
        while launch.poll() is None:
            if not self.ran and self._runs():
                self.ran = True
                for hint in self._hints:
                    say(hint)
            if self._master is not None and self._master.poll() is not None:
                say('the ROS master has ended; another one is started, the node saves the world')
                lost = time.monotonic()
                self._master = start_master(self._uri)
            elif time.monotonic() - lost > SAVE_LIMIT:
                raise Failure('the node has not ended without its ROS master')
            time.sleep(TURN)
        return launch.returncode

    def _runs(self) -> bool:
        """Whether the node runs its world; a node that cannot says why."""
        from rosgraph.names import get_ros_namespace
        with suppress(Failure, OSError):
            return call(self._uri, 'lookupService', get_ros_namespace() + READY) is not None
        return False


def require_no_other(uri: str) -> None:
    """Failure if a node of ours runs already: a second one would end it."""
    from rosgraph.names import get_ros_namespace
    name = get_ros_namespace() + 'angen'
    process = running_node(uri, name)
    if process:
        host, _, port = uri.rstrip('/').rpartition(':')
        beside = f'{host}:{int(port) + 1}' if port.isdigit() else 'another'
        raise Failure(f'already running at {uri} ({process}); it is not changed. To end it: Ctrl-C '
                      f'where it was started, or rosnode kill {name}; to start another beside it: '
                      f'ROS_NAMESPACE=house2 ./angen run, or ROS_MASTER_URI={beside} ./angen run'
                      )


def with_world(words: list[str], world: Path) -> list[str]:
    """The words with the world of a further start. Its models are found where those of the first
    are; it is recorded into a file of its own."""
    given = dict(word.split(':=', 1) for word in words if ':=' in word)
    if 'world' in given:
        folder = Path(given['world']).parent  # it may still name its files
        for variable, first in (('ANGEN_MODEL_PATH', folder / 'models'),
                                ('GAZEBO_RESOURCE_PATH', folder)):
            path = [str(first), *filter(None, os.environ.get(variable, '').split(':'))]
            os.environ[variable] = ':'.join(dict.fromkeys(path))
    if given.get('record'):
        log = Path(given['record'])
        given['record'] = str(next(
            other for number in itertools.count(2)
            if not (other := log.with_name(f'{log.stem}_{number}{log.suffix}')).exists()))
        say(f"it is recorded into {given['record']} from here")
    changed = {**given, 'world': str(world), 'replay': '', 'until': '', 'commands': ''}
    return [*(word for word in words if ':=' not in word),
            *(f'{name}:={value}' for name, value in changed.items() if value)]


def resolved(word: str) -> str:
    """A file by its absolute path, as roslaunch starts nodes in another folder; a time in s."""
    name, _, value = word.partition(':=')
    if name in TIMES:
        with suppress(ValueError):  # a number alone is in s already
            value = f'{duration(value):.9g}'
    if name in FILES:
        value = os.path.realpath(os.path.expanduser(value))
    return f'{name}:={value}' if value else word


def help_text(angen: Path, words: list[str]) -> str:
    """The commands to try in the world that the words start."""
    other = any(word.startswith(('world:=', 'replay:=')) for word in words)
    after = f', after {angen} shell' if angen.exists() else ''  # a package needs no shell
    return '\n         '.join([HELP.format(after=after), *(ANY if other else BUILDING)])


def run(launch: Path, words: list[str]) -> int:
    """Runs the simulator until it ends; the exit code, which is never 0."""
    from rosgraph import get_master_uri
    check_arguments(launch, words)
    stay_local()
    uri = get_master_uri()
    require_no_other(uri)
    check_page(launch, words)
    words = [resolved(word) for word in words]
    hidden = 'gui' not in kinds(launch) or {'gui:=false', 'headless:=true'} & set(words)
    hints = [help_text(launch.parent.parent / 'angen', words)]
    if not hidden and not has_display():
        hints.insert(0, 'no display: the building runs without rviz')
        words.append('gui:=false')
    now, count = words, 1
    with watchdog(), Rescue() as rescue, Session(uri, hints) as session:
        while True:
            code = session.launch(launch, [*now, f'rescue:={rescue.path}'])
            world = rescue.take()
            if world is None and count > 1:
                raise Failure('the simulator ended unexpectedly after it was started again')
            if world is None:
                if session.ran:
                    say('the simulator ended unexpectedly')
                return code or 1  # roslaunch ends with 0 if a node has failed
            say('the ROS master was lost: starting again with the saved world')
            count += 1
            now = with_world(words, world)


def main() -> None:
    """LAUNCH WORD..."""
    for number in CODES:
        if signal.getsignal(number) != signal.SIG_IGN:  # ignored under nohup
            signal.signal(number, stop)
    try:
        sys.exit(run(Path(sys.argv[1]), sys.argv[2:]))
    except Failure as failure:
        say(str(failure))
        sys.exit(code_of(failure))


if __name__ == '__main__':
    main()
