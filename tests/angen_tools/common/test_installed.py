"""Where files are found: in a workspace, in a wheel, and in Debian's package."""
import subprocess
import sys
from pathlib import Path

import pytest

from angen_tools.common.failure import Failure
from angen_tools.common.installed import launch_file, libraries, share

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = '''
import sys
sys.path.insert(0, sys.argv[1])
from angen_tools.common.installed import launch_file, libraries, share
print(libraries(), share('angen_sim'), launch_file())
'''


def test_in_a_workspace() -> None:
    assert libraries() == ROOT / 'devel/lib'
    assert share('angen_sim').resolve() == ROOT / 'src/angen_sim'
    assert launch_file() is None
    with pytest.raises(Failure, match='no_such is not found'):
        share('no_such')


@pytest.mark.parametrize('with_launch', [False, True])
def test_beside_the_module(with_launch: bool, tmp_path: Path) -> None:
    (tmp_path / 'angen.py').touch()
    files = tmp_path / 'angen_files'
    (files / 'share/angen_sim/launch').mkdir(parents=True)
    if with_launch:
        (files / 'share/angen_sim/launch/angen.launch').touch()
    said = subprocess.run([sys.executable, '-c', PROGRAM, str(tmp_path)], check=True, text=True,
                          capture_output=True).stdout.split()
    launch = files / 'share/angen_sim/launch/angen.launch' if with_launch else None
    assert said == [str(files / 'lib'), str(files / 'share/angen_sim'), str(launch)]
