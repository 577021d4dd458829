"""angen bench sensors --vs gazebo: the same worlds in both simulators, measured in turn."""
import math
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Callable, Sequence

from angen_bench.report import cell
from angen_tools.common import files

ANGEN, EACH, ONE_LINK = 'angen', 'gazebo', 'gazebo_one_link'
NAMES = {ANGEN: 'Angen', EACH: 'Gazebo, a model a sensor', ONE_LINK: 'Gazebo, all on one link'}


@dataclass
class Session:
    """One repeat of one simulator; None where it was not measured, or is of nothing."""
    cpu: float | None = None  # % of a core at rate 1, all threads
    rtf: float | None = None  # simulated seconds a second of wall time, at rate 1
    delivered: float | None = None  # readings made, of those due
    rtf_fast: float | None = None  # the same two at rate 0
    delivered_fast: float | None = None
    sim_per_cpu: float | None = None  # simulated seconds a second of processor time, at rate 0
    rss_mb: float | None = None
    start_s: float | None = None  # from the start of the process to the first step
    first_reading_ms: float | None = None  # from the order to spawn a sensor to its first reading
    gone_ms: float | None = None  # from the order to delete it until the deletion is reported

    @property
    def cpu_per_sim(self) -> float | None:
        """`cpu` of a simulated second: where time falls behind the wall's, less is done in one."""
        return self.cpu / self.rtf if self.cpu is not None and self.rtf else None

    @property
    def useful_per_cpu(self) -> float | None:
        """`sim_per_cpu` times the share of readings that were made."""
        made = 1.0 if self.delivered_fast is None else self.delivered_fast
        return None if self.sim_per_cpu is None else self.sim_per_cpu * made


@dataclass
class Row(Session):
    """The medians of the repeats of one count in one simulator."""
    kind: str = ''
    count: int = 0
    simulator: str = ''
    repeats: int = 0


COLUMNS = ('kind', 'count', 'simulator', 'repeats', *(field.name for field in fields(Session)))


def write_csv(path: Path, rows: Sequence[Row]) -> None:
    """Writes a line a count and simulator, empty where nothing was measured."""
    files.write_csv(path, COLUMNS, ([cell(getattr(row, name)) for name in COLUMNS] for row in rows))


@dataclass(frozen=True)
class Question:
    """A figure that is compared."""
    title: str
    value: Callable[[Row], float | None]
    less_is_better: bool
    above_none: bool = False  # without the cost of the world without sensors
    per_sensor: bool = False


QUESTIONS = (
    Question('CPU of a simulated second at rate 1, %', lambda row: row.cpu_per_sim, True),
    Question('the same, above 0 sensors', lambda row: row.cpu_per_sim, True, above_none=True),
    Question('simulated s a second, rate 1', lambda row: row.rtf, False),
    Question('simulated s a second, rate 0', lambda row: row.rtf_fast, False),
    Question('simulated s a CPU second, rate 0', lambda row: row.sim_per_cpu, False),
    Question('the same, times the share of readings made', lambda row: row.useful_per_cpu, False),
    Question('memory a sensor, MB', lambda row: row.rss_mb, True, above_none=True,
             per_sensor=True),
    Question('start to first step, s', lambda row: row.start_s, True),
    Question('spawn to first reading, ms', lambda row: row.first_reading_ms, True),
    Question('deletion, ms', lambda row: row.gone_ms, True),
)


def value(question: Question, row: Row, none: Row | None) -> float | None:
    """A row's figure; `none` is the row of the same simulator without sensors."""
    found = question.value(row)
    if found is None or not question.above_none:
        return found
    base = question.value(none) if none else None
    if base is None or row.count == 0:
        return None
    return (found - base) / (row.count if question.per_sensor else 1)


def ratio(question: Question, angen: float | None, peer: float | None) -> float | None:
    """The factor by which Angen is better; None where a value is missing or not above 0."""
    if angen is None or peer is None or min(angen, peer) <= 0.0:
        return None
    return peer / angen if question.less_is_better else angen / peer


def table(rows: Sequence[Row]) -> list[str]:
    """Lines of a table in Markdown: a line a count and question, ratios in front."""
    simulators = [s for s in NAMES if any(row.simulator == s for row in rows)]
    peers = [s for s in simulators if s != ANGEN]
    at = {(row.simulator, row.count): row for row in rows}
    head = [*(f'times better than {NAMES[p]}' for p in peers), *(NAMES[s] for s in simulators)]
    lines = [f'| {rows[0].kind} | | {" | ".join(head)} |', '|---' * (2 + len(head)) + '|']
    for question in QUESTIONS:
        for count in dict.fromkeys(row.count for row in rows):
            found = {s: value(question, at[s, count], at.get((s, 0)))
                     for s in simulators if (s, count) in at}
            if all(v is None for v in found.values()):
                continue
            cells = [_times(ratio(question, found.get(ANGEN), found.get(p))) for p in peers]
            cells += [_short(found.get(s)) for s in simulators]
            lines.append(f'| {question.title} | {count} | {" | ".join(cells)} |')
    for simulator in simulators:
        lost = [f'{row.count}: {100 * share:.0f} %' for row in rows if row.simulator == simulator
                for share in (row.delivered_fast,) if share is not None and share < 0.99]
        if lost:
            lines += ['', f'{NAMES[simulator]} made only part of its readings at rate 0: '
                      + ', '.join(lost)]
    return lines


def _times(number: float | None) -> str:
    return '' if number is None else f'{number:.2g}' if number < 10 else f'{number:.0f}'


def _short(number: float | None) -> str:
    return '' if number is None or not math.isfinite(number) else f'{number:.3g}'


def draw(path: Path, rows: Sequence[Row]) -> None:
    """Writes the figure: CPU at rate 1 and speed at rate 0 over count, of each simulator."""
    from matplotlib.ticker import MaxNLocator
    figure, (load, speed) = files.pyplot().subplots(2, 1, sharex=True, figsize=(6.4, 6.0),
                                                    layout='constrained')
    simulators = [s for s in NAMES if any(row.simulator == s for row in rows)]
    for simulator, color in zip(simulators, ('C0', 'C3', 'C1')):
        own = [row for row in rows if row.simulator == simulator]
        for axis, of in ((load, lambda r: r.cpu_per_sim), (speed, lambda r: r.useful_per_cpu)):
            points = [(r.count, of(r)) for r in own if of(r) is not None]
            if points:
                axis.plot(*zip(*points), 'o-', color=color, label=NAMES[simulator])
    load.set_ylabel('CPU of a simulated second\nat rate 1, % of a core')
    load.set_ylim(bottom=0)
    speed.set_yscale('log')
    speed.set_ylabel('simulated s a CPU second at rate 0,\ntimes the share of readings made')
    speed.xaxis.set_major_locator(MaxNLocator(integer=True))
    speed.set_xlabel(f'{rows[0].kind} sensors')
    for axis in (load, speed):
        axis.grid(alpha=0.3)
        axis.legend(fontsize='small')
    files.save_figure(figure, path, dpi=100)
