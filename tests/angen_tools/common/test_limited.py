"""Work in a process of its own: its results, its limits, and signals."""
import os
import signal
import subprocess
import sys
import time

import pytest

from angen_tools.common import limited
from angen_tools.common.failure import Failure
from angen_tools.common.limited import run_limited

LIMIT = 2.0  # s of wall time from a signal to the end
# A regular expression that takes years holds the interpreter: no handler in Python runs.
STUCK = '''
import re, sys
from angen_tools.common.limited import run_limited
print('begun', flush=True)
run_limited('file', re.match, r'(a+)+$', 'a' * 60 + 'b')
'''


def fail(error: Exception) -> None:
    raise error


def test_a_result_and_an_exception_come_back() -> None:
    assert run_limited('file', divmod, 17, 5) == (3, 2)
    with pytest.raises(Failure, match='^file:3: is wrong$'):
        run_limited('file', fail, Failure('file:3: is wrong'))
    with pytest.raises(ZeroDivisionError) as raised:
        run_limited('file', divmod, 17, 0)
    assert 'divmod' not in str(raised.value) and '_outcome' in raised.value.__notes__[0]
    large = bytes(range(256)) * 4096  # more than a pipe holds
    assert run_limited('file', bytes, large) == large


def test_what_it_does_stays_there() -> None:
    run_limited('file', os.environ.__setitem__, 'ANGEN_TEST_LIMITED', '1')
    assert 'ANGEN_TEST_LIMITED' not in os.environ


@pytest.mark.parametrize('what, message', [
    ('bytearray(2 << 30)', 'file: needs more than 1 GB of memory to read'),
    ('all(1 for _ in iter(int, 1))', 'file: takes more than 1 s of CPU time to read; simplify it'),
    ('__import__("os").kill(os.getpid(), 9)', 'file: is damaged: reading it crashed')])
def test_limits(what: str, message: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limited, 'SECONDS', 1)
    with pytest.raises(Failure, match=message):
        run_limited('file', eval, what)


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_signals_end_it_inside_a_library_in_c(number: int) -> None:
    process = subprocess.Popen([sys.executable, '-c', STUCK], stdout=subprocess.PIPE, text=True,
                               stderr=subprocess.DEVNULL, start_new_session=True)
    assert process.stdout and process.stdout.readline() == 'begun\n'
    time.sleep(0.3)
    began = time.monotonic()
    process.send_signal(number)  # to the parent alone: a terminal's Ctrl-C reaches both
    assert process.wait(timeout=30) != 0 and time.monotonic() - began < LIMIT
    while True:  # the other process has the same session
        try:
            os.killpg(process.pid, 0)
        except ProcessLookupError:
            break
        assert time.monotonic() - began < LIMIT
        time.sleep(0.01)
