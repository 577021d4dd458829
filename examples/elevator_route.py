#!/usr/bin/env python3
"""Sends the robot to a place on any floor by move_base; between floors it takes the elevator.

    ./angen run odom_parent:=none gui:=false                           # in another terminal
    ./angen shell -c "roslaunch angen_sim navigation.launch"           # in a third one
    ./angen shell -c "python3 examples/elevator_route.py 1 8.6 6.6"    # floor, x and y in m
"""
import math
import sys

import actionlib
import rospy
import tf2_ros
from angen_msgs.msg import ElevatorState
from angen_msgs.srv import List
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.srv import LoadMap
from std_msgs.msg import String
from std_srvs.srv import Empty

LANDING = 1.9  # m from the middle of the cabin to where the robot waits for it
TRIES = 3


def go(what, x, y, yaw):
    """Sends the robot to a pose on the map of its floor."""
    goal = MoveBaseGoal()
    goal.target_pose.header.frame_id = 'map'
    goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = x, y
    goal.target_pose.pose.orientation.z = math.sin(yaw / 2)
    goal.target_pose.pose.orientation.w = math.cos(yaw / 2)
    for _ in range(TRIES):
        began = rospy.get_time()
        if move_base.send_goal_and_wait(goal) == actionlib.GoalStatus.SUCCEEDED:
            print(f'{what}: reached in {rospy.get_time() - began:.0f} s', flush=True)
            return
    sys.exit(f'{what}: not reached')


def call_elevator(name, floor):
    """Returns when the elevator is open at the floor."""
    calls.publish(f'Floor{floor}, {name}')
    while (state := rospy.wait_for_message(f'/angen/elevator/{name}', ElevatorState)) and not (
            state.floor == state.target_floor == floor
            and state.door_mode == ElevatorState.DOOR_OPEN):
        rospy.sleep(0.2)


target, x, y = int(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3])
rospy.init_node('elevator_route')
calls = rospy.Publisher('/gazebo/Elevator_controller', String, queue_size=1)
move_base = actionlib.SimpleActionClient('move_base', MoveBaseAction)
move_base.wait_for_server()
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
height = buffer.lookup_transform('world', 'map', rospy.Time(), rospy.Duration(10.0))
floor = round(height.transform.translation.z / 4.0)
if floor != target:
    cabin = rospy.ServiceProxy('/angen/list', List)('elevator').entities[0]
    at, turn = cabin.pose.position, cabin.pose.orientation
    out = 2 * math.atan2(turn.z, turn.w)  # its doors are on the side of its x axis
    go('landing', at.x + LANDING * math.cos(out), at.y + LANDING * math.sin(out), out + math.pi)
    call_elevator(cabin.name, floor)
    go('cabin', at.x, at.y, out)
    call_elevator(cabin.name, target)
    rospy.ServiceProxy('/change_map', LoadMap)(f'floor{target}')  # amcl keeps its last pose
    rospy.sleep(1.0)
    rospy.ServiceProxy('/move_base/clear_costmaps', Empty)()
    go('out', at.x + LANDING * math.cos(out), at.y + LANDING * math.sin(out), out)
go(f'floor {target}', x, y, 0.0)
