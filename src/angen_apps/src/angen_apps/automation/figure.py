"""A picture of a run: the plan of the home with what takes part, and below it the time line of
people, states, commands and expectations."""
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Sequence

import numpy as np

from angen_apps.automation.bench import Record
from angen_apps.automation.card import storey_of
from angen_apps.automation.claims import Line, pieces
from angen_apps.automation.judge import FAILED, OPEN, Verdict
from angen_apps.care.figure import name_hours
from angen_apps.plan.draw import DPI, INK, Scene, draw_storey, extent, read_scene
from angen_tools.common.failure import Failure
from angen_tools.common.files import pyplot, save_figure
from angen_tools.common.verbs import number

FAINT, GRID = '#7d8a94', '#e3e7ea'
GOOD, BAD, UNKNOWN = '#3d9a5b', '#c8372d', '#a9b2b9'
WIDTH, LEFT, RIGHT = 13.0, 3.3, 0.35      # inches: of the picture, of the names, of the margin
LANE, SMALL, GAP, FOOT = 0.30, 0.24, 0.34, 0.5  # inches
PLAN = 5.2                                 # inches: height of the plan
COLORS = {'light': '#e8a33d', 'binary_sensor': '#5b8db8', 'sensor': '#7a6fb0',
          'cover': '#4f9d9a', 'climate': '#c9653b', 'switch': '#6a8f3c', 'fan': '#6a8f3c'}
ROOMS = ('#5b8db8', '#e8a33d', '#7a6fb0', '#4f9d9a', '#c9653b', '#6a8f3c', '#b0658c', '#8a7a5a')
OFF = ('off', 'closed', 'unknown', 'None', '')


@dataclass
class Lane:
    """A line of the picture: its name, and what draws it on axes between two heights."""

    name: str
    draw: Any
    height: float = LANE
    color: str = INK


def draw(record: Record, verdicts: Sequence[Verdict], path: Path) -> None:
    """Writes the picture of a run."""
    lanes = _lanes(record, verdicts)
    tall = sum(lane.height for lane in lanes) + FOOT
    scene = _scene(record)
    with pyplot().rc_context({'font.size': 8}):
        figure = pyplot().figure(figsize=(WIDTH, tall + (PLAN if scene else 0.4)))
        wide, high = figure.get_size_inches()
        if scene is not None:
            _draw_plan(figure, record, scene, verdicts, (wide, high))
        figure.text(0.3 / wide, 1 - 0.28 / high, _title(record, verdicts), fontsize=12,
                    weight='bold', color=INK, va='center', parse_math=False)
        axis = figure.add_axes((LEFT / wide, FOOT / high, 1 - (LEFT + RIGHT) / wide,
                                (tall - FOOT) / high))
        _draw_lanes(axis, record, lanes, tall - FOOT)
        save_figure(figure, path, dpi=DPI)


def _title(record: Record, verdicts: Sequence[Verdict]) -> str:
    failed = sum(verdict.outcome == FAILED for verdict in verdicts)
    still = sum(verdict.outcome == OPEN for verdict in verdicts)
    words = [f'{len(verdicts) - failed - still} of {len(verdicts)} expectations hold']
    if failed:
        words.append(f'{failed} failed')
    if still:
        words.append(f'{still} not judged')
    return f'{record.tested or record.scenario.path.stem}: {", ".join(words)}'


def _scene(record: Record) -> Scene | None:
    try:
        return read_scene(record.house.path)
    except Failure:
        return None


def _draw_plan(figure: Any, record: Record, scene: Scene, verdicts: Sequence[Verdict],
               size: tuple[float, float]) -> None:
    """The plan at the top left, the expectations beside it."""
    storeys = scene.drawn()
    wide, high = size
    extents = [extent(scene, storey) for storey in storeys]
    inch = min((PLAN - 0.6) / max(e[3] - e[2] for e in extents),
               0.62 * wide / sum(e[1] - e[0] for e in extents))
    left = 0.2
    for storey, each in zip(storeys, extents):
        width, height = (each[1] - each[0]) * inch, (each[3] - each[2]) * inch
        axis = figure.add_axes((left / wide, (high - 0.5 - height) / high, width / wide,
                                height / high))
        draw_storey(axis, scene, storey, inch)
        _mark(axis, record, storey)
        left += width
    _draw_verdicts(figure, record, verdicts, (left + 0.25) / wide, size)


def _mark(axis: Any, record: Record, storey: Any) -> None:
    """Marks what takes part, with its name."""
    poses = {(kind, name): pose for kind, name, _, pose in record.house.site.world.entities()}
    seen: set[tuple[str, str]] = set()
    for name, attribute in record.lines.values:
        if '.' not in name or attribute:
            continue
        entity = record.entities.find(name)
        pose = poses.get(entity.thing.key)
        if pose is None or entity.thing.key in seen or storey.number != storey_of(
                record.house.site.home, pose[:3]):
            continue
        seen.add(entity.thing.key)
        color = COLORS.get(entity.domain, INK)
        axis.plot([pose[0]], [pose[1]], 'o', ms=7, color=color, mec='white', mew=1.2, zorder=12)
        axis.annotate(entity.thing.label, pose[:2], (0, 7), textcoords='offset points',
                      fontsize=6.5, ha='center', va='bottom', color=color, zorder=13,
                      weight='bold', parse_math=False,
                      bbox={'facecolor': 'white', 'alpha': 0.8, 'lw': 0, 'pad': 0.6})


def _draw_verdicts(figure: Any, record: Record, verdicts: Sequence[Verdict], left: float,
                   size: tuple[float, float]) -> None:
    """The expectations as a list."""
    wide, high = size
    columns = max(20, int((1 - left) * wide * 13.5))
    y = high - 0.75
    for verdict in verdicts:
        color = {FAILED: BAD, OPEN: UNKNOWN}.get(verdict.outcome, GOOD)
        text = _wrapped(verdict.expectation.name, columns)
        figure.text(left, y / high, {FAILED: '✘', OPEN: '?'}.get(verdict.outcome, '✔'),
                    color=color, fontsize=11, va='top', weight='bold')
        figure.text(left + 0.22 / wide, y / high, text, color=INK, fontsize=8, va='top',
                    parse_math=False, linespacing=1.15)
        y -= 0.145 * text.count('\n') + 0.16
        figure.text(left + 0.22 / wide, y / high, f'{verdict.outcome}: {verdict.detail}',
                    color=color, fontsize=7.5, va='top', parse_math=False)
        y -= 0.26
        if y < high - PLAN:
            break


def _wrapped(text: str, columns: int) -> str:
    import textwrap
    return '\n'.join(textwrap.wrap(text, columns)[:4])


# --- the time line

def _lanes(record: Record, verdicts: Sequence[Verdict]) -> list[Lane]:
    """People, states, commands and expectations, with gaps."""
    lines = record.lines.values
    rooms = [room.name for room in record.house.site.home.rooms]
    lanes = [Lane(name, lambda axis, low, high, name=name: _draw_person(
        axis, record, lines[name, ''], rooms, low, high)) for name in record.lines.people]
    groups: list[list[Lane]] = [lanes, [], [], []]
    for (name, attribute), line in lines.items():
        if '.' in name and (not attribute or _is_named(record, name, attribute)):
            groups[1].append(_state_lane(record, name, attribute, line))
    by = sorted({done.by for done in record.done})
    for who in by:
        mine = [done for done in record.done if done.by == who]
        groups[2].append(Lane(who, lambda axis, low, high, mine=mine: _draw_done(
            axis, record, mine, low, high), 1.3 * LANE))
    for verdict in verdicts:
        groups[3].append(Lane(_cut(verdict.expectation.name), lambda axis, low, high, v=verdict:
                              _draw_verdict(axis, record, v, low, high), SMALL,
                              BAD if verdict.outcome == FAILED else INK))
    return [lane for group in groups if group for lane in (*group, GAP_LANE)][:-1]


GAP_LANE = Lane('', lambda axis, low, high: None, GAP / 2)


def _is_named(record: Record, name: str, attribute: str) -> bool:
    return any((name, attribute) == part.key for each in record.scenario.expectations
               for claim in each.claims.values() for part in claim.parts)


def _cut(text: str) -> str:
    return text if len(text) <= 48 else text[:46] + ' …'


def _state_lane(record: Record, name: str, attribute: str, line: Line) -> Lane:
    color = COLORS.get(name.partition('.')[0], INK)
    numbers = [number(value) for _, value in line]
    if any(math.isfinite(value) for value in numbers):
        return Lane(f'{name} {attribute}'.strip(), lambda axis, low, high: _draw_number(
            axis, record, line, color, low, high), 1.5 * LANE)
    return Lane(f'{name} {attribute}'.strip(), lambda axis, low, high: _draw_state(
        axis, record, line, color, low, high))


def _draw_lanes(axis: Any, record: Record, lanes: Sequence[Any], tall: float) -> None:
    end = max(record.lines.end, 1.0)
    axis.set_xlim(0.0, end)
    axis.set_ylim(0.0, tall)
    axis.spines[['top', 'right', 'left']].set_visible(False)
    axis.spines['bottom'].set_color(FAINT)
    axis.set_yticks([])
    name_hours(axis, 0.0, record.lines.end, record.house.since)
    axis.tick_params(colors=INK, length=3)
    axis.grid(axis='x', color=GRID, lw=0.6, zorder=0)
    axis.set_axisbelow(True)
    top = tall
    for lane in lanes:
        low, high = top - lane.height + 0.04, top - 0.04
        if lane.name:
            axis.axhline(low - 0.04, color=GRID, lw=0.6, zorder=0)
            axis.text(-0.008 * end, (low + high) / 2, lane.name, ha='right', va='center',
                      fontsize=7.5, color=lane.color, parse_math=False)
        lane.draw(axis, low, high)
        top -= lane.height


def _draw_person(axis: Any, record: Record, line: Line, rooms: list[str], low: float, high: float
                 ) -> None:
    end, run = record.lines.end, list[tuple[float, float, str]]()
    for time, after, value in pieces(line, record.lines.end):
        room, activity, posture = value.split('|')
        word = f'{room}|{posture}'
        if run and run[-1][2] == word:
            run[-1] = run[-1][0], after, word
        else:
            run.append((time, after, word))
    for time, after, word in run:
        room, _, posture = word.partition('|')
        if not room:
            continue
        color = ROOMS[rooms.index(room) % len(ROOMS)] if room in rooms else UNKNOWN
        axis.broken_barh([(time, after - time)], (low, high - low), color=color, lw=0,
                         alpha={'stand': 0.75, 'sit': 0.5, 'lie': 0.25}.get(posture, 0.75))
        text = f'{room.rstrip("0123456789")} {posture}'.removesuffix(' stand')
        if (after - time) / end > 0.0105 * len(text):
            axis.text((time + after) / 2, (low + high) / 2, text, ha='center', va='center',
                      fontsize=6.5, color=INK, parse_math=False, clip_on=True)


def _draw_state(axis: Any, record: Record, line: Line, color: str, low: float, high: float
                ) -> None:
    end = record.lines.end
    axis.plot([0, end], [low, low], color=color, lw=0.5, alpha=0.5)
    for time, after, value in pieces(line, record.lines.end):
        if value in OFF:
            continue
        width = max(after - time, end / 900.0)
        axis.broken_barh([(time, width)], (low, high - low), color=color, lw=0, alpha=0.8)
        if value not in ('on', 'open') and (after - time) / end > 0.011 * len(value):
            axis.text((time + after) / 2, (low + high) / 2, value, ha='center', va='center',
                      fontsize=6.5, color='white', parse_math=False, clip_on=True)


def _draw_number(axis: Any, record: Record, line: Line, color: str, low: float, high: float
                 ) -> None:
    numbers = [(time, number(value)) for time, value in line]
    known = [value for _, value in numbers if math.isfinite(value)]
    least, most = min(known), max(known)
    scale = (high - low) / max(most - least, 1e-9) if most > least else 0.0
    times = [*(time for time, _ in numbers), record.lines.end]
    values = np.array([*(value for _, value in numbers), numbers[-1][1]])
    heights = low + (values - least) * scale if scale else np.full(len(values), (low + high) / 2)
    axis.fill_between(times, low, heights, step='post', color=color, alpha=0.18, lw=0)
    axis.step(times, heights, where='post', color=color, lw=1.0)
    right = record.lines.end * 1.004
    axis.text(right, high, f'{most:g}', fontsize=6, color=color, va='top')
    if most > least:
        axis.text(right, low, f'{least:g}', fontsize=6, color=color, va='bottom')


def _draw_done(axis: Any, record: Record, mine: list[Any], low: float, high: float) -> None:
    end, last = record.lines.end, -math.inf
    for done in mine:
        color = BAD if done.error else INK
        axis.plot([done.time, done.time], [low, low + 0.5 * (high - low)], color=color, lw=1.0)
        axis.plot([done.time], [low + 0.5 * (high - low)], marker='v', ms=3.5, color=color)
        text = _short(done)
        if done.time - last > 0.0075 * len(text) * end and len(mine) < 60:
            at_end = done.time > 0.85 * end
            axis.text(done.time, high, text, fontsize=6.2, color=color, va='top',
                      ha='right' if at_end else 'left', parse_math=False)
            last = done.time


def _short(done: Any) -> str:
    if not done.entity:
        return f'“{done.what[:40]}”'
    verb, _, data = done.what.partition(' ')
    return f'{verb.rpartition(".")[2].replace("_", " ")} {data.rpartition(": ")[2]}'.strip()


def _draw_verdict(axis: Any, record: Record, verdict: Verdict, low: float, high: float) -> None:
    end = record.lines.end
    middle = (low + high) / 2
    color = {FAILED: GOOD, OPEN: UNKNOWN}.get(verdict.outcome, GOOD)
    axis.plot([0, end], [middle, middle], color=color, lw=2.5, alpha=0.8,
              solid_capstyle='butt', ls=':' if verdict.outcome == OPEN else '-')
    for begin, until in verdict.wrong:
        axis.broken_barh([(begin, max(until - begin, end / 250.0))], (low, high - low), color=BAD,
                         lw=0, zorder=5)
