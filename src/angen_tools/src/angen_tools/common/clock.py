"""Durations and times of day as people write them; in s."""
import re

MINUTE, HOUR, DAY = 60.0, 3600.0, 86400.0
UNITS = {'s': 1.0, 'min': MINUTE, 'm': MINUTE, 'h': HOUR, 'd': DAY}
PART = re.compile(r'(\d+(?:\.\d+)?)\s*(s|min|m|h|d)')


def duration(text: str) -> float:
    """The seconds of '10 min' or '1 h 30 min'; ValueError has the right form."""
    rest = PART.sub('', text).strip()
    parts = PART.findall(text)
    if rest or not parts:
        raise ValueError(f"'{text}' is not a duration; write it as 90 s, 10 min or 1 h 30 min")
    return sum(float(number) * UNITS[unit] for number, unit in parts)


def in_seconds(word: str) -> str:
    """The word with a duration in units in s; any other word as it is."""
    try:
        return f'{duration(word):.9g}'
    except ValueError:
        return word


def time_of_day(text: str) -> float:
    """The seconds since midnight of '22:30' or '6:05:30'; ValueError has the right form."""
    found = re.fullmatch(r'(\d{1,2}):(\d{2})(?::(\d{2}))?', text)
    hour, minute, second = (int(part or 0) for part in found.groups()) if found else (99, 0, 0)
    if minute > 59 or second > 59 or hour * HOUR + minute * MINUTE + second > DAY:
        raise ValueError(f"'{text}' is not a time of day; write it as 22:30, from 0:00 to 24:00")
    return hour * HOUR + minute * MINUTE + second


def show_duration(seconds: float) -> str:
    """In two units at most: '1 h 30 min', '40 min', '12 s'."""
    left = int(seconds + 0.5)
    parts = []
    for unit in ('d', 'h', 'min', 's'):
        count, left = divmod(left, int(UNITS[unit]))
        if count:
            parts.append(f'{count} {unit}')
    return ' '.join(parts[:2]) or '0 s'


def show_time(seconds: float) -> str:
    """The text of s since the first midnight: '22:30:05', after that day '+1 d 06:00:00'."""
    days, rest = divmod(int(seconds + 1e-6), int(DAY))
    text = f'{rest // 3600:02}:{rest // 60 % 60:02}:{rest % 60:02}'
    return f'+{days} d {text}' if days else text
