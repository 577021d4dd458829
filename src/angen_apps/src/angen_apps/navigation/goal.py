"""Goals of navigation (docs/navigation.md), as rviz's tool 2D Nav Goal publishes them."""
import math
from typing import Any

from angen_tools.common.failure import Failure

TOPIC = 'move_base_simple/goal'


def publish_goal(publisher: Any, x: float, y: float, yaw: float) -> None:
    """By a publisher of TOPIC; Failure if no program subscribes."""
    from geometry_msgs.msg import PoseStamped
    if publisher.get_num_connections() == 0:
        raise Failure(f'no program subscribes to {TOPIC}; navigation is started as '
                      'docs/navigation.md says')
    goal = PoseStamped()
    goal.header.frame_id = 'map'
    goal.pose.position.x, goal.pose.position.y = x, y
    goal.pose.orientation.z, goal.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    publisher.publish(goal)
