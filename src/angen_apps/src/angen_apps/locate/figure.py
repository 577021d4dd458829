"""A picture of where tags were located: on the plan of the home, beside the truth."""
from collections import Counter
from itertools import cycle
from pathlib import Path
from typing import Any, Sequence

import numpy as np

from angen_apps.locate.score import Row
from angen_apps.plan import overlays
from angen_apps.plan.draw import DPI, Scene, is_on, sheet
from angen_tools.common.files import save_figure

DISC = 18.0  # points^2 of a disc a second
LABELED = 5  # s, at least, of a disc that says its time
WRONG = '#101010'


def draw(path: Path, rows: Sequence[Row], scene: Scene) -> None:
    """The true way of each tag, and a disc where it was located, the larger the longer; crosses
    are answers with a wrong room."""
    tags = sorted({row.answer.tag for row in rows})
    own = {tag: [row for row in rows if row.answer.tag == tag] for tag in tags}
    ways = {f'{tag}, in truth': np.array([(*row.true_at, np.nan) for row in own[tag]])
            for tag in tags}
    heights = [z for row in rows for z in (row.true_at[2], row.answer.at[2])]
    figure, axes = sheet(scene, [storey for storey in scene.drawn()
                                 if any(is_on(z, storey) for z in heights)])
    for axis, storey in axes:
        overlays.draw(axis, scene, storey, overlays.Data(tracks=ways), overlays.What())
        for tag, color in zip(tags, cycle(overlays.TRACKS)):
            here = [row for row in own[tag] if is_on(row.answer.at[2], storey)]
            _located(axis, here, tag, color, _every(own[tag]))
        axis.legend(loc='lower right', fontsize=6)
    save_figure(figure, path, dpi=DPI)


def _every(rows: Sequence[Row]) -> float:
    """Seconds between two answers."""
    return (rows[-1].time - rows[0].time) / max(1, len(rows) - 1)


def _located(axis: Any, rows: Sequence[Row], tag: str, color: str, every: float) -> None:
    """Answers of a storey, one in `every` s: each place with the number of seconds there."""
    axis.scatter([], [], s=30, color=color, alpha=0.5, lw=0, label=f'{tag}, as located')
    places = Counter((round(row.answer.at[0], 1), round(row.answer.at[1], 1)) for row in rows)
    for (x, y), count in places.items():
        seconds = count * every
        axis.scatter([x], [y], s=DISC * seconds, color=color, alpha=0.3, lw=0, zorder=9)
        if seconds >= LABELED:
            axis.text(x, y - 0.2, f'{seconds:.0f} s', fontsize=6, ha='center', va='top', zorder=10)
    wrong = [row.answer.at for row in rows if not row.right]
    if wrong:
        axis.scatter(*np.array(wrong)[:, :2].T, s=14, marker='x', color=WRONG, lw=0.8, zorder=11,
                     label=f'{tag}, in a wrong room')
