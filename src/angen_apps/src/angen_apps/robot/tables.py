"""What every task of a robot leaves: events.csv and track.csv."""
from __future__ import annotations

from pathlib import Path

from angen_apps.robot.driver import Track
from angen_apps.robot.interface import Event
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
