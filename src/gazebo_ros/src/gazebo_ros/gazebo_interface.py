"""Calls of Gazebo's services, as scripts import them from gazebo_ros."""
from typing import Any, Sequence

import rospy
from gazebo_msgs.srv import SetModelConfiguration, SpawnModel
from geometry_msgs.msg import Pose


def _call(name: str, kind: Any, *values: Any) -> bool:
    """Wait for the service, call it, log its answer; whether it has succeeded."""
    rospy.loginfo('Waiting for service %s', name)
    rospy.wait_for_service(name)
    try:
        rospy.loginfo('Calling service %s', name)
        answer = rospy.ServiceProxy(name, kind)(*values)
    except rospy.ServiceException as failure:
        rospy.logerr('Service call failed: %s', failure)
        return False
    log = rospy.loginfo if answer.success else rospy.logerr
    log('%s: %s', name, answer.status_message)
    return bool(answer.success)


def spawn_sdf_model_client(model_name: str, model_xml: str, robot_namespace: str,
                           initial_pose: Pose, reference_frame: str,
                           gazebo_namespace: str) -> bool:
    """Spawn a model of SDF text."""
    return _call(f'{gazebo_namespace}/spawn_sdf_model', SpawnModel, model_name, model_xml,
                 robot_namespace, initial_pose, reference_frame)


def spawn_urdf_model_client(model_name: str, model_xml: str, robot_namespace: str,
                            initial_pose: Pose, reference_frame: str,
                            gazebo_namespace: str) -> bool:
    """Spawn a model of URDF text."""
    return _call(f'{gazebo_namespace}/spawn_urdf_model', SpawnModel, model_name, model_xml,
                 robot_namespace, initial_pose, reference_frame)


def set_model_configuration_client(model_name: str, model_param_name: str,
                                   joint_names: Sequence[str], joint_positions: Sequence[float],
                                   gazebo_namespace: str) -> bool:
    """Put joints of a model to positions."""
    return _call(f'{gazebo_namespace}/set_model_configuration', SetModelConfiguration, model_name,
                 model_param_name, joint_names, joint_positions)
