"""A picture of the warnings: for each rule its degree over the day, and the signals behind it."""
from __future__ import annotations

import math
from pathlib import Path
from typing import Any, Sequence

import numpy as np

from angen_tools.common.clock import DAY, HOUR, MINUTE, show_time
from angen_apps.care.engine import CareWarning, Engine
from angen_apps.care.membership import Trapezoid
from angen_apps.care.rules import Condition, Rule
from angen_tools.common.files import pyplot, save_figure

INK, FAINT, GRID = '#22303c', '#7d8a94', '#dfe4e8'
DEGREE, WARNED, SEEN = '#5b8db8', '#c8372d', '#e8a33d'  # SEEN: acknowledged
SIGNAL, AGAINST, NIGHT = '#3f5566', '#a9bac6', '#8577b0'
LANE = 0.26     # height of a signal's lane; the degree's is 1
WIDTH = 12.0    # in
LEAST = 1 / 800  # share of the whole time: the shortest length that a warning is drawn with
STEPS = (MINUTE, 5 * MINUTE, 10 * MINUTE, 30 * MINUTE, HOUR, 2 * HOUR, 3 * HOUR, 6 * HOUR,
         12 * HOUR, DAY)


def draw(engine: Engine, warnings: Sequence[CareWarning], path: Path) -> None:
    """Writes the picture of all that the engine has seen."""
    rules = engine.rules.rules
    heights = [1.12 + LANE * len(rule.when) for rule in rules]
    figure, axes = pyplot().subplots(
        len(rules), 1, sharex=True, squeeze=False, figsize=(WIDTH, 1.1 + 0.86 * sum(heights)),
        height_ratios=heights, dpi=150)
    for ax, rule in zip(axes[:, 0], rules):
        _draw_rule(ax, engine, rule, [w for w in warnings if w.rule is rule])
    _name_hours(axes[-1, 0], engine)
    figure.suptitle(_title(engine, len(warnings)), x=0.012, ha='left', fontsize=14, color=INK,
                    fontweight='bold')
    figure.legend(handles=_legend(), loc='upper right', ncols=6, fontsize=8.5, frameon=False,
                  bbox_to_anchor=(0.995, 1.0), handlelength=1.6, columnspacing=1.4)
    figure.tight_layout(rect=(0, 0, 1, 1 - 0.15 / figure.get_figheight()), h_pad=0.5)
    save_figure(figure, path)


def _title(engine: Engine, count: int) -> str:
    begin, end = (show_time((engine.starts + t) % DAY)[:-3]
                  for t in (engine.began, engine.now))
    hours = (engine.now - engine.began) / HOUR
    return f'{count or "No"} warning{"s" * (count != 1)}, {begin} to {end} ({hours:.3g} h)'


def _draw_rule(ax: Any, engine: Engine, rule: Rule, warnings: Sequence[CareWarning]) -> None:
    lanes = len(rule.when)
    ax.set_ylim(-LANE * lanes - 0.04, 1.34)
    ax.set_xlim(engine.began, max(engine.now, engine.began + 1.0))
    for side in ('top', 'right', 'left', 'bottom'):
        ax.spines[side].set_visible(False)
    ax.axhline(0.0, color=FAINT, linewidth=0.8, zorder=2)
    ax.set_yticks([0, 1], ['0', '1'], fontsize=7.5, color=FAINT)
    ax.tick_params(length=0, labelcolor=FAINT)
    ax.grid(axis='x', color=GRID, linewidth=0.8)
    ax.set_axisbelow(True)
    ax.text(0.0, 1.0, rule.name.replace('_', ' '), transform=ax.transAxes, ha='left', va='bottom',
            fontsize=10.5, color=WARNED if warnings else INK, fontweight='bold')
    ax.text(1.0, 1.0, rule.reason, transform=ax.transAxes, ha='right', va='bottom', fontsize=8.5,
            color=FAINT, style='italic')
    _draw_degree(ax, engine, rule, warnings)
    for lane, condition in enumerate(rule.when):
        _draw_lane(ax, engine, condition, -LANE * (lane + 1))


def _draw_degree(ax: Any, engine: Engine, rule: Rule, warnings: Sequence[CareWarning]) -> None:
    curve = engine.curves[rule.name].line()
    times, degrees = [time for time, _ in curve], [degree for _, degree in curve]
    ax.fill_between(times, degrees, color=DEGREE, alpha=0.35, linewidth=0, zorder=3)
    ax.plot(times, degrees, color=DEGREE, linewidth=1.3, zorder=4)
    ax.axhline(rule.threshold, color=FAINT, linewidth=0.8, linestyle=(0, (4, 3)), zorder=2)
    least = LEAST * (engine.now - engine.began)
    for warning in warnings:
        end = engine.now if warning.ended is None else warning.ended
        known = end if warning.acknowledged is None else warning.acknowledged
        for first, last, color in ((warning.raised, known, WARNED), (known, end, SEEN)):
            if last > first:
                ax.axvspan(first, max(last, first + least), ymin=0.0, ymax=1.0, color=color,
                           alpha=0.18, linewidth=0, zorder=1)
        ax.plot(warning.raised, warning.degree, 'o', color=WARNED, markersize=5.5, zorder=6,
                markeredgecolor='white', markeredgewidth=0.8)
        _label(ax, engine, warning)


def _label(ax: Any, engine: Engine, warning: CareWarning) -> None:
    """The time and degree at which a warning was raised, on the side where there is room."""
    share = (warning.raised - engine.began) / max(1.0, engine.now - engine.began)
    left = share > 0.85
    clock = show_time((engine.starts + warning.raised) % DAY)[:-3]
    ax.annotate(f'{clock}   degree {warning.degree:.2f}', (warning.raised, 1.06),
                xytext=(4 if left else -4, 0), textcoords='offset points',
                ha='right' if left else 'left', va='bottom', fontsize=8.5, color=WARNED, zorder=7)


def _draw_lane(ax: Any, engine: Engine, condition: Condition, low: float) -> None:
    """When the signal of a condition was true, or its time of day."""
    height = 0.55 * LANE
    least = LEAST * (engine.now - engine.began)
    if condition.time is not None:
        _draw_window(ax, engine, condition.time, low, height)
        name = 'time of day'
    else:
        signal = engine.signals[condition.signal]
        bars = [(begin, max(end - begin, least)) for begin, end in signal.all_periods(engine.now)]
        ax.broken_barh(bars, (low, height), color=AGAINST if condition.negated else SIGNAL,
                       linewidth=0, zorder=3)
        name = f'{"not " * condition.negated}{condition.signal}'
    ax.axhline(low, color=GRID, linewidth=0.8, zorder=1)
    ax.text(-0.012, low + height / 2, name, transform=ax.get_yaxis_transform(), ha='right',
            va='center', fontsize=8, color=INK)


def _draw_window(ax: Any, engine: Engine, window: Trapezoid, low: float, height: float) -> None:
    times = np.linspace(engine.began, engine.now, 2000)
    degrees = [window.degree((engine.starts + t) % DAY) for t in times]
    ax.fill_between(times, low, low + height * np.array(degrees), color=NIGHT, linewidth=0,
                    zorder=3)


def _name_hours(ax: Any, engine: Engine) -> None:
    span = engine.now - engine.began
    step = next((step for step in STEPS if span / step <= 13), STEPS[-1])
    starts = engine.starts
    first = math.ceil((starts + engine.began) / step)
    last = math.floor((starts + engine.now) / step)
    ticks = [k * step - starts for k in range(first, last + 1)]
    ax.set_xticks(ticks, [show_time(starts + tick)[-8:-3] for tick in ticks], fontsize=9,
                  color=INK)


def _legend() -> list[Any]:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch
    return [Patch(facecolor=DEGREE, alpha=0.5, label='degree'),
            Line2D([], [], color=FAINT, linewidth=0.9, linestyle=(0, (4, 3)), label='threshold'),
            Patch(facecolor=WARNED, alpha=0.3, label='warning'),
            Patch(facecolor=SEEN, alpha=0.4, label='acknowledged'),
            Patch(facecolor=SIGNAL, label='signal'),
            Patch(facecolor=AGAINST, label='signal that should not be')]
