"""Where the sun is, by the clock of a home: local mean time, without a time zone."""
import datetime
import math

from angen_tools.common.clock import DAY

J2000 = datetime.datetime(2000, 1, 1, 12)
CENTURY = 36525.0  # days


def equatorial(moment: datetime.datetime) -> tuple[float, float]:
    """The sun's declination and the equation of time (apparent less mean time), both in rad.

    Source: J. Meeus, Astronomical Algorithms, chapters 22, 25 and 28, the lower accuracy of
    0.01 degrees.
    """
    t = (moment - J2000).total_seconds() / DAY / CENTURY
    mean = 280.46646 + 36000.76983 * t
    anomaly = math.radians(357.52911 + 35999.05029 * t)
    center = ((1.914602 - 0.004817 * t) * math.sin(anomaly)
              + 0.019993 * math.sin(2 * anomaly) + 0.000289 * math.sin(3 * anomaly))
    node = math.radians(125.04 - 1934.136 * t)
    longitude = math.radians(mean + center - 0.00569 - 0.00478 * math.sin(node))
    tilt = math.radians(23.439291 - 0.0130042 * t + 0.00256 * math.cos(node))
    ascension = math.atan2(math.cos(tilt) * math.sin(longitude), math.cos(longitude))
    return (math.asin(math.sin(tilt) * math.sin(longitude)),
            math.remainder(math.radians(mean - 0.0057183) - ascension, 2 * math.pi))


def refraction(elevation: float) -> float:
    """How much higher (rad) than at this true elevation (rad) the sun appears.

    Source: T. Saemundsson, Sky and Telescope 72 (1986), 70; 1010 hPa, 10 C. None is added far
    below the horizon.
    """
    degrees = math.degrees(elevation)
    if degrees < -1.0:
        return 0.0
    return math.radians(1.02 / 60.0) / math.tan(math.radians(degrees + 10.3 / (degrees + 5.11)))


def sun(moment: datetime.datetime, latitude: float) -> tuple[float, float]:
    """Its apparent elevation, and its azimuth from north over east (both rad), seen from a
    latitude (degrees), within 0.1 degrees from 1950 to 2050.
    """
    declination, equation = equatorial(moment)
    midnight = moment.replace(hour=0, minute=0, second=0, microsecond=0)
    hour = 2 * math.pi * ((moment - midnight).total_seconds() / DAY - 0.5) + equation
    phi = math.radians(latitude)
    up = (math.sin(phi) * math.sin(declination)
          + math.cos(phi) * math.cos(declination) * math.cos(hour))
    north = (math.cos(phi) * math.sin(declination)
             - math.sin(phi) * math.cos(declination) * math.cos(hour))
    east = -math.cos(declination) * math.sin(hour)
    elevation = math.asin(max(-1.0, min(1.0, up)))
    return elevation + refraction(elevation), math.atan2(east, north) % (2 * math.pi)
