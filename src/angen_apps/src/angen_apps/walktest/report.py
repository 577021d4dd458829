"""The results of a walk test: words, CSV, a plan of detected and missed steps."""
import math
from dataclasses import asdict
from pathlib import Path
from typing import Any, Sequence

from angen_apps.walktest.plan import Probe, Result
from angen_tools.common import files

SEEN, MISSED = '#8fc98d', '#d9534f'  # cells
SEEN_WALK, MISSED_WALK = '#2e7d32', '#c62828'  # walks that cross no cell
SHIFTS = {'across': 0.27, 'towards': -0.12}  # cells from a cell's middle, where it has both walks


def describe(result: Result) -> str:
    """A test's outcome as a line to read."""
    places = result.places
    verdict = 'PASS' if result.passed else 'FAIL'
    line = f'{verdict}  {result.name}: {sum(places.values())} of {len(places)} places'
    ways = {probe.direction for probe in result.probes}
    if len(ways) > 1:
        line += ' (' + ', '.join(_share(result, way) for way in sorted(ways)) + ')'
    if result.required < 1.0:
        line += f', {100 * result.required:.0f} % required'
    return line


def as_dict(result: Result) -> dict[str, Any]:
    """A test's outcome for JSON."""
    return {'test': result.name, 'passed': result.passed, 'share': result.share,
            'required': result.required, 'probes': [asdict(probe) for probe in result.probes]}


def _share(result: Result, direction: str) -> str:
    probes = [probe for probe in result.probes if probe.direction == direction]
    return f'{direction} {sum(probe.seen for probe in probes)}'


def write_csv(path: Path, results: Sequence[Result]) -> None:
    """A row for each place and direction."""
    files.write_csv(path, ('test', 'direction', 'x', 'y', 'detected'),
                    ([result.name, probe.direction, *(f'{v:.3f}' for v in probe.place),
                      'yes' if probe.seen else 'no']
                     for result in results for probe in result.probes))


def draw(path: Path, title: str, results: Sequence[Result]) -> None:
    """Writes the figure: a plan for each test, the detector below, facing up."""
    figure, axes = files.pyplot().subplots(1, len(results), squeeze=False, layout='constrained',
                                           figsize=(1 + 5.2 * len(results), 5.4))
    for axis, result in zip(axes[0], results):
        _plan(axis, result)
    verdict = 'PASS' if all(result.passed for result in results) else 'FAIL'
    figure.suptitle(f'{title}: {verdict}')
    files.save_figure(figure, path, dpi=100)


def _plan(axis: Any, result: Result) -> None:
    """One test's plan. The detector's left is drawn on the left."""
    from matplotlib.patches import Rectangle, Wedge
    for (x, y), seen in result.places.items():
        if result.cell:
            half = result.cell / 2
            axis.add_patch(Rectangle((y - half, x - half), result.cell, result.cell,
                                     facecolor=SEEN if seen else MISSED, edgecolor='white'))
    for probe in result.probes:
        if probe.start == probe.end:
            axis.plot(probe.place[1], probe.place[0], 'P', color=_color(result, probe.seen))
        else:
            _arrow(axis, result, probe)
    half_angle = result.area.angle / 2
    axis.add_patch(Wedge((0, 0), result.area.reach, 90 - half_angle, 90 + half_angle, fill=False,
                         edgecolor='dimgray', linestyle='--'))
    axis.plot(0, 0, marker='^', color='black', markersize=10, clip_on=False)
    margin = 0.8 if result.cell else 2.0
    side = max(result.area.half_width, 1.0) + margin
    axis.set_xlim(side, -side)
    axis.set_ylim(-0.5, result.area.reach + margin)
    axis.set_aspect('equal')
    axis.set_xlabel('to its left and right, m')
    axis.set_ylabel('away from the detector, m')
    axis.set_title(f'{result.name}: {100 * math.floor(1000 * result.share) / 1000:.0f} %',
                   fontsize='medium')
    axis.legend(handles=_legend(result), loc='upper center', bbox_to_anchor=(0.5, -0.12), ncols=2,
                fontsize='small', frameon=False)


def _color(result: Result, seen: bool) -> str:
    """The color of a walk or an arm: on cells it differs from theirs."""
    if result.cell:
        return 'black' if seen else 'white'
    return SEEN_WALK if seen else MISSED_WALK


def _arrow(axis: Any, result: Result, probe: Probe) -> None:
    """The middle of a walk; of two walks through one cell neither hides the other."""
    (x0, y0), (x1, y1) = probe.start, probe.end
    shrink, shift = (0.15, 0.0) if result.cell else (0.0, 0.0)
    if result.cell and len({p.direction for p in result.probes}) > 1:
        shrink, shift = 0.22, SHIFTS.get(probe.direction, 0.0) * result.cell
    axis.annotate('', (y1 + shrink * (y0 - y1), x1 + shrink * (x0 - x1) + shift),
                  (y0 + shrink * (y1 - y0), x0 + shrink * (x1 - x0) + shift),
                  arrowprops={'arrowstyle': '-|>', 'color': _color(result, probe.seen),
                              'lw': 1.3, 'mutation_scale': 9, 'shrinkA': 0, 'shrinkB': 0})


def _legend(result: Result) -> list[Any]:
    """A handle for each thing that the plan shows."""
    from matplotlib.lines import Line2D
    handles = []
    arm = any(probe.start == probe.end for probe in result.probes)
    for seen, word in ((True, 'detected'), (False, 'missed')):
        if result.cell:
            handles.append(Line2D([], [], color=SEEN if seen else MISSED, marker='s', ls='',
                                  markersize=9, label=f'place {word}'))
        if any(probe.seen is seen for probe in result.probes):
            handles.append(Line2D([], [], color=_color(result, seen), markeredgecolor='gray',
                                  markeredgewidth=0.6, marker='P' if arm else r'$\rightarrow$',
                                  ls='', markersize=9 if arm else 13,
                                  label=f'{"arm" if arm else "walk"} {word}'))
    return [*handles,
            Line2D([], [], color='dimgray', ls='--', label='area that it is declared to cover'),
            Line2D([], [], color='black', marker='^', ls='', label='detector')]
