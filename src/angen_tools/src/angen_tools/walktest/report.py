"""What a walk test found: words, CSV, a plan of what was seen and what was not."""
from __future__ import annotations

import csv
import math
from dataclasses import asdict
from pathlib import Path
from typing import Any, Sequence

from angen_tools.walktest.plan import Result

SEEN, MISSED = '#7fb77e', '#d9534f'


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
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open('w', newline='', encoding='utf-8') as file:
        writer = csv.writer(file, lineterminator='\n')
        writer.writerow(['test', 'direction', 'x', 'y', 'detected'])
        for result in results:
            for probe in result.probes:
                x, y = probe.place
                writer.writerow([result.name, probe.direction, f'{x:.3f}', f'{y:.3f}',
                                 'yes' if probe.seen else 'no'])


def draw(path: Path, title: str, results: Sequence[Result]) -> None:
    """Writes the figure: a plan for each test, the detector below, looking up."""
    import matplotlib
    matplotlib.use('Agg')
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, len(results), squeeze=False, layout='constrained',
                                   figsize=(1 + 4.2 * len(results), 4.6))
    for axis, result in zip(axes[0], results):
        _plan(axis, result)
    verdict = 'PASS' if all(result.passed for result in results) else 'FAIL'
    figure.suptitle(f'{title}: {verdict}')
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=100)
    pyplot.close(figure)


def _plan(axis: Any, result: Result) -> None:
    """One test's plan. What the detector sees on its left is drawn on the left."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Rectangle, Wedge
    places = result.places
    for (x, y), seen in places.items():
        colour = SEEN if seen else MISSED
        if result.cell:
            half = result.cell / 2
            axis.add_patch(Rectangle((y - half, x - half), result.cell, result.cell,
                                     facecolor=colour, edgecolor='white'))
    for probe in result.probes:
        (x0, y0), (x1, y1) = probe.start, probe.end
        colour = 'black' if probe.seen else 'white'
        if not result.cell:
            colour = SEEN if probe.seen else MISSED
        if probe.start == probe.end:
            continue
        shrink = 0.3 if result.cell else 0.0
        axis.annotate('', (y1 + shrink * (y0 - y1), x1 + shrink * (x0 - x1)),
                      (y0 + shrink * (y1 - y0), x0 + shrink * (x1 - x0)),
                      arrowprops={'arrowstyle': '->', 'color': colour,
                                  'lw': 0.7 if result.cell else 1.5})
    half_angle = result.area.angle / 2
    axis.add_patch(Wedge((0, 0), result.area.reach, 90 - half_angle, 90 + half_angle, fill=False,
                         edgecolor='grey', linestyle='--'))
    axis.plot(0, 0, marker='^', color='black', markersize=9, clip_on=False)
    side = max(result.area.half_width, 1.0) + 1.0
    axis.set_xlim(side, -side)
    axis.set_ylim(-0.5, result.area.reach + 1.5)
    axis.set_aspect('equal')
    axis.set_xlabel('to its left and right, m')
    axis.set_ylabel('away from the detector, m')
    axis.set_title(f'{result.name}: {100 * math.floor(1000 * result.share) / 1000:.0f} %',
                   fontsize='medium')
    axis.legend(handles=[Line2D([], [], color=SEEN, marker='s', ls='', label='detected'),
                         Line2D([], [], color=MISSED, marker='s', ls='', label='missed')],
                loc='upper right', fontsize='small')
