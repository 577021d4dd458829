"""angen bench soak: spawns and deletes everything again and again, and shows leaks."""
import gc
import itertools
import statistics
import tempfile
import time
from contextlib import ExitStack
from dataclasses import asdict, astuple, dataclass, fields
from pathlib import Path
from typing import Any, Iterator, Protocol, Sequence

from angen_tools.common import files
from angen_tools.common.catalog import Plugin, angen_module, kinds
from angen_tools.common.failure import Failure
from angen_tools.common.output import as_json
from angen_tools.common.progress import Progress
from angen_tools.common.wait import wait
from angen_tools.session.live import Live
from angen_tools.live.sandbox import Sandbox
from angen_tools.world import sdf, sensor
from angen_tools.world.apartment import write_apartment

ROUND = 50  # cycles; lamps are lit and doors open in the first half, a sample is taken at the end
WARM_UP = 2  # times that all things come with lamps lit, and dark, before the first sample
REST = 5.0  # simulated s, within which the light of lamps that were switched is found
LIMIT = 300.0  # s of wall time for it
FLAT = 0.7  # MB that the last quarter may have more than the one before it
MASTER = 2  # connections to the master that roscpp may add: it keeps as many as it used at once
QUIET = 20.0  # s of wall time within which connections of the last cycle close
SEED = 1
ANCHOR = '''<model name="anchor"><static>true</static><link name="link"><collision name="box">
<geometry><box><size>0.1 0.1 0.1</size></box></geometry></collision></link>
<link name="left"/><joint name="left_joint" type="revolute"><parent>link</parent><child>left</child>
<axis><xyz>0 0 1</xyz></axis></joint>
<link name="right"/><joint name="right_joint" type="revolute"><parent>link</parent>
<child>right</child><axis><xyz>0 0 1</xyz></axis></joint></model>'''
ROBOT = 'turtlebot'
# Images of the robot are left out: 30 a second take most of the time. Other cameras are spawned.
PICTURES = ('/camera/', f'/{ROBOT}/camera/')
FAR = (60.0, 0.0, 0.05, 0.0, 0.0, 0.0)  # from the apartment: the pose of spawned models
KOBUKI = [('left_wheel_joint_name', 'left_joint'), ('right_wheel_joint_name', 'right_joint')]
# Parameters that these kinds require.
NEEDS = {'accelerometer': [('link', 'link')], 'reed': [('magnet_link', 'link')],
         'joint_states': [('jointName', 'left_joint')], 'ft_sensor': [('jointName', 'left_joint')],
         'kobuki_odometry': KOBUKI, 'kobuki_wheels': KOBUKI}
ON_ANCHOR = (0.0, 0.0, 0.1, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Thing:
    """Something to spawn: a model, or a <sensor> that is put on a link."""
    kind: str
    what: str
    on: str = ''


@dataclass(frozen=True)
class Sample:
    """The resources of the process; memory in MB."""
    cycle: int
    rss_mb: float
    descriptors: int
    threads: int


class Home(Protocol):
    """The world in which things come and go."""

    def spawn(self, thing: Thing, name: str) -> None: ...
    def delete(self, name: str) -> None: ...
    def command(self, lit: bool) -> None: ...
    def rest(self, seconds: float) -> None: ...
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


def doors_and_lamps(lit: bool) -> list[tuple[str, str]]:
    """Commands by kind, to all doors and lamps."""
    return [('door', 'Open' if lit else 'Close'), ('lamp', 'On' if lit else 'Off')]


def speed(lit: bool) -> tuple[float, float]:
    """m/s and rad/s of the robot, which drives forward and back in turn."""
    return (0.2, 0.5) if lit else (-0.1, 0.3)


def process_sample(process: Any, cycle: int) -> Sample:
    """The resources of a process of psutil."""
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

    def command(self, lit: bool) -> None:
        for kind, verb in doors_and_lamps(lit):
            self._world.command(kind, 'all', verb)
        self._world.command('drive', ROBOT, values=list(speed(lit)))

    def rest(self, seconds: float) -> None:
        self._world.run(seconds)

    def sample(self, cycle: int) -> Sample:
        gc.collect()
        return process_sample(self._process, cycle)

    def registered(self) -> set[str]:
        return {*self._world.models, *self._world.sensors(), *self._world.devices()}


class Node:
    """A node at rate 1 with a master of its own; this process subscribes to its topics."""

    def __init__(self, open_now: ExitStack, folder: Path, path: Path) -> None:
        import psutil
        from geometry_msgs.msg import Twist

        from angen_msgs.msg import Command
        self._sandbox = open_now.enter_context(Sandbox(folder))
        server = self._sandbox.node(path, 1.0)
        self._process = psutil.Process(server.pid)
        self._client = Live()
        self._client.join()
        self._subscribers: dict[str, Any] = {}
        self._known: set[str] = set()  # kinds whose topics are subscribed to
        self._client.spawn('anchor', ANCHOR, FAR)
        self._client.spawn(ROBOT, f'model://{ROBOT}', (0.5, 0.5, 0.01, 0.0, 0.0, 0.0))
        self._drive = self._client.publisher('/cmd_vel', Twist)
        self._commands = self._client.publisher('/angen/command', Command)
        self._subscribe()

    def _subscribe(self) -> None:
        import rospy
        topics = {topic for topic in self._sandbox.topics('/.*') if not topic.startswith(PICTURES)}
        for topic in topics - self._subscribers.keys():
            self._subscribers[topic] = rospy.Subscriber(topic, rospy.AnyMsg, lambda _: None)

    def spawn(self, thing: Thing, name: str) -> None:
        self._client.spawn(name, thing.what, ON_ANCHOR if thing.on else FAR, thing.on)
        if thing.kind not in self._known:  # its topics have the same names the next time
            self._known.add(thing.kind)
            self._subscribe()

    def delete(self, name: str) -> None:
        self._client.delete(name)

    def command(self, lit: bool) -> None:
        from geometry_msgs.msg import Twist, Vector3

        from angen_msgs.msg import Command
        for kind, verb in doors_and_lamps(lit):
            self._commands.publish(Command(f'{kind}/all', verb))
        ahead, turning = speed(lit)
        self._drive.publish(Twist(Vector3(x=ahead), Vector3(z=turning)))

    def rest(self, seconds: float) -> None:
        end = self._client.fence() + seconds
        wait(lambda: self._client.fence() >= end, 'the simulation has not advanced', LIMIT)

    def sample(self, cycle: int) -> Sample:
        return process_sample(self._process, cycle)

    def registered(self) -> set[str]:
        return self._sandbox.registered_by('angen')


def soak(home: Home, cycles: int, progress: Progress) -> tuple[list[Sample], list[str]]:
    """A sample after each round of `ROUND` cycles, and the problems in them. Memory that seems to
    grow is watched for as many cycles again: a leak goes on, what the allocator keeps does not.
    """
    all_things = things()
    warm = [_warm(home, all_things, lit) for _ in range(WARM_UP) for lit in (True, False)]
    registered = home.registered()
    turns = itertools.cycle(all_things)
    samples: list[Sample] = []
    for end in (cycles, 2 * cycles):
        for cycle in range(len(samples) * ROUND + ROUND, end + 1, ROUND):
            samples.append(_round(home, turns, cycle))
            progress.update(cycle / end, f'cycle {cycle}, {samples[-1].rss_mb:.1f} MB')
        if not grown(samples):
            break
    return samples, [*grown(samples), *_left(home, warm, registered, samples[-1].cycle)]


def _warm(home: Home, all_things: Sequence[Thing], lit: bool) -> Sample:
    """The sample after one cycle of each."""
    home.command(lit)
    home.rest(REST)
    for thing in all_things:
        _cycle(home, thing)
    return home.sample(0)


def _round(home: Home, turns: Iterator[Thing], cycle: int) -> Sample:
    """The sample after `ROUND` cycles, which is `cycle`."""
    for lit in (True, False):
        home.command(lit)
        for thing in itertools.islice(turns, ROUND // 2):
            _cycle(home, thing)
    return home.sample(cycle)


def _cycle(home: Home, thing: Thing) -> None:
    name = f'soak_{thing.kind}'
    try:
        home.spawn(thing, name)
        home.delete(name)
    except Exception as error:  # angen.Error, which this module does not know before the core runs
        raise Failure(f'{thing.kind} {thing.what[:60]}: {error}') from None


def grown(samples: Sequence[Sample]) -> list[str]:
    """Whether memory grows on: the medians of the last two quarters. In the first half the
    allocator and caches fill, by up to 4 MB.
    """
    memory = [sample.rss_mb for sample in samples]
    quarter = max(1, len(memory) // 4)
    before = statistics.median(memory[-2 * quarter:-quarter] or memory)
    after = statistics.median(memory[-quarter:])
    if after - before <= FLAT:
        return []
    return [f'memory has grown from {before:.1f} to {after:.1f} MB in the last quarter, '
            f'by more than {FLAT:g} MB']


def _left(home: Home, warm: Sequence[Sample], registered: set[str], cycles: int) -> list[str]:
    """The problems in the last sample, once all is quiet."""
    descriptors = max(sample.descriptors for sample in warm) + MASTER
    threads = max(sample.threads for sample in warm)

    def settled() -> bool:
        now = home.sample(cycles)
        return (now.descriptors <= descriptors and now.threads <= threads
                and home.registered() == registered)

    try:
        wait(settled, '', QUIET)
    except Failure:
        now = home.sample(cycles)
        found = [f'{name} were {before} and are {after}' for name, before, after in (
            ('descriptors', descriptors, now.descriptors),
            ('threads', threads, now.threads)) if after > before]
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
        print(f'{samples[-1].cycle} cycles of {len(things())} things in {seconds:.0f} s: memory '
              f'{memory[0]:.1f} MB at the start, {memory[-1]:.1f} at the end, '
              f'{min(memory):.1f} to {max(memory):.1f} between\nwrote {table}', flush=True)
    if wrong:
        raise Failure('; '.join(wrong))
