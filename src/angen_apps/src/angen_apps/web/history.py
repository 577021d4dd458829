"""The readings of a whole run, of which the older ones get fewer: memory stays within TOTAL."""
import threading
from array import array
from typing import Any, Iterator

TOTAL = 3_000_000  # values of all series, of 16 bytes each
MOST, LEAST = 3000, 64  # values of a series
SERIES = 50_000  # the oldest is dropped for one more
BLOCK = 4  # older values, whose least and greatest stay
NUMBERS = ('flag', 'integer', 'number')  # types of fields that summaries have
Key = tuple[str, str, int]  # kind, name, index of the field


def numbers(kind: dict[str, Any]) -> list[dict[str, Any]]:
    """The fields of a kind whose values are in its summaries, in that order."""
    return [field for field in kind.get('fields', ()) if field['type'] in NUMBERS]


class Series:
    """Values of a field with their times."""

    def __init__(self) -> None:
        self.times, self.values = array('d'), array('d')

    def put(self, time: float, value: float, most: int) -> None:
        """`most`: values that are kept."""
        times, values = self.times, self.values
        if times and time <= times[-1]:
            return
        if len(times) > 1 and values[-1] == value == values[-2]:  # a level line has two ends
            times[-1] = time
            return
        times.append(time)
        values.append(value)
        if len(times) > most:
            self._thin()

    def _thin(self) -> None:
        """Fewer values in the older half, without the loss of a peak."""
        half, values, kept = len(self.times) // 2, self.values, list[int]()
        for first in range(0, half, BLOCK):
            block = range(first, min(first + BLOCK, half))
            kept += sorted({min(block, key=values.__getitem__), max(block, key=values.__getitem__)})
        kept += range(half, len(values))
        self.times = array('d', [self.times[i] for i in kept])
        self.values = array('d', [values[i] for i in kept])


class History:
    """Filled by threads of ROS, read by the server."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._series: dict[Key, Series] = {}

    def put(self, kind: str, name: str, time: float, values: list[float | None]) -> None:
        """The values of the fields of a sensor or device at a time."""
        with self._lock:
            most = max(LEAST, min(MOST, TOTAL // max(1, len(self._series))))
            for index, value in enumerate(values):
                if value is not None:
                    key = kind, name, index
                    series = self._series.get(key)
                    if series is None:
                        if len(self._series) >= SERIES:  # things came and went
                            del self._series[next(iter(self._series))]
                        series = self._series[key] = Series()
                    series.put(time, value, most)

    def clear(self) -> None:
        """Another run."""
        with self._lock:
            self._series.clear()

    def __len__(self) -> int:
        """Values that are kept."""
        with self._lock:
            return sum(len(series.times) for series in self._series.values())

    def of(self, kind: str, name: str, index: int) -> tuple[list[float], list[float]]:
        """Times and values of a field."""
        with self._lock:
            series = self._series.get((kind, name, index)) or Series()
            return series.times.tolist(), series.values.tolist()

    def table(self, fields: dict[str, list[dict[str, Any]]]) -> Iterator[str]:
        """CSV, a part for each field; `fields` that have values, by kind."""
        yield 'time,kind,name,field,value,unit\n'
        with self._lock:
            keys = list(self._series)
        for kind, name, index in keys:
            known = fields.get(kind, [])
            field = known[index] if index < len(known) else {'name': str(index), 'unit': ''}
            same = f'{cell(kind)},{cell(name)},{cell(field["name"])}'
            unit = cell(field['unit'])
            yield ''.join(f'{time:.10g},{same},{value:.10g},{unit}\n'
                          for time, value in zip(*self.of(kind, name, index)))


def cell(text: str) -> str:
    """A cell of a table, quoted where it must be."""
    quoted = text.replace('"', '""')
    return f'"{quoted}"' if set(text) & set(',"\r\n') else text
