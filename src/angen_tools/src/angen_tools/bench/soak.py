"""angen bench soak: spawns and deletes everything again and again, and shows what stays behind."""
from __future__ import annotations

import gc
import tempfile
import time
from contextlib import ExitStack
from dataclasses import asdict, astuple, dataclass, fields
from pathlib import Path
from statistics import median
from typing import Any, Protocol, Sequence

from angen_tools.common import files
from angen_tools.common.catalog import Plugin, angen_module, kinds
from angen_tools.common.failure import Failure
from angen_tools.common.output import as_json
from angen_tools.common.progress import Progress
from angen_tools.live.client import Client
from angen_tools.live.sandbox import Sandbox, wait
from angen_tools.live.spawn import call_spawn
from angen_tools.world import sdf, sensor
from angen_tools.world.apartment import write_apartment

WARM_UP = 0.2  # share of the cycles
FLAT = 2.0  # MB that memory may grow by after it
EACH = 50  # cycles between two samples, and between two rounds of commands
START = 1.0  # s of wall time before the first sample, in which connections close
QUIET = 20.0  # s of wall time within which connections of the last cycle close
SEED = 1
ANCHOR = '''<model name="anchor"><static>true</static><link name="link"><collision name="box">
<geometry><box><size>0.1 0.1 0.1</size></box></geometry></collision></link></model>'''
ROBOT = 'turtlebot'
FAR = (60.0, 0.0, 0.05, 0.0, 0.0, 0.0)  # from the flat, where what is spawned stands
# Parameters without which there is none.
NEEDS = {'accelerometer': [('link', 'link')], 'reed': [('magnet_link', 'link')]}
ON_ANCHOR = (0.0, 0.0, 0.1, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Thing:
    """What is spawned: a model, or a <sensor> that is put on a link."""
    kind: str
    what: str
    on: str = ''


@dataclass(frozen=True)
class Sample:
    """What the process has; memory in MB."""
    cycle: int
    rss_mb: float
    descriptors: int
    threads: int


class Home(Protocol):
    """The world in which things come and go."""

    def spawn(self, thing: Thing, name: str) -> None: ...
    def delete(self, name: str) -> None: ...
    def command(self, turn: int) -> None: ...
    def sample(self, cycle: int) -> Sample: ...
    def registered(self) -> set[str]: ...


def things() -> list[Thing]:
    """One of each kind that a model holds or that is put on a link, and of each of its models."""
    found: list[Thing] = []
    for name, plugin in sorted(kinds().items()):
        models = dict.fromkeys(entry['model'] for entry in plugin['models'])
        found += [Thing(name, f'model://{model}') for model in models]
        if plugin['role'] == 'sensor' and not models:
            found.append(_attached(name, plugin))
    return found


def _attached(kind: str, plugin: Plugin) -> Thing:
    contacts = [('collision', 'box')] if sensor.senses_contacts(plugin) else []
    element = sensor.build(kind, kind, [*contacts, *NEEDS.get(kind, [])], True)
    return Thing(kind, sdf.text(element), 'anchor::link')


def doors_and_lamps(turn: int) -> list[tuple[str, str]]:
    """Commands by kind: all doors and lamps, the other way each turn."""
    return [('door', 'Close' if turn % 2 else 'Open'), ('lamp', 'Off' if turn % 2 else 'On')]


def speed(turn: int) -> tuple[float, float]:
    """m/s and rad/s of the robot."""
    return (0.2, 0.5) if turn % 2 else (-0.1, 0.3)


def process_sample(process: Any, cycle: int) -> Sample:
    """What a process of psutil has."""
    return Sample(cycle, process.memory_info().rss / 1e6, process.num_fds(), process.num_threads())


class Core:
    """The Python module, in this process: the simulator without ROS."""

    def __init__(self, path: Path) -> None:
        import psutil
        self._process = psutil.Process()
        self._world = angen_module().World(str(path), seed=SEED)
        self._world.spawn(ANCHOR, 'anchor', list(FAR))
        self._world.spawn(f'model://{ROBOT}', ROBOT, [0.5, 0.5, 0.01, 0.0, 0.0, 0.0])

    def spawn(self, thing: Thing, name: str) -> None:
        self._world.spawn(thing.what, name, list(ON_ANCHOR if thing.on else FAR), thing.on)
        self._world.run(0.02)

    def delete(self, name: str) -> None:
        self._world.delete(name)
        self._world.events()

    def command(self, turn: int) -> None:
        for kind, verb in doors_and_lamps(turn):
            self._world.command(kind, 'all', verb)
        self._world.command('drive', ROBOT, values=list(speed(turn)))

    def sample(self, cycle: int) -> Sample:
        gc.collect()
        return process_sample(self._process, cycle)

    def registered(self) -> set[str]:
        return {*self._world.models, *self._world.sensors(), *self._world.devices()}


class Node:
    """A node at rate 1 with a master of its own; this process subscribes to all its topics."""

    def __init__(self, open_now: ExitStack, folder: Path, path: Path) -> None:
        import psutil
        from geometry_msgs.msg import Twist

        from angen_msgs.msg import Command
        self._sandbox = open_now.enter_context(Sandbox(folder))
        server = self._sandbox.node(path, 1.0)
        self._process = psutil.Process(server.pid)
        self._client = Client()
        self._client.join()
        self._subscribers: dict[str, Any] = {}
        self._met: set[str] = set()  # kinds whose topics are subscribed to
        call_spawn(self._client, 'anchor', ANCHOR, '', FAR)
        call_spawn(self._client, ROBOT, f'model://{ROBOT}', '', (0.5, 0.5, 0.01, 0.0, 0.0, 0.0))
        self._drive = self._client.publisher('/cmd_vel', Twist)
        self._commands = self._client.publisher('/angen/command', Command)
        self._subscribe()

    def _subscribe(self) -> None:
        import rospy
        for topic in self._sandbox.topics('/.*') - self._subscribers.keys():
            self._subscribers[topic] = rospy.Subscriber(topic, rospy.AnyMsg, lambda _: None)

    def spawn(self, thing: Thing, name: str) -> None:
        call_spawn(self._client, name, thing.what, thing.on, ON_ANCHOR if thing.on else FAR)
        if thing.kind not in self._met:  # its topics have the same names the next time
            self._met.add(thing.kind)
            self._subscribe()

    def delete(self, name: str) -> None:
        from angen_msgs.srv import Delete
        self._client.call('/angen/delete', Delete, name=name)

    def command(self, turn: int) -> None:
        from geometry_msgs.msg import Twist, Vector3

        from angen_msgs.msg import Command
        for kind, verb in doors_and_lamps(turn):
            self._commands.publish(Command(f'{kind}/all', verb))
        ahead, turning = speed(turn)
        self._drive.publish(Twist(Vector3(x=ahead), Vector3(z=turning)))

    def sample(self, cycle: int) -> Sample:
        return process_sample(self._process, cycle)

    def registered(self) -> set[str]:
        return self._sandbox.registered_by('angen')


def soak(home: Home, cycles: int, progress: Progress) -> tuple[list[Sample], list[str]]:
    """The samples of so many cycles, and what is wrong with them."""
    all_things = things()
    for thing in all_things:  # the first of each loads its library
        _cycle(home, thing)
    time.sleep(START)
    start, registered = home.sample(0), home.registered()
    samples = [start]
    for cycle in range(1, cycles + 1):
        _cycle(home, all_things[cycle % len(all_things)])
        if cycle % EACH == 0:
            home.command(cycle // EACH)
            samples.append(home.sample(cycle))
            progress.update(cycle / cycles, f'cycle {cycle}, {samples[-1].rss_mb:.1f} MB')
    if samples[-1].cycle < cycles:
        samples.append(home.sample(cycles))
    return samples, [*grown(samples), *_left(home, start, registered, cycles)]


def _cycle(home: Home, thing: Thing) -> None:
    name = f'soak_{thing.kind}'
    try:
        home.spawn(thing, name)
        home.delete(name)
    except Exception as error:  # angen.Error, which this module does not know before the core runs
        raise Failure(f'{thing.kind} {thing.what[:60]}: {error}') from None


def grown(samples: Sequence[Sample]) -> list[str]:
    """What is wrong with memory, by the medians of the first and last tenth after the warm-up."""
    steady = [s.rss_mb for s in samples if s.cycle >= WARM_UP * samples[-1].cycle]
    tenth = max(1, len(steady) // 10)
    before, after = median(steady[:tenth]), median(steady[-tenth:])
    if after - before <= FLAT:
        return []
    return [f'memory has grown from {before:.1f} to {after:.1f} MB, by more than {FLAT:g} MB']


def _left(home: Home, start: Sample, registered: set[str], cycles: int) -> list[str]:
    """What has not gone, once all is quiet."""
    def settled() -> bool:
        now = home.sample(cycles)
        return (now.descriptors <= start.descriptors and now.threads <= start.threads
                and home.registered() == registered)

    try:
        wait(settled, '', QUIET)
    except Failure:
        now = home.sample(cycles)
        found = [f'{name} were {before} and are {after}' for name, before, after in (
            ('descriptors', start.descriptors, now.descriptors),
            ('threads', start.threads, now.threads)) if after > before]
        other = sorted(registered ^ home.registered())
        return [*found, *([f'registrations differ: {", ".join(other[:5])}'] if other else [])]
    return []


def measure(cycles: int, core: bool, folder: Path, json: bool) -> None:
    """Soaks, prints and writes folder/soak.csv; Failure where something stays behind."""
    with ExitStack() as open_now:
        work = Path(open_now.enter_context(tempfile.TemporaryDirectory(prefix='angen_bench_')))
        path = work / 'soak.world'
        write_apartment(path, 1, {'pir': 4, 'luminosity': 2, 'switch': 2, 'contact': 1}, SEED, True)
        home: Home
        if core:
            home = Core(path)
        else:
            home = Node(open_now, work, path)
        progress = open_now.enter_context(Progress('soak', 0.1))
        began = time.monotonic()
        samples, wrong = soak(home, cycles, progress)
        seconds = time.monotonic() - began
    table = folder / ('soak_core.csv' if core else 'soak.csv')
    files.write_csv(table, [field.name for field in fields(Sample)],
                    (astuple(sample) for sample in samples))
    if json:
        print(as_json([asdict(sample) for sample in samples]))
    else:
        memory = [sample.rss_mb for sample in samples]
        print(f'{cycles} cycles of {len(things())} things in {seconds:.0f} s: memory '
              f'{memory[0]:.1f} MB at the start, {memory[-1]:.1f} at the end, '
              f'{min(memory):.1f} to {max(memory):.1f} between\nwrote {table}', flush=True)
    if wrong:
        raise Failure('; '.join(wrong))
