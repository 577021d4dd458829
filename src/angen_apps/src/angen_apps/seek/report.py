"""Files and texts of a search: of one, and of many."""
import math
from pathlib import Path
from statistics import mean, median

from angen_apps.robot.tables import write_events, write_figures, write_track
from angen_apps.seek.home import Home
from angen_apps.seek.run import Figures, Outcome
from angen_tools.common.files import write_csv
from angen_tools.common.output import Table, table

WITH, WITHOUT = 'WITH s', 'WITHOUT s'
HEAD = ('SEED', WITH, 'ROOM', 'BESIDE cm', 'm', WITHOUT, 'ROOM ', 'BESIDE cm ', 'm ', 'COLLISIONS')
RIGHT = ('SEED', WITH, 'BESIDE cm', 'm', WITHOUT, 'BESIDE cm ', 'm ', 'COLLISIONS')


def write_outcome(outcome: Outcome, home: Home, out: Path) -> None:
    """Writes search.csv, events.csv, track.csv, person.csv and goals.csv into a folder."""
    write_figures(Figures, [outcome.figures], out / 'search.csv')
    write_events(outcome.events, out)
    write_track(outcome.track, out)
    write_csv(out / 'person.csv', ('time_s', 'x_m', 'y_m', 'z_m'),
              ([f'{value:.3f}' for value in row] for row in outcome.person))
    write_csv(out / 'goals.csv', ('time_s', 'room', 'x_m', 'y_m'),
              ([f'{t:.1f}', home.rooms[home.room[cell]], *(f'{v:.2f}' for v in home.point(cell))]
               for t, cell in outcome.goals))


def summary(outcome: Outcome, home: Home) -> str:
    """The events of one search."""
    figures, found = outcome.figures, outcome.found
    if found is None:
        rooms = home.room_sums(outcome.beliefs[-1][1])
        best = max(rooms, key=lambda room: rooms[room])
        first = (f'no person was found within {figures.time_s:.0f} s; most probable is {best} with '
                 f'{100 * rooms[best]:.0f} %')
    else:
        first = (f'found after {found.time:.1f} s in {found.room}, at {found.x:.2f}, {found.y:.2f}'
                 f' on floor {found.floor}, by {found.by}')
    lines = [first]
    if found is not None and math.isfinite(figures.error_m):
        lines.append(f'in truth {100 * figures.error_m:.0f} cm from there, in {figures.true_room}')
    elif figures.true_room:
        lines.append(f'in truth in {figures.true_room}')
    lines.append(f'the robot went {figures.distance_m:.1f} m; collisions: {figures.collisions}; '
                 f'{figures.wall_s:.0f} s of wall time')
    return '\n'.join(lines)


def verdict(figures: Figures) -> int:
    """0, or 1 where no person was found or the robot touched something."""
    return 0 if figures.found and not figures.collisions else 1


def pairs(found: list[Figures]) -> list[tuple[Figures, Figures]]:
    """The searches of each seed, with ambient sensors and without, where both exist."""
    by = {(figures.seed, figures.ambient): figures for figures in found}
    seeds = sorted({figures.seed for figures in found})
    return [(by[seed, True], by[seed, False]) for seed in seeds
            if (seed, True) in by and (seed, False) in by]


def table_of(found: list[Figures]) -> Table:
    """A line a seed."""
    rows = []
    for one, other in pairs(found):
        rows.append((str(one.seed), *_cells(one), *_cells(other),
                     str(one.collisions + other.collisions)))
    return table(HEAD, rows, right=RIGHT)


def _cells(figures: Figures) -> tuple[str, ...]:
    if not figures.found:
        return 'not found', figures.true_room, '', f'{figures.distance_m:.0f}'
    return (f'{figures.time_s:.0f}', figures.room, f'{100 * figures.error_m:.0f}',
            f'{figures.distance_m:.0f}')


def compare(found: list[Figures], limit: float) -> str:
    """Median and mean of both ways; a search without a find counts as `limit` s."""
    lines = []
    for ambient, name in ((True, 'with ambient sensors'), (False, 'without')):
        those = [figures for figures in found if figures.ambient is ambient]
        times = [figures.time_s if figures.found else limit for figures in those]
        errors = [figures.error_m for figures in those if figures.found]
        missed = sum(not figures.found for figures in those)
        beside = f'at most {100 * max(errors):.0f} cm beside the truth; ' if errors else ''
        lines.append(f'{name}: median {median(times):.0f} s, mean {mean(times):.0f} s, longest '
                     f'{max(times):.0f} s, {missed} of {len(those)} not found; {beside}'
                     f'{mean(f.distance_m for f in those):.0f} m driven on average; '
                     f'{sum(f.collisions for f in those)} collisions')
    both = pairs(found)
    ratio = [other.time_s / one.time_s for one, other in both]
    sooner = sum(one.time_s < other.time_s for one, other in both)
    lines.append(f'sooner with them in {sooner} of {len(both)}; median of the ratios '
                 f'{median(ratio):.1f}')
    return '\n'.join(lines)
