"""bench/history.csv: the ratios of angen bench core, for each release."""
import csv
from pathlib import Path
from typing import Mapping, Sequence

from angen_tools.common.files import write_csv

FILE = Path(__file__).resolve().parents[1] / 'history.csv'
COLUMNS = ('release', 'case', 'against', 'ratio', 'commit')


def add(file: Path, release: str, rows: Sequence[Mapping[str, str]]) -> int:
    """Writes the rows with a ratio behind those of other releases; returns their number.

    They replace rows of the same release.
    """
    others: list[Mapping[str, str]] = []
    if file.exists():
        with file.open(newline='', encoding='utf-8') as text:
            others = [row for row in csv.DictReader(text) if row['release'] != release]
    measured = [{**row, 'release': release} for row in rows if row['ratio']]
    write_csv(file, COLUMNS, ([row[key] for key in COLUMNS] for row in [*others, *measured]))
    return len(measured)
