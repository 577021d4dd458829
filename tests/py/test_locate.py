"""Locating a walking person and a driving robot in the building, by its sensors alone."""
import math

from angen_apps.locate.locator import locate
from angen_apps.locate.site import make_site
from angen_apps.robot.entities import entities_of

from angen_tools.session.in_process import InProcess

# s: from then on the robot drives so (m/s, rad/s): to and fro in the hall, in sight of its gate
ROUTE = ((0.0, -0.3, 0.0), (5.0, 0.3, 0.0), (10.0, 0.0, 0.5236), (16.0, 0.0, 0.0))


def drive(world: InProcess) -> None:
    orders = [order for order in ROUTE if order[0] <= world.now]
    world.world.command('drive', 'turtlebot', values=list(orders[-1][1:]))


def test_a_person_and_a_robot_are_located_by_sensors_alone(building):
    world = InProcess.load(building, 0)
    site = make_site(world.home, entities_of(world))
    rows, _ = locate(world, 60.0, lambda _: None, drive)
    assert len(site.rooms) == 14 and len(site.ways) == 13
    for tag, least in (('person', 0.7), ('turtlebot', 0.8)):
        own = [row for row in rows if row.answer.tag == tag]
        known = [row for row in own if row.answer.room]
        assert len(known) > 0.5 * len(own) > 20
        assert sum(row.right for row in known) > least * len(known)
        errors = sorted(row.error for row in known if not math.isnan(row.error))
        assert errors[len(errors) // 2] < 2.0
