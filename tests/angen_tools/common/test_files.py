"""Files that are whole under their name, whatever happens while they are written."""
import ast
import os
import random
import resource
import signal
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path
from typing import Iterator

import pytest

from angen_tools.common import files
from angen_tools.common.failure import Failure
from angen_tools.common.files import check_folder, later_signals, write_csv, write_text, writing

ROOT = Path(__file__).resolve().parents[3]
SOURCES = ('src/angen_tools/src', 'src/angen_apps/src', 'bench/angen_bench')


@contextmanager
def limited(size: int) -> Iterator[None]:
    """No file gets larger than that many bytes: as on a full disk, also for root."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_a_file_has_its_name_once_it_is_whole(tmp_path: Path) -> None:
    path = tmp_path / 'made/new.txt'
    with writing(path) as file:
        file.write('a')
        file.flush()
        assert names(path.parent) == ['new.txt.part']
    assert names(path.parent) == ['new.txt'] and path.read_text() == 'a'
    umask = os.umask(0)
    os.umask(umask)
    assert path.stat().st_mode & 0o777 == 0o666 & ~umask


@pytest.mark.parametrize('problem', [ValueError, KeyboardInterrupt, SystemExit])
def test_an_error_leaves_the_old_file(tmp_path: Path, problem: type[BaseException]) -> None:
    path = tmp_path / 'a.txt'
    path.write_text('old')
    with pytest.raises(problem):
        with writing(path) as file:
            file.write('new')
            raise problem
    assert names(tmp_path) == ['a.txt'] and path.read_text() == 'old'


def test_a_full_disk_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / 'table.csv'
    write_csv(path, ('a', 'b'), [(1, 2)])
    with limited(10_000), pytest.raises(Failure) as failed:
        write_csv(path, ('a', 'b'), [('x' * 100, i) for i in range(1000)])
    assert str(failed.value) == f'{path}: cannot be written: {os.strerror(27)}'
    assert names(tmp_path) == ['table.csv'] and path.read_text() == 'a,b\n1,2\n'
    write_csv(path, ('a', 'b'), [(3, 4)])
    assert path.read_text() == 'a,b\n3,4\n'


def test_a_device_without_space_is_named(tmp_path: Path) -> None:
    (tmp_path / 'full').symlink_to('/dev/full')
    with pytest.raises(Failure, match=f'{tmp_path}/full: cannot be written: No space left'):
        write_text(tmp_path / 'full', 'a' * 100_000)
    assert Path('/dev/full').is_char_device() and names(tmp_path) == ['full']


def test_the_whole_lines_of_a_log_stay(tmp_path: Path) -> None:
    path = tmp_path / 'events.csv'
    path.write_text('of the last run\n')
    with limited(10_000), pytest.raises(Failure, match=f'before are in {path}.part') as failed:
        with writing(path, log=True) as file:
            for i in range(10_000):
                file.write(f'{i:06d},something happened\n')
    assert 'cannot be written' in str(failed.value)
    lines = (tmp_path / 'events.csv.part').read_text().splitlines()
    assert lines == [f'{i:06d},something happened' for i in range(len(lines))]
    assert 10_000 - 26 < 26 * len(lines) <= 10_000 and path.read_text() == 'of the last run\n'
    with writing(path, log=True) as file:
        file.write('next\n')
    assert names(tmp_path) == ['events.csv'] and path.read_text() == 'next\n'


@pytest.mark.parametrize('problem', [KeyboardInterrupt, SystemExit])
def test_a_log_that_a_signal_ends_gets_its_name(tmp_path: Path, problem: type[BaseException]
                                                ) -> None:
    with pytest.raises(problem):
        with writing(tmp_path / 'events.csv', log=True) as file:
            file.write('one\n')
            raise problem
    assert names(tmp_path) == ['events.csv']
    assert (tmp_path / 'events.csv').read_text() == 'one\n'


def test_two_writers_do_not_mix(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, 'WAIT', 0.2)
    path = tmp_path / 'a.txt'
    with writing(path) as file:
        with pytest.raises(Failure, match='another command writes it'):
            write_text(path, 'second')
        file.write('first')
    assert path.read_text() == 'first' and names(tmp_path) == ['a.txt']


def test_a_link_stays_and_its_file_is_replaced(tmp_path: Path) -> None:
    (tmp_path / 'real').write_text('old')
    (tmp_path / 'link').symlink_to('real')
    write_text(tmp_path / 'link', 'new')
    assert (tmp_path / 'link').is_symlink() and (tmp_path / 'real').read_text() == 'new'


def test_a_folder_that_is_none_is_named(tmp_path: Path) -> None:
    (tmp_path / 'file').touch()
    for check in (lambda: write_text(tmp_path / 'file/a.txt', ''),
                  lambda: check_folder(tmp_path / 'file/out')):
        with pytest.raises(Failure, match=f'{tmp_path}/file: is not a folder'):
            check()
    with pytest.raises(Failure, match='/proc: cannot be written'):  # also by root
        check_folder(Path('/proc/out'))
    check_folder(tmp_path / 'not/yet')
    assert names(tmp_path) == ['file']


WRITER = '''
import sys
from pathlib import Path
from angen_tools.common.files import writing
texts = [letter * 2_000_000 for letter in "abc"]
for i in range(1_000_000):
    with writing(Path(sys.argv[1])) as file:
        for at in range(0, 2_000_000, 100_000):
            file.write(texts[i % 3][at:at + 100_000])
            print(end='.', flush=True)
'''


def test_a_kill_at_any_moment_leaves_a_whole_file(tmp_path: Path) -> None:
    path, chance, interrupted = tmp_path / 'a.txt', random.Random(13), 0
    for _ in range(20):
        writer = subprocess.Popen([sys.executable, '-c', WRITER, str(path)],
                                  stdout=subprocess.PIPE, bufsize=0)
        for _ in range(chance.randrange(1, 60)):  # of 20 a file
            assert writer.stdout.read(1) == b'.'
        writer.kill()
        writer.communicate()
        if path.exists():
            assert path.stat().st_size == 2_000_000 and len(set(path.read_text())) == 1
        interrupted += (tmp_path / 'a.txt.part').exists()
    assert interrupted > 5 and path.exists()
    write_text(path, 'the next one')
    assert names(tmp_path) == ['a.txt'] and path.read_text() == 'the next one'


def test_ctrl_c_waits_for_the_end_of_a_write() -> None:
    done = []
    with pytest.raises(KeyboardInterrupt):
        with later_signals():
            signal.raise_signal(signal.SIGINT)
            done.append('written')
        done.append('not reached')
    assert done == ['written']
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)


def writes(path: Path) -> Iterator[str]:
    """The calls of a source that write files by themselves."""
    for node in ast.walk(ast.parse(path.read_text(encoding='utf-8'))):
        if not isinstance(node, ast.Call):
            continue
        name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(
            node.func, 'id', '')
        words = [w.value for w in node.args if isinstance(w, ast.Constant)]
        if name in ('write_text', 'write_bytes', 'savefig', 'to_csv', 'dump', 'imsave', 'save') \
                and not (isinstance(node.func, ast.Name) or name == 'save'):
            yield f'{path.relative_to(ROOT)}:{node.lineno}: {name}'
        elif name == 'open' and any(set(str(w)) & set('wax+') and len(str(w)) < 4 for w in words):
            yield f'{path.relative_to(ROOT)}:{node.lineno}: open'


def test_nothing_else_writes_files() -> None:
    found = [line for folder in SOURCES for path in sorted((ROOT / folder).rglob('*.py'))
             if path.parts[-2:] != ('common', 'files.py') for line in writes(path)]
    allowed = (f'{SOURCES[0]}/angen_tools/live/sandbox.py',  # logs of its processes
               f'{SOURCES[1]}/angen_apps/automation/program.py',
               f'{SOURCES[1]}/angen_apps/web/chromium.py',
               'bench/angen_bench/gazebo.py',
               'bench/angen_bench/contest.py')  # a model in a temporary folder
    assert [line for line in found if not line.startswith(allowed)] == []
    assert len(found) >= 3
