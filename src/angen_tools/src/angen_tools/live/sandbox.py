"""A ROS master of its own on a free port, the node, rviz. Ends its processes, by process id; when
it is killed itself, a watchdog does."""
import os
import re
import shutil
import signal
import subprocess
import time
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import Any, Self

from angen_tools.common.failure import Failure
from angen_tools.common.files import later_signals
from angen_tools.common.installed import share
from angen_tools.common.port import free_port
from angen_tools.common.wait import wait
from angen_tools.common.watchdog import watchdog
from angen_tools.entry.master import master_command

START_LIMIT = 120.0  # s; hundreds of models take a while on a busy machine
CLIENT_LIMIT = 40.0
END_LIMIT = 10.0


def built_program(name: str) -> Path | None:
    """A built program of angen_sim; None if it is not built."""
    places = (Path(prefix) / 'lib/angen_sim' / name
              for prefix in os.environ.get('CMAKE_PREFIX_PATH', '').split(':') if prefix)
    return next((path for path in places if path.is_file()), None)


class Sandbox:
    """A master on a free port, and the processes around it. A context: its end ends them all."""

    def __init__(self, folder: Path) -> None:
        import xmlrpc.client
        self.folder = folder
        self.launched = 0.0  # when the last node was started, s of wall time
        self._all = ExitStack()
        self._all.enter_context(watchdog())
        port = free_port()
        uri = f'http://127.0.0.1:{port}'
        # for this process too, which is to become a node of that master
        os.environ.update(ROS_MASTER_URI=uri, ROS_IP='127.0.0.1', ROS_LOG_DIR=str(folder),
                          ROS_HOME=str(folder))
        for name in ('ROS_HOSTNAME', 'ROS_NAMESPACE'):
            os.environ.pop(name, None)
        self.environment = dict(os.environ)
        self._api: Any = xmlrpc.client.ServerProxy(uri)
        self.start(master_command(port), 'master')
        try:
            wait(self._answers, 'the ROS master has not answered', START_LIMIT)
        except BaseException:
            self._all.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._all.close()

    def _answers(self) -> bool:
        try:
            return self._api.getUri('/angen_bench')[0] == 1
        except OSError:
            return False

    def _state(self) -> Any:
        """Names, each with its nodes: of published topics, subscribed topics, and services."""
        return self._api.getSystemState('/angen_bench')[2]

    def _names(self, which: int, name: str) -> list[str]:
        """Nodes that publish (0) or subscribe (1) a topic, or serve (2) a service."""
        return next((nodes for topic, nodes in self._state()[which]
                     if topic == name), [])

    def topics(self, pattern: str) -> set[str]:
        """The published topics whose whole name matches a pattern."""
        return {topic for topic, _ in self._state()[0] if re.fullmatch(pattern, topic)}

    def subscribed_by(self, name: str) -> set[str]:
        """The topics that nodes with this in their name subscribe."""
        return {topic for topic, nodes in self._state()[1] if any(name in node for node in nodes)}

    def received_by(self, name: str, pattern: str) -> int:
        """Messages that C++ nodes with this in their name have received, on the topics whose
        whole name matches a pattern.
        """
        import xmlrpc.client
        nodes = {node for _, nodes in self._state()[1]
                 for node in nodes if name in node}
        count = 0
        for node in nodes:
            api: Any = xmlrpc.client.ServerProxy(self._api.lookupNode('/angen_bench', node)[2])
            # roscpp answers without code and text: publications, subscriptions
            for topic, connections in api.getBusStats('/angen_bench')[1]:
                if re.fullmatch(pattern, topic):
                    count += sum(connection[2] for connection in connections)
        return count

    def registered_by(self, name: str) -> set[str]:
        """Topics and services of the node with this name: `publishes /x`, `subscribes /x`,
        `serves /x`.
        """
        return {f'{verb} {topic}' for verb, entries in zip(
            ('publishes', 'subscribes', 'serves'), self._state()) for topic, nodes in entries
            if f'/{name}' in nodes}

    def start(self, words: list[str], log: str, **options: Any) -> subprocess.Popen[bytes]:
        """Starts a process without Ctrl-C; its output is written to a file named `log`."""
        with (self.folder / f'{log}.log').open('wb') as out, later_signals():
            settings: dict[str, Any] = {'env': self.environment, 'stdout': out, **options}
            process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stderr=out,
                                       start_new_session=True, **settings)
            self._all.callback(end, process)
        return process

    def node(self, world: Path | None, rate: float, **params: Any) -> subprocess.Popen[bytes]:
        """The node with a world, or none with `replay`, once it serves; `params` are more of its
        parameters."""
        wait(lambda: not self._names(0, '/angen/ready'), 'the last node has not ended', START_LIMIT)
        self.launched = time.monotonic()
        words = [f'_rate:={rate:g}', *(f'_{key}:={value}' for key, value in params.items())]
        node = built_program('angen_node')
        if node is None:
            raise Failure('angen_node is not found; use ./angen, or source devel/setup.bash')
        process = self.start([str(node), *([str(world)] if world else []), *words], 'node')

        def serves() -> bool:
            if process.poll() is not None:
                self.complain()
            return bool(self._names(0, '/angen/ready'))

        wait(serves, 'the node does not serve', START_LIMIT)
        return process

    def complain(self) -> None:
        """Failure with the node's last line."""
        lines = (self.folder / 'node.log').read_text(errors='replace').splitlines()
        raise Failure(f'the node ended: {lines[-1] if lines else "without a message"}')

    def rviz(self) -> subprocess.Popen[bytes] | None:
        """rviz, once it shows the building; None if it does not start."""
        view = share('angen_sim') / 'launch/angen.rviz'
        process = self.start(['rviz', '-d', str(view)], 'rviz')
        with suppress(Failure):
            wait(lambda: process.poll() is not None or any(
                'rviz' in name for name in self._names(1, '/angen/markers')), '', CLIENT_LIMIT)
            if process.poll() is None:
                return process
        end(process)
        return None

    def display(self) -> str | None:
        """Starts a display for rviz where there is none; returns why that is not possible."""
        if not shutil.which('rviz'):
            return 'rviz is not installed'
        if self.environment.get('DISPLAY'):
            return None
        if not shutil.which('Xvfb'):
            return 'there is no display, and Xvfb is not installed'
        self.start(['Xvfb', '-displayfd', '1', '-screen', '0', '1280x800x24', '-nolisten', 'tcp'],
                   'xvfb_errors', stdout=(self.folder / 'display').open('wb'))
        number = self.folder / 'display'
        try:
            wait(lambda: number.read_text().endswith('\n'), 'Xvfb has not started', CLIENT_LIMIT)
        except Failure as failure:
            return str(failure)
        self.environment.update(DISPLAY=f':{number.read_text().strip()}', LIBGL_ALWAYS_SOFTWARE='1')
        return None


def end(process: subprocess.Popen[Any]) -> None:
    """Ends a process: by SIGTERM, then by SIGKILL."""
    for order in (signal.SIGTERM, signal.SIGKILL):
        if process.poll() is not None:
            return
        process.send_signal(order)
        with suppress(subprocess.TimeoutExpired):
            process.wait(END_LIMIT)
