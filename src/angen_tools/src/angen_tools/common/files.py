"""Files that commands write. A file has its name only when all of it is written: before, it is
NAME.part beside it. After an error, a full disk or SIGKILL, an older file of the name is unchanged.
"""
import csv
import errno
import fcntl
import os
import signal
import tempfile
import threading
import time
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any, Iterable, Iterator

from angen_tools.common.failure import Failure

WAIT = 5.0  # s, for another command that writes the same file
LONGEST = 1 << 20  # bytes of a line


@contextmanager
def writing(path: Path, binary: bool = False, log: bool = False) -> Iterator[IO[Any]]:
    """A file to write, as UTF-8 unless `binary`; missing folders are made.

    A `log` is useful in part: a signal that ends the command ends it, too, so that it gets its
    name; after an error the whole lines of a text stay in NAME.part. Failure if it cannot be
    written.
    """
    target = path.resolve()
    try:
        if path.exists() and not path.is_file():  # a terminal; a pipe, whose target has no name
            with _opened(os.open(path, os.O_WRONLY), binary) as file:
                yield file
        else:
            make_folder(target.parent)
            yield from _in_part(target, binary, log)
    except BrokenPipeError:
        raise
    except OSError as error:
        rest = f'; the lines written before are in {path}.part' if log and not binary else ''
        raise Failure(f'{path}: cannot be written: {error.strerror or error}{rest}') from None


def _in_part(target: Path, binary: bool, log: bool) -> Iterator[IO[Any]]:
    if target.exists() and not os.access(target, os.W_OK):  # replacing it would be allowed
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    part = target.with_name(target.name + '.part')
    file = _opened(_locked(part), binary)
    try:
        try:
            yield file
        except (KeyboardInterrupt, SystemExit):
            if log:
                _finish(file, part, target)
            raise
        _finish(file, part, target)
    except BaseException:
        with suppress(OSError):  # its data could not be written
            file.close()
        with suppress(FileNotFoundError):  # it is finished
            _cut(part) if log and not binary else part.unlink()
        raise


def _opened(descriptor: int, binary: bool) -> IO[Any]:
    if binary:
        return open(descriptor, 'wb')
    return open(descriptor, 'w', encoding='utf-8', newline='')


def _locked(part: Path) -> int:
    """A descriptor of the empty file, which no other command writes until it is closed."""
    end = time.monotonic() + WAIT
    while True:
        made = os.open(part, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o666)
        try:
            fcntl.flock(made, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if os.path.samestat(os.fstat(made), os.stat(part)):  # it is not finished yet
                os.ftruncate(made, 0)
                return made
        except (BlockingIOError, FileNotFoundError):
            if time.monotonic() > end:
                os.close(made)
                raise BlockingIOError(errno.EAGAIN, 'another command writes it') from None
        os.close(made)
        time.sleep(0.02)


def _finish(file: IO[Any], part: Path, target: Path) -> None:
    file.flush()
    os.fsync(file.fileno())
    os.replace(part, target)
    file.close()


def _cut(part: Path) -> None:
    """Removes the end of a line that could not be written whole."""
    with part.open('rb+') as file:
        size = file.seek(0, os.SEEK_END)
        begin = file.seek(max(0, size - LONGEST))
        file.truncate(begin + file.read().rfind(b'\n') + 1)


@contextmanager
def later_signals() -> Iterator[None]:
    """Ctrl-C, SIGTERM and SIGHUP wait for the end of this block: an interrupted write would damage
    a compressed file, and a process that has just been started would be forgotten."""
    if threading.current_thread() is not threading.main_thread():
        yield  # signals interrupt the main thread only
        return
    came: list[int] = []
    before = {number: signal.signal(number, lambda came_now, _: came.append(came_now))
              for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        for one in came[:1]:
            signal.raise_signal(one)


def make_folder(path: Path) -> None:
    """Makes a folder where there is none; Failure if it cannot be made."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise Failure(f'{path}: is not a folder') from None
    except OSError as error:
        raise Failure(f'{path}: cannot be made: {error.strerror}') from None


def check_folder(path: Path, better: str = 'a folder of yours, as --out DIR') -> None:
    """Failure if files cannot be written into a folder, which may be missing: before work whose
    result would be lost."""
    nearest = next(folder for folder in (path.absolute(), *path.absolute().parents)
                   if folder.exists())
    if not nearest.is_dir():
        raise Failure(f'{nearest}: is not a folder')
    try:
        with tempfile.TemporaryFile(dir=nearest):  # root may write anywhere, and cannot in /proc
            pass
    except OSError:
        raise Failure(f'{nearest}: cannot be written; give {better}') from None


def check_output(path: Path, ending: str = '') -> None:
    """Failure if a file cannot be written, or its name has another ending: before work whose
    result would be lost."""
    if not path.name.lower().endswith(ending):
        raise Failure(f'{path}: must end in {ending}')
    if path.is_dir():
        raise Failure(f'{path}: is a folder; give a file')
    check_folder(path.absolute().parent, 'a file in a folder of yours')


def write_text(path: Path, text: str) -> None:
    """Writes a text file."""
    with writing(path) as file:
        file.write(text)


def write_csv(path: Path, head: Iterable[Any], rows: Iterable[Iterable[Any]]) -> None:
    """Writes a table with a line of names."""
    with writing(path) as file:
        writer = csv.writer(file, lineterminator='\n')
        writer.writerow(head)
        writer.writerows(rows)


def pyplot() -> Any:
    """matplotlib.pyplot, which needs no display."""
    import matplotlib
    matplotlib.use('Agg')
    from matplotlib import pyplot as made
    return made


def save_figure(figure: Any, path: Path, **options: Any) -> None:
    """Writes a figure of pyplot as PNG, or another `format`, and closes it; `options` as of its
    savefig."""
    with writing(path, binary=True) as file:
        figure.savefig(file, **{'format': 'png', **options})
    pyplot().close(figure)
