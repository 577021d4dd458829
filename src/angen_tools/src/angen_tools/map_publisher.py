"""The node that publishes the maps of a building's floors."""
from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from typing import Any

from .gridmap import GridMap, floors, load_world, make_map


def survey(path: str) -> list[GridMap]:
    """The maps of all floors of a world's file, doors away; Failure where it does not load."""
    world = load_world(path)
    return [make_map(world, floor) for floor in floors(world)]


def publish_maps() -> None:
    """Latches /floorN/map for each floor of the file in ~world, and /map for floor 0.

    It ends at once where nothing stands in the world, otherwise when ROS ends. Failure where the
    world does not load.
    """
    import rospy
    from nav_msgs.msg import OccupancyGrid
    with ProcessPoolExecutor(1) as other:  # which takes the world's memory with it
        other.submit(int).result()  # it starts while this process has one thread
        rospy.init_node('map_publisher')
        path = rospy.get_param('~world')
        maps = other.submit(survey, path).result()
    publishers = []
    for grid in maps:
        for topic in [f'/floor{grid.floor}/map'] + ['/map'] * (grid.floor == 0):
            publishers.append(rospy.Publisher(topic, OccupancyGrid, queue_size=1, latch=True))
            publishers[-1].publish(occupancy_grid(grid))
    if not maps:
        rospy.loginfo('nothing stands in %s, so there is no map', path)
        return
    rospy.spin()


def occupancy_grid(grid: GridMap) -> Any:
    """The map as nav_msgs/OccupancyGrid in the frame world, at its floor's height."""
    from nav_msgs.msg import OccupancyGrid
    message = OccupancyGrid()
    message.header.frame_id = 'world'
    message.info.resolution = grid.resolution
    message.info.height, message.info.width = grid.cells.shape
    message.info.origin.position.x, message.info.origin.position.y = grid.origin
    message.info.origin.position.z = grid.height
    message.info.origin.orientation.w = 1.0
    message.data = grid.cells.ravel().tolist()
    return message
