"""ros2/angen_msgs makes messages of ROS 2 out of those of ROS 1."""
import re
import runpy
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
convert = runpy.run_path(str(ROOT / 'ros2/angen_msgs/convert.py'))['convert']
# https://docs.ros.org/en/humble/Concepts/Basic/About-Interfaces.html: types, and names of fields
TYPE = re.compile(r'(bool|byte|char|float(32|64)|u?int(8|16|32|64)|string|[A-Z][A-Za-z0-9]*|'
                  r'(builtin_interfaces|gazebo_msgs|geometry_msgs|std_msgs)/[A-Z][A-Za-z0-9]*)'
                  r'(\[\d*\])?')
NAME = re.compile(r'[a-z](_?[a-z0-9])*|[A-Z](_?[A-Z0-9])*=.+')


def test_each_field_is_one_of_ros_2(tmp_path: Path) -> None:
    names = convert(ROOT / 'src/angen_msgs', tmp_path)
    assert len(names) == len(list((ROOT / 'src/angen_msgs').glob('[ms][sr][gv]/*')))
    for name in names:
        for line in (tmp_path / name).read_text().splitlines():
            words = line.partition('#')[0].split()
            assert not words or words == ['---'] or (
                TYPE.fullmatch(words[0]) and NAME.fullmatch(''.join(words[1:]))), (name, line)
    assert 'builtin_interfaces/Time raised' in (tmp_path / 'msg/CareWarning.msg').read_text()
