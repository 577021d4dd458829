"""The node that publishes the maps of a building's floors."""
import sys
from multiprocessing import Pipe, Process
from multiprocessing.connection import Connection
from typing import Any

from angen import Grid

from angen_apps.maps.gridmap import floors, load_world, make_map
from angen_tools.common.failure import Failure

WORLD = 'world'  # the frame


def publish_maps(path: str) -> None:
    """A node that serves the maps of a world's file; see MapServer.

    It ends at once where the world is empty, otherwise when ROS ends. Failure if the
    world does not load.
    """
    maps = survey(path)
    import rospy
    rospy.init_node('map_publisher')
    if not maps:
        rospy.loginfo('%s has no floor, so there is no map', path)
        return
    MapServer(maps, rospy.get_param('~frame_id', WORLD))
    rospy.spin()


class MapServer:
    """Latches floorN/map of each floor, and does as map_server does for one of them.

    That one, floor 0 at first, is map, map_metadata and the answer of static_map;
    change_map chooses another one. In a frame other than the world's it is at z = 0, and a
    transform puts that frame on its floor.
    """

    def __init__(self, maps: list[Grid], frame: str) -> None:
        import rospy
        from nav_msgs.msg import MapMetaData, OccupancyGrid
        from nav_msgs.srv import GetMap, LoadMap
        self._maps = {f'floor{grid.floor}': grid for grid in maps}
        self._frame = frame
        latched = {'queue_size': 1, 'latch': True}
        self._floors = {name: rospy.Publisher(f'{name}/map', OccupancyGrid, **latched)
                        for name in self._maps}
        for name, grid in self._maps.items():
            self._floors[name].publish(occupancy_grid(grid))
        self._map = rospy.Publisher('map', OccupancyGrid, **latched)
        self._metadata = rospy.Publisher('map_metadata', MapMetaData, **latched)
        self._broadcaster: Any = None
        self._choose('floor0' if 'floor0' in self._maps else next(iter(self._maps)))
        rospy.Service('static_map', GetMap, lambda _: self._current)
        rospy.Service('change_map', LoadMap, self._change)

    def _choose(self, name: str) -> None:
        """Makes a floor's map the one."""
        grid = self._maps[name]
        if self._frame != WORLD:
            self._place_frame(grid.height)
        self._current = occupancy_grid(grid, self._frame)
        self._map.publish(self._current)
        self._metadata.publish(self._current.info)

    def _place_frame(self, height: float) -> None:
        from geometry_msgs.msg import TransformStamped
        from tf2_ros import StaticTransformBroadcaster
        self._broadcaster = self._broadcaster or StaticTransformBroadcaster()
        transform = TransformStamped(child_frame_id=self._frame)
        transform.header.frame_id = WORLD
        transform.transform.translation.z = height
        transform.transform.rotation.w = 1.0
        self._broadcaster.sendTransform(transform)

    def _change(self, request: Any) -> Any:
        """The response to LoadMap; its map_url is the name of a floor."""
        import rospy
        from nav_msgs.srv import LoadMapResponse
        if request.map_url not in self._maps:
            rospy.logwarn("there is no map '%.80s'; there are: %s", request.map_url,
                          ', '.join(self._maps))
            return LoadMapResponse(result=LoadMapResponse.RESULT_MAP_DOES_NOT_EXIST)
        self._choose(request.map_url)
        return LoadMapResponse(map=self._current, result=LoadMapResponse.RESULT_SUCCESS)


def survey(path: str) -> list[Grid]:
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
    unused.close()  # or a write would not fail once the reader has ended
    try:
        world = load_world(path)
        out.send([make_map(world, floor) for floor in floors(world)])
    except Failure as failure:
        out.send(failure)
    except (KeyboardInterrupt, BrokenPipeError):
        pass  # the reader has ended


def occupancy_grid(grid: Grid, frame: str = WORLD) -> Any:
    """The map as nav_msgs/OccupancyGrid; in the frame world at its floor's height."""
    from nav_msgs.msg import OccupancyGrid
    message = OccupancyGrid()
    message.header.frame_id = frame
    message.info.resolution = grid.resolution
    message.info.height, message.info.width = grid.cells.shape
    message.info.origin.position.x, message.info.origin.position.y = grid.origin
    message.info.origin.position.z = grid.height if frame == WORLD else 0.0
    message.info.origin.orientation.w = 1.0
    message.data = grid.cells.ravel().tolist()
    return message


def main() -> None:
    """WORLD: the node map_publisher."""
    from rospy import myargv
    words = myargv()[1:]
    if len(words) != 1:
        sys.exit('usage: map_publisher WORLD')
    try:
        publish_maps(words[0])
    except Failure as failure:
        print(f'map_publisher: {failure}')  # under roslaunch into a log: the node reports it
        sys.exit(1)
