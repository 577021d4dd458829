"""A patrol's figure of a floor: rooms, track, and where each sensor noticed the robot."""
from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from angen_tools.common.geometry import rotation
from angen_tools.maps.gridmap import FREE, OCCUPIED, STOREY
from angen_tools.patrol.drive import floor_of
from angen_tools.patrol.report import Row, Run, begun, moving
from angen_tools.robot.route_file import Route

TRACK, PIR, SWITCH, TEXT = '#1f6fb4', '#c8102e', '#2a8c3c', '#303030'
GREYS = {FREE: 1.0, OCCUPIED: 0.35}
UNKNOWN_GREY = 0.88
INWARD = 0.42  # m from a sensor to its label


def draw(run: Run, rows: list[Row], route: Route, floor: int, path: Path) -> None:
    """Writes the figure of one floor."""
    import matplotlib
    matplotlib.use('Agg')
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(10, 6.9), dpi=150)
    plan(axes, run, floor)
    track = np.array(run.track.rows)
    here = np.floor((track[:, 3] + 0.5) / STOREY) == floor
    line = np.where(here[:, None], track[:, 1:3], np.nan)
    axes.plot(line[:, 0], line[:, 1], color=TRACK, linewidth=1.2, label="the robot's track",
              zorder=3)
    seen = np.where(noticed(run, track)[:, None], line, np.nan)
    axes.plot(seen[:, 0], seen[:, 1], 'o', color=PIR, markersize=8, alpha=0.25, zorder=2,
              markeredgewidth=0, label='a PIR detects it')
    entities = {entity.name: entity for entity in run.sensors}
    labelled: set[str] = set()
    for row in rows:
        entity = entities[row.sensor]
        if row.kind in ('pir', 'switch') and floor_of(entity.pose.position.z) == floor:
            mark(axes, row, entity, track, labelled)
    name_rooms(axes, route, floor)
    axes.set_xlabel('x (m)')
    axes.set_ylabel('y (m)')
    axes.set_title(f'Floor {floor}: first detection of the robot, and its delay after the first '
                   'line of sight', fontsize=10)
    figure.legend(loc='lower center', ncols=6, fontsize=8, frameon=False, columnspacing=1.2,
                  handletextpad=0.5)
    figure.tight_layout(rect=(0, 0.04, 1, 1))
    figure.savefig(path)
    pyplot.close(figure)


def noticed(run: Run, track: np.ndarray) -> np.ndarray:
    """The rows of a track (t, x, y, z, yaw) in which the robot moves and a PIR detects motion."""
    times = track[:, 0]
    found = np.zeros(len(track), bool)
    for sensor in run.sensors:
        if sensor.kind == 'pir':
            for start, end in begun(run.of(sensor.name, 'pir'), 'pir'):
                found |= (times >= start) & (times < end)
    return found & np.isin(times, moving(track))


def name_rooms(axes: Any, route: Route, floor: int) -> None:
    """The waypoints' names; of two that lie beside each other the first one's."""
    named: list[tuple[float, float]] = []
    for point in route.waypoints:
        if point.floor != floor or any(np.hypot(*np.subtract(point.at, at)) < 1.0 for at in named):
            continue
        named.append(point.at)
        axes.annotate(point.name, point.at, fontsize=9, color=TEXT, ha='center', va='top',
                      xytext=(0, -7), textcoords='offset points', style='italic',
                      bbox={'facecolor': 'white', 'alpha': 0.75, 'pad': 1, 'edgecolor': 'none'})


def plan(axes: Any, run: Run, floor: int) -> None:
    """The rooms, as the map of the floor has them with doors open."""
    grid = run.scene.maps[floor]
    shade = np.full(grid.cells.shape, UNKNOWN_GREY)
    for value, grey in GREYS.items():
        shade[grid.cells == value] = grey
    rows, columns = np.nonzero(grid.cells != -1)
    west, south = grid.origin
    height, width = grid.cells.shape
    axes.imshow(shade, origin='lower', cmap='gray', vmin=0, vmax=1, zorder=0, extent=(
        west, west + width * grid.resolution, south, south + height * grid.resolution))
    margin = 4
    axes.set_xlim(west + (columns.min() - margin) * grid.resolution,
                  west + (columns.max() + margin) * grid.resolution)
    axes.set_ylim(south + (rows.min() - margin) * grid.resolution,
                  south + (rows.max() + margin) * grid.resolution)


def mark(axes: Any, row: Row, entity: Any, track: np.ndarray, labelled: set[str]) -> None:
    """A sensor, its label, and for a PIR where the robot was when it first detected it."""
    colour, shape, name = {'pir': (PIR, '^', 'PIR'), 'switch': (SWITCH, 's', 'optical switch')}[
        row.kind]
    article = 'an' if name[0] == 'o' else 'a'
    place = np.array([entity.pose.position.x, entity.pose.position.y])

    def once(label: str) -> str | None:
        if label in labelled:
            return None
        labelled.add(label)
        return label

    axes.plot(*place, shape, color=colour, markersize=7, markeredgecolor='black', zorder=4,
              markeredgewidth=0.6, linestyle='none', label=once(name))
    if row.kind == 'pir':
        ahead = rotation(entity.pose.orientation)[:2, 0]
        ahead = ahead / np.linalg.norm(ahead)
    else:
        ahead = np.array([0.0, 0.5])
    text = f'{row.delay:.1f} s' if row.delay is not None else 'none'
    if row.detection is not None:
        at = track[min(int(np.searchsorted(track[:, 0], row.detection)), len(track) - 1), 1:3]
        axes.plot(*at, 'o', color=colour, markersize=4.5, markeredgecolor='white', zorder=5,
                  markeredgewidth=0.5, linestyle='none',
                  label=once(f'first detection by {article} {name}'))
        axes.plot([place[0], at[0]], [place[1], at[1]], ':', color=colour, linewidth=0.8, zorder=3)
    axes.annotate(text, place + INWARD * ahead, fontsize=7.5, color=colour, ha='center',
                  va='center', zorder=6,
                  bbox={'facecolor': 'white', 'alpha': 0.8, 'pad': 1, 'edgecolor': 'none'})
