"""angen bench load: a node that serves many sensors, subscribers, commands and spawns at once."""
import itertools
import random
import sys
import tempfile
import threading
import time
from collections import Counter, deque
from contextlib import ExitStack
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from statistics import median
from typing import Any, Callable, Sequence

import numpy as np

from angen_bench import listeners
from angen_bench.measure import STATS_LIMIT, Meter, Sample
from angen_bench.measure import load as cpu_load
from angen_bench.report import REAL_TIME, cell
from angen_models import plan
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_csv
from angen_tools.common.output import as_json, show, table
from angen_tools.common.progress import Steps
from angen_tools.common.wait import wait
from angen_tools.session.live import Live
from angen_tools.live.sandbox import Sandbox, end
from angen_tools.world.apartment import write_apartment

FLOORS = 10
SEED = 1
SHARES = {'pir': 0.5, 'switch': 0.3, 'luminosity': 0.15, 'contact': 0.05}  # of all sensors
READERS = {'kind': 20, 'sensor': 2}  # subscribers of every topic
SLEEPERS = 1  # subscribers that never read
COMMANDS = 50.0  # a second
SPAWNS = 10.0  # a second, each with a deletion
LIVES = 5.0  # s that a spawned sensor is there
SETTLED = 3.0  # simulated s, until which furniture comes to rest
WARM_UP = 5.0  # s of wall time, under load
SETTLE_LIMIT = 600.0
CONNECT_LIMIT = 120.0
VERBS = {'door': ('Open', 'Close')}  # with a lamp lit, each spawn has its light computed again


@dataclass
class Row:
    """The result of a run. Times in ms; ticks in CPU time, service answers in wall time."""
    topics: str
    sensors: int
    readers: int
    connections: int
    seconds: float
    rtf: float
    cpu: float  # of the node, in % of a core
    others_cpu: float  # of all other processes
    tick_median: float
    tick_p99: float  # of the median second
    tick_longest: float
    answers: int
    rejected: int
    answer_median: float
    answer_p99: float
    answer_longest: float
    rss_start: float  # MB
    rss_end: float
    rss_most: float

    @property
    def real_time(self) -> bool:
        return self.rtf >= REAL_TIME


def quantile(values: Sequence[float], share: float) -> float:
    """The smallest value that at least that share of them does not exceed."""
    return float(np.quantile(values, share, method='inverted_cdf'))


@dataclass
class Callers:
    """Threads that call services at a steady rate, each on a connection of its own."""
    stop: threading.Event = field(default_factory=threading.Event)
    answers: list[float] = field(default_factory=list)  # ms
    rejected: list[str] = field(default_factory=list)
    _threads: list[threading.Thread] = field(default_factory=list)

    def start(self, rate: float, call: Callable[[], Any]) -> None:
        """Calls `call` at a rate per second, or as often as it is answered."""
        thread = threading.Thread(target=self._run, args=(1.0 / rate, call), daemon=True)
        self._threads.append(thread)
        thread.start()

    def _run(self, period: float, call: Callable[[], Any]) -> None:
        due = time.monotonic()
        while not self.stop.wait(max(0.0, due - time.monotonic())):
            due = max(due + period, time.monotonic() - 1.0)
            asked = time.monotonic()
            try:
                answer = call()
            except Exception as problem:  # of rospy, where the node has not answered
                self.rejected.append(str(problem))
                continue
            self.answers.append(1e3 * (time.monotonic() - asked))
            if not answer.success:
                self.rejected.append(answer.message)

    def end(self) -> None:
        """Returns when none of them calls any more."""
        self.stop.set()
        for thread in self._threads:
            thread.join(STATS_LIMIT)


def start_calls(callers: Callers, client: Live) -> None:
    """Commands to doors, spawns and deletions of sensors."""
    import rospy
    from geometry_msgs.msg import Point, Pose, Quaternion

    from angen_msgs.srv import Delete, SendCommand, Spawn

    def service(name: str, kind: type) -> Any:
        return rospy.ServiceProxy(name, kind, persistent=True)

    targets = [(f'{kind}/{entity.name}', verb) for kind, verbs in VERBS.items()
               for entity in client.entities(kind) for verb in verbs]
    if not targets:
        raise Failure('the world has no doors')
    rng, numbers = random.Random(SEED), itertools.count()
    there: deque[tuple[float, str]] = deque()
    command = service('/angen/command', SendCommand)
    spawn, delete = service('/angen/spawn', Spawn), service('/angen/delete', Delete)

    def one_command() -> Any:
        target, verb = rng.choice(targets)
        return command(target=target, text=verb)

    def one_spawn() -> Any:
        number = next(numbers)
        height = plan.STOREY * (number % FLOORS) + 2.0
        pose = Pose(Point(0.5 + number % 7, 0.5 + number % 5, height),
                    Quaternion(0.0, 0.0, 0.0, 1.0))
        answer = spawn(name=f'load_{number}', xml='model://pir', pose=pose)
        there.append((time.monotonic(), f'load_{number}'))
        return answer

    def one_deletion() -> Any:
        while not there or time.monotonic() - there[0][0] < LIVES:
            if callers.stop.wait(0.01):
                raise Failure('the bench ends')
        return delete(name=there.popleft()[1])

    callers.start(COMMANDS, one_command)
    callers.start(SPAWNS, one_spawn)
    callers.start(SPAWNS, one_deletion)


def counts_of(sensors: int) -> dict[str, int]:
    """The number of each kind, together `sensors`."""
    counts = {kind: int(share * sensors) for kind, share in SHARES.items()}
    counts['pir'] += sensors - sum(counts.values())
    return counts


def run(sandbox: Sandbox, topics: str, sensors: int, seconds: float) -> Row:
    """One run, with a node of its own."""
    listeners.allow_many_connections()
    world = sandbox.folder / 'load.world'
    counts = counts_of(sensors)
    write_apartment(world, FLOORS, counts, SEED)
    with ExitStack() as open_now:
        node = sandbox.node(world, 1.0, topics=topics)
        open_now.callback(end, node)
        client = Live()
        meter = open_now.enter_context(Meter(client, node))
        wait(lambda: bool(meter.samples) and meter.samples[-1].sim >= SETTLED,
             'the world has not come to rest', SETTLE_LIMIT)
        said = sandbox.folder / 'listeners.log'
        readers = READERS[topics]
        group = sandbox.start([sys.executable, listeners.__file__, str(readers),
                               str(SLEEPERS)], 'listeners')
        open_now.callback(end, group)
        wait(lambda: said.read_bytes().endswith(b'connections\n') or group.poll() is not None,
             'the subscribers have not connected', CONNECT_LIMIT)
        if group.poll() is not None:
            raise Failure(f'the subscribers ended: {said.read_text(errors="replace")[-300:]}')
        connections = int(said.read_text().split()[-2])
        callers = Callers()
        open_now.callback(callers.end)
        start_calls(callers, client)
        meter.pass_by(WARM_UP)
        del callers.answers[:], callers.rejected[:]
        taken = meter.pass_by(seconds)
        answers, rejected = list(callers.answers), list(callers.rejected)
        callers.end()
    if not answers:
        raise Failure('no service call was answered' + (f': {rejected[0]}' if rejected else ''))
    for reason, count in Counter(rejected).most_common(3):
        print(f'angen: {count} times rejected: {reason}', file=sys.stderr)
    return row_of(taken, answers, topics=topics, sensors=sensors, readers=readers,
                  connections=connections, rejected=len(rejected))


def row_of(seconds: Sequence[Sample], answers: Sequence[float], **what: Any) -> Row:
    """The figures of a run."""
    first, last = seconds[0], seconds[-1]
    wall = last.wall - first.wall
    cpu = cpu_load(first.server, last.server, wall)
    within = seconds[1:]  # the ticks of the first came before it
    memory = [second.rss / 1e6 for second in seconds]
    return Row(
        seconds=wall, rtf=(last.sim - first.sim) / wall, cpu=cpu,
        others_cpu=cpu_load(first.machine, last.machine, wall) - cpu,
        tick_median=median(s.tick_median for s in within),
        tick_p99=median(s.tick_p99 for s in within),
        tick_longest=max(s.tick_longest for s in within),
        answers=len(answers), answer_median=quantile(answers, 0.5),
        answer_p99=quantile(answers, 0.99), answer_longest=max(answers),
        rss_start=memory[0], rss_end=memory[-1], rss_most=max(memory), **what)


def measure(modes: Sequence[str], sensors: int, seconds: float, out: Path, json: bool) -> None:
    """Runs each mode, prints a table and writes out/load.csv."""
    steps = Steps(len(modes))
    rows = []
    with tempfile.TemporaryDirectory(prefix='angen_bench_') as work, Sandbox(Path(work)) as sandbox:
        for mode in modes:
            steps.next(f'topics:={mode}, {sensors} sensors, {READERS[mode]} subscribers')
            rows.append(run(sandbox, mode, sensors, seconds))
    steps.close()
    cells = [asdict(row) | {'real_time': row.real_time} for row in rows]
    columns = [*(f.name for f in fields(Row)), 'real_time']
    write_csv(out / 'load.csv', columns, ([cell(row[key]) for key in columns] for row in cells))
    if json:
        print(as_json(cells))
        return
    show(table(('TOPICS', 'SUBSCRIBERS', 'RTF', 'CPU %', 'TICK p50/p99/max ms',
                'ANSWER p50/p99/max ms', 'REJECTED', 'MEMORY MB'), [
        (row.topics, f'{row.readers} + {SLEEPERS}', f'{row.rtf:.3f}', f'{row.cpu:.0f}',
         f'{row.tick_median:.2f} / {row.tick_p99:.2f} / {row.tick_longest:.0f}',
         f'{row.answer_median:.1f} / {row.answer_p99:.1f} / {row.answer_longest:.0f}',
         f'{row.rejected} of {row.answers}',
         f'{row.rss_start:.0f} to {row.rss_end:.0f}, most {row.rss_most:.0f}') for row in rows],
        right=('RTF', 'CPU %')))
    print(f"wrote {out / 'load.csv'}")
