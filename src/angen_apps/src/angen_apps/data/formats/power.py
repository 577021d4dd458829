"""The home's power at 1 Hz: of the mains, and of each appliance."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from angen_apps.data.formats.periods import zipped
from angen_apps.data.run import Data
from angen_tools.common.clock import DAY

EPOCH = 719163  # days from year 1 to 1970


def write(folder: Path, data: Data) -> list[Path]:
    """power.csv.gz: seconds since 1970 (of the local clock), mains and appliances in W."""
    path = folder / 'power.csv.gz'
    names = sorted(data.power)
    base = (data.start.toordinal() - EPOCH) * int(DAY)
    count = int(data.days * DAY)
    watts = np.zeros((len(names), count))
    for line, name in zip(watts, names):
        for time, value in data.power[name]:
            line[min(int(np.ceil(time)), count):] = value
    mains = watts.sum(axis=0)
    changes = np.flatnonzero((watts[:, 1:] != watts[:, :-1]).any(axis=0)) + 1
    with zipped(path) as file:
        file.write(','.join(['time', 'mains', *names]) + '\n')
        edges = [0, *changes.tolist(), count]
        for a, b in zip(edges, edges[1:]):
            rest = ','.join(f'{value:g}' for value in (mains[a], *watts[:, a]))
            file.writelines(f'{base + second},{rest}\n' for second in range(a, b))
    return [path]
