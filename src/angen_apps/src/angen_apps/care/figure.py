"""A picture of the warnings: on the plan of the home where each rule looks, and below it the
degree of each rule over the day."""
import math
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

from angen_apps.care.engine import CareWarning, Engine
from angen_apps.care.report import warnings_of
from angen_apps.plan.draw import DPI, INK, Scene, is_on, sheet
from angen_tools.common.clock import DAY, HOUR, MINUTE, show_time
from angen_tools.common.files import pyplot, save_figure

FAINT, DEGREE, WARNED, SEEN = '#7d8a94', '#5b8db8', '#c8372d', '#e8a33d'  # SEEN: acknowledged
LANE, NAMES, EDGE = 0.52, 3.5, 0.35  # inches: height of a rule, width of its reason, margin
ALONE = 12.0  # inches: width of a picture without a plan
RADIUS, ASIDE = 0.26, 0.6  # m of a mark, and between two at one place
LEAST = 1 / 800  # share of the whole time: the shortest length that a warning is drawn with
STEPS = (1.0, 5.0, 10.0, 30.0, MINUTE, 5 * MINUTE, 10 * MINUTE, 30 * MINUTE, HOUR, 2 * HOUR,
         3 * HOUR, 6 * HOUR, 12 * HOUR, DAY)


def draw(engine: Engine, scene: Scene | None, path: Path) -> None:
    """Writes the picture of all that the engine has seen in a home; without a plan where none can
    be drawn."""
    warnings = warnings_of(engine)
    lanes = LANE * len(engine.rules.rules)
    below = lanes + 3 * EDGE
    if scene is None:
        figure = pyplot().figure(figsize=(ALONE, below))
    else:
        figure, axes = sheet(scene, scene.drawn(), below)
        _draw_marks(axes, engine, scene, {warning.rule.name for warning in warnings})
    wide, tall = figure.get_size_inches()
    day = figure.add_axes((NAMES / wide, 1.4 * EDGE / tall, 1 - (NAMES + EDGE) / wide,
                           lanes / tall))
    _draw_day(day, engine, warnings)
    save_figure(figure, path, dpi=DPI)


def _draw_marks(axes: Any, engine: Engine, scene: Scene, warned: set[str]) -> None:
    """The number of each rule where its warnings are."""
    taken: Counter[tuple[float, ...]] = Counter()
    for number, rule in enumerate(engine.rules.rules, 1):
        pose = scene.pose_of(engine.places[rule.name])
        if pose is None:
            continue
        x, y, z = pose
        shift = ASIDE * taken[pose]
        taken[pose] += 1
        for axis, storey in axes:
            if is_on(z, storey):
                color = WARNED if rule.name in warned else FAINT
                angles = np.linspace(0, 2 * math.pi, 32)
                axis.fill(x + shift + RADIUS * np.cos(angles), y + RADIUS * np.sin(angles),
                          color=color, lw=0, zorder=10)
                axis.text(x + shift, y, str(number), color='white', fontsize=8, ha='center',
                          va='center', weight='bold', zorder=11)


def _draw_day(axis: Any, engine: Engine, warnings: list[CareWarning]) -> None:
    """A lane for each rule."""
    begin, end = engine.began, max(engine.now, engine.began + 1.0)
    axis.set_xlim(begin, end)
    axis.set_ylim(-len(engine.rules.rules), 0.0)
    axis.spines[['top', 'right', 'left']].set_visible(False)
    axis.set_yticks([])
    for i, rule in enumerate(engine.rules.rules):
        low = -i - 0.9
        curve = np.array(engine.curves[rule.name].line()).reshape(-1, 2)
        axis.fill_between(curve[:, 0], low, low + 0.6 * curve[:, 1], color=DEGREE, alpha=0.5, lw=0)
        axis.plot([begin, end], 2 * [low + 0.6 * rule.threshold], color=FAINT, lw=0.6, ls=':')
        axis.axhline(low, color=FAINT, lw=0.6)
        own = [warning for warning in warnings if warning.rule is rule]
        for warning in own:
            _draw_warning(axis, engine, warning, low)
        left = begin - 0.01 * (end - begin)
        axis.text(left, low + 0.4, f'{i + 1}  {rule.name}', ha='right', va='center', fontsize=8,
                  color=WARNED if own else INK)
        axis.text(left, low + 0.1, rule.reason, ha='right', va='center', fontsize=6.5, color=FAINT,
                  style='italic')
    name_hours(axis, begin, engine.now, engine.starts)


def _draw_warning(axis: Any, engine: Engine, warning: CareWarning, low: float) -> None:
    """Red until it is acknowledged, then amber; with its time and degree."""
    end = engine.now if warning.ended is None else warning.ended
    known = end if warning.acknowledged is None else warning.acknowledged
    whole = max(engine.now - engine.began, 1.0)
    for first, last, color in ((warning.raised, known, WARNED), (known, end, SEEN)):
        if last > first:
            axis.broken_barh([(first, max(last - first, LEAST * whole))], (low, 0.6), color=color,
                             alpha=0.35, lw=0)
    clock = show_time((engine.starts + warning.raised) % DAY)[:-3]
    axis.text(warning.raised, low + 0.64, f'{clock}, degree {warning.degree:.2f}', va='bottom',
              ha='left' if warning.raised < engine.began + 0.6 * whole else 'right', fontsize=7,
              color=WARNED)


def name_hours(axis: Any, begin: float, end: float, since: float) -> None:
    """Ticks at times of day, of several days at their starts; `since`: s of the day at time 0."""
    step = next((step for step in STEPS if (end - begin) / step <= 14),
                DAY * max(1, round((end - begin) / DAY / 12)))
    ticks = [k * step - since for k in range(math.ceil((since + begin) / step),
                                             math.floor((since + end) / step) + 1)]
    axis.set_xticks(ticks, [show_time(since + tick)[-8:-3 if step >= MINUTE else None]
                            if step < DAY else f'day {round((since + tick) / DAY) + 1}'
                            for tick in ticks], fontsize=8)
