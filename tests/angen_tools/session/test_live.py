"""The way to the simulator, without one."""
import subprocess
import sys
from types import SimpleNamespace
from typing import Any

import pytest

from angen_tools.common.failure import Failure
from angen_tools.session import live
from angen_tools.session.live import Inbox, Live, News

COMMAND = '''
import sys
from angen_tools.live import listing
from angen_tools.session import live
live.import_genpy()
import rospy
from angen_msgs.srv import List
from geometry_msgs.msg import Point
print('numpy' in sys.modules)
import io, numpy
Point(numpy.float64(1), numpy.float32(2), 3).serialize(io.BytesIO())
print(numpy.arange(3).sum())
'''


def test_a_command_starts_without_numpy() -> None:
    done = subprocess.run([sys.executable, '-c', COMMAND], text=True, capture_output=True)
    assert (done.stdout, done.stderr) == ('False\n3\n', '')


class Connections:
    """Records the arguments of subscribers and publishers; is the subscriber, too."""

    def __init__(self) -> None:
        self.asked: list[bool] = []

    def connect(self, *_: Any, tcp_nodelay: bool = False, **__: Any) -> SimpleNamespace:
        self.asked.append(tcp_nodelay)
        return SimpleNamespace(get_num_connections=lambda: 1)


@pytest.fixture
def connections(monkeypatch: pytest.MonkeyPatch) -> Connections:
    made = Connections()
    monkeypatch.setitem(sys.modules, 'rospy', SimpleNamespace(Subscriber=made.connect,
                                                              Publisher=made.connect))
    return made


def inbox(most: int) -> Inbox:
    return Inbox(News(), '/topic', object, most, lambda _: None)


def test_messages_do_not_wait_for_acknowledgments(connections: Connections) -> None:
    """TCP holds back a small message until the one before is acknowledged: up to 40 ms."""
    inbox(1)
    world = Live.__new__(Live)
    world._is_node = True
    world.publisher('/cmd_vel', object)
    assert connections.asked == [True, True]


def test_an_inbox_hands_out_each_message_once(connections: Connections) -> None:
    box = inbox(live.MOST)
    box._put('a')
    box._put('b')
    assert (box.take(), box.take(), box.latest, box.count) == (['a', 'b'], [], 'b', 2)


def test_more_messages_than_an_inbox_keeps_are_a_failure(connections: Connections) -> None:
    box = inbox(live.MOST)
    for number in range(live.MOST + 1):
        box._put(number)
    with pytest.raises(Failure, match='/topic: 20000 messages'):
        box.take()
    assert box.take() == []
