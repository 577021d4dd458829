"""The sun's place against an ephemeris (VSOP87 by libastro, 1010 hPa, 10 C), and in the page."""
import json
import math
import random
import subprocess
from datetime import datetime, timedelta
from pathlib import Path

import pytest

from angen_tools.common.sun import equatorial, sun

PAGE = Path(__file__).resolve().parents[3] / 'src/angen_apps/page/js/daylight.js'
# Universal time at longitude 0, latitude, elevation as it appears, azimuth (degrees).
EPHEMERIS = [
    ('2037-06-23T10:56:54', 10.67, 69.867, 48.650),
    ('1962-01-01T12:41:00', 23.34, 42.772, 191.784),
    ('2008-07-06T11:08:34', 6.5, 68.941, 38.611),
    ('2045-02-23T16:37:26', -25.28, 25.655, 271.375),
    ('1964-02-29T11:52:43', 60.66, 21.420, 174.720),
    ('2033-11-24T03:05:45', -64.45, 3.450, 134.279),
    ('2017-11-12T08:52:43', 58.79, 5.908, 139.382),
    ('2014-01-24T15:16:47', -26.08, 47.039, 269.448),
    ('1987-01-16T09:36:55', 19.61, 34.844, 135.345),
    ('1964-05-04T06:36:06', -10.69, 6.465, 72.361),
    ('2028-04-04T08:56:42', 42.73, 34.975, 118.255),
    ('1986-10-24T12:45:29', 46.35, 30.313, 197.423),
]


def direction(elevation: float, azimuth: float) -> tuple[float, float, float]:
    """East, north, up."""
    level = math.cos(elevation)
    return level * math.sin(azimuth), level * math.cos(azimuth), math.sin(elevation)


@pytest.mark.parametrize('moment, latitude, elevation, azimuth', EPHEMERIS)
def test_the_sun_is_within_a_twentieth_of_a_degree(moment: str, latitude: float, elevation: float,
                                                   azimuth: float) -> None:
    found = direction(*sun(datetime.fromisoformat(moment), latitude))
    right = direction(math.radians(elevation), math.radians(azimuth))
    assert math.degrees(math.dist(found, right)) < 0.05


def test_the_equation_of_time_has_its_known_extremes() -> None:
    minutes = [math.degrees(equatorial(datetime(2026, 1, 1, 12) + timedelta(days=day))[1]) * 4
               for day in range(365)]
    assert min(minutes) == pytest.approx(-14.2, abs=0.1)  # February 11
    assert max(minutes) == pytest.approx(16.4, abs=0.1)   # November 3


def test_the_page_has_the_same_sun(tmp_path: Path) -> None:
    draw = random.Random(1)
    cases = [((datetime(1990, 1, 1) + timedelta(seconds=draw.randrange(50 * 365 * 86400))),
              draw.uniform(-80, 80), draw.uniform(0, 6)) for _ in range(200)]
    script = tmp_path / 'sun.mjs'
    given = json.dumps([[moment.isoformat(), *angles] for moment, *angles in cases])
    script.write_text(f'import {{ sunAt }} from {json.dumps(str(PAGE))};\nconst cases = {given};\n'
                      'console.log(JSON.stringify(cases.map(([start, latitude, north]) =>'
                      ' sunAt({ start, latitude, north }, 0))));\n')
    done = subprocess.run(['node', str(script)], capture_output=True, text=True, check=True)
    for (moment, latitude, north), (x, y, z) in zip(cases, json.loads(done.stdout)):
        east, to_north, up = direction(*sun(moment, latitude))
        expected = (to_north * math.cos(north) + east * math.sin(north),
                    to_north * math.sin(north) - east * math.cos(north), up)
        assert (x, y, z) == pytest.approx(expected, abs=1e-9)
