"""How pytest runs all tests: the longest files first, and Ctrl-C ends what tests start."""
from __future__ import annotations

import signal
from pathlib import Path

import pytest

# By CPU time, the longest first: a file runs on one worker, and should not begin last. Without
# an entry a file runs after these.
LONG = ('docs/test_commands.py', 'docs/test_thesis.py', 'ros/test_cli.py', 'ros/test_soak.py',
        'ros/test_patrol_run.py', 'ros/test_replay_run.py', 'ros/test_traffic.py',
        'angen_apps/walktest/test_command.py', 'angen_apps/seek/test_command.py',
        'py/test_replay.py', 'ros/test_rmf.py', 'worlds/test_world_geometry.py')
TESTS = Path(__file__).parent
ORDER = {TESTS / name: place for place, name in enumerate(LONG)}

# A shell ignores SIGINT in a process that it starts by &, and children inherit that.
if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Keeps the order within a file."""
    items.sort(key=lambda item: ORDER.get(item.path, len(ORDER)))
