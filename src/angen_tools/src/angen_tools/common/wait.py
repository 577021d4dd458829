"""Waiting for a condition, with a limit."""
import time
from typing import Callable

from angen_tools.common.failure import Failure

FIRST, LONGEST = 0.01, 0.1  # s between two checks, which become rarer: some query a node


def wait(condition: Callable[[], bool], problem: str, limit: float) -> None:
    """Returns when the condition holds; Failure with `problem` after `limit` s of wall time."""
    end = time.monotonic() + limit
    pause = FIRST
    while not condition():
        if time.monotonic() > end:
            raise Failure(f'{problem} within {limit:g} s')
        time.sleep(pause)
        pause = min(1.5 * pause, LONGEST)
