"""angen bench sensors: the cost of sensors, with a master, nodes and rviz of its own."""
import sys
import tempfile
from collections import Counter
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any, Iterator, Sequence

from angen_bench.measure import (SUBSCRIBED, Meter, Sample, client_load, deploy, due, handled,
                                 load, share, spread, topic_of)
from angen_bench.report import (Row, Session, as_cells, combine, describe, describe_fit, draw,
                                draw_together, extremes, write_csv)
from angen_models import plan
from angen_tools.common.failure import Failure
from angen_tools.common.output import as_json
from angen_tools.common.progress import Steps
from angen_tools.session.live import Live
from angen_tools.live.sandbox import Sandbox, end
from angen_tools.world import sdf
from angen_tools.world.apartment import apartment, write_apartment
from angen_tools.world.models import find
from angen_tools.world.placing import KINDS, Placement, floors_for

FLOORS = 2
SEED = 1
WARM_UP = 8.0  # s; a body is at rest after 5, see docs/architecture.md
PLANTS_READ = 70.0  # s simulated, reached at rate 0: the light of lamps at plants is found at 60
COUNTS = {'added': [0, 1, 10, 50, 100, 200, 500], 'desired': [1, 2, 3, 10]}
COUNTS['deployed'] = COUNTS['added']


@dataclass(frozen=True)
class Case:
    """One world: a count of a kind, or a number of floors with all that it should have."""
    mode: str
    kind: str
    count: int
    floors: int
    mover: str = 'person'

    @property
    def counts(self) -> dict[str, int]:
        """The number of sensors of each kind that the case has in the end."""
        if self.mode == 'desired':
            rooms, places = 6 * self.count, 9 * self.count  # chairs and tables
            return {'pir': 2 * rooms, 'luminosity': rooms, 'switch': rooms, 'contact': places + 1}
        return {self.kind: self.count}

    @property
    def elevator(self) -> bool:
        return self.mode == 'desired'

    def sensors(self) -> list[Placement]:
        return apartment(self.floors, self.counts, SEED, self.elevator)


def cases(mode: str, kind: str, counts: Sequence[int] | None, mover: str = 'person'
          ) -> list[list[Case]]:
    """The cases of each figure; `both` is added and deployed. All counts of a kind have as many
    apartments as the largest needs.

    Failure where `desired` is given without an apartment, or there is no room for the sensors.
    """
    if mode == 'both':
        return [*cases('added', kind, counts, mover), *cases('deployed', kind, counts, mover)]
    counts = sorted(set(counts if counts is not None else COUNTS[mode]))
    if mode == 'desired':
        if counts[0] < 1:
            raise Failure('desired counts floors; give 1 or more')
        return [[Case(mode, 'all', count, count) for count in counts]]
    groups = []
    for name in KINDS if kind == 'all' else (kind,):
        floors = floors_for(name, counts[-1], FLOORS)
        groups.append([Case(mode, name, count, floors, mover) for count in counts])
        groups[-1][-1].sensors()
    return groups


@cache
def rate_of(model: str) -> float:
    """The rate of the sensor of a block, Hz."""
    path = find(f'model://{model}')
    text = sdf.read(path).findtext('.//sensor/update_rate') if path else None
    if not text:
        raise Failure(f'model://{model} has no sensor with an <update_rate>')
    return float(text)


@dataclass
class Bench:
    """Runs cases on one master."""
    sandbox: Sandbox
    shows: bool  # whether there is an rviz to measure
    window: float  # s of wall time
    trouble: list[str] = field(default_factory=list)
    furniture: float = 0.0  # readings of its sensors, as of plants, in a simulated second

    def session(self, case: Case) -> Session:
        """One repeat of a case."""
        self.write(case)
        found = Session()
        with ExitStack() as open_now:
            self.in_time(case, found, *self.start(open_now, case, 1.0, self.shows))
        with ExitStack() as open_now:
            self.fast(case, found, *self.start(open_now, case, 0.0, False))
        return found

    @property
    def world(self) -> Path:
        """The file of the case that is measured."""
        return self.sandbox.folder / 'bench.world'

    def write(self, case: Case, one_link: bool = False) -> None:
        """Writes its world."""
        deployed = case.mode == 'deployed'
        write_apartment(self.world, case.floors, {}, SEED, False, 'nobody')
        self.furniture = sum(float(rate.text) for uri in sdf.read(self.world).iter('uri')
                             if uri.text.startswith('model://') and (path := find(uri.text))
                             for rate in sdf.read(path).iterfind('.//sensor/update_rate'))
        write_apartment(self.world, case.floors, {} if deployed else case.counts, SEED,
                        case.elevator and not deployed, case.mover, one_link)

    def in_time(self, case: Case, found: Session, meter: Meter, client: Live) -> None:
        """The cost of a node at rate 1."""
        sensors = case.sensors()
        subscribed = spread(sensors, SUBSCRIBED)
        meter.subscribe([topic_of(s) for s in subscribed])
        if case.mode == 'deployed' and sensors:
            meter.sample(0.0)
            done = deploy(client, meter, sensors)
            found.deploy_s, found.first_reading_ms = done.seconds, done.first_reading_ms
            found.deploy_server_cpu = done.server_cpu
            found.deploy_client_cpu = done.client_cpu
        first, last = meter.window(WARM_UP, self.window)
        if meter.began is not None:
            found.start_s = meter.began - self.sandbox.launched
        seconds = last.wall - first.wall
        found.rtf = (last.sim - first.sim) / seconds
        server = load(first.server, last.server, seconds)
        found.server_cpu, found.client_cpu = server, client_load(
            first.client, last.client, seconds)
        found.others_cpu = (load(first.machine, last.machine, seconds)
                            - server - (found.client_cpu or 0.0))
        found.rss_mb = last.rss / 1e6
        found.delivered = share(self._made(first, last),
                                expected(case, sensors, first.sim, last.sim))
        found.received = share(last.received - first.received,
                               expected(case, subscribed, first.sim, last.sim))

    def fast(self, case: Case, found: Session, meter: Meter, client: Live) -> None:
        """The speed of a node at rate 0."""
        sensors = case.sensors()
        if case.mode == 'deployed' and sensors:
            meter.subscribe([topic_of(s) for s in spread(sensors, SUBSCRIBED)])
            deploy(client, meter, sensors)
        first, last = meter.window(WARM_UP, self.window, PLANTS_READ)
        found.rtf_fast = (last.sim - first.sim) / (last.wall - first.wall)
        found.sim_per_cpu = share(last.sim - first.sim, last.server - first.server)
        found.delivered_fast = share(self._made(first, last),
                                     expected(case, sensors, first.sim, last.sim))

    def _made(self, first: Sample, last: Sample) -> float:
        """Readings of the case's sensors; those of its furniture, such as plants, are all made."""
        return last.readings - first.readings - self.furniture * (last.sim - first.sim)

    def start(self, open_now: ExitStack, case: Case, rate: float, shows: bool
              ) -> tuple[Meter, Live]:
        """A node with the case's world and all lamps on, and with rviz if it `shows`."""
        from geometry_msgs.msg import Twist, Vector3
        from std_msgs.msg import String
        node = self.sandbox.node(self.world, rate)
        open_now.callback(end, node)
        client = Live()
        meter = open_now.enter_context(Meter(client, node))
        self._send(open_now, client, '/gazebo/Light_controller', String('On, all'))
        if case.mover == 'robot':
            speed, turn = robot_round()
            self._send(open_now, client, '/cmd_vel', Twist(Vector3(x=speed), Vector3(z=turn)))
        if shows:
            viewer = self.sandbox.rviz()
            if viewer:
                open_now.callback(end, viewer)
                meter.watch(viewer)
            else:
                self.trouble.append('rviz does not start')
                self.shows = False
        return meter, client

    @staticmethod
    def _send(open_now: ExitStack, client: Live, topic: str, message: Any) -> None:
        publisher = client.publisher(topic, type(message))
        open_now.callback(publisher.unregister)
        publisher.publish(message)
        handled(client)


def expected(case: Case, sensors: Sequence[Placement], begin: float, end: float) -> float:
    """The number of readings that are due between two simulated times in s."""
    rates = Counter(rate_of(sensor.model) for sensor in sensors)
    if case.mode == 'deployed':  # each counts from its own start
        return sum(n * rate * (end - begin) for rate, n in rates.items())
    return sum(n * due(rate, begin, end) for rate, n in rates.items())


def robot_round() -> tuple[float, float]:
    """m/s and rad/s of the robot that moves in a bench's world."""
    return plan.ROUND_SPEED, plan.ROUND_SPEED / plan.ROUND[2]


def rows_of(bench: Bench, group: Sequence[Case], repeats: int, steps: Steps, kept: list[Row]
            ) -> Iterator[Row]:
    """The row of each case, also added to `kept`; on Ctrl-C from the repeats until then."""
    for case in group:
        sessions: list[Session] = []
        try:
            for repeat in range(repeats):
                steps.next(f'{case.mode} {case.kind} {case.count}, repeat {repeat + 1}')
                sessions.append(bench.session(case))
        finally:
            if sessions:
                kept.append(combine(sessions, extremes=extremes(sessions), mode=case.mode,
                                    kind=case.kind, count=case.count, floors=case.floors,
                                    sensors=sum(case.counts.values())))
        yield kept[-1]


def measure(groups: Sequence[Sequence[Case]], repeats: int, window: float, folder: Path,
            json: bool) -> None:
    """Measures, prints and writes into `folder` a CSV and a figure for each kind and mode, and for
    several modes one of all.

    KeyboardInterrupt keeps all measurements and is raised again.
    """
    steps = Steps(repeats * sum(len(group) for group in groups))
    with tempfile.TemporaryDirectory(prefix='angen_bench_') as work, Sandbox(Path(work)) as sandbox:
        why = sandbox.display()
        if why:
            print(f'angen: the client is not measured: {why}', file=sys.stderr)
        bench = Bench(sandbox, why is None, window)
        tables: list[list[Row]] = []
        for group in groups:
            kept: list[Row] = []
            tables.append(kept)
            try:
                for _ in rows_of(bench, group, repeats, steps, kept):
                    write_csv(_path(folder, group[0], 'csv'), kept)
            finally:
                steps.close()
                _report(folder, group[0], kept, json)
        if len({group[0].mode for group in groups}) > 1:
            figure = folder / 'sensors_both.png'
            draw_together(figure, tables)
            if not json:
                print(f'wrote {figure}')
        for line in bench.trouble:
            print(f'angen: the client is not measured: {line}', file=sys.stderr)


def _report(folder: Path, case: Case, rows: list[Row], json: bool) -> None:
    if not rows:
        return
    table, figure = _path(folder, case, 'csv'), _path(folder, case, 'png')
    write_csv(table, rows)
    draw(figure, rows)
    if json:
        print(as_json([as_cells(row) for row in rows]), flush=True)
        return
    print(f'{case.mode} {case.kind}')
    for row in rows:
        print(describe(row))
    for line in describe_fit(rows):
        print(line)
    print(f'wrote {table} and {figure}', flush=True)


def _path(folder: Path, case: Case, ending: str) -> Path:
    return folder / f'sensors_{case.kind}_{case.mode}.{ending}'
