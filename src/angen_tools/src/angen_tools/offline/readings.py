"""All readings of a run as one long table: a row for each field of each reading."""
import csv
import gzip
import io
import math
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any, Callable, Iterator, Protocol

from angen_tools.common.failure import Failure
from angen_tools.common.files import later_signals, writing
from angen_tools.offline.events import seconds

COLUMNS = ('time', 'kind', 'name', 'field', 'value', 'unit', 'text')
LEVEL = 3  # gzip's level: twice as quick as its default, and a tenth larger


class Writer(Protocol):
    """Writes the readings that a world has kept since the last call."""

    def write(self, world: Any) -> int: ...


class CsvWriter:
    """As CSV. A flag is 0 or 1; `text` has texts and the names of choices."""

    def __init__(self, file: IO[bytes]) -> None:
        self._file = file
        self._file.write((','.join(COLUMNS) + '\n').encode())
        self._heads: list[str] = []
        self._tails: list[str] = []

    def write(self, world: Any) -> int:
        rows = world.take_readings()
        self._describe(world.reading_series)
        texts = {row: _line([text]) for row, text in rows['texts'].items()}
        heads, tails = self._heads, self._tails
        lines = [
            f'{time}{heads[one]}{value}{tails[one]}{texts.get(row, "")}\n'
            for row, (time, one, value) in enumerate(zip(
                _texts(rows['time'], seconds), rows['series'].tolist(),
                _texts(rows['value'], _number)))]
        self._file.write(''.join(lines).encode())
        return len(lines)

    def _describe(self, series: list[tuple[str, ...]]) -> None:
        for kind, name, field, unit, _ in series[len(self._heads):]:
            self._heads.append(f',{_line([kind, name, field])},')
            self._tails.append(f',{_line([unit])},')


class ParquetWriter:
    """As Parquet, in which texts that repeat take no space."""

    def __init__(self, file: IO[bytes]) -> None:
        import pyarrow
        from pyarrow import parquet
        word = pyarrow.dictionary(pyarrow.int32(), pyarrow.string())
        types = dict.fromkeys(COLUMNS, word) | {'time': pyarrow.float64(),
                                                'value': pyarrow.float64()}
        self._arrow, self._schema = pyarrow, pyarrow.schema(types)
        self._writer = parquet.ParquetWriter(file, self._schema)

    def write(self, world: Any) -> int:
        rows, series = world.take_readings(), world.reading_series
        count = len(rows['time'])
        if not count:
            return 0
        arrow = self._arrow
        columns = {name: arrow.DictionaryArray.from_arrays(
            arrow.array(rows['series'].astype('int32')),
            arrow.array([one[place] for one in series])).cast(arrow.string()).dictionary_encode()
            for place, name in enumerate(('kind', 'name', 'field', 'unit'))}
        texts = rows['texts']
        columns |= {'time': arrow.array(rows['time']),
                    'value': arrow.array(rows['value'], from_pandas=True),
                    'text': arrow.array([texts.get(row) for row in range(count)],
                                        arrow.string()).dictionary_encode()}
        self._writer.write_table(arrow.table([columns[name] for name in COLUMNS], self._schema))
        return count

    def close(self) -> None:
        self._writer.close()


def _texts(numbers: Any, text: Callable[[float], str]) -> list[str]:
    """The text of each number. Times and readings repeat: equal ones become text once."""
    import numpy
    bits, places = numpy.unique(numbers.view('int64'), return_inverse=True)
    texts = [text(number) for number in bits.view('float64').tolist()]
    return [texts[place] for place in places.tolist()]


def _number(value: float) -> str:
    return '' if math.isnan(value) else f'{value:.9g}'


def _line(words: list[str]) -> str:
    """Words as CSV."""
    text = io.StringIO()
    csv.writer(text, lineterminator='').writerow(words)
    return '' if words == [''] else text.getvalue()


def check_name(path: Path) -> None:
    """Failure if such a table cannot be written."""
    if path.suffix == '.parquet':
        try:
            import pyarrow.parquet  # noqa: F401
        except ImportError as error:
            raise Failure(f"{path}: Parquet needs pyarrow ({error}); pip install 'pyarrow<20', or "
                          'give a name that ends in .csv.gz') from None
    elif not path.name.endswith(('.csv', '.csv.gz')):
        raise Failure(f'{path}: the name of a table of readings ends in .csv, .csv.gz or .parquet')


@contextmanager
def reading_table(path: Path) -> Iterator[Writer]:
    """Writes a table of readings; the end of its name says how. After Ctrl-C it has those until
    then."""
    with writing(path, binary=True, log=True) as file:
        if path.suffix == '.parquet':
            table = ParquetWriter(file)
            try:
                yield table
            finally:
                table.close()
        elif path.suffix == '.gz':
            with gzip.GzipFile('', 'wb', LEVEL, file, mtime=0) as packed:
                with later_signals():
                    lines = CsvWriter(packed)  # type: ignore[arg-type]
                yield lines
        else:
            yield CsvWriter(file)
