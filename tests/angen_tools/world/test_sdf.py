"""The words and files of SDF."""
from pathlib import Path

import pytest

from angen_tools.common.failure import Failure
from angen_tools.world import sdf


@pytest.mark.parametrize('text, pose', [
    ('1 2 3', (1, 2, 3, 0, 0, 0)),
    (' -1 2e0  3 0 0 1.57 ', (-1, 2, 3, 0, 0, 1.57)),
    ('1,2,3', (1, 2, 3, 0, 0, 0)),
])
def test_poses_have_three_or_six_numbers(text: str, pose: tuple[float, ...]) -> None:
    assert sdf.parse_pose(text) == pose


@pytest.mark.parametrize('text, part', [('', '0 numbers'), ('1 2', '2 numbers'),
                                        ('1 2 3 4', '4 numbers'), ('1 2 x', "'x'"),
                                        ('1 2 nan', 'not a number'), ('1 2 1e999', 'finite')])
def test_what_is_no_pose_is_explained(text: str, part: str) -> None:
    with pytest.raises(ValueError, match=part):
        sdf.parse_pose(text)


@pytest.mark.parametrize('link', ['', 'a', 'a::', '::b', 'a::::b'])
def test_what_is_no_link(link: str) -> None:
    with pytest.raises(ValueError, match='MODEL::LINK'):
        sdf.check_link(link)


def test_broken_xml_is_reported_with_its_line(tmp_path: Path) -> None:
    broken = tmp_path / 'model.sdf'
    broken.write_text('<sdf>\n<model name="a">\n</sdf>')
    with pytest.raises(Failure, match=r'model\.sdf:3: '):
        sdf.read(broken)
