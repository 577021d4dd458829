"""The figures of a run of angen bench load, and its subscribers."""
import socket
import struct
import threading

import pytest

from angen_bench import listeners, load
from angen_bench.measure import Sample


def second(wall: float, sim: float, longest: float = 1.0, rss: int = 0) -> Sample:
    return Sample(wall, sim, readings=0, received=0, server=0.5 * wall, client=None,
                  machine=0.8 * wall, rss=rss, tick_median=0.1, tick_p99=0.5, tick_longest=longest)


def test_a_row_is_of_the_window_between_its_first_and_last_second() -> None:
    seconds = [second(10.0, 9.0, longest=99.0, rss=50_000_000), second(11.0, 10.0, longest=3.0),
               second(12.0, 10.9, longest=2.0, rss=60_000_000)]
    row = load.row_of(seconds, [1.0, 2.0, 30.0], topics='kind', sensors=5, readers=2,
                      connections=8, rejected=0)
    assert (row.seconds, row.cpu, row.tick_longest) == (2.0, 50.0, 3.0)
    assert row.rtf == pytest.approx(0.95) and not row.real_time
    assert row.others_cpu == pytest.approx(30.0)
    assert (row.answers, row.answer_median, row.answer_longest) == (3, 2.0, 30.0)
    assert (row.rss_start, row.rss_end, row.rss_most) == (50.0, 60.0, 60.0)


@pytest.mark.parametrize('share, value', [(0.5, 50), (0.99, 99), (1.0, 100), (0.001, 1)])
def test_a_quantile_is_one_of_the_values(share: float, value: float) -> None:
    assert load.quantile(list(range(100, 0, -1)), share) == value


def test_all_sensors_are_shared_out() -> None:
    assert sum(load.counts_of(1000).values()) == 1000
    assert sum(load.counts_of(7).values()) == 7


def test_a_header_is_one_of_tcpros() -> None:
    made = listeners.header({'topic': '/a', 'md5sum': '*'})
    (length,) = struct.unpack('<I', made[:4])
    assert length == len(made) - 4
    assert made[4:] == struct.pack('<I', 8) + b'topic=/a' + struct.pack('<I', 8) + b'md5sum=*'


def test_readers_end_when_all_have_been_closed() -> None:
    pairs = [socket.socketpair() for _ in range(3)]
    thread = threading.Thread(target=listeners.drain, args=([ours for ours, _ in pairs],))
    thread.start()
    for _, theirs in pairs:
        theirs.sendall(b'x' * 1_000_000)  # more than a socket buffers: the reader reads
        theirs.close()
    thread.join(10.0)
    assert not thread.is_alive()
    for ours, _ in pairs:
        ours.close()
