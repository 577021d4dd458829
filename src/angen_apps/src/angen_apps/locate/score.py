"""Reports the accuracy of the answers: a table, a CSV file and a figure."""
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Iterable, Sequence

import numpy as np

from angen_apps.locate.belief import Answer
from angen_tools.common import files
from angen_tools.common.home import Home
from angen_tools.common.output import RenderableType, as_json, number, table

HEAD = ('TAG', 'SECONDS', 'KNOWN', 'ROOM RIGHT', 'RIGHT WHERE KNOWN', 'MEDIAN', '90 %')
ANSWERS = ('TAG', 'ROOM', 'CHANCE', 'X', 'Y', 'Z')
COLUMNS = ('time', 'tag', 'room', 'chance', 'x', 'y', 'z', 'true_room', 'true_x', 'true_y',
           'true_z', 'error')


@dataclass(frozen=True)
class Row:
    """An answer at a time (s), and the truth; its room is '' outside of all rooms."""

    time: float
    answer: Answer
    true_room: str
    true_at: tuple[float, float, float]

    @property
    def error(self) -> float:
        """Horizontal distance to the truth, m; not a number if it is unknown, or on another
        floor."""
        if not self.answer.room or abs(self.answer.at[2] - self.true_at[2]) > 2.0:
            return math.nan
        return math.dist(self.answer.at[:2], self.true_at[:2])

    @property
    def right(self) -> bool:
        return self.answer.room == self.true_room


def compare(time: float, answers: Iterable[Answer],
            truth: dict[str, tuple[float, float, float]], home: Home) -> list[Row]:
    """Answers beside the true places (m) of the tags' carriers."""
    rows = []
    for answer in answers:
        if answer.tag not in truth:
            continue
        x, y, z = truth[answer.tag]
        room = home.room_at(x, y, z + 0.5)
        rows.append(Row(time, answer, room.name if room else '', (x, y, z)))
    return rows


def table_rows(rows: Sequence[Row]) -> list[list[str]]:
    """A line for each tag, as HEAD names its cells."""
    lines = []
    for tag in sorted({row.answer.tag for row in rows}):
        own = [row for row in rows if row.answer.tag == tag]
        known = [row for row in own if row.answer.room]
        errors = [row.error for row in known if not math.isnan(row.error)]
        lines.append([
            tag, number(own[-1].time - own[0].time, 0), _share(len(known), len(own)),
            _share(sum(row.right for row in own), len(own)),
            _share(sum(row.right for row in known), len(known)),
            *([f'{number(float(np.percentile(errors, p)), 1)} m' for p in (50, 90)] if errors
              else ['-', '-'])])
    return lines


def _share(part: int, whole: int) -> str:
    return f'{100.0 * part / whole:.0f} %' if whole else '-'


def cells(answer: Answer) -> list[str]:
    """An answer, as ANSWERS names its cells."""
    at = [number(v, 1) for v in answer.at] if answer.room else ['', '', '']
    return [answer.tag, answer.room or 'unknown', number(answer.chance), *at]


def answers_table(answers: list[Answer], json: bool) -> RenderableType:
    """The answers as a table, or as JSON."""
    if json:
        return as_json([{'tag': a.tag, 'room': a.room or None, 'chance': round(a.chance, 3),
                         'at': [round(v, 3) for v in a.at] if a.room else None} for a in answers])
    return table(ANSWERS, map(cells, answers), right=('CHANCE', 'X', 'Y', 'Z'))


def write_csv(path: Path, rows: Iterable[Row]) -> None:
    """A line for each answer; lengths in m, time in s."""
    def cells(row: Row) -> list[str]:
        answer = row.answer
        return [f'{row.time:.1f}', answer.tag, answer.room, f'{answer.chance:.3f}',
                *(f'{v:.3f}' for v in answer.at), row.true_room,
                *(f'{v:.3f}' for v in row.true_at), f'{row.error:.3f}']
    files.write_csv(path, COLUMNS, map(cells, rows))
