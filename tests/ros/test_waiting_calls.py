"""Calls that wait: they leave threads for others, can be interrupted, and end with their client."""
import socket
import struct
import threading
import time
import xmlrpc.client
from typing import Any
from urllib.parse import urlparse

import pytest
from angen_msgs.msg import Command, Event
from angen_msgs.srv import List, SendCommand, Spawn, Step
from harness import Angen, Inbox, until, without_sanitizer
from std_srvs.srv import Empty

MOST = 10_000_000  # ticks of a call
PIR_ON = """<model name="m"><static>true</static><link name="l">
  <sensor name="beam" type="ray"><update_rate>10</update_rate>
  <ray><scan><horizontal><samples>1</samples></horizontal></scan>
  <range><min>0.05</min><max>6</max></range></ray>
  <plugin name="pir" filename="libpir_controller.so"><topicName>TOPIC</topicName></plugin></sensor>
  </link></model>"""


def in_threads(angen: Angen, count: int) -> tuple[list[Any], list[threading.Thread]]:
    """That many steps at once; their answers are appended to the list."""
    answers: list[Any] = []
    threads = [threading.Thread(
        target=lambda: answers.append(angen.call("/angen/step", Step, ticks=MOST)))
        for _ in range(count)]
    for thread in threads:
        thread.start()
    return answers, threads


def raw_step(angen: Angen, ticks: int) -> socket.socket:
    """The connection of a client that has requested a step and waits."""
    where = urlparse(angen.master.api.lookupService("/raw", "/angen/step")[2])
    connection = socket.create_connection((where.hostname, where.port), timeout=20.0)
    fields = b"".join(struct.pack("<I", len(f)) + f for f in (
        b"callerid=/raw", b"service=/angen/step", b"md5sum=" + Step._md5sum.encode()))
    connection.sendall(struct.pack("<I", len(fields)) + fields)
    length, = struct.unpack("<I", connection.recv(4))
    connection.recv(length)
    connection.sendall(struct.pack("<II", 4, ticks))
    return connection


def test_many_long_steps_leave_threads_for_others(angen: Angen, paused: None) -> None:
    answers, threads = in_threads(angen, 7)
    until(lambda: len(answers) == 3, "those that are too many are answered at once")
    assert all("4 other steps wait" in answer.message for answer in answers)
    assert angen.call("/angen/list", List, kind="").entities
    answers.clear()
    angen.call("/gazebo/pause_physics", Empty)
    for thread in threads:
        thread.join(20)
    assert len(answers) == 4
    assert not any(answer.success for answer in answers)
    assert all("interrupted by a pause after" in answer.message for answer in answers)
    assert sum(answer.taken > 0 for answer in answers) == 1  # one after the other
    still = angen.call("/angen/step", Step, ticks=0).sim_time
    assert angen.call("/angen/step", Step, ticks=0).sim_time == still


def test_a_step_says_how_many_ticks_it_took(angen: Angen, paused: None) -> None:
    done = angen.call("/angen/step", Step, ticks=12)
    assert done.success and done.taken == 12
    rejected = angen.call("/angen/step", Step, ticks=2**32 - 1)
    assert not rejected.success and rejected.taken == 0 and "at most 10000000" in rejected.message


@pytest.mark.parametrize("count", [1, 4])
def test_steps_of_lost_clients_end(angen: Angen, paused: None, count: int) -> None:
    lost = [raw_step(angen, MOST) for _ in range(count)]
    start = angen.call("/angen/step", Step, ticks=0).sim_time
    until(lambda: angen.call("/angen/step", Step, ticks=0).sim_time > start, "time advances")
    for connection in lost:
        connection.close()

    def stands_still() -> bool:
        now = angen.call("/angen/step", Step, ticks=0).sim_time
        time.sleep(0.3)
        return bool(angen.call("/angen/step", Step, ticks=0).sim_time == now)

    until(stands_still, "the steps end")
    assert angen.call("/angen/step", Step, ticks=1).success


def test_long_texts_are_cut(angen: Angen) -> None:
    longest = "ü" * 500_000
    with Inbox("/angen/events", Event) as events:
        angen.send("/angen/events/add", Event(source=longest, kind="k", event="e", detail=longest))
        noted = events.wait(lambda e: e.event == "e", "the event")
        assert len(noted.source.encode()) < 300 and noted.source.endswith("… (1000000 bytes)")
        assert len(noted.detail.encode()) < 2100 and noted.detail.endswith("… (1000000 bytes)")
        angen.send("/angen/command", Command(target=longest, text=longest))
        rejected = events.wait(lambda e: e.event == "rejected", "the rejection")
        assert len(rejected.detail.encode()) < 500 and "2000000 bytes" in rejected.detail
    answer = angen.call("/angen/command", SendCommand, target="bathroom0", text=longest)
    assert not answer.success and len(answer.message.encode()) < 500
    answer = angen.call("/angen/spawn", Spawn, name="p", xml="<model name='" + longest)
    assert not answer.success and len(answer.message.encode()) < 10_100
    assert max(len(line) for line in angen.log().splitlines()) < 4000


@without_sanitizer
def test_a_slow_subscriber_of_events_holds_little(angen: Angen) -> None:
    status = f"/proc/{angen.process.pid}/status"

    def megabytes() -> float:
        with open(status) as lines:
            return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS")) / 1024

    where = urlparse(angen.master.api.lookupNode("/raw", "/angen")[2])
    api = xmlrpc.client.ServerProxy(f"http://{where.hostname}:{where.port}")
    _, _, (_, host, port) = api.requestTopic("/raw", "/angen/events", [["TCPROS"]])
    with socket.create_connection((host, port)) as silent:
        fields = b"".join(struct.pack("<I", len(f)) + f for f in (
            b"callerid=/raw", b"topic=/angen/events", b"type=angen_msgs/Event",
            b"md5sum=" + Event._md5sum.encode()))
        silent.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        silent.sendall(struct.pack("<I", len(fields)) + fields)
        longest = "x" * 1_000_000
        before = megabytes()
        for _ in range(300):
            angen.call("/angen/command", SendCommand, target=longest, text="Open")
        assert megabytes() < before + 50


@pytest.mark.parametrize("topic", ["/clock", "/tf", "/angen/events", "/angen/door/bathroom0",
                                   "/cmd_vel", "/gazebo/Door_controller"])
def test_a_topic_that_carries_something_else_is_rejected(angen: Angen, topic: str) -> None:
    before = angen.names()
    xml = PIR_ON.replace("TOPIC", topic)
    answer = angen.call("/angen/spawn", Spawn, name="loud", xml=xml)
    assert not answer.success and topic in answer.message and "<topicName>" in answer.message
    assert angen.names() == before


def test_a_topic_of_the_same_type_can_be_shared(angen: Angen) -> None:
    xml = PIR_ON.replace("TOPIC", "/angen/pir/eye")
    angen.spawn("second", xml)
    angen.delete("second")
