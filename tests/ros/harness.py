"""A ROS master of the tests' own, and the node in it. Ends its own processes, by pid."""
from __future__ import annotations

import fcntl
import itertools
import json
import os
import pty
import signal
import socket
import subprocess
import sys
import termios
import time
import xmlrpc.client
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Callable, Iterator, Protocol

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "src/angen_tools/scripts/angen"
TREE = ROOT / os.environ.get("ANGEN_TEST_TREE", "build")  # a sanitizer's has another
SANITIZED = TREE.name != "build"
SLOWNESS = 4.0 if SANITIZED else 1.0  # limits of time are multiplied by it
without_sanitizer = pytest.mark.skipif(
    SANITIZED, reason="it limits memory, or the time of another program that a sanitizer slows")
WORLD = """<?xml version="1.0"?>
<sdf version="1.6">
  <world name="small">
    <gravity>0 0 -9.8</gravity>
    <physics name="steps" type="ode"><max_step_size>0.001</max_step_size></physics>
    <model name="ground">
      <static>true</static>
      <link name="link">
        <collision name="c"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision>
        <visual name="v"><geometry><plane><normal>0 0 1</normal></plane></geometry></visual>
      </link>
    </model>
    <include>
      <uri>model://bathroom_door</uri><name>bathroom_door0</name><pose>0 0 0.02 0 0 0</pose>
    </include>
    <include>
      <uri>model://ceiling_lamp</uri><name>kitchen_lamp0</name><pose>0 3 2.5 0 0 0</pose>
    </include>
    <include><uri>model://turtlebot</uri><pose>5 5 0.01 0 0 0</pose></include>
    <include><uri>model://pir</uri><name>eye</name><pose>0 4 1.5 0 0 0</pose></include>
    <plugin name="doors" filename="libdoor_world_plugin.so"/>
    <plugin name="robots" filename="librobot_controller.so">
      <wheelSeparation>0.23</wheelSeparation>
      <wheelDiameter>0.0704</wheelDiameter>
    </plugin>
  </world>
</sdf>
"""


def until(condition: Callable[[], Any], what: str, timeout: float = 30.0) -> Any:
    """Return the first true value of `condition`; fail after `timeout` wall seconds, more with
    a sanitizer."""
    timeout *= SLOWNESS
    end = time.monotonic() + timeout
    pause = 0.01
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(pause)
        pause = min(1.5 * pause, 0.1)  # a condition that queries the master costs CPU time
    raise AssertionError(f"not within {timeout} s: {what}")


def node_binary() -> Path:
    """The built node; the first on CMAKE_PREFIX_PATH, as rosrun would find it."""
    for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(":"):
        path = Path(prefix) / "lib/angen_sim/angen_node"
        if prefix and path.exists():
            return path
    raise RuntimeError("angen_node is not built, or devel/setup.bash is not sourced")


def world_file(world: Path | str, folder: Path) -> Path:
    """The file of a world; that of a text is in the folder."""
    if isinstance(world, Path):
        return world
    path = folder / "small.world"
    path.write_text(world)
    return path


@contextmanager
def own_node(folder: Path, world: Path | str, environment: dict[str, str] = {}, **params: object
             ) -> Iterator[Angen]:
    """A node with a master of its own."""
    with Master(folder) as master:
        master.environment |= environment
        with master.serving(world, folder, **params) as angen:
            yield angen


# Each process begins elsewhere, workers of neighboring ids 997 apart, below the ports that the
# kernel gives to connections: one of those could be taken before a master listens at it.
_ports = itertools.count(10_000 + os.getpid() * 997 % 20_000)


def free_port() -> int:
    for port in _ports:
        with socket.socket() as probe:
            try:
                probe.bind(("127.0.0.1", port))
                return port
            except OSError:
                continue
    raise AssertionError("there are ports")


def end(process: subprocess.Popen[str], timeout: float = 20.0) -> int:
    """Interrupt the process and return its exit code; kill it when it does not end."""
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
    try:
        return process.wait(SLOWNESS * timeout)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        raise


def processes_with(word: str) -> list[int]:
    """The processes whose environment contains a text."""
    found = []
    for environment in Path("/proc").glob("[0-9]*/environ"):
        try:
            if word.encode() in environment.read_bytes():
                found.append(int(environment.parent.name))
        except OSError:
            continue
    return found


class HasEnvironment(Protocol):
    """What a program runs in."""

    environment: dict[str, str]


class Master:
    """A rosmaster process at `uri`, and the environment that points to it."""

    def __init__(self, folder: Path, port: int = 0) -> None:
        port = port or free_port()
        self.uri = f"http://127.0.0.1:{port}"
        self.environment = dict(
            os.environ, ROS_MASTER_URI=self.uri, ROS_IP="127.0.0.1", ROS_LOG_DIR=str(folder),
            ROS_HOME=str(folder))
        self.environment.pop("ROS_HOSTNAME", None)
        self.process = subprocess.Popen(
            [sys.executable, "/usr/bin/rosmaster", "--core", "-p", str(port)],
            env=self.environment, text=True,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.api: Any = xmlrpc.client.ServerProxy(self.uri)
        until(self._answers, "the master answers")

    def __enter__(self) -> Master:
        return self

    def __exit__(self, *_: object) -> None:
        end(self.process)

    def _answers(self) -> bool:
        try:
            return bool(self.api.getUri("/test")[0] == 1)
        except OSError:
            return False

    def topics(self) -> dict[str, str]:
        """Every published topic, with its type."""
        published = {name for name, _ in self.api.getSystemState("/test")[2][0]}
        return {name: kind for name, kind in self.api.getTopicTypes("/test")[2]
                if name in published}

    def _pid_of(self, node: str) -> int | None:
        """The process of a node; None where one that was killed is still registered."""
        try:
            api: Any = xmlrpc.client.ServerProxy(self.api.lookupNode("/test", node)[2])
            return int(api.getPid("/test")[2])
        except OSError:
            return None

    def node(self, world: Path, log: Path, **params: object) -> subprocess.Popen[str]:
        """Start the node, with no parameter that an earlier one had, and wait until it serves."""
        self.api.deleteParam("/test", "/angen")
        arguments = [f"_{key}:={value}" for key, value in params.items()]
        with log.open("w") as out:
            process = subprocess.Popen([str(node_binary()), str(world), *arguments],
                                       env=self.environment, text=True, stdout=out, stderr=out)

        def serves() -> bool:
            assert process.poll() is None, log.read_text()
            publishers = dict(self.api.getSystemState("/test")[2][0]).get("/angen/ready", [])
            return any(self._pid_of(name) == process.pid for name in publishers)

        try:
            until(serves, "the node serves")
        except BaseException:
            end(process)
            raise
        return process

    @contextmanager
    def serving(self, world: Path | str, folder: Path, **params: object) -> Iterator[Angen]:
        """A node until the end of the block, with the file or text of a world."""
        angen = Angen(self, self.node(world_file(world, folder), folder / "log", **params),
                      folder / "log")
        try:
            yield angen
        finally:
            end(angen.process)

    def rejected(self, *words: object) -> str:
        """The errors of a node that does not start with these words."""
        done = subprocess.run([str(node_binary()), *map(str, words)], env=self.environment,
                              text=True, capture_output=True, timeout=60 * SLOWNESS)
        assert done.returncode == 1, done.stderr
        return done.stderr


_publishers: dict[tuple[str, type], Any] = {}


def publisher_of(topic: str, kind: type) -> Any:
    """The publisher of this process for a topic.

    It stays until the end of the module: a subscriber discards unread messages of a publisher
    that unregisters.
    """
    import rospy
    if (topic, kind) not in _publishers:
        _publishers[topic, kind] = rospy.Publisher(topic, kind, queue_size=10)
    return _publishers[topic, kind]


def unregister_publishers() -> None:
    for publisher in _publishers.values():
        publisher.unregister()
    _publishers.clear()


class Angen:
    """The node under test, as its users reach it."""

    def __init__(self, master: Master, process: subprocess.Popen[str], log: Path) -> None:
        self.master = master
        self.process = process
        self._log = log

    def log(self) -> str:
        return self._log.read_text()

    def call(self, name: str, kind: type, /, **fields: Any) -> Any:
        """Call a service; blank fields keep their defaults."""
        import rospy
        rospy.wait_for_service(name, timeout=20.0 * SLOWNESS)
        return rospy.ServiceProxy(name, kind)(**fields)

    def send(self, topic: str, message: Any) -> None:
        """Publish one message when the node subscribes."""
        publisher = publisher_of(topic, type(message))

        def subscribes() -> bool:
            publisher.impl.check()  # a connection that the node has closed counts until then
            return bool(publisher.get_num_connections())

        until(subscribes, f"the node subscribes to {topic}")
        publisher.publish(message)
        time.sleep(0.1)

    def spawn(self, name: str, xml: str, x: float = 0.0, y: float = 0.0, z: float = 0.0,
              on: str = "") -> None:
        """Add a model at a place, or a sensor on a link."""
        from angen_msgs.srv import Spawn
        from geometry_msgs.msg import Point, Pose
        answer = self.call("/angen/spawn", Spawn, name=name, xml=xml, on=on,
                           pose=Pose(position=Point(x, y, z)))
        assert answer.success, answer.message

    def delete(self, *names: str) -> None:
        from angen_msgs.srv import Delete
        for name in names:
            assert self.call("/angen/delete", Delete, name=name).success, name

    def command(self, target: str, text: str) -> None:
        from angen_msgs.srv import SendCommand
        answer = self.call("/angen/command", SendCommand, target=target, text=text)
        assert answer.success, answer.message

    def names(self, kind: str = "") -> list[str]:
        """Names of all entities, or of those of a kind."""
        from angen_msgs.srv import List
        return [entity.name for entity in self.call("/angen/list", List, kind=kind).entities]

    @contextmanager
    def paused(self) -> Iterator[None]:
        from std_srvs.srv import Empty
        self.call("/gazebo/pause_physics", Empty)
        try:
            yield
        finally:
            self.call("/gazebo/unpause_physics", Empty)

    def wait(self, topic: str, kind: type, accept: Callable[[Any], bool] = lambda _: True,
             timeout: float = 30.0) -> Any:
        """Subscribe and return the first message that `accept` accepts."""
        with Inbox(topic, kind) as inbox:
            return until(lambda: next((m for m in list(inbox.messages) if accept(m)), None),
                         f"an accepted message on {topic}", timeout)


class RawText(str):
    """A text that is sent as bytes of its own, whatever their encoding."""
    raw: bytes

    def __new__(cls, raw: bytes) -> RawText:
        made = super().__new__(cls, repr(raw))
        made.raw = raw
        return made

    def encode(self, *_: object) -> bytes:
        return self.raw


def publishes_to_us(topic: str) -> bool:
    """Whether a publisher of the topic knows this process as a subscriber: rospy counts connections
    that are not made yet."""
    import rosgraph
    import rospy
    us = rospy.get_name()
    master = rosgraph.Master(us)

    def knows_us(node: str) -> bool:
        try:
            publisher: Any = xmlrpc.client.ServerProxy(master.lookupNode(node))
            connections = publisher.getBusInfo(us)[2]
        except (OSError, rosgraph.MasterError):
            return False  # it was killed, and is still registered
        return any((to, way, name) == (us, "o", topic) for _, to, way, _, name, *_ in connections)

    return any(knows_us(node) for node in dict(master.getSystemState()[0]).get(topic, []))


class Inbox:
    """Collects the messages of a topic while it is open, from when a publisher of it knows."""

    def __init__(self, topic: str, kind: type) -> None:
        import rospy
        self.messages: list[Any] = []
        self._subscriber = rospy.Subscriber(topic, kind, self.messages.append)
        if topic in dict(rospy.get_published_topics()):
            until(lambda: self._subscriber.get_num_connections() > 0 and publishes_to_us(topic),
                  f"{topic} is connected")

    def __enter__(self) -> Inbox:
        return self

    def __exit__(self, *_: object) -> None:
        self._subscriber.unregister()

    def wait(self, accept: Callable[[Any], bool], what: str, timeout: float = 30.0) -> Any:
        return until(lambda: next((m for m in list(self.messages) if accept(m)), None), what,
                     timeout)


class Cli:
    """The angen command in the environment of a master."""

    def __init__(self, master: HasEnvironment) -> None:
        self.environment = dict(master.environment, PYTHONUNBUFFERED="1", TERM="xterm")
        self.words = [sys.executable, str(SCRIPT)]

    def run(self, *words: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run([*self.words, *words], env=self.environment, text=True,
                              capture_output=True, stdin=subprocess.DEVNULL, timeout=120 * SLOWNESS)

    def does(self, *words: str) -> str:
        """Its output when it succeeds, without the newline."""
        done = self.run(*words)
        assert (done.returncode, done.stderr) == (0, ""), done
        return done.stdout.removesuffix("\n")

    def fails(self, *words: str) -> str:
        """The one line that it says when it fails."""
        done = self.run(*words)
        assert (done.returncode, done.stdout) == (1, ""), done
        line, = done.stderr.splitlines()
        assert line.startswith("angen: ")
        return line.removeprefix("angen: ")

    def listed(self, kind: str) -> list[str]:
        return [e["name"] for e in json.loads(self.does("list", "--kind", kind, "--json"))]


def open_terminal() -> tuple[int, int]:
    """Both ends of a pseudo-terminal; skips where there is none, as in a chroot without /dev/pts.

    A machine of continuous integration must have one.
    """
    if not os.path.ismount("/dev/pts") and "CI" not in os.environ:
        pytest.skip("no pseudo-terminals here: /dev/pts is not mounted")
    return pty.openpty()


def own_terminal() -> None:
    """Makes stdin the terminal of a session, so that its Ctrl-C reaches the command."""
    os.setsid()
    fcntl.ioctl(0, termios.TIOCSCTTY, 0)
