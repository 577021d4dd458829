"""The person of a search: a resident who walks from room to room, as the robot's cycles pass."""
import math
from typing import Any

from angen_apps.data.run import first_day
from angen_apps.residents.floors import Floors
from angen_apps.residents.household import Household
from angen_apps.residents.places import Spot
from angen_apps.residents.profiles import Profile
from angen_apps.residents.simulator import Simulator
from angen_apps.residents.wanderer import Wanderer
from angen_apps.robot.route_file import Route
from angen_apps.seek.home import Home
from angen_tools.common.failure import Failure
from angen_tools.session.in_process import InProcess

WALKER = Profile('wanderer', 0.8, {}, {}, (), {}, {}, closes_doors=0.6, lamps_on=0.8, lamps_off=1.0)
DOOR_ROOM = 0.45  # m from where one stays to where a leaf swings
LIFT_ROOM = 1.6  # m from there to the middle of the cabin


class _Beside(Simulator):
    """The simulation whose time passes by the robot's cycles."""

    def run(self, seconds: float) -> None:
        return


def add_person(world: Any, floors: Floors, home: Home, route: Route, name: str, seed: int
               ) -> Household:
    """A household of one who walks about; its run() is called before each of the robot's cycles.
    Failure if the building has no place to walk to."""
    simulator = _Beside(InProcess(world), home.described)
    household = Household(simulator, floors, seed, 'seek', first_day(home.described),
                          home.described.time_of_day)
    spots = [spot for cell in range(len(home.at)) if (spot := _spot(home, cell, floors, route))]
    if not spots:
        raise Failure('the building has no free place for a person')
    pose = home.start.pose
    Wanderer(household, name, WALKER, spots, home.room_at(pose.x, pose.y, home.start.floor))
    return household


def _spot(home: Home, cell: int, floors: Floors, route: Route) -> Spot | None:
    """The place of a cell, if one can stay there: no door swings there, the robot gets there, and
    the cabin is not near."""
    point, floor = home.point(cell), int(home.floor[cell])
    if not route.elevator and floor != home.start.floor:
        return None
    if floor not in floors.grids or not floors.is_free(point, floor):
        return None
    if any(door.room_for(point) < DOOR_ROOM for door in home.doors[floor]):
        return None
    if route.elevator and math.dist(point, route.elevator.cabin) < LIFT_ROOM:
        return None
    return Spot(point, floor, home.described.elevation(floor), home.rooms[home.room[cell]])
