"""Waiting for a condition, with a limit."""
from __future__ import annotations

import time
from typing import Callable

from angen_tools.common.failure import Failure

PERIOD = 0.01  # s between two checks


def wait(condition: Callable[[], bool], problem: str, limit: float) -> None:
    """Returns when the condition holds; Failure with `problem` after `limit` s of wall time."""
    end = time.monotonic() + limit
    while not condition():
        if time.monotonic() > end:
            raise Failure(f'{problem} within {limit:g} s')
        time.sleep(PERIOD)
