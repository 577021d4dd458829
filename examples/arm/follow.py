#!/usr/bin/env python3
"""Sends the arm of arm.launch along a trajectory and prints how far off it was: 0 within 0.02 rad.

Both controllers get a FollowJointTrajectory goal, as MoveIt sends them, and are compared all the
way with the joint states that the simulator has.
"""
import sys

import actionlib
import rospy
from control_msgs.msg import (FollowJointTrajectoryAction, FollowJointTrajectoryGoal,
                              JointTrajectoryControllerState)
from trajectory_msgs.msg import JointTrajectoryPoint

ALLOWED = 0.02  # rad
WAYS = {'reach': (['turn', 'shoulder'], [(2.0, [1.2, -0.8]), (4.0, [-0.9, 0.3])]),
        'bend': (['elbow'], [(2.0, [1.0]), (4.0, [-0.5])])}


class Worst:
    """The greatest error that a controller has published."""

    def __init__(self, controller: str) -> None:
        self.off = 0.0
        self.seen = 0
        topic = f'/arm/{controller}/state'
        rospy.Subscriber(topic, JointTrajectoryControllerState, self.see)

    def see(self, state: JointTrajectoryControllerState) -> None:
        """Notes the errors of one message."""
        self.seen += 1
        errors = [abs(a - b) for a, b in zip(state.desired.positions, state.actual.positions)]
        self.off = max(self.off, *errors)


def goal_of(joints: list[str], points: list[tuple[float, list[float]]]
            ) -> FollowJointTrajectoryGoal:
    """A goal that stops at each point."""
    goal = FollowJointTrajectoryGoal()
    goal.trajectory.joint_names = joints
    for time, positions in points:
        goal.trajectory.points.append(JointTrajectoryPoint(
            positions=positions, velocities=[0.0] * len(joints),
            time_from_start=rospy.Duration.from_sec(time)))
    return goal


def main() -> int:
    """The exit code."""
    rospy.init_node('follow')
    clients = {}
    for name in WAYS:
        clients[name] = actionlib.SimpleActionClient(f'/arm/{name}/follow_joint_trajectory',
                                                     FollowJointTrajectoryAction)
        if not clients[name].wait_for_server(rospy.Duration(30)):
            print(f'{name}: no controller; see docs/controllers.md')
            return 1
    worst = {name: Worst(name) for name in WAYS}
    rospy.sleep(1.0)
    for name, way in WAYS.items():
        clients[name].send_goal(goal_of(*way))
    code = 0
    for name, client in clients.items():
        client.wait_for_result(rospy.Duration(20))
        result = client.get_result()
        done = result is not None and result.error_code == 0
        print(f'{name}: {"reached" if done else "not reached"}, at most {worst[name].off:.4f} rad '
              f'off in {worst[name].seen} states')
        if not done or worst[name].off > ALLOWED or worst[name].seen == 0:
            code = 1
    return code


if __name__ == '__main__':
    sys.exit(main())
