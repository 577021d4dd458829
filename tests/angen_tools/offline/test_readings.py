"""The table of all readings of a run as CSV."""
import io
import math
from types import SimpleNamespace

import numpy

from angen_tools.offline.readings import CsvWriter


def test_numbers_are_written_as_each_alone_would_be():
    """Equal ones become text together; a text may look like a number that is none."""
    times = [0.1, 0.1, 0.1, 0.2, 0.2, 86400.25]
    values = [0.0, -0.0, math.nan, 1e9 + 0.5, 21.0, 21.0]
    world = SimpleNamespace(
        reading_series=[('pir', 'eye', 'signal', 'V', 0), ('rfid', 'gate', 'tag', '', 0)],
        take_readings=lambda: {
            'time': numpy.array(times), 'series': numpy.array([0, 0, 1, 0, 0, 0], 'uint32'),
            'value': numpy.array(values), 'texts': {2: 'a,nan,b'}})
    file = io.BytesIO()
    assert CsvWriter(file).write(world) == len(values)
    assert file.getvalue().decode().splitlines()[1:] == [
        '0.1,pir,eye,signal,0,V,', '0.1,pir,eye,signal,-0,V,', '0.1,rfid,gate,tag,,,"a,nan,b"',
        '0.2,pir,eye,signal,1e+09,V,', '0.2,pir,eye,signal,21,V,', '86400.25,pir,eye,signal,21,V,']
