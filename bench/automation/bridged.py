"""The built-in building on a broker, and pictures of pages beside it."""
import os
import subprocess
import sys
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any, Iterator

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT), str(ROOT / 'tests/ros')]
from harness import Master, end, until  # noqa: E402

from tests.angen_apps.mqtt.mosquitto import Client, Mosquitto  # noqa: E402

SCRIPT = ROOT / 'src/angen_apps/scripts/mqtt'


@contextmanager
def bridged(folder: Path) -> Iterator[tuple[int, Client]]:
    """The port of the broker and a client of it, after the bridge has sent all states."""
    with ExitStack() as ends:
        mosquitto = Mosquitto(folder)
        ends.callback(mosquitto.stop)
        master = ends.enter_context(Master(folder))
        os.environ.update(master.environment)
        client = Client(mosquitto.port)
        ends.callback(client.close)
        ends.callback(end, master.node(ROOT / 'worlds/angen.world', folder / 'log'))
        ends.callback(end, subprocess.Popen(
            [sys.executable, str(SCRIPT), '--broker', f'127.0.0.1:{mosquitto.port}'],
            env=master.environment, text=True))
        client.has('angen/bridge/state', 'online', 120.0)
        until(lambda: 'angen/lamp/kitchen0/state' in client.retained, 'the lamp', 60.0)
        yield mosquitto.port, client


def save(page: Any, name: str) -> None:
    """Makes docs/images/NAME, also if a busy machine draws the page late."""
    from browser import LIMIT
    from selenium.common.exceptions import TimeoutException

    def saved() -> bool:
        try:
            return bool(page.driver.save_screenshot(str(ROOT / 'docs/images' / name)))
        except TimeoutException:
            return False

    until(saved, 'the picture', LIMIT)
