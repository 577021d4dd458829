"""The processes of a command end with it."""
import os
import random
import signal
import subprocess
import sys
import time
import uuid
from pathlib import Path

import pytest

from angen_tools.common.watchdog import VARIABLE, marked, watchdog

LIMIT = 5.0  # s of wall time, as the page says
# Starts a process that starts one in a session of its own; that ignores SIGTERM.
PARENT = '''
import subprocess, sys, time
from angen_tools.common.watchdog import watchdog
with watchdog():
    for _ in range(5):
        subprocess.Popen(["sh", "-c",
                          "setsid sh -c 'trap : TERM; while :; do sleep 1; done' & sleep 99"])
        print("started", flush=True)
    time.sleep(99)
'''


@pytest.fixture
def mark(monkeypatch: pytest.MonkeyPatch) -> str:
    """The environment of a test's processes, besides the mark of the watchdog."""
    value = uuid.uuid4().hex
    monkeypatch.setenv('ANGEN_TEST_MARK', value)
    return f'ANGEN_TEST_MARK={value}'


def has_ended(mark: str) -> bool:
    """Whether no process has the mark before the limit."""
    end = time.monotonic() + LIMIT
    while marked(mark):
        if time.monotonic() > end:
            return False
        time.sleep(0.05)
    return True


def seen(mark: str) -> list[int]:
    """The processes with the mark; Linux shows an environment a moment after Popen's exec."""
    end = time.monotonic() + LIMIT
    while not (found := marked(mark)) and time.monotonic() < end:
        time.sleep(0.01)
    return found


@pytest.mark.parametrize('seed', range(4))
def test_a_kill_ends_all_that_was_started(mark: str, seed: int) -> None:
    parent = subprocess.Popen([sys.executable, '-c', PARENT], stdout=subprocess.PIPE, text=True)
    for _ in range(seed + 1):  # the last ones are being started
        assert parent.stdout.readline() == 'started\n'
    time.sleep(random.Random(seed).uniform(0.0, 0.1))
    assert len(marked(mark)) > 1
    parent.kill()
    parent.communicate()
    assert has_ended(mark)


def test_a_signal_to_the_group_does_not_end_the_watchdog(mark: str) -> None:
    parent = subprocess.Popen([sys.executable, '-c', PARENT], stdout=subprocess.PIPE, text=True,
                              start_new_session=True)
    assert parent.stdout.readline() == 'started\n'
    os.killpg(parent.pid, signal.SIGKILL)
    parent.communicate()
    assert has_ended(mark)


def test_an_orderly_end_leaves_nothing(mark: str) -> None:
    before = os.environ.get(VARIABLE)
    with watchdog():
        assert os.environ[VARIABLE] != before
        inner = f'{VARIABLE}={os.environ[VARIABLE]}'
        forgotten = subprocess.Popen(['sleep', '99'])
        assert seen(inner) == [forgotten.pid]
    assert forgotten.wait(1.0) == -signal.SIGKILL
    assert os.environ.get(VARIABLE) == before


def test_other_processes_continue() -> None:
    other = subprocess.Popen(['sleep', '99'])
    with watchdog():
        pass
    assert other.poll() is None
    other.kill()
    other.wait()


FORKER = '''
import os, time
from angen_tools.common.watchdog import end_with_parent
parent = os.getpid()
if os.fork() == 0:
    end_with_parent(parent)
    print(os.getpid(), flush=True)
time.sleep(99)
'''


def test_a_fork_ends_with_its_parent() -> None:
    parent = subprocess.Popen([sys.executable, '-c', FORKER], stdout=subprocess.PIPE, text=True)
    child = Path('/proc') / parent.stdout.readline().strip()
    assert child.exists()
    parent.kill()
    parent.wait()
    end = time.monotonic() + LIMIT
    while child.exists() and '\nState:\tZ' not in (child / 'status').read_text():
        assert time.monotonic() < end
        time.sleep(0.02)
