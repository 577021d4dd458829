"""./angen run: it ends all that it started after Ctrl-C, and no roscore that it found."""
import contextlib
import os
from pathlib import Path
import random
import re
import signal
import socket
import subprocess
import threading
import time
import uuid

import pytest
from harness import free_port

from angen_tools.common.watchdog import VARIABLE, marked as with_mark, watchdog

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.ros
NODE_RUNS = 'Ctrl-C ends it'  # in the line that is printed then


@pytest.fixture
def environment(tmp_path):
    """An environment with a ROS master's address of its own, and a mark that children inherit."""
    environment = dict(os.environ, ROS_MASTER_URI=f'http://localhost:{free_port()}', DISPLAY='',
                       ROS_HOME=str(tmp_path), ANGEN_TEST_MARK=uuid.uuid4().hex)
    with watchdog():  # also when the tests are killed
        yield dict(environment, **{VARIABLE: os.environ[VARIABLE]})


def marked(environment):
    """Ids of the processes that carry the environment's mark."""
    return with_mark(f'ANGEN_TEST_MARK={environment["ANGEN_TEST_MARK"]}')


def running(environment):
    """Master and node of those processes."""
    found = []
    for number in marked(environment):
        with contextlib.suppress(FileNotFoundError):  # it has ended meanwhile
            if re.search(b'rosmaster|angen_node', Path(f'/proc/{number}/cmdline').read_bytes()):
                found.append(number)
    return found


def restore_signals():
    """In the child: restores signals that tests in the background or under nohup ignore."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def until(process, words):
    """Its output, up to a line with these words."""
    printed = []
    alarm = threading.Timer(120, process.kill)  # a line that never comes must not hold up the tests
    alarm.start()
    try:
        for line in process.stdout:
            printed.append(line)
            if words in line:
                return printed
    finally:
        alarm.cancel()
    raise AssertionError(f'{words} is not in:\n{"".join(printed)}')


def start(environment):
    """Starts ./angen run and returns it when the node runs, with the lines printed until then."""
    process = subprocess.Popen([ROOT / 'angen', 'run', f'world:={ROOT}/worlds/empty.world'],
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               env=environment, preexec_fn=restore_signals)
    return process, until(process, NODE_RUNS)


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
    assert (result.stdout + result.stderr).count('broken.world:') == 1
    assert not re.search('Traceback|process has died|====|no display|Ctrl-C|ended unexpectedly',
                         result.stdout + result.stderr)


@pytest.mark.parametrize('wait', [0.3, 1.0, 2.0])
def test_an_early_ctrl_c_prints_no_traceback(environment, wait):
    process = subprocess.Popen([ROOT / 'angen', 'run', f'world:={ROOT}/worlds/empty.world'],
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               env=environment, preexec_fn=restore_signals)
    time.sleep(wait)
    process.send_signal(signal.SIGINT)
    printed = process.communicate(timeout=60)[0]
    assert 'Traceback' not in printed and 'KeyboardInterrupt' not in printed, printed
    assert process.returncode in (130, -signal.SIGINT) and marked(environment) == []


def test_a_ctrl_c_while_python_starts_prints_no_traceback(environment, tmp_path):
    (tmp_path / 'sitecustomize.py').write_text(
        'import os, signal\nos.kill(os.getpid(), signal.SIGINT)\n')
    path = f'{tmp_path}:{os.environ.get("PYTHONPATH", "")}'
    done = subprocess.run([ROOT / 'angen', 'run', f'world:={ROOT}/worlds/empty.world'],
                          capture_output=True, text=True, timeout=60, preexec_fn=restore_signals,
                          env=environment | {'PYTHONPATH': path})
    assert done.stdout + done.stderr == '' and done.returncode == -signal.SIGINT
    assert marked(environment) == []


@pytest.mark.parametrize('word, part', [
    ('wrold:=worlds/empty.world', 'did you mean world:=?'),
    ('port:=eighty', 'not a port; give 1024 to 65535')])
def test_a_wrong_argument_is_named_and_nothing_starts(environment, word, part):
    result = subprocess.run([ROOT / 'angen', 'run', word],
                            capture_output=True, text=True, env=environment, timeout=120)
    line, = result.stderr.splitlines()
    assert result.returncode == 2 and line.startswith(f'angen: {word}: ') and part in line


def test_a_port_in_use_is_named_and_nothing_starts(environment):
    with socket.socket() as taken:
        taken.bind(('127.0.0.1', 0))
        taken.listen()
        port = taken.getsockname()[1]
        result = subprocess.run([ROOT / 'angen', 'run', 'web:=true', f'port:={port}'],
                                capture_output=True, text=True, env=environment, timeout=120)
    line, = result.stderr.splitlines()
    assert result.returncode == 1 and f'127.0.0.1:{port} cannot be served: Address already' in line


def test_roslaunch_rejects_it_too(environment):
    result = subprocess.run([ROOT / 'angen', 'shell', '-c',
                             'roslaunch angen_sim angen.launch wrld:=x'],
                            capture_output=True, text=True, env=environment, timeout=120)
    assert result.returncode == 2
    assert 'wrld:=x: ' in result.stderr and 'did you mean world:=?' in result.stderr
    assert marked(environment) == []


def test_a_second_one_leaves_the_first_alone(environment):
    first, _ = start(environment)
    before = running(environment)
    assert len(before) == 2
    second = subprocess.run([ROOT / 'angen', 'run'], capture_output=True, text=True,
                            env=environment, timeout=120)
    last = second.stderr.splitlines()[-1]
    uri = environment['ROS_MASTER_URI']
    assert second.returncode == 1 and f'already running at {uri} (process ' in last
    port = int(uri.rpartition(':')[2]) + 1
    assert f'ROS_MASTER_URI=http://localhost:{port} ./angen run' in last and 'rosnode kill' in last
    time.sleep(2.0)
    assert first.poll() is None and running(environment) == before
    first.send_signal(signal.SIGINT)
    first.communicate(timeout=60)
    assert marked(environment) == []


@pytest.mark.parametrize('seed', range(4))
def test_a_kill_leaves_nothing(environment, seed):
    """At any moment: from the start of the master until after the node runs."""
    process = subprocess.Popen([ROOT / 'angen', 'run', f'world:={ROOT}/worlds/empty.world'],
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               env=environment, preexec_fn=restore_signals)
    if seed < 2:
        while not running(environment):
            time.sleep(0.02)
    else:
        until(process, NODE_RUNS)
    time.sleep(random.Random(seed).uniform(0.0, 1.5))
    assert len(marked(environment)) > 1
    process.kill()
    process.wait()
    end = time.monotonic() + 5.0
    while marked(environment) and time.monotonic() < end:
        time.sleep(0.05)
    assert marked(environment) == []
