"""The world that the node leaves when it has lost the ROS master."""
from pathlib import Path

import pytest

from angen_tools.common.failure import Failure
from angen_tools.entry import rescue
from angen_tools.entry.rescue import Rescue, own_folder


@pytest.fixture(autouse=True)
def runtime(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of $XDG_STATE_HOME."""
    monkeypatch.setenv('XDG_STATE_HOME', str(tmp_path))
    return tmp_path / 'angen'


def test_the_world_is_taken_once_and_removed_at_the_end(runtime: Path) -> None:
    with Rescue() as found:
        assert found.path.parent == runtime and found.take() is None
        found.path.write_text('<sdf/>')
        world = found.take()
        assert world is not None and world.read_text() == '<sdf/>'
        assert found.take() is None
    assert list(runtime.iterdir()) == []


def test_no_other_user_may_read_it(runtime: Path) -> None:
    runtime.mkdir(mode=0o777)
    assert own_folder() == runtime and runtime.stat().st_mode & 0o777 == 0o700


def test_a_folder_of_somebody_else_is_not_used(runtime: Path, tmp_path: Path) -> None:
    (tmp_path / 'theirs').mkdir()
    runtime.symlink_to(tmp_path / 'theirs')
    with pytest.raises(Failure, match='is not a folder of yours'):
        own_folder()


def test_it_gives_up_and_keeps_the_world(runtime: Path, monkeypatch: pytest.MonkeyPatch,
                                         capsys: pytest.CaptureFixture[str]) -> None:
    now = [100.0]
    monkeypatch.setattr(rescue.time, 'monotonic', lambda: now[0])
    with pytest.raises(Failure) as failed, Rescue() as found:
        for i in range(10):
            found.path.write_text(f'{i}')
            found.take()
            now[0] += 10.0
    assert 'lost 4 times within 60 s' in str(failed.value)
    assert capsys.readouterr().err == f'angen: the world is saved in {found.path}\n'
    assert list(runtime.iterdir()) == [found.path]
    assert found.path.read_text() == '3'


def test_a_restart_that_fails_keeps_the_world(runtime: Path,
                                              capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(Failure), Rescue() as found:
        found.path.write_text('<sdf/>')
        world = found.take()
        raise Failure('no ROS master could be started')
    assert world is not None and world.read_text() == '<sdf/>'
    assert f'the world is saved in {world}' in capsys.readouterr().err


def test_now_and_then_is_no_reason_to_give_up(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr(rescue.time, 'monotonic', lambda: now[0])
    with Rescue() as found:
        for i in range(10):
            found.path.write_text(f'{i}')
            assert found.take() is not None
            now[0] += 25.0
