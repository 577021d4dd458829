"""Reports of the benches: medians, CSV, a straight line, a figure."""
import math
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from statistics import median
from typing import Any, Sequence

from angen_tools.common import files

REAL_TIME = 0.99  # of simulated seconds a second, and of readings, that still count as real time


@dataclass
class Session:
    """One repeat. CPU in % of one core; None where it was not measured."""
    server_cpu: float | None = None
    client_cpu: float | None = None
    others_cpu: float | None = None  # of all other processes, the bench's own too
    rtf: float | None = None
    rtf_fast: float | None = None  # at rate 0
    sim_per_cpu: float | None = None  # at rate 0, simulated seconds a second of processor time
    delivered: float | None = None  # readings made, of those expected
    delivered_fast: float | None = None
    received: float | None = None  # messages received on subscribed topics, of those expected
    rss_mb: float | None = None
    start_s: float | None = None  # from the start of the process to the first tick
    deploy_s: float | None = None  # for all sensors together
    deploy_server_cpu: float | None = None
    deploy_client_cpu: float | None = None
    first_reading_ms: float | None = None  # after the spawn of its sensor


@dataclass
class Row(Session):
    """The medians of a count's repeats. `count` is of sensors, or with `desired` of floors."""
    mode: str = ''
    kind: str = ''
    count: int = 0
    sensors: int = 0
    floors: int = 0
    repeats: int = 0
    extremes: dict[str, tuple[float, float]] = field(default_factory=dict)  # of each figure

    @property
    def real_time(self) -> bool:
        """Whether time keeps up with the clock on the wall, and readings with time, if any."""
        delivered = 1.0 if self.delivered is None else self.delivered
        return min(self.rtf or 0.0, delivered) >= REAL_TIME


@dataclass(frozen=True)
class Line:
    """CPU % = base + slope * count; `error` is the standard error of the slope, NaN with two
    points."""
    base: float
    slope: float
    error: float = math.nan


def combine(sessions: Sequence[Any], made: type[Any] = Row, **what: Any) -> Any:
    """The row of one count: each figure's median over the sessions that have it.

    `made` is the dataclass of the row, which adds to that of the sessions.
    """
    row = made(repeats=len(sessions), **what)
    for figure in fields(sessions[0]):
        values = measured(sessions, figure.name)
        setattr(row, figure.name, median(values) if values else None)
    return row


def measured(sessions: Sequence[Any], figure: str) -> list[float]:
    return [value for session in sessions if (value := getattr(session, figure)) is not None]


def extremes(sessions: Sequence[Session]) -> dict[str, tuple[float, float]]:
    """The least and the largest value of each figure over the repeats."""
    return {figure.name: (min(values), max(values)) for figure in fields(Session)
            if (values := measured(sessions, figure.name))}


def fit(counts: Sequence[float], values: Sequence[float | None]) -> Line | None:
    """The least-squares line through the points that have a value; None below two counts."""
    from scipy.stats import linregress
    points = [(c, v) for c, v in zip(counts, values) if v is not None]
    if len({c for c, _ in points}) < 2:
        return None
    line = linregress(*zip(*points))
    return Line(line.intercept, line.slope, line.stderr if len(points) > 2 else math.nan)


def fit_of(rows: Sequence[Row], panel: str) -> Line | None:
    """The line of a figure over the counts that ran in real time."""
    kept = [row for row in rows if row.real_time]
    return fit([row.count for row in kept], [getattr(row, panel) for row in kept])


COLUMNS = ('mode', 'kind', 'count', 'sensors', 'floors', 'repeats',
           *(figure.name for figure in fields(Session)), 'real_time')


def write_csv(path: Path, rows: Sequence[Row]) -> None:
    """Writes the rows, empty where nothing was measured."""
    cells = [as_cells(row) | {'real_time': 'yes' if row.real_time else 'no'} for row in rows]
    files.write_csv(path, COLUMNS, ([cell(row[key]) for key in COLUMNS] for row in cells))


def as_cells(row: Row) -> dict[str, Any]:
    """The row by column."""
    return asdict(row) | {'real_time': row.real_time}


def cell(value: object) -> object:
    """A value as a CSV has it: short, blank where there is none."""
    if isinstance(value, float):
        return f'{value:.4g}' if math.isfinite(value) else ''
    return '' if value is None else value


def describe(row: Row) -> str:
    """A row as a line to read."""
    parts = [f'{row.count:4d}', f'server {_number(row.server_cpu)} %',
             f'client {_number(row.client_cpu)} %', f'RTF {_number(row.rtf, 2)}',
             f'at rate 0 {_number(row.rtf_fast)}', f'delivered {_percent(row.delivered)}',
             f'{_number(row.rss_mb, 0)} MB', f'others used {_number(row.others_cpu, 0)} %']
    if row.first_reading_ms is not None:
        parts.append(f'first reading {_number(row.first_reading_ms)} ms')
    if row.mode == 'desired':
        parts.append(f'{row.sensors} sensors: '
                     + ('runs in real time' if row.real_time else 'does not run in real time'))
    return '  '.join(parts)


def _number(value: float | None, digits: int = 1) -> str:
    return '-' if value is None else f'{value:.{digits}f}'


def _percent(value: float | None) -> str:
    return '-' if value is None else f'{100 * value:.0f} %'


def describe_fit(rows: Sequence[Row]) -> list[str]:
    """The cost of one more sensor, or floor, for the server and the client; of the rows in real
    time, as a processor that is full shows no cost."""
    thing = 'floor' if rows and rows[0].mode == 'desired' else 'sensor'
    slow = [row.count for row in rows if not row.real_time]
    lines = [f'not fitted, as not in real time: {", ".join(map(str, slow))}'] if slow else []
    for who in ('server', 'client'):
        line = fit_of(rows, f'{who}_cpu')
        if line:
            error = '' if math.isnan(line.error) else f' ± {line.error:.2g}'
            lines.append(f'{who}: one more {thing} costs {line.slope:.3g}{error} % of a core '
                         f'({line.base:.1f} % without)')
    return lines


PANELS = {'server_cpu': 'server (the node)', 'client_cpu': 'client (rviz)',
          'deploy_server_cpu': 'server, while they are spawned',
          'deploy_client_cpu': 'client, while they are spawned'}


def draw(path: Path, rows: Sequence[Row]) -> None:
    """Writes the figure: CPU of server and client over count, with their lines."""
    from matplotlib.ticker import MaxNLocator
    desired = rows[0].mode == 'desired'
    panels = [panel for panel in PANELS if any(getattr(r, panel) is not None for r in rows)]
    figure, axes = files.pyplot().subplots(
        len(panels), 1, sharex=True, squeeze=False, figsize=(6.4, 1 + 2.2 * len(panels)),
        layout='constrained')
    for axis, panel in zip(axes[:, 0], panels):
        _panel(axis, panel, rows, 'floor' if desired else 'sensor')
    axes[-1, 0].xaxis.set_major_locator(MaxNLocator(integer=True))
    axes[-1, 0].set_xlabel('floors' if desired else f'{rows[0].kind} sensors')
    figure.suptitle({'added': 'Sensors in the world when it starts',
                     'deployed': 'Sensors spawned while it runs',
                     'desired': 'Floors with all the sensors that they should have'}[rows[0].mode])
    files.save_figure(figure, path, dpi=100)


def draw_together(path: Path, tables: Sequence[Sequence[Row]]) -> None:
    """Writes one figure of several tables: CPU of the server, a row a kind and a column a mode."""
    kinds = list(dict.fromkeys(rows[0].kind for rows in tables))
    modes = list(dict.fromkeys(rows[0].mode for rows in tables))
    figure, axes = files.pyplot().subplots(
        len(kinds), len(modes), squeeze=False, layout='constrained',
        figsize=(4.6 * len(modes), 2.2 * len(kinds)))
    for rows in tables:
        axis = axes[kinds.index(rows[0].kind), modes.index(rows[0].mode)]
        for panel in ('server_cpu', 'deploy_server_cpu'):
            if any(getattr(r, panel) is not None for r in rows):
                _panel(axis, panel, rows, 'sensor')
        axis.set_title(f'{rows[0].kind} sensors, {rows[0].mode}', fontsize='medium')
    files.save_figure(figure, path, dpi=100)


def _panel(axis: Any, panel: str, rows: Sequence[Row], thing: str) -> None:
    """One axis: the medians as points with bars to the least and the largest, hollow where not in
    real time, and, of a load that lasts, their line and its slope."""
    points = [(r.count, v) for r in rows if (v := getattr(r, panel)) is not None]
    counts, values = zip(*points)
    for real_time, fill in ((True, 'full'), (False, 'none')):
        some = [(r.count, v, *r.extremes.get(panel, (v, v))) for r in rows
                if r.real_time is real_time and (v := getattr(r, panel)) is not None]
        if some:
            at, middle, low, high = zip(*some)
            bars = [[m - e for m, e in zip(middle, low)], [e - m for m, e in zip(middle, high)]]
            axis.errorbar(at, middle, bars, fmt='o', color=f'C{list(PANELS).index(panel)}',
                          fillstyle=fill, capsize=3,
                          label=PANELS[panel] + ('' if real_time else ', not in real time'))
    line = None if panel.startswith('deploy') else fit_of(rows, panel)
    if line:
        ends = [min(counts), max(counts)]
        axis.plot(ends, [line.base + line.slope * c for c in ends],
                  label=f'fitted line: {line.slope:.2g} % per {thing}')
    axis.set_ylim(0, max(1.2 * max(values) or 1, axis.get_ylim()[1]))
    axis.set_ylabel('CPU, % of a core')
    axis.grid(alpha=0.3)
    axis.legend(loc='best', fontsize='small')
