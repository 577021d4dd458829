"""A plain long table: one event a line, with its cause."""
from __future__ import annotations

from pathlib import Path
from typing import Any

from angen_apps.data.formats.periods import zipped
from angen_apps.data.run import Data
from angen_tools.common.failure import Failure
from angen_tools.common.files import writing

HEAD = ('time', 'sensor', 'kind', 'room', 'value', 'resident', 'activity', 'cause')


def rows(data: Data) -> list[tuple[str, ...]]:
    """The lines of the table."""
    found: list[tuple[str, ...]] = []
    for event in data.events:
        sensor = data.by_id[event.sensor]
        found.append((f'{data.at(event.time):%Y-%m-%d %H:%M:%S.%f}', event.sensor, sensor.kind,
                      sensor.room, event.value, event.resident, event.activity, event.cause))
    return found


def write(folder: Path, data: Data) -> list[Path]:
    """events.csv.gz."""
    path = folder / 'events.csv.gz'
    with zipped(path) as file:
        file.write(','.join(HEAD) + '\n')
        file.writelines(','.join(row) + '\n' for row in rows(data))
    return [path]


def pyarrow() -> Any:
    """The optional library; Failure if it is not installed."""
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError as error:
        raise Failure(f"parquet needs pyarrow ({error}); install it with `pip install "
                      "'pyarrow<20'`, or leave parquet out of --format") from None
    return pyarrow


def write_parquet(folder: Path, data: Data) -> list[Path]:
    """events.parquet."""
    arrow = pyarrow()
    columns = dict(zip(HEAD, zip(*rows(data)) if data.events else [()] * len(HEAD)))
    words = arrow.dictionary(arrow.int16(), arrow.string())
    typed = {name: arrow.array([word or None for word in column], words)
             for name, column in columns.items()}
    typed['time'] = arrow.array([data.at(event.time) for event in data.events],
                                arrow.timestamp('us'))
    typed['value'] = arrow.array(columns['value'], arrow.string())
    path = folder / 'events.parquet'
    with writing(path, binary=True) as file:
        arrow.parquet.write_table(arrow.table(typed), file, compression='zstd')
    return [path]
