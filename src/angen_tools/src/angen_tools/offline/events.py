"""Events as rows of a CSV file."""
import re
from typing import Any

COLUMNS = ('time', 'source', 'kind', 'event', 'detail', 'quantity', 'value', 'unit')
# "difference 0.11 m", "magnet at 0.02 m", "from 0 to 130 lx", "floor 1", "120 g", "3 ml in all"
QUANTITY = re.compile(
    r'(?:from \S+ to |(?P<quantity>[a-z][a-z ]*?)(?: at)? )?'
    r'(?P<value>-?\d+(?:\.\d+)?(?:e[-+]?\d+)?)(?: (?P<unit>[^\W\d_]\S*|%))?(?:,.*| in all)?')


def row(time: float, source: str, kind: str, event: str, detail: str) -> tuple[Any, ...]:
    """A row of COLUMNS; `time` in s. The value of a detail is in columns of its own, which are
    blank where it has none."""
    found = QUANTITY.fullmatch(detail)
    values = found.group('quantity', 'value', 'unit') if found else ()
    return (seconds(time), source, kind, event, detail, *(values or ('', '', '')))


def seconds(time: float) -> str:
    """A time in s without zeros at its end: 0.3."""
    return repr(round(time, 6)).removesuffix('.0')
