"""This process as a node of ROS that outlives its master."""
import sys
import time

from angen_apps.web.feed import master_process


def start_node(command: str) -> None:
    """Returns when there is a master, and this process is a node of it; `command` is that of
    angen."""
    import rospy
    said = False
    while not master_process():
        if not said:
            print(f'angen {command}: waits for a ROS master; start one with ./angen run',
                  file=sys.stderr, flush=True)
            said = True
        time.sleep(0.5)
    rospy.init_node(f'angen_{command}', anonymous=True, disable_signals=True, disable_rosout=True,
                    disable_rostime=True)
