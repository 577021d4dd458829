"""The C++ of the node names a kind in the kind's own files only: others read its registration."""
import re
from pathlib import Path

import pytest

import angen

SOURCES = Path(__file__).resolve().parents[2] / 'src'
KINDS = {plugin['kind'] for plugin in angen.plugins()}
ALLOWED = {('angen_sim/tf/joints.cpp', 'joint_states')}  # a topic of that name
REGISTERS = 'ANGEN_REGISTER_ROS_KIND({'


def sources(folder: str) -> list[Path]:
    return [path for path in sorted((SOURCES / folder).glob('*'))
            if path.suffix in ('.cpp', '.h') and REGISTERS not in path.read_text()]


def named_in(path: Path) -> set[tuple[str, str]]:
    name = str(path.relative_to(SOURCES))
    return {(name, word) for word in re.findall(r'"(\w+)"', path.read_text()) if word in KINDS}


@pytest.mark.parametrize('folder', ['angen_sim/ros', 'angen_sim/tf', 'angen_sim/rviz',
                                    'angen_sim/node', 'angen_gazebo/gazebo'])
def test_a_folder_of_the_node_names_no_kind(folder: str) -> None:
    assert len(KINDS) > 50 and len(sources(folder)) > 3
    found = set().union(*(named_in(path) for path in sources(folder)))
    assert found <= ALLOWED


def test_a_kinds_own_file_does_name_it() -> None:
    assert ('angen_sim/ros/kinds/drive.cpp', 'drive') in named_in(
        SOURCES / 'angen_sim/ros/kinds/drive.cpp')
