"""Automations over entities without a simulator: a home whose states a test sets."""
import datetime
from pathlib import Path
from typing import Any

from angen_apps.automation.automation_file import read_automations
from angen_apps.automation.automations import Service
from angen_apps.automation.engine import Engine, Sky
from angen_apps.automation.entities import Entities
from angen_tools.session import State
from tests.angen_apps.mqtt.fakes import FakeWorld

MOTION, LAMP = 'binary_sensor.hall_motion_sensor', 'light.hall_lamp'
START = datetime.datetime(2026, 3, 23, 18)


class Told(FakeWorld):
    """Its states are those that were told last."""

    def __init__(self) -> None:
        super().__init__('pir/hall', 'lamp/hall', 'luminosity/hall')
        self.told: dict[tuple[str, str], dict[str, Any]] = {
            ('pir', 'hall'): {'motion': False}, ('lamp', 'hall'): {'on': False, 'level': 0.0},
            ('luminosity', 'hall'): {'illuminance': 5.0}}

    def state(self, kind: str, name: str) -> State:
        return State(kind, name, 0.0, self.told[kind, name])


class Stage:
    """Runs a file of automations; `called` are the services, with their times."""

    def __init__(self, folder: Path, text: str, start: datetime.datetime = START) -> None:
        self.world: Any = Told()
        self.entities = Entities(self.world)
        self.entities.read(list(self.entities.things), 0.0)
        (folder / 'automations.yaml').write_text(text)
        self.called: list[tuple[float, str]] = []
        self.engine = Engine(read_automations(folder / 'automations.yaml', self.entities),
                             self.entities, Sky(start, 48.1), self._order)

    def _order(self, service: Service, by: str) -> None:
        self.called.append((round(self.engine.now, 3), service.name.rpartition('.')[2]))

    def until(self, time: float) -> None:
        """Time passes."""
        while self.engine.due <= time:
            self.engine.advance(max(self.engine.due, self.engine.now))
        self.engine.now = time

    def tell(self, time: float, kind: str, **values: Any) -> None:
        """A state changes."""
        self.until(time)
        self.world.told[kind, 'hall'] = values
        for change in self.entities.read([(kind, 'hall')], time):
            self.engine.observe(*change)
        self.until(time)

    def motion(self, time: float, on: bool) -> None:
        self.tell(time, 'pir', motion=on)
