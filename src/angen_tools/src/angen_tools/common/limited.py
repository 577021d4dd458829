"""Work on files of others in a process of its own, as angen_mesh reads meshes: its memory and CPU
time have limits, and a signal ends it at once, also inside a library in C."""
import ctypes  # noqa: F401: end_with_parent() imports it, once instead of in each process
import os
import re
import resource
import signal
import traceback
from contextlib import suppress
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, Callable, NoReturn, TypeVar

from angen_tools.common.failure import Failure
from angen_tools.common.watchdog import end_with_parent

MEMORY = 1 << 30  # bytes, beside those of this process
SECONDS = 60  # CPU time
T = TypeVar('T')


def run_limited(file: object, work: Callable[..., T], *arguments: Any) -> T:
    """The result of `work`, or the exception that it raises. Failure that names the file if it
    needs more than the limits, or crashes."""
    parent = os.getpid()
    reading, writing = Pipe(duplex=False)
    child = os.fork()
    if not child:
        _work(parent, writing, file, work, arguments)
    writing.close()
    result: Any = None
    error: Exception | None = None
    try:
        with reading, suppress(EOFError):  # the process has ended without an answer
            result, error = reading.recv()
    except BaseException:  # a signal
        os.kill(child, signal.SIGKILL)
        raise
    finally:
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if code == -signal.SIGXCPU:
        raise Failure(f'{file}: takes more than {SECONDS} s of CPU time to read; simplify it')
    if code:
        raise Failure(f'{file}: is damaged: reading it crashed')
    if error is not None:
        raise error
    made: T = result
    return made


def _work(parent: int, answer: Connection, file: object, work: Callable[..., Any],
          arguments: tuple[Any, ...]) -> NoReturn:
    """In the other process: sends the result and the exception."""
    code = 1
    try:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_DFL)
        end_with_parent(parent)
        own = re.search(r'VmData:\s*(\d+)', Path('/proc/self/status').read_text())
        memory = MEMORY + 1024 * int(own[1] if own else 0)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 1))
        resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))
        answer.send(_outcome(file, work, arguments))
        code = 0
    finally:
        os._exit(code)


def _outcome(file: object, work: Callable[..., Any], arguments: tuple[Any, ...]
             ) -> tuple[Any, Exception | None]:
    try:
        return work(*arguments), None
    except MemoryError:
        return None, Failure(f'{file}: needs more than {MEMORY >> 30} GB of memory to read; it is '
                             'damaged or too large')
    except Exception as error:
        error.add_note(traceback.format_exc())
        return None, error
