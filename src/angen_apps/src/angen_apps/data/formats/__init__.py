"""Writers of data sets. Each has write(folder, data), which returns the files that it wrote."""
from __future__ import annotations

from pathlib import Path
from typing import Callable

from angen_apps.data.formats import aras, casas, kasteren, openshs, power, table, xes
from angen_apps.data.run import Data

Writer = Callable[[Path, Data], list[Path]]

FORMATS: dict[str, Writer] = {
    'casas': casas.write, 'casas-columns': casas.write_columns, 'aras': aras.write,
    'kasteren': kasteren.write, 'openshs': openshs.write, 'csv': table.write,
    'parquet': table.write_parquet, 'xes': xes.write, 'power': power.write}
