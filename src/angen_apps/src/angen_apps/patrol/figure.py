"""A patrol's figure of a floor: rooms, track, and where each sensor noticed the robot."""
from pathlib import Path
from typing import Any

import numpy as np

from angen_apps.patrol.report import Row, Run, begun, moving
from angen_apps.plan.draw import Scene, draw_storey, extent
from angen_apps.robot.entities import Entity
from angen_tools.common.files import pyplot, save_figure

TRACK, SWITCH, NEUTRAL = '#1f6fb4', '#2a8c3c', '#505050'
# for the PIRs of a floor, neighbors far apart
PIRS = ('#e6194b', '#f58231', '#911eb4', '#808000', '#f032e6', '#9a6324', '#008080', '#c71585',
        '#b8860b', '#6a5acd', '#a52a2a', '#d2691e', '#8b008b', '#556b2f')
WIDE = 10.0  # inches of paper
INWARD = 0.42  # m from a sensor to its label


def draw(run: Run, rows: list[Row], plan: Scene, floor: int, path: Path) -> None:
    """Writes the figure of one floor."""
    storey = next(each for each in plan.drawn() if each.number == floor)
    west, east, south, north = extent(plan, storey)
    inch = WIDE / (east - west)
    figure, axes = pyplot().subplots(figsize=(WIDE, (north - south) * inch + 0.9), dpi=150)
    draw_storey(axes, plan, storey, inch)
    track = np.array(run.track.rows)
    here = run.scene.home.storeys_at(track[:, 3]) == floor
    line = np.where(here[:, None], track[:, 1:3], np.nan)
    axes.plot(line[:, 0], line[:, 1], color=TRACK, linewidth=1.2, zorder=8)
    entities = {entity.name: entity for entity in run.sensors}
    shown = [row for row in rows if row.kind in ('pir', 'switch')
             and entities[row.sensor].floor == floor]
    pirs = [row.sensor for row in shown if row.kind == 'pir']
    colors = {name: PIRS[i % len(PIRS)] for i, name in enumerate(pirs)}
    for i, name in enumerate(pirs):
        seen = np.where(noticed(run, name, track)[:, None], line, np.nan)
        axes.plot(seen[:, 0], seen[:, 1], 'o', color=colors[name], markersize=(10, 6)[i % 2],
                  alpha=0.3, zorder=7 + i % 2 / 2, markeredgewidth=0)
    for row in shown:
        mark(axes, row, entities[row.sensor], track, colors.get(row.sensor, SWITCH))
    axes.set_title(f'Floor {floor}: first detection of the robot, and its delay after the first '
                   'line of sight', fontsize=10)
    figure.legend(handles=legend(), loc='lower center', ncols=4, fontsize=8, frameon=False,
                  columnspacing=1.5, handletextpad=0.5)
    figure.tight_layout(rect=(0, 0.06, 1, 1))
    save_figure(figure, path)


def legend() -> list[Any]:
    """A handle for each thing in the figure."""
    from matplotlib.lines import Line2D

    def dot(marker: str, color: str, size: float, label: str, **more: Any) -> Any:
        return Line2D([], [], marker=marker, color=color, markersize=size, label=label, ls='none',
                      **more)

    edge = {'markeredgecolor': 'black', 'markeredgewidth': 0.6}
    rim = {'markeredgecolor': 'white', 'markeredgewidth': 0.5}
    return [Line2D([], [], color=TRACK, linewidth=1.2, label="the robot's track"),
            dot('o', NEUTRAL, 8, 'a PIR detects it (in its color)', alpha=0.3, markeredgewidth=0),
            dot('^', NEUTRAL, 7, 'PIR, each in a color of its own', **edge),
            dot('o', NEUTRAL, 5, 'first detection by a PIR', **rim),
            dot('s', SWITCH, 7, 'optical switch', **edge),
            dot('o', SWITCH, 5, 'first detection by a switch', **rim),
            Line2D([], [], color=NEUTRAL, linewidth=0.8, ls=':',
                   label='from a sensor to its first detection'),
            dot('$0.2\\,s$', NEUTRAL, 16, 'delay of the first detection')]


def noticed(run: Run, sensor: str, track: np.ndarray) -> np.ndarray:
    """The rows of a track (t, x, y, z, yaw) in which the robot moves and a PIR detects motion."""
    times = track[:, 0]
    found = np.zeros(len(track), bool)
    for start, end in begun(run.of(sensor, 'pir'), 'pir'):
        found |= (times >= start) & (times < end)
    return found & np.isin(times, moving(track))


def mark(axes: Any, row: Row, entity: Entity, track: np.ndarray, color: str) -> None:
    """A sensor, its label, and where the robot was when it first detected it."""
    place = entity.place[:2]
    axes.plot(*place, '^' if row.kind == 'pir' else 's', color=color, markersize=7, zorder=10,
              markeredgecolor='black', markeredgewidth=0.6, linestyle='none')
    if row.kind == 'pir':
        ahead = entity.rotation[:2, 0]
        ahead = ahead / np.linalg.norm(ahead)
    else:
        ahead = np.array([0.0, 0.5])
    text = (f'{row.delay:.1f} s' if row.delay is not None
            else 'only a door' if row.other else 'never')
    if row.detection is not None:
        at = track[min(int(np.searchsorted(track[:, 0], row.detection)), len(track) - 1), 1:3]
        axes.plot(*at, 'o', color=color, markersize=4.5, markeredgecolor='white', zorder=11,
                  markeredgewidth=0.5, linestyle='none')
        axes.plot([place[0], at[0]], [place[1], at[1]], ':', color=color, linewidth=0.8, zorder=8)
    axes.annotate(text, place + INWARD * ahead, fontsize=7.5, color=color, ha='center',
                  va='center', zorder=12,
                  bbox={'facecolor': 'white', 'alpha': 0.8, 'pad': 1, 'edgecolor': 'none'})
