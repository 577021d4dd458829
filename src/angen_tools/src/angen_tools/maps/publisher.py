"""The node that publishes the maps of a building's floors."""
from __future__ import annotations

from multiprocessing import Pipe, Process
from multiprocessing.connection import Connection
from typing import Any

from angen_tools.common.failure import Failure
from angen_tools.maps.gridmap import GridMap, floors, load_world, make_map


def publish_maps(path: str) -> None:
    """A node that latches /floorN/map for each floor of a world's file, and /map for floor 0.

    It ends at once where nothing stands in the world, otherwise when ROS ends. Failure where the
    world does not load.
    """
    maps = survey(path)
    import rospy
    from nav_msgs.msg import OccupancyGrid
    rospy.init_node('map_publisher')
    publishers = []
    for grid in maps:
        for topic in [f'/floor{grid.floor}/map'] + ['/map'] * (grid.floor == 0):
            publishers.append(rospy.Publisher(topic, OccupancyGrid, queue_size=1, latch=True))
            publishers[-1].publish(occupancy_grid(grid))
    if not maps:
        rospy.loginfo('nothing stands in %s, so there is no map', path)
        return
    rospy.spin()


def survey(path: str) -> list[GridMap]:
    """The maps of all floors of a world's file, doors away; Failure where it does not load.

    Made by another process, which takes the world's memory with it when it ends.
    """
    ours, theirs = Pipe(duplex=False)
    other = Process(target=_survey, args=(path, ours, theirs), daemon=True)
    other.start()
    theirs.close()
    try:
        maps = ours.recv()
    except EOFError:
        raise Failure(f'{path}: its maps could not be made') from None
    other.join()
    if isinstance(maps, Failure):
        raise maps
    return maps


def _survey(path: str, unused: Connection, out: Connection) -> None:
    unused.close()  # or a write would not fail once the reader is gone
    try:
        world = load_world(path)
        out.send([make_map(world, floor) for floor in floors(world)])
    except Failure as failure:
        out.send(failure)
    except (KeyboardInterrupt, BrokenPipeError):
        pass  # the reader is gone


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
