"""Ends the processes of a command when the command ends, however it ends: also by SIGKILL.

A process of its own waits at a pipe that only the command holds open. The command's processes are
found by a mark in their environment, which children inherit, whatever their parent and session are.
"""
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Iterator

VARIABLE = 'ANGEN_STARTED_BY'
GRACE = 2.0  # s between SIGTERM and SIGKILL
TURN = 0.1  # s between two searches
LIMIT = 10.0  # s after SIGKILL, for processes that do not end
QUIET = 3  # searches in a row that find nothing: a process that is being started has no mark yet
PR_SET_PDEATHSIG = 1


@contextmanager
def watchdog() -> Iterator[None]:
    """All processes that this process starts within, and their children, have ended at the end.

    Not what `fork` alone has made: that calls `end_with_parent`.
    """
    mark = f'{os.getpid()}-{os.urandom(8).hex()}'
    before = os.environ.get(VARIABLE)
    reading, held = os.pipe()
    unmarked: dict[str, str] = {}
    process = subprocess.Popen(
        [sys.executable, '-I', '-S', __file__, f'{VARIABLE}={mark}'], stdin=reading, env=unmarked,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True, cwd='/')
    os.close(reading)
    os.environ[VARIABLE] = mark
    try:
        yield
    finally:
        if before is None:
            del os.environ[VARIABLE]
        else:
            os.environ[VARIABLE] = before
        with suppress(OSError):
            os.write(held, b'.')  # an orderly end: remaining processes get no grace
        os.close(held)
        process.wait()


def end_with_parent(parent: int) -> None:
    """Lets the kernel kill this process, which a thread of `parent` forked, when that ends."""
    import ctypes
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:  # it has ended in the meantime
        os._exit(1)


def marked(mark: str) -> list[int]:
    """Ids of the processes with this `NAME=VALUE` in their environment."""
    found = []
    for entry in os.listdir('/proc'):
        if entry.isdigit():
            with suppress(OSError):  # it has ended, or is another user's
                if mark.encode() in Path(f'/proc/{entry}/environ').read_bytes().split(b'\0'):
                    found.append(int(entry))
    return found


def end_marked(mark: str, grace: float) -> None:
    """Ends the processes with that mark: by SIGTERM, after `grace` s by SIGKILL."""
    end = time.monotonic() + grace
    quiet = 0
    signaled: set[int] = set()
    while quiet < (QUIET if grace else 1) and time.monotonic() < end + LIMIT:
        found = marked(mark)
        quiet = 0 if found else quiet + 1
        for number in found:
            with suppress(OSError):
                if time.monotonic() >= end:
                    os.kill(number, signal.SIGKILL)
                elif number not in signaled:
                    signaled.add(number)
                    os.kill(number, signal.SIGTERM)
        if found or grace:
            time.sleep(TURN)


def main() -> None:
    """The watchdog's process; its argument is the mark."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    orderly = sys.stdin.buffer.read() != b''
    end_marked(sys.argv[1], 0.0 if orderly else GRACE)


if __name__ == '__main__':
    main()
