"""A search's figures: where he may be, moment by moment; and how long it takes, seed by seed."""
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

from angen_apps.maps.cells import cell_of
from angen_apps.plan.draw import Scene, draw_storey, extent
from angen_apps.seek.home import CELL, Home
from angen_apps.seek.report import pairs
from angen_apps.seek.run import Figures, Outcome
from angen_tools.common.files import pyplot, save_figure

WITH, WITHOUT, ROBOT, PERSON, PIR, INK = ('#0b7a75', '#c8553d', '#1f4e8c', '#d1495b', '#ef8a17',
                                          '#303030')
MOMENTS = 4
RECENT = 5.0  # s


def draw_search(home: Home, outcome: Outcome, plan: Scene, path: Path) -> None:
    """Draws, floor by floor at MOMENTS, the belief, the robot's way until then, and the person."""
    storeys = {storey.number: storey for storey in plan.drawn()}
    floors = sorted(home.maps.keys() & storeys.keys())
    end = outcome.figures.time_s
    moments = outcome.began + np.linspace(0.0, end, MOMENTS)
    west, east, south, north = extent(plan, storeys[floors[0]])
    wide, high = east - west, north - south
    figure, axes = pyplot().subplots(len(floors), MOMENTS, squeeze=False, dpi=130, figsize=(
        3.3 * MOMENTS, 3.15 * high / wide * len(floors) + 0.75), constrained_layout=True)
    for column, moment in enumerate(moments):
        times = [t for t, _ in outcome.beliefs]
        belief = outcome.beliefs[max(0, int(np.searchsorted(times, moment, side='right')) - 1)][1]
        for row, floor in enumerate(floors[::-1]):
            ax = axes[row][column]
            shade = _shade(ax, home, floor, belief)
            draw_storey(ax, plan, storeys[floor], None)
            _detections(ax, home, outcome, floor, moment)
            _walks(ax, home, outcome, floor, moment)
            share = belief[home.floor == floor].sum()
            ax.text(0.02, 0.02, f'{100 * share:.0f} % on floor {floor}', transform=ax.transAxes,
                    fontsize=7, color=INK)
        axes[0][column].set_title(f'{moment - outcome.began:.0f} s', fontsize=10)
    bar = figure.colorbar(shade, ax=axes, shrink=0.7, pad=0.01, aspect=30)
    bar.set_label('probability of a cell, %', fontsize=8)
    bar.ax.tick_params(labelsize=7)
    figure.legend(handles=_legend(), loc='lower center', ncols=6, fontsize=8, frameon=False)
    figure.get_layout_engine().set(rect=(0, 0.06, 1, 0.94))
    save_figure(figure, path)


def _legend() -> list[Any]:
    from matplotlib.lines import Line2D
    return [Line2D([], [], color=PIR, marker='^', ls='none', label=f'PIR that has detected motion '
                   f'in the last {RECENT:.0f} s'),
            Line2D([], [], color='#9a9a9a', marker='^', ls='none', ms=4, label='other PIR'),
            Line2D([], [], color=ROBOT, lw=1.3, label="the robot's way"),
            Line2D([], [], color=ROBOT, marker='o', ls='none', label='the robot'),
            Line2D([], [], color=PERSON, lw=1.0, ls=':', label="the person's last 30 s"),
            Line2D([], [], color=PERSON, marker='*', ls='none', ms=9, label='the person')]


def _from_white() -> Any:
    from matplotlib.colors import LinearSegmentedColormap
    return LinearSegmentedColormap.from_list('belief', ('#ffffff', '#d3eeea', '#72c5bd', '#1d8a8a',
                                                        '#0b4f63', '#06283d'))


def _shade(ax: Any, home: Home, floor: int, belief: np.ndarray) -> Any:
    """The belief in the cells of a floor."""
    from matplotlib.colors import PowerNorm
    from scipy.spatial import cKDTree
    grid = home.maps[floor]
    squares = np.full(grid.cells.shape, np.nan)
    fine = np.argwhere(home.walkable[floor].cells == 0)
    here = np.nonzero(home.floor == floor)[0]
    other = home.walkable[floor]
    places = np.column_stack([other.x[fine[:, 1]], other.y[fine[:, 0]]])
    away, nearest = cKDTree(home.at[here]).query(places)
    for (x, y), cell in zip(places[away < 1.5 * CELL], here[nearest[away < 1.5 * CELL]]):
        square = cell_of(grid, (x, y))
        if square is not None:
            squares[square] = 100 * belief[cell]
    return ax.imshow(squares, origin='lower', extent=grid.extent, cmap=_from_white(),
                     norm=PowerNorm(0.4, 0.0, 10.0), zorder=1.5)


def _walks(ax: Any, home: Home, outcome: Outcome, floor: int, moment: float) -> None:
    """Robot and person until a moment."""
    robot = np.array(outcome.track.rows)
    robot = robot[:max(1, int((robot[:, 0] <= moment + 0.05).sum()))]
    _line(ax, home, robot[:, :4], floor, ROBOT, '-', 1.3, 'o', 6)
    if outcome.person:
        person = np.array(outcome.person)
        person = person[(person[:, 0] <= moment + 0.05) & (person[:, 0] >= moment - 30.0)]
        _line(ax, home, person, floor, PERSON, ':', 1.0, '*', 10)


def _detections(ax: Any, home: Home, outcome: Outcome, floor: int, moment: float) -> None:
    """The PIRs of a floor; in color those that have detected motion in the last RECENT s."""
    began = {}
    for event in outcome.events:
        if event.kind == 'pir' and event.event == 'motion' and event.time <= moment:
            began[event.source] = event.time
    for entity in home.entities:
        if entity.kind == 'pir' and entity.floor == floor:
            recent = moment - began.get(entity.name, -1e9) < RECENT
            ax.plot(*entity.place[:2], '^', ms=6 if recent else 4, mec='white', mew=0.4, zorder=8,
                    color=PIR if recent else '#9a9a9a')


def _line(ax: Any, home: Home, rows: np.ndarray, floor: int, color: str, style: str, width: float,
          mark: str, size: float) -> None:
    if not len(rows):
        return
    here = home.described.storeys_at(rows[:, 3]) == floor
    places = np.where(here[:, None], rows[:, 1:3], np.nan)
    ax.plot(places[:, 0], places[:, 1], style, color=color, lw=width, zorder=8)
    if here[-1]:
        ax.plot(*places[-1], mark, color=color, ms=size, mec='white', mew=0.7, zorder=9)


def draw_times(found: list[Figures], limit: float, path: Path) -> None:
    """Draws the share of searches that have found him by a time, and both times of each seed."""
    figure, (left, right) = pyplot().subplots(1, 2, figsize=(11, 5.2), dpi=130,
                                              constrained_layout=True, width_ratios=(1.15, 1))
    for ambient, color, name in ((True, WITH, 'with ambient sensors'),
                                 (False, WITHOUT, "with the robot's own sensors only")):
        _shares(left, [f for f in found if f.ambient is ambient], limit,
                1.02 * max(figures.time_s for figures in found), color, name)
    both = sorted(pairs(found), key=lambda pair: pair[0].time_s)
    for i, (one, other) in enumerate(both):
        right.plot([one.time_s, other.time_s], [i, i], color='#c0c0c0', lw=2, zorder=1)
        for figures, color in ((one, WITH), (other, WITHOUT)):
            right.plot(figures.time_s, i, 'o' if figures.found else 'X', color=color, ms=7,
                       mec='white', mew=0.7, zorder=2)
    right.set_yticks(range(len(both)), [str(one.seed) for one, _ in both], fontsize=7)
    right.set_ylabel('seed')
    right.set_title('Each search, sorted by the time with ambient sensors', fontsize=10)
    left.set_title('How many have found the person', fontsize=10)
    for ax in (left, right):
        ax.set_xlim(0, 1.02 * max([60.0] + [f.time_s for f in found]))
        ax.set_xlabel('time, s')
        ax.grid(axis='x', color='#e4e4e4', lw=0.7)
        ax.set_axisbelow(True)
        ax.spines[['top', 'right']].set_visible(False)
    figure.suptitle('What a smart apartment contributes to a robot that searches for a person',
                    fontsize=12)
    save_figure(figure, path)


def _shares(ax: Any, found: list[Figures], limit: float, end: float, color: str, name: str
            ) -> None:
    """A step for each search that found a person, up to `end` (s), and the median."""
    times = sorted(figures.time_s for figures in found if figures.found)
    ends = [0.0, *times, end]
    shares = [0.0, *(100 * (i + 1) / len(found) for i in range(len(times)))]
    ax.step(ends, [*shares, shares[-1]], where='post', color=color, lw=2.2, label=name)
    ax.fill_between(ends, [*shares, shares[-1]], step='post', color=color, alpha=0.08)
    middle = median(figures.time_s if figures.found else limit for figures in found)
    ax.plot([middle], [50], 'o', color=color, ms=8, mec='white', mew=1, zorder=4)
    ax.annotate(f'{middle:.0f} s', (middle, 50), color=color, xytext=(7, -12), fontsize=10,
                textcoords='offset points', weight='bold')
    ax.set_ylim(0, 103)
    ax.set_ylabel('found, %')
    ax.legend(loc='lower right', frameon=False, fontsize=9)
