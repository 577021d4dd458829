"""Runs the commands of the pages as a reader would, with a simulator in a second terminal.

Left out are those that do not end by themselves or take longer than a minute, and those that need
root, a network, or hands.
"""
import os
import re
import signal
import subprocess
import time
import xmlrpc.client
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Iterator

import pytest
from angen_tools.session.live import Live
from harness import free_port

from tests.docs.pages import PAGES, ROOT, blocks, files

pytestmark = pytest.mark.ros

# In a terminal of its own; ends with Ctrl-C.
START = re.compile(r'\./angen run(?! --)((?: \w+:=\S+)*)')
LEFT_OUT = re.compile('|'.join((
    r'\./angen (shell|demo|build|wheel|package)( [^"]*)?$',  # as CI does
    r'\./angen (test|fuzz|coverage|tidy|docs)( [^"]*)?$',
    r'mosquitto_',  # ros/test_mqtt.py runs them
    r'(\./)?angen (drive|watch$|care$|web|edit|mqtt|replay .*--until)',  # hands, no end
    r'(\./)?angen (bench|task|situations$|generate|validate out|realism out)',  # minutes
    r'.*(ROS_NAMESPACE=|ROS_IP=|--ns )',  # ros/test_namespaces.py runs them
    r'rostopic pub -r', r'roslaunch', r'rosrun (image_view|angen_apps|angen_tools)',  # no end
    r'sudo', r'apt-get', r'docker', r'rosdep', r'cd ~/catkin_ws',  # root, network
    r'angen run$', r'python3 -m venv', r'~/angen/bin',  # of a package or a wheel
    r'/usr/bin/python3 -m venv', r'~/mcap/bin', r'mkdir -p ~/bridge', r'git clone', r'cd ~/bridge',
    r'source ~/bridge', r'colcon', r'export ROS_MASTER_URI', r'.*node-red',  # network, others
    r'cmake --build build', r'python3 (bench/physics|worlds/make_|-m pytest|docs/tables)',
    r'\./angen shell -c "python3 (-m pytest|examples)',  # minutes, or they write into the checkout
    r'.*(\bNAME\b|\bKIND\b)',  # usage
)))
# Variables that a page exports in the shell that starts the simulator.
SCRIPTS = re.compile(r'`export ANGEN_PLUGIN_PATH=\$PWD/(\S+)`')


def steps(page: Path) -> list[tuple[str, str]]:
    """A reader's input: the arguments of a simulator to start, and the commands beside it."""
    made = [('', '')]
    for block in blocks(page):
        made.append((made[-1][0], ''))
        for line in (re.sub(r'\s+# .*', '', line)
                     for line in block.replace('\\\n', ' ').splitlines()):
            start = START.match(line)
            if start:
                made.append((start.group(1).strip(), ''))
            elif not LEFT_OUT.match(line):
                made[-1] = (made[-1][0], made[-1][1] + line + '\n')
    return [step for step in made if step[1].strip()]


class Terminal:
    """A folder that looks like the checkout, and a simulator of its own."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.home = home = folder / 'home'
        home.mkdir()
        for entry in ROOT.iterdir():
            if entry.name not in ('out', '.git'):
                (folder / entry.name).symlink_to(entry)
        uri = f'http://127.0.0.1:{free_port()}'
        self.master: Any = xmlrpc.client.ServerProxy(uri)
        self.environment = dict(
            os.environ, HOME=str(home), ROS_HOME=str(home / '.ros'),
            ROS_MASTER_URI=uri, ROS_IP='127.0.0.1',
            ANGEN_MODEL_PATH=str(home / 'my_models'),
            ANGEN_PLUGIN_PATH=str(home / 'tape_measure/devel/lib'))
        self.started: tuple[str, str] | None = None  # arguments and paths of the simulator
        self.process: subprocess.Popen[str] | None = None

    def run(self, text: str, timeout: float = 300.0) -> str:
        done = subprocess.run(['bash', '-e', '-o', 'pipefail', '-c', text], cwd=self.folder,
                              env=self.environment, text=True, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout)
        assert done.returncode == 0, f'{text}\nends with {done.returncode}:\n{done.stdout}'
        return done.stdout

    def simulate(self, arguments: str) -> None:
        """A simulator with these arguments of ./angen run; that which runs, if it has them and the
        paths of plug-ins."""
        needed = (arguments, self.environment['ANGEN_PLUGIN_PATH'])
        if needed == self.started:
            return
        self.end()
        log = (self.folder / 'home/run.log').open('w')
        self.process = subprocess.Popen(
            f'exec ./angen run headless:=true {arguments}', shell=True, cwd=self.folder,
            env=self.environment, stdout=log, stderr=log)
        end = time.monotonic() + 180.0
        while not self.is_ready():
            assert time.monotonic() < end, (self.folder / 'home/run.log').read_text()
            time.sleep(0.1)
        with self.session() as world:
            self.first = {entity.name for entity in world.entities()}
        self.started = needed

    def is_ready(self) -> bool:
        """Whether the simulator serves."""
        try:
            published = self.master.getSystemState('/test')[2][0]
        except OSError:  # no master yet
            return False
        return any(topic == '/angen/ready' for topic, _ in published)

    @contextmanager
    def session(self) -> Iterator[Live]:
        """The simulator, from this process."""
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv('ROS_MASTER_URI', self.environment['ROS_MASTER_URI'])
            yield Live()

    def clear(self) -> None:
        """Deletes all spawned models and sensors; the sensors and devices of a model go with it."""
        with self.session() as world:
            spawned = [entity for entity in world.entities() if entity.name not in self.first]
            models = {entity.name for entity in spawned if entity.kind == 'model'}
            others = {entity.name for entity in spawned if entity.model not in models}
            for name in sorted(models | others):
                world.delete(name)

    def end(self) -> None:
        if self.process:
            self.process.send_signal(signal.SIGINT)
            self.process.wait(60)
        self.process = self.started = None


@pytest.fixture(scope='module')
def terminal(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Terminal]:
    made = Terminal(tmp_path_factory.mktemp('checkout'))
    yield made
    made.end()


# Pages with the same simulators one after the other.
ORDER = sorted((page for page in PAGES if steps(page)),
               key=lambda page: [start for start, _ in steps(page)])


@pytest.mark.parametrize('page', ORDER, ids=lambda page: str(page.relative_to(ROOT)))
def test_its_commands_work(page: Path, terminal: Terminal) -> None:
    for path, text in files(page).items():
        where = terminal.folder / path.replace('~', terminal.environment['HOME'])
        where.parent.mkdir(parents=True, exist_ok=True)
        where.write_text(text)
    terminal.environment['ANGEN_PLUGIN_PATH'] = ':'.join([
        str(terminal.home / 'tape_measure/devel/lib'),
        *(str(ROOT / folder) for folder in SCRIPTS.findall(page.read_text()))])
    drives = any('angen go ' in text for _, text in steps(page))  # for minutes at rate 1
    for arguments, text in steps(page):
        terminal.simulate(f'rate:=4 {arguments}'.strip() if drives else arguments)
        terminal.run(text)
    if any('spawn' in text for _, text in steps(page)):
        terminal.clear()
