"""The illuminance in a room by daylight through its window."""
from __future__ import annotations

import datetime
import math

FACTOR = 0.015  # of the light outside that comes to the eyes in a room with a window
TILT = 23.44  # degrees, of the earth's axis


def elevation(day: datetime.date, seconds: float, latitude: float) -> float:
    """The sun's elevation in rad; the clock is taken as solar time."""
    turn = 2 * math.pi * (day.timetuple().tm_yday - 81) / 365.0
    declination = math.radians(TILT) * math.sin(turn)
    hour = math.radians((seconds / 3600.0 - 12.0) * 15.0)
    phi = math.radians(latitude)
    return math.asin(math.sin(phi) * math.sin(declination)
                     + math.cos(phi) * math.cos(declination) * math.cos(hour))


def daylight(day: datetime.date, seconds: float, latitude: float) -> float:
    """lx at the eyes, under an overcast sky (Krochmann: 300 + 21000 sin of the elevation)."""
    up = math.sin(elevation(day, seconds, latitude))
    return FACTOR * (300.0 + 21000.0 * up) if up > 0 else 0.0
