"""Limits of what a client sends: checked by its length, before the bytes take memory."""
from __future__ import annotations

import socket
import struct
from typing import Any
from urllib.parse import urlparse

import pytest
import rospy
from angen_msgs.srv import List
from harness import Angen, until
from std_msgs.msg import String

ALLOWED, TOO_MUCH = 15 << 20, 17 << 20  # bytes
WAIT = {False: 1.0, True: 20.0}  # s, by whether the end of a connection is expected


def fields(*entries: bytes) -> bytes:
    """A header of a connection."""
    body = b''.join(struct.pack('<I', len(entry)) + entry for entry in entries)
    return struct.pack('<I', len(body)) + body


def connect(uri: str) -> socket.socket:
    found = urlparse(uri)
    client = socket.create_connection((found.hostname, found.port or 0), timeout=20)
    return client


def is_closed(client: socket.socket, expected: bool) -> bool:
    client.settimeout(WAIT[expected])
    try:
        return client.recv(1) == b''
    except ConnectionResetError:
        return True
    except socket.timeout:
        return False


def begin_call(angen: Angen, service: str, kind: Any) -> socket.socket:
    """A client that has sent its header, and read the answer to it."""
    client = connect(angen.master.api.lookupService('/test', service)[2])
    client.sendall(fields(b'callerid=/raw', b'service=' + service.encode(),
                          b'md5sum=' + kind._md5sum.encode()))
    size, = struct.unpack('<I', client.recv(4, socket.MSG_WAITALL))
    client.recv(size, socket.MSG_WAITALL)
    return client


@pytest.mark.parametrize(('size', 'closed'), [(ALLOWED, False), (TOO_MUCH, True)])
def test_a_request_is_rejected_by_its_length(angen: Angen, size: int, closed: bool) -> None:
    with begin_call(angen, '/angen/list', List) as client:
        client.sendall(struct.pack('<I', size))
        assert is_closed(client, closed) is closed
    if closed:
        until(lambda: f'a request of {size} bytes' in angen.log(), 'the reason is logged')


@pytest.mark.parametrize(('size', 'closed'), [(1 << 19, False), (2 << 20, True)])
def test_a_header_is_rejected_by_its_length(angen: Angen, size: int, closed: bool) -> None:
    with connect(angen.master.api.lookupService('/test', '/angen/list')[2]) as client:
        client.sendall(struct.pack('<I', size))
        assert is_closed(client, closed) is closed


def test_a_publisher_of_too_large_messages_is_left(angen: Angen, rospy_node: None) -> None:
    publisher = rospy.Publisher('/gazebo/Door_controller', String, queue_size=1)
    try:
        until(lambda: publisher.get_num_connections() == 1, 'the node subscribes')
        publisher.publish('x' * TOO_MUCH)

        def is_left() -> bool:
            publisher.impl.check()
            return publisher.get_num_connections() == 0

        until(is_left, 'the node leaves it')
    finally:
        publisher.unregister()


def call(values: int) -> bytes:
    """getPid of XML-RPC with so many values in each other."""
    begin, end = b'<value><array><data>', b'</data></array></value>'
    return (b'<?xml version="1.0"?><methodCall><methodName>getPid</methodName><params><param>'
            + begin * values + b'<value>/test</value>' + end * values
            + b'</param></params></methodCall>')


@pytest.mark.parametrize(('values', 'closed'), [(0, False), (90, False), (1000, True)])
def test_a_call_has_a_depth(angen: Angen, values: int, closed: bool) -> None:
    body = call(values)
    with connect(angen.master.api.lookupNode('/test', '/angen')[2]) as client:
        client.sendall(b'POST / HTTP/1.1\r\nContent-Length: %d\r\n\r\n' % len(body) + body)
        assert is_closed(client, closed) is closed


@pytest.mark.parametrize(('size', 'closed'), [(1 << 19, False), (2 << 20, True)])
def test_a_call_has_a_size(angen: Angen, size: int, closed: bool) -> None:
    with connect(angen.master.api.lookupNode('/test', '/angen')[2]) as client:
        client.sendall(b'POST / HTTP/1.1\r\nContent-Length: %d\r\n\r\nx' % size)
        assert is_closed(client, closed) is closed


def test_a_head_of_a_call_that_never_ends_has_a_size(angen: Angen) -> None:
    with connect(angen.master.api.lookupNode('/test', '/angen')[2]) as client:
        with pytest.raises(OSError):
            for _ in range(64):
                client.sendall(b'a' * (1 << 20))
