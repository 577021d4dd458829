"""./angen run: whatever it started is gone after Ctrl-C, and a roscore that it found is not."""
import os
from pathlib import Path
import re
import signal
import socket
import subprocess
import threading
import uuid

import pytest

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.ros
NODE_RUNS = ' models, '  # in the line that the node prints then


@pytest.fixture
def environment(tmp_path):
    """An environment with a ROS master's address of its own, and a mark that children inherit."""
    with socket.socket() as probe:
        probe.bind(('localhost', 0))
        port = probe.getsockname()[1]
    environment = dict(os.environ, ROS_MASTER_URI=f'http://localhost:{port}', DISPLAY='',
                       ROS_HOME=str(tmp_path), ANGEN_TEST_MARK=uuid.uuid4().hex)
    yield environment
    for process_id in marked(environment):
        os.kill(process_id, signal.SIGKILL)


def marked(environment):
    """Ids of the processes that carry the environment's mark."""
    mark = f'ANGEN_TEST_MARK={environment["ANGEN_TEST_MARK"]}'.encode()
    found = []
    for folder in Path('/proc').iterdir():
        try:
            if folder.name.isdigit() and mark in (folder / 'environ').read_bytes().split(b'\0'):
                found.append(int(folder.name))
        except OSError:
            pass  # it ended meanwhile, or is another user's
    return found


def restore_signals():
    """In the child: undoes what a test run in the background or under nohup ignores."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def start(environment):
    """Starts ./angen run and returns it when the node runs, with the lines printed so far."""
    process = subprocess.Popen([ROOT / 'angen', 'run', f'world:={ROOT}/worlds/empty.world'],
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               env=environment, preexec_fn=restore_signals)
    printed = []
    alarm = threading.Timer(120, process.kill)  # a line that never comes must not hold up the tests
    alarm.start()
    for line in process.stdout:
        printed.append(line)
        if NODE_RUNS in line:
            break
    alarm.cancel()
    return process, printed


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_all_that_it_started(environment, number):
    process, printed = start(environment)
    assert any('no display' in line for line in printed)
    assert len(marked(environment)) > 3  # the script, roslaunch, the master, the node
    process.send_signal(number)
    printed += process.communicate(timeout=60)[0].splitlines(keepends=True)
    assert not re.search('process.*started|killing on exit|auto-starting|shutting down|run_id',
                         ''.join(printed))
    assert process.returncode == 128 + number
    assert marked(environment) == []


def test_a_running_roscore_is_used_and_left(environment):
    port = environment['ROS_MASTER_URI'].rpartition(':')[2]
    roscore = subprocess.Popen(['/usr/bin/roscore', '-p', port], stdout=subprocess.PIPE,
                               stderr=subprocess.DEVNULL, text=True, preexec_fn=restore_signals,
                               env=dict(environment, PYTHONUNBUFFERED='1'))
    for line in roscore.stdout:
        if 'started core service' in line:
            break
    before = marked(environment)
    process, _ = start(environment)
    masters = [number for number in marked(environment)
               if b'rosmaster' in Path(f'/proc/{number}/cmdline').read_bytes()]
    assert len(masters) == 1
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert sorted(marked(environment)) == sorted(before)
    roscore.send_signal(signal.SIGINT)
    roscore.communicate(timeout=60)


def test_a_world_that_cannot_be_read_ends_it_with_failure(environment, tmp_path):
    (tmp_path / 'broken.world').write_text('<sdf version="1.6"><world name="w"></sdf>')
    result = subprocess.run([ROOT / 'angen', 'run', f'world:={tmp_path}/broken.world'],
                            capture_output=True, text=True, env=environment, timeout=120)
    assert result.returncode == 1
    assert 'broken.world:' in result.stdout + result.stderr
    assert 'process has died' in result.stderr  # of roslaunch's lines those of errors stay


def test_an_unknown_argument_is_named(environment):
    result = subprocess.run([ROOT / 'angen', 'run', 'wrold:=worlds/empty.world'],
                            capture_output=True, text=True, env=environment, timeout=120)
    assert result.returncode == 1
    assert 'wrold' in result.stderr
