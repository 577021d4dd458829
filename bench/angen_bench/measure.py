"""Measures a running node: processor time, simulated time, readings, memory."""
import math
import subprocess
import threading
import time
from dataclasses import dataclass
from statistics import median
from typing import Any, Callable, Self, Sequence

from angen_tools.common.failure import Failure
from angen_tools.common.wait import wait
from angen_tools.session.live import Live
from angen_tools.world.placing import Placement

SUBSCRIBED = 10  # topics that are subscribed to; more would measure the subscriber
STATS_LIMIT = 120.0  # s of wall time


@dataclass(frozen=True)
class Sample:
    """The state of things when a /angen/stats came: s of wall, simulated and processor time."""
    wall: float
    sim: float
    readings: int
    received: int
    server: float
    client: float | None
    machine: float  # of all processes
    rss: int  # bytes, of the node
    tick_median: float  # ms of the ticks of the second before
    tick_p99: float
    tick_longest: float


def due(rate: float, begin: float, end: float) -> int:
    """The readings of a sensor that started at time 0 in (begin, end]; rate in Hz, times in s."""
    return math.floor(end * rate + 1e-6) - math.floor(begin * rate + 1e-6)


def machine_time() -> float:
    """Processor time in s that all processes of the machine have used, on all cores."""
    import psutil
    times = psutil.cpu_times()
    return sum(times) - times.idle - times.iowait - times.guest - times.guest_nice


class Meter:
    """Watches a node. A context: its end takes the subscriptions away."""

    def __init__(self, client: Live, server: subprocess.Popen[bytes]) -> None:
        import psutil
        import rospy

        from angen_msgs.msg import Stats
        client.join()
        self._server = psutil.Process(server.pid)
        self._viewer: psutil.Process | None = None
        self._gone = psutil.NoSuchProcess
        self.samples: list[Sample] = []
        self._lock = threading.Lock()
        self._received = 0
        self.began: float | None = None  # wall time of the first tick, of a node at rate 1
        self.first: dict[str, float] = {}  # topic: wall time of its first message
        self._subscribers = [rospy.Subscriber('/angen/stats', Stats, self._take)]

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for subscriber in self._subscribers:
            subscriber.unregister()

    def watch(self, viewer: subprocess.Popen[bytes]) -> None:
        """Watches a client too."""
        import psutil
        self._viewer = psutil.Process(viewer.pid)

    def subscribe(self, topics: Sequence[str]) -> None:
        """Subscribes to topics without decoding their messages; they may come later."""
        import rospy

        def counter(topic: str) -> Callable[[Any], None]:
            def count(_: Any) -> None:
                with self._lock:
                    self._received += 1
                    self.first.setdefault(topic, time.monotonic())
            return count

        self._subscribers += [rospy.Subscriber(t, rospy.AnyMsg, counter(t)) for t in topics]

    def processor(self) -> tuple[float, float | None]:
        """Processor time in s that the node and the client have used, all threads."""
        def used(process: Any) -> float:
            times = process.cpu_times()
            return times.user + times.system

        client = None
        if self._viewer:
            try:
                client = used(self._viewer)
            except self._gone:
                self._viewer = None
        return used(self._server), client

    def _take(self, stats: Any) -> None:
        try:
            server, client = self.processor()
            rss = self._server.memory_info().rss
        except self._gone:
            return
        wall, sim = time.monotonic(), stats.sim_time.to_sec()
        if self.began is None:
            self.began = wall - sim
        self.samples.append(Sample(
            wall, sim, stats.readings, self._received, server, client, machine_time(), rss,
            1e3 * stats.tick_median, 1e3 * stats.tick_p99, 1e3 * stats.tick_longest))

    def sample(self, after: float) -> Sample:
        """The first sample that came later than the wall time `after`; waits for it."""
        end = max(after, time.monotonic()) + STATS_LIMIT
        while True:
            if self.samples and self.samples[-1].wall > after:
                return self.samples[-1]
            if time.monotonic() > end or not self._server.is_running():
                raise Failure('the node no longer publishes /angen/stats')
            time.sleep(0.01)

    def pass_by(self, length: float) -> list[Sample]:
        """The samples from the next one on, `length` s of wall time or a little more."""
        first = self.sample(time.monotonic())
        self.sample(first.wall + length)
        return [sample for sample in self.samples if sample.wall >= first.wall]

    def window(self, warm_up: float, length: float, simulated: float = 0.0
               ) -> tuple[Sample, Sample]:
        """Two samples `length` s of wall time apart or a little more.

        The first comes when `warm_up` s have passed, of wall time and of simulated time, and
        simulated time is at least `simulated` s: only then has each lamp shone on each sensor, and
        only then is all furniture at rest, whose light is computed once.
        """
        first = self.sample(0.0)
        begun = first.sim
        first = self.sample(first.wall + warm_up)
        while first.sim < max(begun + warm_up, simulated):
            first = self.sample(first.wall)
        return first, self.sample(first.wall + length)


@dataclass(frozen=True)
class Deployed:
    """The cost of spawning sensors: s, % of a core, ms."""
    seconds: float
    server_cpu: float
    client_cpu: float | None
    first_reading_ms: float | None


def share(part: float, whole: float) -> float | None:
    """part / whole; None of nothing."""
    return part / whole if whole else None


def load(first: float, last: float, seconds: float) -> float:
    """% of a core between two processor times."""
    return 100 * (last - first) / seconds


def client_load(first: float | None, last: float | None, seconds: float) -> float | None:
    """The same for the client; None where it was not measured."""
    return None if first is None or last is None else load(first, last, seconds)


def spread(sensors: Sequence[Placement], most: int) -> list[Placement]:
    """At most `most` of the sensors, evenly over the list."""
    step = max(1, math.ceil(len(sensors) / most))
    return list(sensors[::step])


def handled(client: Live, limit: float = 3 * STATS_LIMIT) -> None:
    """Returns when the simulator has handled all that it has received. The tick in which lamps
    shine on many sensors for the first time takes longer than a service waits."""
    end = time.monotonic() + limit
    while True:
        try:
            client.fence()
            return
        except Failure:
            if time.monotonic() > end:
                raise
            time.sleep(1.0)


def deploy(client: Live, meter: Meter, sensors: Sequence[Placement]) -> Deployed:
    """Spawns the sensors one after the other; those with a subscriber show how soon they read."""
    watched = {topic_of(s) for s in spread(sensors, SUBSCRIBED)}
    subscribed: dict[str, float] = {}
    start, (server, viewer) = time.monotonic(), meter.processor()
    for sensor in sensors:
        subscribed[topic_of(sensor)] = time.monotonic()
        client.spawn(sensor.name, f'model://{sensor.model}', sensor.pose)
    seconds, (server_end, viewer_end) = time.monotonic() - start, meter.processor()
    wait(lambda: watched <= meter.first.keys(), 'a spawned sensor has not published', STATS_LIMIT)
    waits = [1000 * (meter.first[topic] - subscribed[topic]) for topic in watched]
    return Deployed(seconds, load(server, server_end, seconds),
                    client_load(viewer, viewer_end, seconds), median(waits) if waits else None)


def topic_of(sensor: Placement) -> str:
    """The topic of a sensor's readings."""
    return f'/angen/{sensor.kind}/{sensor.name}'
