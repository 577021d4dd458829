"""Subscribers of all that a node publishes, many in one process: python3 -m … READERS SLEEPERS

They speak TCPROS and decode nothing, so that the machine measures the node and not them. Readers
read messages and drop them; sleepers connect and never read. A line on stdout
says when all are connected.
"""
import os
import resource
import selectors
import socket
import struct
import sys
from typing import Any, Mapping

NODE = '/angen'
BUFFER = 1 << 18


def allow_many_connections() -> None:
    """Raises the soft limit of open files to the hard limit, for this process and its children."""
    most = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))


def header(fields: Mapping[str, str]) -> bytes:
    """A TCPROS connection header."""
    lines = [f'{key}={value}'.encode() for key, value in fields.items()]
    body = b''.join(struct.pack('<I', len(line)) + line for line in lines)
    return struct.pack('<I', len(body)) + body


def topics_of(master: Any) -> list[str]:
    """The topics that the node publishes, as the master has them."""
    published = master.getSystemState('/listeners')[2][0]
    return sorted(topic for topic, nodes in published if NODE in nodes)


def address_of(master: Any, topic: str) -> tuple[str, int]:
    """The address at which the node takes connections, the same for all its topics."""
    import xmlrpc.client
    uri = master.lookupNode('/listeners', NODE)[2]
    node: Any = xmlrpc.client.ServerProxy(uri)
    _, host, port = node.requestTopic('/listeners', topic, [['TCPROS']])[2]
    return host, port


def connect(address: tuple[str, int], topic: str, name: str) -> socket.socket:
    """A subscription of the node called `name`."""
    made = socket.create_connection(address)
    made.sendall(header({'callerid': name, 'topic': topic, 'type': '*', 'md5sum': '*',
                         'message_definition': ''}))
    return made


def drain(readers: list[socket.socket]) -> None:
    """Reads all of them until the node has closed each."""
    ready = selectors.DefaultSelector()
    for reader in readers:
        ready.register(reader, selectors.EVENT_READ)
    buffer = bytearray(BUFFER)
    while ready.get_map():
        for key, _ in ready.select():
            try:
                alive = key.fileobj.recv_into(buffer) > 0  # type: ignore[union-attr]
            except OSError:
                alive = False
            if not alive:
                ready.unregister(key.fileobj)


def main() -> None:
    """Connects, and reads until the node disconnects."""
    import xmlrpc.client
    allow_many_connections()
    readers, sleepers = int(sys.argv[1]), int(sys.argv[2])
    master: Any = xmlrpc.client.ServerProxy(os.environ['ROS_MASTER_URI'])
    topics = topics_of(master)
    address = address_of(master, topics[0])
    reading = [connect(address, topic, f'/reader{i}') for i in range(readers) for topic in topics]
    sleeping = [connect(address, topic, f'/sleeper{i}') for i in range(sleepers)
                for topic in topics]
    print(f'{len(topics)} topics, {len(reading) + len(sleeping)} connections', flush=True)
    drain(reading)


if __name__ == '__main__':
    main()
