"""Measures angen mqtt: docs/automation.md, Figures.

    python3 bench/mqtt.py [--world FILE] [--lamp NAME] [--seconds 10]

in ./angen shell, with mosquitto. CPU times say more than times on a busy machine; the load is
printed.
"""
import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Iterator

ROOT = Path(__file__).resolve().parents[1]
sys.path += [str(ROOT), str(ROOT / 'tests/ros'), str(ROOT / 'bench')]
from harness import Master, end, until  # noqa: E402
from web import cpu  # noqa: E402

from tests.angen_apps.mqtt.mosquitto import Client, Mosquitto  # noqa: E402

SCRIPT = ROOT / 'src/angen_apps/scripts/mqtt'
RATE = 200  # changes of lamps a second


class Watch(Client):
    """A client that notes when each message came."""

    def __init__(self, port: int) -> None:
        self.times: dict[str, float] = {}
        super().__init__(port)

    def _on_message(self, client: object, data: object, message: object) -> None:
        self.times[message.topic] = time.monotonic()  # type: ignore[attr-defined]
        super()._on_message(client, data, message)


def discovery(watch: Watch) -> None:
    until(lambda: 'angen/bridge/state' in watch.retained, 'the bridge is online', 120.0)
    configs = watch.configs()
    last = max(watch.times[topic] for topic in configs)
    print(f'discovery: {len(configs)} entities {last - watch.times["angen/bridge/hello"]:.2f} s '
          'after the connection')


def latency(watch: Watch, lamp: str) -> None:
    """From a command to the state."""
    topic, found = f'angen/lamp/{lamp}/brightness', list[float]()
    for number in range(1, 61):
        began = time.monotonic()
        watch.send(f'{topic}/set', str(number))
        while watch.retained.get(topic) != str(number):
            time.sleep(0.0005)
        found.append(1000.0 * (time.monotonic() - began))
        time.sleep(0.1)
    print(f'command to state back: median {statistics.median(found):.0f} ms, '
          f'95 % within {sorted(found)[56]:.0f} ms, longest {max(found):.0f} ms')


def pulses(seconds: float) -> Iterator[int]:
    """Counts at the rate."""
    began = time.monotonic()
    for number in range(round(RATE * seconds)):
        time.sleep(max(0.0, began + number / RATE - time.monotonic()))
        yield number


def events(watch: Watch, pid: int, seconds: float) -> None:
    """Motion of detectors in turn, as events that this program adds."""
    import rospy
    from angen_msgs.msg import Event
    names = [topic.split('/')[2] for topic in watch.retained if topic.startswith('angen/pir/')]
    publisher = rospy.Publisher('/angen/events/add', Event, queue_size=1000)
    until(publisher.get_num_connections, 'the node subscribes')
    seen, used = len(watch.received), cpu(pid)
    for number in pulses(seconds):
        turn, which = divmod(number, len(names))
        publisher.publish(Event(kind='pir', source=names[which],
                                event='still' if turn % 2 else 'motion'))
    time.sleep(1.0)
    report(watch, seen, '/motion', 'events', round(RATE * seconds), (cpu(pid) - used) / seconds)


def states(watch: Watch, lamp: str, pid: int, seconds: float) -> None:
    """Changes of a lamp by commands in ROS: each is a state and an event."""
    import rospy
    from angen_msgs.msg import LampState
    from std_msgs.msg import String
    found = list[float]()
    rospy.Subscriber(f'/angen/lamp/{lamp}', LampState, lambda state: found.append(state.level))
    until(lambda: found, 'the state of the lamp')
    publisher = rospy.Publisher('/gazebo/Light_controller', String, queue_size=1000)
    until(publisher.get_num_connections, 'the node subscribes')
    seen, used = len(watch.received), cpu(pid)
    for number in pulses(seconds):
        publisher.publish(f'Dim, {lamp}, {number % 90 + 5}')
    time.sleep(1.0)
    report(watch, seen, f'{lamp}/brightness', 'states', len(found) - 1,
           (cpu(pid) - used) / seconds)


def report(watch: Watch, seen: int, end_: str, what: str, count: int, share: float) -> None:
    came = sum(name.endswith(end_) for name, _ in watch.received[seen:])
    print(f'{RATE} {what}/s: {came} messages of {count} {what}, {100.0 * share:.1f} % of a core')


def cost(watch: Watch, pid: int, seconds: float, what: str) -> None:
    seen, used = len(watch.received), cpu(pid)
    time.sleep(seconds)
    topics = [name for name, _ in watch.received[seen:] if '/simulation/' not in name]
    print(f'{what} for {seconds:g} s: {len(topics)} messages, '
          f'{100.0 * (cpu(pid) - used) / seconds:.1f} % of a core')


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('--world', type=Path, default=ROOT / 'worlds/angen.world')
    parser.add_argument('--lamp', default='kitchen0')
    parser.add_argument('--seconds', type=float, default=10.0)
    args = parser.parse_args()
    folder = Path(tempfile.mkdtemp(prefix='angen_mqtt_'))
    mosquitto, master = Mosquitto(folder), Master(folder)
    os.environ.update(master.environment)
    node = master.node(args.world, folder / 'log')
    import rospy
    rospy.init_node('bench_mqtt', disable_signals=True)
    watch = Watch(mosquitto.port)
    bridge = subprocess.Popen([sys.executable, str(SCRIPT), '--broker',
                               f'127.0.0.1:{mosquitto.port}'], env=master.environment, text=True)
    try:
        discovery(watch)
        until(lambda: f'angen/lamp/{args.lamp}/state' in watch.retained, 'the lamp', 60.0)
        time.sleep(5.0)
        cost(watch, bridge.pid, args.seconds, 'as the world runs')
        latency(watch, args.lamp)
        states(watch, args.lamp, bridge.pid, args.seconds)
        watch.send('angen/simulation/simulation/paused/set', 'ON')
        watch.has('angen/simulation/simulation/paused', 'ON')
        time.sleep(1.0)
        events(watch, bridge.pid, args.seconds)
        cost(watch, bridge.pid, args.seconds, 'paused')
        print('load of the machine:', *(f'{each:.1f}' for each in os.getloadavg()))
    finally:
        end(bridge)
        end(node)
        watch.close()
        mosquitto.stop()
        end(master.process)


if __name__ == '__main__':
    main()
