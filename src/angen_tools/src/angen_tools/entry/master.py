"""The ROS master that ./angen run uses: one that runs already, or one of its own."""
import http.client
import shutil
import socket
import subprocess
import sys
import time
from typing import Any
from urllib.parse import urlsplit
from xmlrpc.client import Error, ServerProxy, Transport

from angen_tools.common.failure import Failure

ANSWER_LIMIT = 3.0  # s
START_LIMIT = 60.0
CALLER = '/angen_run'
PORT = 11311


class Limited(Transport):
    """XML-RPC with a timeout."""

    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        connection = super().make_connection(host)
        connection.timeout = ANSWER_LIMIT
        return connection


def call(uri: str, method: str, *arguments: str) -> Any:
    """The value of a method of a ROS master or node; None if it fails. OSError if nothing
    listens, Failure if the listener is not of ROS or does not answer."""
    try:
        code, _, value = getattr(ServerProxy(uri, Limited()), method)(CALLER, *arguments)
    except TimeoutError:
        raise Failure(f'{uri} does not answer') from None
    except (Error, http.client.HTTPException, TypeError, ValueError):
        raise Failure(f'the program at {uri} is not a part of ROS') from None
    return value if code == 1 else None


def answers(uri: str) -> bool:
    """Whether a master runs there."""
    try:
        return call(uri, 'getUri') is not None
    except OSError:
        return False


def running_node(uri: str, name: str) -> str:
    """The process of the node of that name, as 'process 123'; '' where it does not run."""
    try:
        address = call(uri, 'lookupNode', name)
        return f'process {call(address, "getPid")}' if address else ''
    except Failure:
        return 'it does not answer'  # stopped, or busy
    except OSError:
        return ''


def master_command(port: int) -> list[str]:
    """The command line of a master; Failure if it is not installed."""
    program = shutil.which('rosmaster')
    if not program:
        raise Failure('rosmaster is not found; install ros-core')
    return [sys.executable, program, '--core', '-p', str(port)]


def start_master(uri: str) -> subprocess.Popen[bytes] | None:
    """Starts a master at that address; None if one runs. Failure if it cannot."""
    if answers(uri):
        return None
    address = urlsplit(uri)
    _check_local(uri, address.hostname or '')
    process = subprocess.Popen(
        master_command(address.port or PORT), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
        start_new_session=True)
    end = time.monotonic() + START_LIMIT
    while not answers(uri):
        if process.poll() is not None or time.monotonic() > end:
            raise Failure(f'no ROS master could be started at {uri}')
        time.sleep(0.05)
    return process


def _check_local(uri: str, host: str) -> None:
    from rosgraph.network import get_local_addresses, is_local_address
    try:
        if is_local_address(host) or socket.gethostbyname(host) in get_local_addresses():
            return
    except OSError:
        pass
    raise Failure(f'no ROS master answers at {uri}; start roscore there, or set ROS_MASTER_URI')
