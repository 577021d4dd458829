"""A catkin workspace that has another gazebo_msgs, as docs/gazebo.md says."""
import re
from pathlib import Path

import pytest
from catkin_pkg.topological_order import topological_order

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/gazebo.md").read_text()


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """Angen's packages beside another package named gazebo_msgs."""
    (tmp_path / "src/other/gazebo_msgs").mkdir(parents=True)
    manifest = (ROOT / "src/gazebo_msgs/package.xml").read_text()
    manifest = re.sub("<version>.*</version>", "<version>2.9.2</version>", manifest)
    (tmp_path / "src/other/gazebo_msgs/package.xml").write_text(manifest)
    for package in (ROOT / "src").iterdir():
        copy = tmp_path / "src/angen/src" / package.name
        copy.mkdir(parents=True)
        (copy / "package.xml").write_text((package / "package.xml").read_text())
    return tmp_path


def test_two_are_rejected_and_one_is_not(workspace: Path) -> None:
    with pytest.raises(RuntimeError, match="gazebo_msgs"):
        topological_order(str(workspace / "src"))
    ignored = re.search(r"touch (src/\S+/gazebo_msgs/CATKIN_IGNORE)", PAGE)
    assert ignored
    (workspace / ignored[1]).touch()
    order = [(package.name, package.version)
             for _, package in topological_order(str(workspace / "src"))]
    assert ("gazebo_msgs", "2.9.2") in order and "angen_sim" in dict(order)
    names = [name for name, _ in order]
    assert names.index("gazebo_msgs") < names.index("angen_sim") < names.index("angen_gazebo")
    # those in a cycle have no place
    assert set(names) == {path.parent.name for path in (ROOT / "src").glob("*/package.xml")}


def test_an_overlay_may_have_another(workspace: Path) -> None:
    underlay = workspace / "src/angen"
    order = topological_order(str(workspace / "src/other"), underlay_workspaces=[str(underlay)])
    assert [package.version for _, package in order] == ["2.9.2"]
