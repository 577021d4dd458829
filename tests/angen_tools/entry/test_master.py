"""The program at the address of the ROS master."""
import socket
import threading
from typing import Iterator
from xmlrpc.server import SimpleXMLRPCServer

import pytest

from angen_tools.common.failure import Failure
from angen_tools.entry import master
from angen_tools.entry.master import answers, running_node, start_master


class Server(SimpleXMLRPCServer):
    """A master and its nodes at once."""

    def __init__(self) -> None:
        super().__init__(('127.0.0.1', 0), logRequests=False)
        self.uri = f'http://127.0.0.1:{self.server_address[1]}'
        self.node = self.uri
        self.register_function(lambda caller: (1, '', self.uri), 'getUri')
        self.register_function(lambda caller: (1, '', 4711), 'getPid')
        self.register_function(
            lambda caller, name: (1, '', self.node) if name == '/angen' else (-1, 'unknown', ''),
            'lookupNode')


@pytest.fixture
def server() -> Iterator[Server]:
    made = Server()
    threading.Thread(target=made.serve_forever, args=(0.02,), daemon=True).start()
    yield made
    made.shutdown()
    made.server_close()


def free_uri() -> str:
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return f'http://127.0.0.1:{probe.getsockname()[1]}'


def test_a_node_that_runs_is_found(server: Server) -> None:
    assert answers(server.uri) and start_master(server.uri) is None
    assert running_node(server.uri, '/angen') == 'process 4711'
    assert running_node(server.uri, '/other') == ''


def test_a_node_that_is_registered_and_gone_is_not_running(server: Server) -> None:
    server.node = free_uri()
    assert running_node(server.uri, '/angen') == ''


def test_a_node_that_does_not_answer_is_running(server: Server, monkeypatch: pytest.MonkeyPatch
                                                ) -> None:
    monkeypatch.setattr(master, 'ANSWER_LIMIT', 0.2)
    with socket.socket() as silent:
        silent.bind(('127.0.0.1', 0))
        silent.listen()
        server.node = f'http://127.0.0.1:{silent.getsockname()[1]}'
        assert running_node(server.uri, '/angen') == 'it does not answer'
        with pytest.raises(Failure, match='does not answer'):
            answers(server.node)


def test_no_master_is_no_node() -> None:
    uri = free_uri()
    assert not answers(uri) and running_node(uri, '/angen') == ''


def test_what_is_not_ros_is_named() -> None:
    server = SimpleXMLRPCServer(('127.0.0.1', 0), logRequests=False)
    threading.Thread(target=server.serve_forever, args=(0.02,), daemon=True).start()
    with pytest.raises(Failure, match='is not a part of ROS'):
        answers(f'http://127.0.0.1:{server.server_address[1]}')
    server.shutdown()
    server.server_close()
