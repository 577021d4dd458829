"""The small sensors and devices of the catalog, as subscribers see them."""
import math

import pytest
from angen_msgs.msg import Command, DoorState, PlugMsg, PressureMsg, Reading, ReedMsg, RfidMsg, \
    RssiMsg
from angen_msgs.srv import List
from harness import Angen
from sensor_msgs.msg import BatteryState, Range, RelativeHumidity, Temperature
from std_msgs.msg import String

HERE = (-8.0, -8.0)     # outside of the building


@pytest.fixture
def spawned(angen: Angen):
    """Spawns models of worlds/models outside; takes them away again."""
    names: list[str] = []

    def spawn(xml: str, name: str, z: float, x: float = 0.0) -> None:
        angen.spawn(name, xml, HERE[0] + x, HERE[1], z)
        names.append(name)
    yield spawn
    angen.delete(*names)


@pytest.mark.parametrize("model, kind, message", [
    ("proximity", "proximity", Range), ("pressure_mat", "pressure", PressureMsg),
    ("rfid_reader", "rfid", RfidMsg), ("radio_receiver", "receiver", RssiMsg),
    ("microphone", "microphone", Reading), ("smart_plug", "plug", PlugMsg),
    ("temperature_sensor", "temperature", Temperature),
    ("humidity_sensor", "humidity", RelativeHumidity)])
def test_each_sensor_is_listed_and_heard(angen: Angen, spawned, model: str, kind: str,
                                         message: type) -> None:
    spawned(f"model://{model}", "it", 1.0)
    entity, = angen.call("/angen/list", List, kind=kind).entities
    assert (entity.name, entity.topic, entity.type) == ("it", f"/angen/{kind}/it", message._type)
    reading = angen.wait(entity.topic, message)
    assert reading.header.frame_id == "it"
    if message is Range:
        assert reading.range == reading.max_range > 0   # nothing is in reach
    if message is Temperature:
        assert math.isnan(reading.temperature)    # this world has no climate


def test_a_window_opens_by_its_topic_and_its_reed_tells(angen: Angen, spawned) -> None:
    spawned("model://window", "yard_window0", 1.0)
    assert angen.wait("/angen/reed/yard_window0", ReedMsg).closed
    angen.send("/gazebo/Window_controller", String("Open, yard0"))
    angen.wait("/angen/window/yard0", DoorState, lambda m: m.mode == m.OPENING)
    angen.wait("/angen/reed/yard_window0", ReedMsg, lambda m: not m.closed)


def test_the_robots_battery_is_heard_and_charged(angen: Angen) -> None:
    topic = "/angen/battery/turtlebot_battery"
    assert 0.5 < angen.wait(topic, BatteryState).percentage <= 1
    angen.send("/angen/command", Command("battery/turtlebot_battery", "Charge 40"))
    state = angen.wait(topic, BatteryState, lambda m: m.percentage < 0.5)
    assert state.percentage == pytest.approx(0.4, abs=0.01) and state.current < 0
    angen.send("/angen/command", Command("battery/turtlebot_battery", "Charge 100"))
