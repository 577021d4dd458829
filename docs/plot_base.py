"""Worlds, runs and axes of the plots; docs/plots.py draws them."""
import sys
from pathlib import Path
from typing import Callable, Iterable, Mapping, Sequence

import angen
import matplotlib.pyplot as plt
import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / 'tests/py'))
from sdf_text import air, box, holder, include, sdf_world, sensor, walker  # noqa: E402, F401

PLUGINS = '''<plugin name="doors" filename="libdoor_world_plugin.so"/>
<plugin name="robots" filename="librobot_controller.so">
<wheelDiameter>0.0704</wheelDiameter></plugin>'''
Order = tuple[int, str, str, str]  # the step before which it is given, kind, name, text


def world(content: str) -> angen.World:
    """A floor, the plug-ins of doors and robots, and `content`."""
    return angen.World.from_text(sdf_world(content, PLUGINS), seed=1)


def sampled(w: angen.World, seconds: float, count: int, read: Callable[[], Iterable[float]],
            orders: Iterable[Order] = ()) -> tuple[np.ndarray, list[np.ndarray]]:
    """Runs `count` steps of `seconds`. The time after each, s, and the values that `read` returns
    then, as columns."""
    rows = []
    for step in range(count):
        for at, *order in orders:
            if at == step:
                w.command(*order)
        w.run(seconds)
        rows.append((w.time, *read()))
    times, *columns = np.array(rows, float).T
    return times, columns


def figure(rows: int, heading: str) -> tuple[plt.Figure, list[plt.Axes]]:
    """Axes below each other that share their x."""
    drawn, axes = plt.subplots(rows, 1, sharex=True, figsize=(7, 1.2 + 1.8 * rows), squeeze=False)
    axes[0][0].set_title(heading, fontsize=10)
    for ax in axes[:, 0]:
        ax.grid(alpha=0.3)
    return drawn, list(axes[:, 0])


def curves(ax: plt.Axes, x: Sequence[float], unit: str, columns: Mapping[str, Sequence[float]],
           x_unit: str = '', mark: str = '-') -> None:
    """Draws columns by their labels; '' is one without."""
    for label, values in columns.items():
        ax.plot(x, values, mark, label=label or None)
    ax.set_ylabel(unit)
    if x_unit:
        ax.set_xlabel(x_unit)
    if any(columns):
        ax.legend()


def states(ax: plt.Axes, times: Sequence[float], flags: Sequence[float], words: Sequence[str]
           ) -> None:
    """Draws a flag over the time in s; `words` for false and true."""
    ax.step(times, flags, where='post')
    ax.set_yticks([0, 1], words)
    ax.set_xlabel('s')
