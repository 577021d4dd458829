"""Files and texts of a patrol: events.csv, rooms.csv, and the printed summary."""
import csv
import math
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

from angen_tools.common.files import write_csv
from angen_tools.common.output import Table, table
from angen_tools.world import sdf

from angen_apps.patrol.scene import Scene
from angen_apps.patrol.sight import Sight
from angen_apps.robot import interface
from angen_apps.robot.entities import Entity
from angen_apps.robot.driver import Track
from angen_apps.robot.interface import BUMPER, CYCLE, Event
from angen_apps.robot.tables import write_events, write_track
from angen_apps.robot.views import sensor_element, view_of

TIMES = ('SIGHT s', 'DETECTED s', 'DELAY s')
BEGINS = {'pir': ('motion',), 'switch': ('opened', 'closed'), 'luminosity': ('changed',)}
LEVEL = 5.0  # mm
STATE_PERIOD = 0.02  # s between two angles that a moving door publishes
STILL = 0.002  # m, rad: less in a cycle is not motion


@dataclass(frozen=True)
class Row:
    """A sensor's first sight of the robot and its first detection, s; None: there was none."""

    room: str
    sensor: str
    kind: str
    sight: float | None
    detection: float | None
    other: bool = False  # it detected something else: a door

    @property
    def delay(self) -> float | None:
        if self.sight is None or self.detection is None:
            return None
        return max(0.0, self.detection - self.sight)


@dataclass(frozen=True)
class Run:
    """All that a patrol's report is made of."""

    robot: str
    scene: Scene
    track: Track
    reached: list[tuple[float, str]]  # s, waypoint
    events: list[Event]
    sensors: list[Entity]
    angles: dict[str, list[tuple[float, float]]]  # angles of doors: s, rad from shut

    def of(self, source: str, kind: str) -> list[tuple[float, str, str]]:
        """Time (s), name and detail of a source's events."""
        return [(e.time, e.event, e.detail) for e in self.events
                if (e.source, e.kind) == (source, kind)]

    def collisions(self) -> list[tuple[float, str]]:
        """When the robot touched something that it must not touch, and its name."""
        return interface.collisions(self.events)


def begun(events: list[tuple[float, str, str]], kind: str) -> list[tuple[float, float]]:
    """The periods in which a sensor detected something, s."""
    found: list[tuple[float, float]] = []
    for t, event, _ in events:
        if event in BEGINS[kind]:
            found.append((t, math.inf if kind == 'pir' else t))
        elif found:
            found[-1] = (found[-1][0], t)
    return found


def make_rows(run: Run, world: Path) -> list[Row]:
    """A row for each sensor that could have noticed the robot or did, by floor and room."""
    sight = Sight(run.scene.world, run.scene.body,
                  [door for doors in run.scene.doors.values() for door in doors],
                  {name: np.array(angles) for name, angles in run.angles.items()})
    track = np.array(run.track.rows)
    described, moved = sdf.read(world), moving(track)
    rows = []
    for entity in run.sensors:
        if entity.kind == 'contact':
            rows += contact_row(run, entity)
            continue
        detected = begun(run.of(entity.name, entity.kind), entity.kind)
        if entity.kind == 'switch':
            seen = beam_change(run, entity)
            first = next((t for t, _ in detected
                          if seen is not None and t >= seen - STATE_PERIOD), None)
        else:
            here = track[run.scene.home.storeys_at(track[:, 3]) == entity.floor]
            seen = sight.first(view_of(entity, sensor_element(described, entity)), here)
            first = first_detection(seen, detected, moved)
        rows.append(Row(run.scene.rooms[entity.name], entity.name, entity.kind, seen, first,
                        first is None and bool(detected)))
    return sorted(rows, key=lambda row: (row.room[-1:], row.room, row.kind, row.sensor))


def moving(track: np.ndarray) -> np.ndarray:
    """The times in a track (rows t, x, y, z, yaw) before which the robot has moved."""
    steps = np.diff(track, axis=0)
    return track[1:, 0][(np.linalg.norm(steps[:, 1:3], axis=1) > STILL)
                        | (np.abs(np.sin(steps[:, 4])) > STILL)]


def first_detection(seen: float | None, detected: list[tuple[float, float]], moved: np.ndarray
                    ) -> float | None:
    """When a sensor that detected something from … to … (s) first did so because of the robot.

    The robot waits while doors turn: a detection during that time is of a door.
    """
    if seen is None:
        return None
    for start, end in detected:
        because = moved[(moved >= max(start, seen) - 1e-6) & (moved <= max(start, end) + CYCLE)]
        if len(because):
            return max(start, seen, float(because[0]) - CYCLE)
    return None


def contact_row(run: Run, entity: Entity) -> list[Row]:
    """A contact sensor's row, if the robot touched it: there is no line of sight to a touch."""
    touched = [t for t, event, detail in run.of(entity.name, 'contact')
               if event == 'pressed' and f'{run.robot}::' in detail]
    if not touched or entity.name == BUMPER:
        return []
    return [Row(run.scene.rooms[entity.name], entity.name, 'contact', None, touched[0])]


def beam_change(run: Run, entity: Entity) -> float | None:
    """When the door of a switch first passed the angle at which its beam comes free, s."""
    angles = run.angles.get(run.scene.rooms[entity.name])
    limit = run.scene.beams.get(entity.name)
    if not angles or limit is None:
        return None
    return crossing([(t, abs(angle)) for t, angle in angles], limit)


def crossing(history: list[tuple[float, float]], limit: float) -> float | None:
    """When values at times first pass a limit, either way; straight between two of them."""
    for (t, a), (then, b) in zip(history, history[1:]):
        if (a < limit) != (b < limit):
            return t + (then - t) * (limit - a) / (b - a)
    return None


def write_tables(run: Run, rows: list[Row], out: Path) -> None:
    """Writes events.csv, rooms.csv and track.csv into a folder; times in s, blank where there is
    none."""
    write_track(run.track, out)
    write_events(run.events, out)
    write_csv(out / 'rooms.csv',
              ('room', 'sensor', 'kind', 'first_sight_s', 'first_detection_s', 'delay_s'),
              ((row.room, row.sensor, row.kind, *times(row, '')) for row in rows))


def times(row: Row, none: str) -> list[str]:
    """Sight, detection and delay as text."""
    return [none if value is None else f'{value:.2f}'
            for value in (row.sight, row.detection, row.delay)]


@dataclass(frozen=True)
class Figures:
    """A run in numbers: m, s, mm; `aside` is the largest error of the estimated position
    once it had had a second to find out."""

    seed: int
    waypoints: int
    distance_m: float
    time_s: float
    wall_s: float
    collisions: int
    elevator_mm: float
    aside_m: float
    wheels_m: float
    wheels_end_m: float


def measure(run: Run, seed: int, wall: float) -> Figures:
    """The figures of a run that took `wall` s of wall time."""
    track = np.array(run.track.rows)
    aside, wheels = (np.linalg.norm(np.array(places) - track[:, 1:3], axis=1)
                     for places in (run.track.believed, run.track.odometry))
    return Figures(
        seed, len(run.reached), run.track.distance, float(track[-1, 0]), wall,
        len(run.collisions()),
        max((1000 * abs(error) for _, error in run.track.levels), default=0.0),
        float(aside[track[:, 0] > 1.0].max()), float(wheels.max()), float(wheels[-1]))


def read_figures(path: Path) -> list[Figures]:
    """The figures of a file that write_figures has written."""
    with path.open() as file:
        return [Figures(**{field.name: (int if field.type == 'int' else float)(row[field.name])
                           for field in fields(Figures)}) for row in csv.DictReader(file)]


def table_of(rows: list[Row]) -> Table:
    """The sensors that could notice the robot, of those kinds that did."""
    kinds = {row.kind for row in rows if row.detection is not None}
    return table(('ROOM', 'SENSOR', *TIMES),
                 [(row.room, row.sensor, sight,
                   detection or ('only a door' if row.other else 'never'), delay)
                  for row in rows if row.kind in kinds
                  for sight, detection, delay in [times(row, '')]], right=TIMES)


def summary(run: Run, found: Figures, whole: float, out: Path) -> str:
    """The summary of a run; `whole`: s of wall time of all."""
    stops = ', '.join(f'floor {floor} {1000 * error:+.2f} mm' for floor, error in
                      run.track.levels)
    lines = [
        f'{found.waypoints} waypoints, {found.distance_m:.1f} m in {found.time_s:.1f} s, '
        f'{found.wall_s:.0f} s of wall time ({whole:.0f} s with all preparation)',
        f'elevator stops beside their level: {stops or "none"}',
        f'collisions: {found.collisions}' + ''.join(f'\n  {t:.2f} s {what}'
                                                    for t, what in run.collisions()),
        f'error of the estimated position: at most {100 * found.aside_m:.1f} cm; wheels alone: '
        f'{100 * found.wheels_m:.0f} cm, at the end {100 * found.wheels_end_m:.0f} cm',
        f'wrote {out}/rooms.csv, events.csv, track.csv, summary.csv, {", ".join(plans(run))}, '
        'patrol.bag']
    return '\n'.join(lines)


def plans(run: Run) -> list[str]:
    """Names of the figures of floors."""
    return [f'floor_{floor}.png' for floor in sorted(run.scene.maps)]


def verdict(found: Figures) -> int:
    """0, or 1 where the robot touched something or the elevator stopped beside a level."""
    return 0 if found.elevator_mm <= LEVEL and not found.collisions else 1
