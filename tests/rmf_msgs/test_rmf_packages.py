"""The fields and constants of Open-RMF's messages, and a workspace that has other packages of their
names, as docs/rmf.md says."""
import re
from pathlib import Path

import pytest
from catkin_pkg.topological_order import topological_order
from genmsg import MsgContext
from genmsg.msg_loader import load_msg_from_file

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ('rmf_door_msgs', 'rmf_lift_msgs')
FIELDS = {
    'rmf_door_msgs/DoorMode': 'uint32 value',
    'rmf_door_msgs/DoorRequest': 'time request_time, string requester_id, string door_name, '
                                 'rmf_door_msgs/DoorMode requested_mode',
    'rmf_door_msgs/DoorState': 'time door_time, string door_name, '
                               'rmf_door_msgs/DoorMode current_mode',
    'rmf_lift_msgs/LiftRequest': 'string lift_name, time request_time, string session_id, '
                                 'uint8 request_type, string destination_floor, uint8 door_state',
    'rmf_lift_msgs/LiftState': 'string lift_name, time lift_time, string[] available_floors, '
                               'string current_floor, string destination_floor, uint8 door_state, '
                               'uint8 motion_state, uint8[] available_modes, uint8 current_mode, '
                               'string session_id'}
CONSTANTS = {
    'rmf_door_msgs/DoorMode': {'MODE_CLOSED': 0, 'MODE_MOVING': 1, 'MODE_OPEN': 2,
                               'MODE_OFFLINE': 3, 'MODE_UNKNOWN': 4},
    'rmf_lift_msgs/LiftRequest': {'REQUEST_END_SESSION': 0, 'REQUEST_AGV_MODE': 1,
                                  'REQUEST_HUMAN_MODE': 2, 'DOOR_CLOSED': 0, 'DOOR_OPEN': 2},
    'rmf_lift_msgs/LiftState': {
        'DOOR_CLOSED': 0, 'DOOR_MOVING': 1, 'DOOR_OPEN': 2, 'MOTION_STOPPED': 0, 'MOTION_UP': 1,
        'MOTION_DOWN': 2, 'MOTION_UNKNOWN': 3, 'MODE_UNKNOWN': 0, 'MODE_HUMAN': 1, 'MODE_AGV': 2,
        'MODE_FIRE': 3, 'MODE_OFFLINE': 4, 'MODE_EMERGENCY': 5}}


@pytest.mark.parametrize('name', sorted(FIELDS))
def test_a_message_is_open_rmf_s(name: str) -> None:
    package, message = name.split('/')
    path = ROOT / 'src' / package / 'msg' / f'{message}.msg'
    spec = load_msg_from_file(MsgContext.create_default(), str(path), name)
    assert ', '.join(f'{kind} {field}' for kind, field in zip(spec.types, spec.names)) \
        == FIELDS[name]
    assert {constant.name: constant.val for constant in spec.constants} == CONSTANTS.get(name, {})


def test_these_are_all() -> None:
    found = {f'{package}/{path.stem}' for package in PACKAGES
             for path in (ROOT / 'src' / package / 'msg').iterdir()}
    assert found == FIELDS.keys()


def test_others_of_these_names_take_their_place(tmp_path: Path) -> None:
    for package in (ROOT / 'src').iterdir():
        manifest = (package / 'package.xml').read_text()
        copy = tmp_path / 'src/angen/src' / package.name
        copy.mkdir(parents=True)
        (copy / 'package.xml').write_text(manifest)
        if package.name in PACKAGES:
            other = tmp_path / 'src/other' / package.name
            other.mkdir(parents=True)
            (other / 'package.xml').write_text(
                re.sub('<version>.*</version>', '<version>3.2.1</version>', manifest))
    with pytest.raises(RuntimeError, match='rmf_door_msgs'):
        topological_order(str(tmp_path / 'src'))
    page = (ROOT / 'docs/rmf.md').read_text()
    for ignored in re.findall(r'src/angen/\S+/CATKIN_IGNORE', page):
        (tmp_path / ignored).touch()
    order = [(package.name, package.version)
             for _, package in topological_order(str(tmp_path / 'src'))]
    assert {(package, '3.2.1') for package in PACKAGES} < set(order)
    assert {'angen_apps', 'angen_tools'} <= set(dict(order))
