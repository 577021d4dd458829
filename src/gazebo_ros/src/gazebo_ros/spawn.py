"""spawn_model: a model from a file, a parameter, the model path or stdin into the simulator."""
import argparse
import math
import re
import sys
from pathlib import Path
from xml.etree import ElementTree

import rospy
from gazebo_msgs.msg import ModelStates
from gazebo_msgs.srv import DeleteModel
from geometry_msgs.msg import Pose
from std_srvs.srv import Empty

from gazebo_ros.gazebo_interface import (set_model_configuration_client, spawn_sdf_model_client,
                                         spawn_urdf_model_client)

INCLUDE = ('<sdf version="1.6"><world name="default"><include><uri>model://{}</uri></include>'
           '</world></sdf>')


class Failure(Exception):
    """Why nothing is spawned, in one line."""


def parser(namespace: str) -> argparse.ArgumentParser:
    """The options of Gazebo's spawn_model; `namespace` is the node's."""
    made = argparse.ArgumentParser(prog='spawn_model',
                                   description='Spawn a model in the running simulator.')
    kind = made.add_mutually_exclusive_group(required=True)
    kind.add_argument('-urdf', action='store_true', help='the XML is URDF')
    kind.add_argument('-sdf', action='store_true', help='the XML is SDF')
    source = made.add_mutually_exclusive_group(required=True)
    source.add_argument('-file', metavar='FILE', help='read it from a file')
    source.add_argument('-param', metavar='NAME', help='read it from a ROS parameter')
    source.add_argument('-database', metavar='MODEL', help='model://MODEL of the model path')
    source.add_argument('-stdin', action='store_true', help='read it from stdin')
    made.add_argument('-model', required=True, metavar='NAME', help="the model's name")
    made.add_argument('-reference_frame', default='', metavar='NAME',
                      help='model or link that the pose is relative to; the world')
    made.add_argument('-gazebo_namespace', default='/gazebo', help='of the services')
    made.add_argument('-robot_namespace', default=namespace, help="of the model's topics")
    made.add_argument('-unpause', action='store_true', help='unpause when it is there')
    made.add_argument('-wait', metavar='MODEL', help='wait until another model exists')
    for letter, what in zip('xyzRPY', ('x in m', 'y in m', 'z in m', 'roll in rad', 'pitch in rad',
                                       'yaw in rad')):
        made.add_argument(f'-{letter}', type=float, default=0.0, help=what)
    made.add_argument('-J', dest='joints', nargs=2, default=[], action='append',
                      metavar=('JOINT', 'POSITION'), help='where a joint starts, rad or m')
    made.add_argument('-package_to_model', action='store_true',
                      help='package:// of meshes is read as model://')
    made.add_argument('-b', dest='bond', action='store_true',
                      help='stay, and delete the model at the end')
    return made


def joint_positions(given: list[list[str]]) -> dict[str, float]:
    """-J's pairs."""
    try:
        return {name: float(position) for name, position in given}
    except ValueError as problem:
        raise Failure(f'-J: {problem}') from problem


def pose_of(options: argparse.Namespace) -> Pose:
    """-x -y -z -R -P -Y; the rotations are about fixed axes, roll first."""
    pose = Pose()
    pose.position.x, pose.position.y, pose.position.z = options.x, options.y, options.z
    cr, sr = math.cos(options.R / 2), math.sin(options.R / 2)
    cp, sp = math.cos(options.P / 2), math.sin(options.P / 2)
    cy, sy = math.cos(options.Y / 2), math.sin(options.Y / 2)
    pose.orientation.x = sr * cp * cy - cr * sp * sy
    pose.orientation.y = cr * sp * cy + sr * cp * sy
    pose.orientation.z = cr * cp * sy - sr * sp * cy
    pose.orientation.w = cr * cp * cy + sr * sp * sy
    return pose


def without_late_declaration(text: str) -> str:
    """The text without an XML declaration after a comment, which Gazebo takes."""
    comments = re.match(r'(\s*<!--.*?-->)+\s*(<\?xml.*?\?>)', text, re.DOTALL)
    return text if comments is None else text[:comments.start(2)] + text[comments.end(2):]


def read_xml(options: argparse.Namespace) -> str:
    """The model's text, from where the options say."""
    if options.file:
        try:
            text = Path(options.file).read_text(encoding='utf-8')
        except (OSError, UnicodeDecodeError) as problem:
            raise Failure(f'{options.file}: {problem}') from problem
    elif options.param:
        if not rospy.has_param(options.param):
            raise Failure(f'there is no parameter {rospy.resolve_name(options.param)}')
        text = str(rospy.get_param(options.param))
    elif options.database:
        text = INCLUDE.format(options.database)
    else:
        text = sys.stdin.read()
    if not text.strip():
        raise Failure('the XML is empty')
    text = without_late_declaration(text)
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as problem:
        raise Failure(f'the XML is not well-formed: {problem}') from problem
    if options.package_to_model:
        for mesh in root.iter('mesh'):
            name = mesh.get('filename', '')
            if name.startswith('package://'):
                mesh.set('filename', 'model://' + name[len('package://'):])
        text = ElementTree.tostring(root, encoding='unicode')
    return text


def wait_for_model(name: str, namespace: str) -> None:
    """Return when a model of that name exists."""
    rospy.loginfo('Waiting for model %s', name)
    while not rospy.is_shutdown():
        try:
            models = rospy.wait_for_message(f'{namespace}/model_states', ModelStates, timeout=1.0)
        except rospy.ROSException:
            continue
        if name in models.name:
            return


def call_empty(name: str) -> None:
    """Call a service that has no answer."""
    rospy.wait_for_service(name)
    try:
        rospy.ServiceProxy(name, Empty)()
    except rospy.ServiceException as problem:
        raise Failure(f'{name}: {problem}') from problem


def delete(name: str, namespace: str) -> None:
    """Delete the model that this was bound to."""
    try:
        answer = rospy.ServiceProxy(f'{namespace}/delete_model', DeleteModel)(name)
        rospy.loginfo('%s', answer.status_message)
    except rospy.ServiceException as problem:
        rospy.logerr('%s is not deleted: %s', name, problem)


def spawn(options: argparse.Namespace) -> None:
    """Execute the options; raise Failure if one fails."""
    joints = joint_positions(options.joints)
    namespace = options.gazebo_namespace.rstrip('/')
    if options.wait:
        wait_for_model(options.wait, namespace)
    call = spawn_urdf_model_client if options.urdf else spawn_sdf_model_client
    if not call(options.model, read_xml(options), options.robot_namespace, pose_of(options),
                options.reference_frame, namespace):
        raise Failure('the simulator did not spawn it')
    if joints and not set_model_configuration_client(options.model, '', list(joints),
                                                     list(joints.values()), namespace):
        raise Failure('its joints were not set')
    if options.unpause:
        call_empty(f'{namespace}/unpause_physics')
    if options.bond:
        rospy.on_shutdown(lambda: delete(options.model, namespace))
        rospy.loginfo('Waiting for shutdown to delete model %s', options.model)
        rospy.spin()


def main() -> int:
    """The command; its exit code."""
    words = rospy.myargv()[1:]
    if {'-h', '--help'} & set(words):  # without a master
        parser('/').parse_args(words)
    rospy.init_node('spawn_model', anonymous=True)
    try:
        spawn(parser(rospy.get_namespace()).parse_args(words))
    except Failure as failure:
        rospy.logerr('spawn_model: %s', failure)
        return 1
    except rospy.ROSInterruptException:
        return 1
    return 0
