"""The cost of a world in a process of its own."""
import resource
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import Any, Callable


def _spent(work: Callable[[str], Any], text: str) -> tuple[Any, float, float]:
    work('')
    before, start = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.process_time()
    found = work(text)
    spent = time.process_time() - start
    return found, spent, (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024


def spent_on(work: Callable[[str], Any], text: str) -> tuple[Any, float, float]:
    """The result of `work`, its CPU time (s) and peak memory (MB above what it takes for no text),
    in a process of its own."""
    with ProcessPoolExecutor(1, get_context('spawn')) as pool:
        return pool.submit(_spent, work, text).result(300)
