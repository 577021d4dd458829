"""Files of every task of a robot: events.csv, track.csv and a table of figures."""
from dataclasses import astuple, fields
from pathlib import Path
from typing import Any, Sequence

from angen_apps.robot.driver import Track
from angen_tools.session import Event
from angen_tools.common.files import write_csv


def write_events(events: list[Event], out: Path) -> None:
    """Writes events.csv into a folder; times in s."""
    write_csv(out / 'events.csv', ('time_s', 'source', 'kind', 'event', 'detail'),
              ((f'{e.time:.3f}', e.source, e.kind, e.event, e.detail) for e in events))


def write_track(track: Track, out: Path) -> None:
    """Writes track.csv: the true pose, the estimate, and the odometry of the wheels alone."""
    write_csv(out / 'track.csv',
              ('time_s', 'x_m', 'y_m', 'z_m', 'yaw_rad', 'believed_x_m', 'believed_y_m',
               'wheels_x_m', 'wheels_y_m'),
              ([f'{value:.4f}' for value in (*row, *believed, *wheels)]
               for row, believed, wheels in zip(track.rows, track.believed, track.odometry)))


def write_figures(kind: type[Any], found: Sequence[Any], path: Path) -> None:
    """Writes a line for each run; `kind` is the dataclass of its figures."""
    write_csv(path, [field.name for field in fields(kind)],
              ([f'{value:.4f}' if isinstance(value, float) else value
                for value in astuple(figures)] for figures in found))
