"""A picture of situations: the room of each on a plan, the detector and its field, and the ways of
the cast."""
from math import ceil
from pathlib import Path
from tempfile import TemporaryDirectory
from textwrap import fill
from typing import Any, Sequence

import numpy as np

from angen_apps.plan import overlays
from angen_apps.plan.draw import DPI, INK, Scene, draw_storey, read_scene
from angen_apps.situations.cast import BEGINS, Part
from angen_apps.situations.report import Results, signal_of
from angen_apps.situations.stage import Outcome, furnished
from angen_tools.common.files import pyplot, save_figure, write_text

COLUMNS = 4
WIDE, HIGH = 3.4, 3.1  # inches of a situation
LETTERS = 46  # letters of a line
EVERY = 0.1  # s between two places of a way
PASSED, FAILED = '#2a7a3c', '#c8372d'


def draw(results: Results, path: Path) -> None:
    """Writes a plan for each row that was played."""
    rows = ceil(len(results) / COLUMNS)
    figure, axes = pyplot().subplots(rows, COLUMNS, squeeze=False,
                                     figsize=(COLUMNS * WIDE, rows * HIGH))
    for axis in axes.flat:
        axis.axis('off')
    with TemporaryDirectory() as folder:
        for axis, outcomes in zip(axes.flat, results):
            _draw_row(axis, outcomes, Path(folder) / 'situation.world')
    figure.tight_layout(h_pad=1.0)
    save_figure(figure, path, dpi=DPI)


def _draw_row(axis: Any, outcomes: Sequence[Outcome], copy: Path) -> None:
    row = outcomes[0].row
    world, parts = furnished(row, outcomes[0].model)
    write_text(copy, world.save())
    scene: Scene = read_scene(copy)
    storey = scene.drawn()[0]
    draw_storey(axis, scene, storey, None)
    ways = {f'cast{i}': _way(part) for i, part in enumerate(parts)}
    overlays.draw(axis, scene, storey, overlays.Data(tracks={
        name: way for name, way in ways.items() if len(way)}), overlays.What(sensors=True))
    if axis.get_legend():
        axis.get_legend().remove()
    for entry, part, way in zip(row.cast, parts, ways.values()):
        at = [*way[:1, :2].tolist(), *(model[2][:2] for model in part.models)]
        for x, y in at:
            axis.plot([x], [y], 'o', color=INK, ms=3, zorder=9)
            axis.text(x, y - 0.25, entry.get('who') or entry.get('model') or entry['thing'],
                      fontsize=6, ha='center', va='top', zorder=9,
                      bbox={'facecolor': 'white', 'alpha': 0.65, 'lw': 0, 'pad': 0.6})
    axis.set_title(fill(row.scene, LETTERS), fontsize=7)
    for i, outcome in enumerate(outcomes):
        text = f'{outcome.model}: {outcome.got}, {signal_of(outcome)}'
        if not outcome.passed:
            text += f'; expected {row.expected(outcome.model)}'
        axis.text(0.5, -0.02 - 0.07 * i, text, transform=axis.transAxes, fontsize=6.5, ha='center',
                  va='top', color=PASSED if outcome.passed else FAILED)


def _way(part: Part) -> np.ndarray:
    """The places (n, 4) of a puppet from the beginning to its end; empty without one."""
    places = [(puppet.start[0] + joints.get('x', 0.0), puppet.start[1] + joints.get('y', 0.0),
               0.0, np.nan)
              for puppet in part.puppets for t in np.arange(BEGINS, part.ends, EVERY)
              for joints in [puppet.script(float(t))]]
    return np.array(places).reshape(-1, 4)
