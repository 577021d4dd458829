"""The folder of an unfinished home: never one of the user."""
from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from angen_apps.data.part_folder import MARKER, part_folder
from angen_tools.common.failure import Failure

HOLDER = """
import sys, time
from pathlib import Path
from angen_apps.data.part_folder import part_folder
with part_folder(Path(sys.argv[1])) as part:
    (part / 'half').mkdir()
    (part / 'half' / 'events.csv').write_text('half')
    print('ready', flush=True)
    time.sleep(600)
"""


def test_it_is_empty_and_removed_after_an_error(tmp_path: Path) -> None:
    with pytest.raises(RuntimeError), part_folder(tmp_path / 'home') as part:
        assert part == tmp_path / 'home.part'
        assert [path.name for path in part.iterdir()] == [MARKER]
        (part / 'events.csv').write_text('half')
        raise RuntimeError
    assert not list(tmp_path.iterdir())


def test_a_folder_of_the_user_is_named_and_kept(tmp_path: Path) -> None:
    (tmp_path / 'home.part').mkdir()
    (tmp_path / 'home.part' / 'thesis.tex').write_text('years')
    with pytest.raises(Failure, match='home.part: was not made by angen generate; move it'), \
            part_folder(tmp_path / 'home'):
        pass
    assert (tmp_path / 'home.part' / 'thesis.tex').read_text() == 'years'


def test_a_link_and_a_file_are_named_and_kept(tmp_path: Path) -> None:
    (tmp_path / 'mine').mkdir()
    (tmp_path / 'home.part').symlink_to(tmp_path / 'mine')
    with pytest.raises(Failure, match='home.part: is a link; remove it'), \
            part_folder(tmp_path / 'home'):
        pass
    (tmp_path / 'other.part').write_text('mine')
    with pytest.raises(Failure, match='other.part: is not a folder'), \
            part_folder(tmp_path / 'other'):
        pass
    assert (tmp_path / 'home.part').is_symlink() and (tmp_path / 'other.part').is_file()


def test_the_second_process_is_told_of_the_first_until_that_is_killed(tmp_path: Path) -> None:
    holder = subprocess.Popen([sys.executable, '-c', HOLDER, str(tmp_path / 'home')],
                              stdout=subprocess.PIPE, text=True)
    try:
        assert holder.stdout and holder.stdout.readline() == 'ready\n'
        told = f'home.part: process {holder.pid} on .* makes this home'
        with pytest.raises(Failure, match=told), part_folder(tmp_path / 'home'):
            pass
    finally:
        os.kill(holder.pid, signal.SIGKILL)
        holder.wait()
    with part_folder(tmp_path / 'home') as part:
        assert [path.name for path in part.iterdir()] == [MARKER]
