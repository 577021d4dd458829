"""One search from its seed to its figures."""
import math
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Callable

import numpy as np

from angen_apps.maps.gridmap import load_world
from angen_apps.patrol.scene import start_offset
from angen_apps.residents.floors import Floors
from angen_apps.robot.building import find_start, write_world
from angen_apps.robot.driver import Track
from angen_apps.robot.interface import Event, collisions
from angen_apps.robot.route_file import Route
from angen_apps.seek.home import Home
from angen_apps.seek.person import add_person
from angen_apps.seek.search import Found, Search
from angen_apps.seek.simulation import Simulation

NO_PERSON = ''  # the name and the room of a person in a world without people


@dataclass(frozen=True)
class Figures:
    """A search in numbers; m, s. Without a find `time_s` is when it ended."""

    seed: int
    ambient: bool
    found: bool
    time_s: float
    room: str  # the reported one
    x_m: float
    y_m: float
    error_m: float  # error of the reported place
    true_room: str
    distance_m: float
    collisions: int
    wall_s: float


@dataclass(frozen=True)
class Outcome:
    """A search: its figures, and the data of its report."""

    figures: Figures
    found: Found | None
    track: Track
    person: list[tuple[float, ...]]  # t, x, y, z: in truth
    goals: list[tuple[float, int]]
    events: list[Event]
    beliefs: list[tuple[float, np.ndarray]]  # s, of each cell; every BELIEF s
    began: float  # s: when the search began


BELIEF = 1.0  # s between two beliefs that are kept
SOON = 1e-6  # s


def search(world: Path, route: Route, home: Home, seed: int, ambient: bool, limit: float,
           scratch: Path, note: Callable[[float, str], None] = lambda now, text: None) -> Outcome:
    """Runs one search; `scratch`: the file for its world; `note` is called with the time (s) and
    the robot's next action."""
    began = time.monotonic()
    people = write_world(world, route.robot, start_offset(seed), scratch)
    name = people[0] if people else NO_PERSON
    simulation = Simulation(scratch, seed, route.robot)
    start = find_start(route, simulation.entities, start_offset(seed))
    home = replace(home, start=start)
    seeker = Search(home, route, simulation, ambient, note)
    person: list[tuple[float, ...]] = []
    beliefs: list[tuple[float, np.ndarray]] = []
    household = (add_person(simulation.world, Floors(load_world(str(scratch)), home.described),
                            home, route, name, seed) if name else None)

    def others() -> None:
        if household is not None:
            household.run(simulation.now + SOON)
            person.append((simulation.now, *simulation.place(f'{name}::body')[:3]))
        if simulation.now >= len(beliefs) * BELIEF:
            beliefs.append((simulation.now, seeker.belief.cells.astype(np.float32)))

    simulation.others = others
    found = seeker.run(limit)
    end = simulation.place(f'{name}::body') if name else None
    figures = judge(home, seed, ambient, found, end, seeker.driver.track, simulation,
                    seeker.began, limit, time.monotonic() - began)
    return Outcome(figures, found, seeker.driver.track, person, seeker.goals, simulation.events,
                   beliefs, seeker.began)


def judge(home: Home, seed: int, ambient: bool, found: Found | None,
          truth: tuple[float, float, float, float] | None, track: Track, simulation: Simulation,
          since: float, limit: float, wall: float) -> Figures:
    """The figures of a search; the truth is used only here."""
    error, true_room = math.nan, NO_PERSON
    if truth is not None:
        floor = home.described.storey_at(truth[2])
        true_room = home.room_at(truth[0], truth[1], floor)
        if found is not None:
            error = (math.dist((found.x, found.y), truth[:2]) if floor == found.floor
                     else math.inf)
    return Figures(seed, ambient, found is not None,
                   found.time if found else min(simulation.now - since, limit),
                   found.room if found else '',
                   found.x if found else math.nan, found.y if found else math.nan,
                   error, true_room, track.distance, len(collisions(simulation.events)), wall)
