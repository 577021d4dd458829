"""angen mqtt: connects the running building to a broker until Ctrl-C."""
import math
import os
import signal
import sys
import time
from pathlib import Path
from typing import Any

from angen_apps.mqtt.bridge import Bridge, Taken
from angen_apps.mqtt.broker import Access, Broker, Log
from angen_apps.mqtt.discovery import Discovery
from angen_apps.mqtt.habits import SHOP, Habits
from angen_apps.mqtt.styles import STYLES
from angen_apps.web.node import start_node
from angen_tools.common.catalog import angen_module
from angen_tools.common.failure import Failure
from angen_tools.session.live import Live

TURN = 0.5  # s of wall time between two turns without news
REST = 0.01  # s between two turns with news, which take several messages at once
PAUSE = 1.0  # s after a simulator has ended


def serve(access: Access, prefix: str, style_name: str, discovery: str, profile: str, truth: bool
          ) -> None:
    """Bridges until Ctrl-C. If the simulator ends, this process starts again and waits for the
    next one."""
    start_node('mqtt')
    log = Log()
    world = _simulator(log)
    style = STYLES[style_name](prefix)
    path = SHOP if profile == 'shop' else Path(profile) if profile else None
    broker = Broker(access, log, world.wake)
    bridge = Bridge(world, broker, style,
                    Discovery(style, discovery == 'device', angen_module().__version__)
                    if discovery != 'none' else None, Habits(path), truth, log)
    ends: list[int] = []

    def end(number: int, _: Any) -> None:
        ends.append(number)

    before = {number: signal.signal(number, end) for number in (signal.SIGINT, signal.SIGTERM)}
    broker.start(bridge.will)
    print(f'angen mqtt: bridges to {access.address}, topics {prefix}/…', flush=True)
    try:
        while not ends:
            seen = world.received
            bridge.turn()
            if not bridge.has_work:
                world.until(lambda: bool(ends or broker.waiting or world.received != seen), TURN)
                time.sleep(REST)
    except Taken:
        raise
    except Failure as why:  # the simulator has ended, perhaps within a call
        log.say(f'{why}; waits for the next simulator', True)
    finally:
        bridge.stop()
        broker.stop()
        for number, handler in before.items():
            signal.signal(number, handler)
    if not ends:
        time.sleep(PAUSE)
        os.execv(sys.executable, sys.orig_argv)  # a new node, of the next master


def _simulator(log: Log) -> Live:
    """The running one, or the one that will run."""
    try:
        return Live()
    except Failure as absent:
        log.say(f'waits: {absent}')
        return Live(patience=math.inf)


def read_password(path: Path | None) -> str:
    """The first line of a file."""
    if path is None:
        return ''
    try:
        return path.read_text(encoding='utf-8').partition('\n')[0]
    except (OSError, UnicodeDecodeError) as error:
        raise Failure(f'{path}: cannot be read: {error}') from None
