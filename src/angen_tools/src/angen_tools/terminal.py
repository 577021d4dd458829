"""A terminal whose keys come one by one."""
from __future__ import annotations

import signal
import sys
import termios
import tty
from contextlib import contextmanager
from typing import Any, Iterator


@contextmanager
def single_keys() -> Iterator[None]:
    """Keys of stdin come one by one and unseen; all is put back at the end, however it ends."""
    before = termios.tcgetattr(sys.stdin)
    signals = {number: signal.signal(number, _end) for number in (signal.SIGTERM, signal.SIGHUP)}
    try:
        tty.setcbreak(sys.stdin)
        yield
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)
        for number, handler in signals.items():
            signal.signal(number, handler)


def _end(number: int, _: Any) -> None:
    sys.exit(128 + number)  # as a shell says of a command that a signal ended
