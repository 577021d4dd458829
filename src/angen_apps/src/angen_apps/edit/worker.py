"""A process that works on drawings, each in a process of its own with limits."""
import os
import signal
import threading
from contextlib import suppress
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from typing import Any, Callable

from angen_tools.common.failure import Failure
from angen_tools.common.limited import run_limited
from angen_tools.common.watchdog import end_with_parent


class Worker:
    """Forks for each task, which the server cannot do beside its threads: make it before these."""

    def __init__(self) -> None:
        parent = os.getpid()
        self._pipe, theirs = Pipe()
        self._turn = threading.Lock()
        self._child = os.fork()
        if not self._child:
            self._pipe.close()
            _serve(parent, theirs)
        theirs.close()

    def run(self, file: object, work: Callable[..., Any], *arguments: Any) -> Any:
        """The result of `work`, or the exception that it raises; see run_limited."""
        with self._turn:
            try:
                self._pipe.send((file, work, arguments))
                result, error = self._pipe.recv()
            except (EOFError, OSError):
                raise Failure(f'{file}: the process that works on drawings has ended; start '
                              'angen edit again') from None
        if error is not None:
            raise error
        return result

    def end(self) -> None:
        """Ends the process, and its work."""
        self._pipe.close()
        os.kill(self._child, signal.SIGTERM)
        os.waitpid(self._child, 0)


def _serve(parent: int, tasks: Connection) -> None:
    try:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # it ends with its parent
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        end_with_parent(parent)
        with suppress(EOFError):
            while True:
                tasks.send(_outcome(*tasks.recv()))
    finally:
        os._exit(0)


def _outcome(file: object, work: Callable[..., Any], arguments: tuple[Any, ...]
             ) -> tuple[Any, Exception | None]:
    try:
        return run_limited(file, work, *arguments), None
    except Exception as error:
        return None, error
