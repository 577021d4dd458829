"""Runs the worlds of a bench in Angen and in Gazebo, in turn."""
import sys
import tempfile
import time
from contextlib import ExitStack, suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median
from typing import Sequence

from angen_bench.contest_report import (ANGEN, EACH, ONE_LINK, Row, Session, draw, table,
                                        write_csv)
from angen_bench.gazebo import STEPS, Gazebo, Tick, default_chroot, prepare
from angen_bench.measure import Meter, load, share, topic_of
from angen_bench.report import Session as OwnSession
from angen_bench.report import combine
from angen_bench.sensors import WARM_UP, Bench, Case, rate_of, robot_round
from angen_models.devices import SEPARATION, WHEEL_RADIUS
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text
from angen_tools.common.output import as_json
from angen_tools.common.progress import Steps
from angen_tools.common.wait import wait
from angen_tools.session.live import Live
from angen_tools.live.sandbox import Sandbox
from angen_tools.world import sdf
from angen_tools.world.apartment import block, put
from angen_tools.world.placing import Placement

LEAST_READINGS = 5  # a sensor, for a share to be meaningful
TRIALS = 3  # spawns and deletions a repeat
NEW = Placement('pir', 'pir', 'bench_new', (2.0, 2.0, 2.3, 0.0, 0.45, 0.0))
NEWS_LIMIT = 20.0  # s of wall time


@dataclass
class Contest:
    """Runs cases; `chroot` holds Gazebo."""
    bench: Bench
    chroot: Path

    def session(self, simulator: str, case: Case) -> Session:
        """One repeat of a case in one simulator."""
        self.bench.write(case, simulator == ONE_LINK)
        return self._angen(case) if simulator == ANGEN else self._gazebo(case)

    def _angen(self, case: Case) -> Session:
        own = OwnSession()
        with ExitStack() as open_now:
            meter, client = self.bench.start(open_now, case, 1.0, False)
            self.bench.in_time(case, own, meter, client)
            first_reading, gone = _spawn_and_delete(meter, client)
        with ExitStack() as open_now:
            self.bench.fast(case, own, *self.bench.start(open_now, case, 0.0, False))
        return Session(own.server_cpu, own.rtf, own.delivered, own.rtf_fast, own.delivered_fast,
                       own.sim_per_cpu, own.rss_mb, own.start_s, first_reading, gone)

    def _gazebo(self, case: Case) -> Session:
        folder = self.bench.sandbox.folder
        (folder / 'new.sdf').write_text(_new_model(), encoding='utf-8')
        sensors = case.sensors()
        found = Session()
        with Gazebo(self.chroot, folder, self.bench.world.name, self.bench.sandbox.environment
                    ) as gazebo:
            found.start_s = gazebo.start_s
            gazebo.settle(len(sensors))
            gazebo.send(f'drive turtlebot {" ".join(f"{w:g}" for w in _wheels())}')
            first, last = gazebo.window(WARM_UP, self.bench.window)
            found.rtf, found.delivered = _speed(sensors, first, last)
            found.cpu = load(first.processor, last.processor, last.wall - first.wall)
            found.rss_mb = last.rss / 1e6
            gazebo.send('rate 0')
            first, last = gazebo.window(WARM_UP, self.bench.window)
            found.rtf_fast, found.delivered_fast = _speed(sensors, first, last)
            found.sim_per_cpu = share(last.sim - first.sim, last.processor - first.processor)
            gazebo.send(f'rate {STEPS}')
            with suppress(Failure):  # it sometimes stops answering; the spawns until then count
                readings, ends = [], []
                for trial in range(TRIALS):
                    readings.append(gazebo.spawn(NEW.name, 'new.sdf'))
                    found.first_reading_ms = 1000 * median(readings)
                    ends.append(gazebo.delete(NEW.name))
                    found.gone_ms = 1000 * median(ends)
        return found


def _speed(sensors: Sequence[Placement], first: Tick, last: Tick) -> tuple[float, float | None]:
    """Simulated seconds a second of wall time, and readings made of those due.

    No share where so little time went by that the edges of the window decide it.
    """
    seconds = last.sim - first.sim
    rates = [rate_of(sensor.model) for sensor in sensors]
    made = None
    if rates and seconds * min(rates) >= LEAST_READINGS:
        made = (last.readings - first.readings) / (seconds * sum(rates))
    return seconds / (last.wall - first.wall), made


def _wheels() -> tuple[float, float]:
    """rad/s of the left and the right wheel on the robot's round."""
    speed, turn = robot_round()
    return ((speed - turn * SEPARATION / 2) / WHEEL_RADIUS,
            (speed + turn * SEPARATION / 2) / WHEEL_RADIUS)


def _new_model() -> str:
    """The PIR that is spawned, as an SDF document."""
    model = block(NEW.model)
    model.set('name', NEW.name)
    put(model, *NEW.pose)
    return sdf.text(model.getroottree().getroot())


def _spawn_and_delete(meter: Meter, client: Live) -> tuple[float, float]:
    """ms from the call to the first message of the new topic, and to the event of the deletion."""
    topic = topic_of(NEW)
    client.events()
    meter.subscribe([topic])
    readings, ends = [], []
    for trial in range(TRIALS):
        meter.first.pop(topic, None)
        ordered = time.monotonic()
        client.spawn(NEW.name, f'model://{NEW.model}', NEW.pose)
        wait(lambda: topic in meter.first, 'a spawned sensor has not published', NEWS_LIMIT)
        readings.append(1000 * (meter.first[topic] - ordered))
        ordered = time.monotonic()
        client.delete(NEW.name)
        if not client.until(lambda: any((event.source, event.event) == (NEW.name, 'deleted')
                                        for event in client.events()), NEWS_LIMIT):
            raise Failure('the deletion of a sensor is not published on /angen/events')
        ends.append(1000 * (time.monotonic() - ordered))
    return median(readings), median(ends)


def measure(groups: Sequence[Sequence[Case]], repeats: int, window: float, folder: Path,
            chroot: Path | None, json: bool) -> None:
    """Measures, prints and writes into `folder` a CSV, a table and a figure for each kind.

    `chroot` is made where it is missing. KeyboardInterrupt keeps all measurements and is raised
    again. Failure where Gazebo cannot be had.
    """
    chroot = (chroot or default_chroot()).resolve()
    prepare(chroot)
    steps = Steps(repeats * sum(len(group) * len(simulators(group[0].kind)) for group in groups))
    with tempfile.TemporaryDirectory(prefix='angen_bench_') as work, Sandbox(Path(work)) as sandbox:
        why = sandbox.display()
        if why and any(group[0].kind == 'luminosity' for group in groups):
            raise Failure(f"Gazebo's luminosity sensors are cameras, which need a display: {why}")
        contest = Contest(Bench(sandbox, False, window), chroot)
        for group in groups:
            rows: list[Row] = []
            try:
                for case in group:
                    measure_case(contest, case, repeats, steps, rows)
                    write_csv(_path(folder, case, 'csv'), rows)
            finally:
                steps.close()
                _report(folder, group[0], rows, json)


def simulators(kind: str) -> tuple[str, ...]:
    """The cases to compare: contact sensors sit on furniture, not on one link."""
    return (ANGEN, EACH) if kind == 'contact' else (ANGEN, EACH, ONE_LINK)


def measure_case(contest: Contest, case: Case, repeats: int, steps: Steps, rows: list[Row]
                 ) -> None:
    """Appends a row a simulator, also on Ctrl-C. What Gazebo fails at is reported and left out."""
    found: dict[str, list[Session]] = {simulator: [] for simulator in simulators(case.kind)}
    try:
        for repeat in range(repeats):
            for simulator, sessions in found.items():
                steps.next(f'{case.kind} {case.count}, {simulator}, repeat {repeat + 1}')
                try:
                    sessions.append(contest.session(simulator, case))
                except Failure as failure:
                    if simulator == ANGEN:
                        raise
                    print(f'angen: {case.kind} {case.count}: {failure}', file=sys.stderr)
    finally:
        rows += [combine(sessions, Row, kind=case.kind, count=case.count, simulator=simulator)
                 for simulator, sessions in found.items() if sessions]


def _report(folder: Path, case: Case, rows: Sequence[Row], json: bool) -> None:
    if not rows:
        return
    numbers, text, figure = (_path(folder, case, ending) for ending in ('csv', 'md', 'png'))
    write_csv(numbers, rows)
    lines = table(rows)
    write_text(text, '\n'.join(lines) + '\n')
    draw(figure, rows)
    if json:
        print(as_json([asdict(row) for row in rows]), flush=True)
        return
    print('\n'.join(lines))
    print(f'wrote {numbers}, {text} and {figure}', flush=True)


def _path(folder: Path, case: Case, ending: str) -> Path:
    return folder / f'sensors_{case.kind}_vs_gazebo.{ending}'
