"""The node that starts rviz with views of the world at hand, and becomes it."""
import ctypes
import os
import sys
from pathlib import Path
from typing import Any

import rospkg
import yaml

from angen_apps.viewer.bounds import bounds
from angen_apps.viewer.views import framed
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text

LIMIT = 120.0  # s that scene and home take to come: until a large world is loaded


def screen() -> tuple[int, int] | None:
    """Width and height of the display in pixels; None without one."""
    x11 = ctypes.CDLL('libX11.so.6')  # rviz needs it, too
    x11.XOpenDisplay.restype = ctypes.c_void_p
    display = ctypes.c_void_p(x11.XOpenDisplay(None))
    if not display:
        return None
    number = x11.XDefaultScreen(display)
    size = x11.XDisplayWidth(display, number), x11.XDisplayHeight(display, number)
    x11.XCloseDisplay(display)
    return size


def received(config: dict[str, Any]) -> dict[str, Any]:
    """A configuration of rviz with views of the running world; this process is a node."""
    import rospy
    from angen_msgs.msg import Home, Scene
    scene = rospy.wait_for_message('angen/scene', Scene, LIMIT)
    home = rospy.wait_for_message('angen/home', Home, LIMIT)
    return framed(config, bounds(scene), home.storeys, screen())


def main() -> None:
    """FILE.rviz: the node rviz."""
    import rospy
    words = rospy.myargv()[1:]
    if len(words) != 1:
        sys.exit('usage: viewer FILE.rviz')
    config, own = Path(words[0]), Path(rospkg.get_ros_home()) / 'angen.rviz'
    rospy.init_node('rviz')
    try:
        write_text(own, yaml.safe_dump(received(yaml.safe_load(config.read_text()))))
        config = own
    except rospy.ROSInterruptException:
        return
    except (rospy.ROSException, OSError, Failure) as error:
        rospy.logwarn('rviz opens with the views of %s: %s', config, error)
    rospy.signal_shutdown('rviz takes its name')
    mapped = [word for word in sys.argv[1:] if ':=' in word]
    os.execvp('rviz', ['rviz', '-d', str(config), *mapped])
