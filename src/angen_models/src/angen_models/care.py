"""Worlds of angen care: floor 0, and a person who spends a day in it, from 6:00 to 6:00."""
from dataclasses import dataclass, field
from math import atan2, hypot
from pathlib import Path

from angen_models import plan
from angen_models.sdf import write
from angen_models.things import add_tag
from angen_models.world import (add_actor, add_devices, add_home_site, add_openers, add_readers,
                                add_state, add_world_plugins, comment, furniture_in, include,
                                new_world)

BEGINS = 60 * int(plan.BEGINS[:2])      # min of the day at which the worlds begin
SPEED = 0.8             # m/s
PAUSE = 0.6             # s, to turn
HALL = 4.9              # y of the way along the entrance

# room: its door from the entrance's side, the first place behind it, and places in it
WAYS: dict[str, tuple[tuple[float, float], ...]] = {
    "kitchen": ((2.92, HALL), (2.92, 2.4), (3.3, 2.0), (2.3, 1.4), (2.5, 2.0)),
    "livingroom": ((4.82, HALL), (4.82, 2.75), (8.0, 2.75), (5.6, 2.75), (5.6, 1.4)),
    "bedroom": ((3.28, HALL), (3.28, 7.07), (2.94, 8.4), (2.0, 7.07)),
    "bathroom": ((5.98, HALL), (5.98, 7.2), (5.3, 7.4), (5.3, 6.8)),
    "workroom": ((6.2, 4.82), (7.6, 4.82), (8.6, 4.82), (8.4, 6.0)),
    "landing": ((0.7, 5.02), (-1.2, 5.02), (-1.8, 5.02)),
}


@dataclass
class Day:
    """A way through the apartment: rows of t (s), x, y, yaw."""

    room: str = "bedroom"
    rows: list[tuple[float, float, float, float]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._place = 0
        self._add(0.0, *WAYS[self.room][2])

    def _add(self, t: float, x: float, y: float) -> None:
        yaw = self.rows[-1][3] if self.rows else 0.0
        self.rows.append((t, x, y, yaw))

    def _go(self, x: float, y: float) -> None:
        t, x0, y0, _ = self.rows[-1]
        far = hypot(x - x0, y - y0)
        if far < 0.01:
            return
        yaw = atan2(y - y0, x - x0)
        self.rows.append((t + PAUSE, x0, y0, yaw))
        self.rows.append((t + PAUSE + far / SPEED, x, y, yaw))

    def at(self, clock: str, room: str, every: float = 0.0, until: str = "") -> None:
        """Enters a room at a time of day; there moves every `every` minutes until a time."""
        self._add(seconds(clock), *self.rows[-1][1:3])
        if room != self.room:
            self._go(*WAYS[self.room][1])
            self._go(*WAYS[self.room][0])
            for place in WAYS[room][:3]:
                self._go(*place)
            self.room, self._place = room, 0
        t = self.rows[-1][0] + 60 * every
        while every and t < seconds(until):
            self._place = (self._place + 1) % len(WAYS[room][2:])
            self._add(t, *self.rows[-1][1:3])
            self._go(*WAYS[room][2:][self._place])
            t = self.rows[-1][0] + 60 * every


def seconds(clock: str) -> float:
    """The seconds from the start of the world to a time of day such as 22:30."""
    hours, minutes = clock.split(":")
    return 60.0 * ((int(hours) * 60 + int(minutes) - BEGINS) % (24 * 60))


def ordinary() -> Day:
    """A day in which nothing is wrong."""
    day = Day()
    day.at("7:00", "bathroom", 3, "7:18")
    day.at("7:20", "kitchen", 2, "7:58")
    day.at("8:00", "livingroom", 12, "9:55")
    day.at("10:00", "landing")
    day.at("11:00", "livingroom", 12, "11:55")
    day.at("12:00", "kitchen", 2, "12:58")
    day.at("13:00", "bedroom", 30, "14:25")
    day.at("14:30", "livingroom", 15, "17:55")
    day.at("18:00", "kitchen", 2, "18:58")
    day.at("19:00", "livingroom", 12, "21:55")
    day.at("22:00", "bathroom", 3, "22:12")
    day.at("22:15", "bedroom", 45, "23:50")
    day.at("2:30", "bathroom", 2, "2:36")
    day.at("2:38", "bedroom")
    return day


def wrong() -> Day:
    """A day with every situation of which the rules warn."""
    day = Day()
    day.at("7:00", "bathroom", 3, "7:18")
    day.at("7:20", "kitchen", 2, "7:28")
    day.at("7:30", "livingroom", 12, "8:55")
    day.at("9:00", "workroom")
    day.at("9:05", "livingroom", 12, "11:55")
    day.at("12:00", "kitchen", 2, "12:12")
    day.at("12:15", "livingroom", 10, "12:50")
    day.at("12:50", "kitchen", 2, "12:58")
    day.at("13:00", "bedroom")
    day.at("2:30", "bathroom", 15, "3:40")
    day.at("3:45", "bedroom", 45, "5:50")
    return day


def write_days(folder: Path) -> None:
    """Writes both worlds."""
    write_day(folder, "ordinary", ordinary())
    write_day(folder, "wrong", wrong())


def write_day(folder: Path, name: str, day: Day) -> None:
    """Writes a world of one day."""
    root, world = new_world(name)
    add_world_plugins(world)
    add_home_site(world)
    comment(world, "floor 0")
    include(world, "apartment", "apartment0", (0, 0, 0, 0, 0, 0))
    add_devices(world, 0)
    for room in plan.FURNITURE:
        for piece in furniture_in(room, 0):
            include(world, *piece)
    add_openers(world, 0)
    comment(world, "what care watches")
    for room, corners in plan.PIRS.items():
        for suffix, (x, y, yaw) in zip("ab", corners):
            include(world, "pir", f"{room}_pir0_{suffix}",
                    (x, y, plan.PIR_HEIGHT, 0, plan.PIR_PITCH, yaw))
    add_readers(world)
    comment(world, "who lives there")
    add_tag(add_actor(world, day.rows, False, 2), plan.BADGE)
    add_state(world, name, [f"{room}_door0" for room in plan.ROOMS if room != "entrance"])
    write(root, folder / f"{name}.world")
