"""Where a world is written: files, links and pipes."""
import os
import threading
from pathlib import Path

from angen_apps.plan.apartment import apartment
from angen_apps.plan.writer import write_world


def test_the_file_of_a_link_is_written(tmp_path: Path) -> None:
    (tmp_path / 'homes').mkdir()
    link = tmp_path / 'home.world'
    link.symlink_to('homes/first.world')
    write_world(apartment(1, 1, 7), link)
    assert link.is_symlink() and '</sdf>' in (tmp_path / 'homes/first.world').read_text()
    assert sorted(path.name for path in tmp_path.rglob('*')) == [
        'first.world', 'home.world', 'homes']


def test_a_pipe_stays_a_pipe(tmp_path: Path) -> None:
    pipe, came = tmp_path / 'pipe', []
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: came.append(pipe.read_text()))
    reader.start()
    write_world(apartment(1, 1, 7), pipe)
    reader.join(60)
    write_world(apartment(1, 1, 7), tmp_path / 'file')
    assert pipe.is_fifo() and came == [(tmp_path / 'file').read_text()]
