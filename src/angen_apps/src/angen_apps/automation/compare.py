"""Two automations over the same days of the same people: comfort, energy, false alarms."""
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Sequence

from angen_apps.automation.bench import Record
from angen_apps.automation.claims import (ANYONE, Claim, Part, Spans, both, inverse, power_used,
                                          total, union)
from angen_apps.automation.judge import FAILED, Verdict
from angen_apps.residents.light import daylight_in
from angen_tools.common.clock import DAY
from angen_tools.common.files import pyplot, save_figure

DARK = 50.0   # lx at the eyes by daylight: with less a room with people needs its lamp
STEP = 300.0  # s between two looks at the daylight
SHORT = 5.0   # s: who only passes is not counted as late


@dataclass
class Room:
    """A lamp's room over the run, in s. `late`: of each time that light was needed."""

    lamp: str
    room: str
    needed: float
    lit: float
    wasted: float
    late: list[float]
    alarms: int


@dataclass
class Score:
    """What one automation did for people."""

    name: str
    rooms: list[Room]
    kwh: float
    switched: int
    notes: int
    verdicts: Sequence[Verdict]

    @property
    def lit_share(self) -> float:
        needed = sum(room.needed for room in self.rooms)
        return 100.0 * sum(room.lit for room in self.rooms) / needed if needed else 100.0

    @property
    def late(self) -> float:
        """Mean, s."""
        every = [one for room in self.rooms for one in room.late]
        return sum(every) / len(every) if every else 0.0

    def rows(self, days: float) -> list[tuple[str, str]]:
        failed = sum(verdict.outcome == FAILED for verdict in self.verdicts)
        return [('lit when needed, %', f'{self.lit_share:.1f}'),
                ('late, mean s', f'{self.late:.1f}'),
                ('lit for nobody, h a day',
                 f'{sum(room.wasted for room in self.rooms) / 3600.0 / days:.2f}'),
                ('switched on for nobody, a day',
                 f'{sum(room.alarms for room in self.rooms) / days:.1f}'),
                ('energy of all loads, kWh a day', f'{self.kwh / days:.3f}'),
                ('commands a day', f'{self.switched / days:.1f}'),
                ('messages to people a day', f'{self.notes / days:.1f}'),
                ('expectations failed', f'{failed} of {len(self.verdicts)}')]


def score(record: Record, verdicts: Sequence[Verdict]) -> Score:
    """The figures of a run, for the lamps that were commanded in it."""
    lamps = sorted({done.entity for done in record.done if done.entity.startswith('light.')})
    return Score(record.tested, [_room(record, lamp) for lamp in lamps],
                 power_used(record.watts, record.lines.end),
                 sum(bool(done.entity) for done in record.done),
                 sum(not done.entity for done in record.done), verdicts)


def _room(record: Record, lamp: str) -> Room:
    lines, home = record.lines, record.house.site.home
    pose = next(pose for kind, name, _, pose in record.house.site.world.entities()
                if (kind, name) == record.entities.find(lamp).thing.key)
    found = home.room_at(*pose[:3])
    room = found.name if found else ''

    def spans(*parts: Part) -> Spans:
        return lines.spans(Claim('', parts))

    on = spans(Part(lamp, value='on'))
    present = spans(Part(ANYONE, who=ANYONE, room=room))
    awake = spans(Part(ANYONE, who=ANYONE, room=room, awake=True))
    needed = [span for span in both(awake, _dark(record, room)) if span[1] - span[0] > SHORT]
    empty = inverse(present, lines.end)
    late = [min((max(0.0, low - begin) for low, high in on if high > begin and low < end),
                default=end - begin) for begin, end in needed]
    alarms = sum(any(a < low < b for a, b in empty) for low, _ in on if low > 0.0)
    return Room(lamp, room, total(needed), total(both(on, needed)), total(both(on, empty)), late,
                alarms)


def _dark(record: Record, room: str) -> Spans:
    """When daylight is not enough; always in a room without a window."""
    end, home, start = record.lines.end, record.house.site.home, record.house.start
    since, steps = record.house.since, [STEP * i for i in range(math.ceil(end / STEP))]
    return union([[(time, min(time + STEP, end)) for time in steps
                   if daylight_in(home, room, start.date(), since + time) < DARK]])


def as_dict(scores: Sequence[Score], days: float) -> list[dict[str, Any]]:
    return [{'automation': one.name, **dict(one.rows(days)),
             'rooms': [vars(room) for room in one.rooms]} for one in scores]


def draw(scores: Sequence[Score], days: float, path: Path) -> None:
    """Writes the picture: a row of bars for each figure, side by side."""
    from angen_apps.automation.figure import BAD, FAINT, GOOD, INK
    rows = [one.rows(days) for one in scores]
    shown = [i for i in range(len(rows[0]) - 1) if any(float(row[i][1]) for row in rows)]
    colors = (FAINT, GOOD)
    with pyplot().rc_context({'font.size': 9}):
        figure, axes = pyplot().subplots(1, len(shown), figsize=(13.0, 3.4), squeeze=False)
        for i, axis in zip(shown, axes[0]):
            values = [float(row[i][1]) for row in rows]
            most = max(*values, 1e-9)
            for j, (value, color) in enumerate(zip(values, colors)):
                axis.bar(j, value, 0.62, color=color)
                axis.text(j, value + 0.02 * most, rows[j][i][1], ha='center', va='bottom',
                          fontsize=9, color=INK)
            axis.set_title(rows[0][i][0].replace(', ', '\n').replace('nobody a', 'nobody\na'),
                           fontsize=8.5, color=INK)
            axis.set_xticks([])
            axis.set_yticks([])
            axis.set_xlim(-0.6, len(values) - 0.4)
            axis.set_ylim(0, 1.18 * most)
            axis.spines[['top', 'right', 'left']].set_visible(False)
            axis.spines['bottom'].set_color(FAINT)
        for j, (one, color) in enumerate(zip(scores, colors)):
            failed = rows[j][-1][1]
            figure.text(0.03 + 0.5 * j, 0.04, '■', color=color, fontsize=14, va='center')
            figure.text(0.05 + 0.5 * j, 0.04, f'{one.name}: {failed} expectations failed',
                        fontsize=9.5, va='center', parse_math=False,
                        color=BAD if not failed.startswith('0') else INK)
        figure.subplots_adjust(0.02, 0.12, 0.98, 0.82, 0.25)
        figure.suptitle(f'{days:g} days of the same people'.replace('1 days', '1 day'),
                        fontsize=11, color=INK, weight='bold', y=0.98)
        save_figure(figure, path, dpi=130)


def days_of(record: Record) -> float:
    return record.lines.end / DAY
