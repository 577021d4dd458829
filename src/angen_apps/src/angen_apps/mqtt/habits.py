"""Habits of hardware: what a thing reports, and when."""
import math
from dataclasses import dataclass
from pathlib import Path

from angen_apps.mqtt.table import Component, Part
from angen_apps.mqtt.things import Thing
from angen_apps.mqtt.values import Value
from angen_tools.common.catalog import kinds
from angen_tools.common.clock import DAY
from angen_tools.common.yaml_file import YamlFile

SHOP = Path(__file__).with_name('profiles.yaml')
KEYS = ('hold', 'delay', 'step', 'every', 'battery')
PERIOD = 6 * 3600.0  # s between two reports of a battery
BATTERY = Component(
    'sensor', 'battery', 'Battery', {'device_class': 'battery', 'unit_of_measurement': '%',
                                     'state_class': 'measurement'},
    (Part('battery', field='battery level', type='number'),))


@dataclass
class Report:
    """The last report of a value, and the change that waits."""

    value: Value
    time: float
    waits: Value = None
    due: float = math.inf


def read(path: Path) -> dict[str, dict[str, float]]:
    """The habits of a file, by kind; Failure has file and line of an error."""
    file = YamlFile(path)
    found = {}
    for kind, node in file.entries(file.root, 'the file', kinds()).items():
        entries = file.entries(node, kind, KEYS)
        found[kind] = {key: file.number(value, key, 0.0, 1e9) for key, value in entries.items()}
    return found


class Habits:
    """Those of one profile; times are simulated."""

    def __init__(self, path: Path | None = None) -> None:
        self._kinds = read(path) if path else {}
        self._reports: dict[tuple[tuple[str, str], str], Report] = {}

    def __bool__(self) -> bool:
        return bool(self._kinds)

    def equip(self, thing: Thing) -> None:
        """Gives a thing its battery."""
        if self._kinds.get(thing.kind, {}).get('battery') and BATTERY not in thing.components:
            thing.components.append(BATTERY)

    def charge(self, thing: Thing, now: float) -> None:
        """Sets the level of a thing's battery."""
        days = self._kinds.get(thing.kind, {}).get('battery')
        if days:
            level = 100.0 * (1.0 - now / (days * DAY))
            thing.fields['battery level'] = max(level, 0.0)

    def forget(self) -> None:
        """After a reset of time."""
        self._reports.clear()

    def shown(self, thing: Thing, part: Part, value: Value, now: float) -> Value:
        """The value that the thing reports now."""
        habit = self._kinds.get(thing.kind)
        if not habit:
            return value
        key = thing.key, part.key
        report = self._reports.get(key)
        if report is None or now < report.time:
            self._reports[key] = Report(value, now)
            return value
        if value == report.value:
            report.due = math.inf
        elif value != report.waits or not math.isfinite(report.due):
            report.waits = value
            report.due = self._due(habit, part, report, value, now)
        if report.due <= now:
            self._reports[key] = Report(report.waits, now)
        return self._reports[key].value

    @staticmethod
    def _due(habit: dict[str, float], part: Part, report: Report, value: Value, now: float
             ) -> float:
        if isinstance(value, bool) or isinstance(report.value, bool):
            off = value is False and report.value is True
            return now + (habit.get('hold', 0.0) if off else 0.0) + habit.get('delay', 0.0)
        if part.field == BATTERY.parts[0].field:
            return report.time + PERIOD
        if isinstance(value, float) and isinstance(report.value, float):
            if abs(value - report.value) < habit.get('step', 0.0) - 1e-9:
                return report.time + habit.get('every', 0.0)
        return now

    def waiting(self, now: float) -> set[tuple[str, str]]:
        """The things of which a report is due."""
        return {key for (key, _), report in self._reports.items() if report.due <= now}
