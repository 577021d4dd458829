"""Time, spawning, deleting, listing and saving by service."""
import math

import pytest
from angen_msgs.msg import PirMsg, Stats
from angen_msgs.srv import Delete, List, Save, Spawn, Step
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from harness import Angen, Inbox, RawText, until
from geometry_msgs.msg import Point, Pose, Quaternion, Twist
from nav_msgs.msg import Odometry
from rosgraph import Master, MasterException
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Bool, String
from std_srvs.srv import Empty

PIR = "model://pir"
SENSOR = """<sensor name="beam" type="ray"><update_rate>10</update_rate>
  <ray><scan><horizontal><samples>3</samples><min_angle>-0.5</min_angle><max_angle>0.5</max_angle>
  </horizontal></scan><range><min>0.05</min><max>6</max></range></ray>
  <plugin name="pir" filename="libpir_controller.so"/></sensor>"""


def test_a_sensor_on_a_link(angen: Angen) -> None:
    angen.spawn("p2", SENSOR, 0, 0, 0.5, on="turtlebot::base_footprint")
    angen.wait("/angen/pir/p2", PirMsg)
    entity, = [e for e in angen.call("/angen/list", List, kind="pir").entities if e.name == "p2"]
    assert entity.model == "turtlebot" and entity.topic == "/angen/pir/p2"
    assert abs(entity.pose.position.z - 0.5) < 0.05
    assert "p2" in angen.call("/angen/save", Save).xml
    angen.delete("p2")


def test_what_cannot_be_spawned_is_explained(angen: Angen) -> None:
    before = angen.names()
    nan = Pose(position=Point(x=math.nan))
    stretched = Pose(orientation=Quaternion(w=3.0))
    wrong = [
        (dict(name="", xml=PIR), "empty"),
        (dict(name="eye", xml=PIR), "eye"),
        (dict(name="a::b", xml=PIR), "::"),
        (dict(name=RawText(b"\xff"), xml=PIR), "UTF-8"),
        (dict(name="p3", xml=""), "empty"),
        (dict(name="p3", xml=PIR, pose=nan), "finite"),
        (dict(name="p3", xml=PIR, pose=stretched), "quaternion"),
        (dict(name="p3", xml="model://no_such_model"), "no_such_model"),
        (dict(name="p3", xml="<model name='m'><link"), ""),
        (dict(name="p3", xml=SENSOR), "MODEL::LINK"),
        (dict(name="p3", xml=SENSOR, on="turtlebot::nose"), "nose"),
        (dict(name="p3", xml=PIR, on="turtlebot::base_footprint"), "<sensor>"),
    ]
    for fields, part in wrong:
        answer = angen.call("/angen/spawn", Spawn, **fields)
        assert not answer.success and answer.message and part in answer.message, (fields, answer)
    assert angen.names() == before


def test_what_cannot_be_deleted_is_explained(angen: Angen) -> None:
    for name, part in (("", "empty"), ("nobody", "nobody")):
        answer = angen.call("/angen/delete", Delete, name=name)
        assert not answer.success and part in answer.message


def test_paused_time_moves_by_steps_only(angen: Angen, paused: None) -> None:
    first = angen.call("/angen/step", Step, ticks=1)
    assert first.success
    second = angen.call("/angen/step", Step, ticks=250)
    assert second.success
    assert (second.sim_time - first.sim_time).to_nsec() == 250_000_000
    with Inbox("/clock", Clock) as clock:
        until(lambda: [m.clock for m in clock.messages[-3:]] == [second.sim_time] * 3,
              "a clock for latecomers while time is paused")


def test_a_step_counts_commands_and_events(angen: Angen, paused: None) -> None:
    before = angen.call("/angen/step", Step, ticks=0)
    angen.send("/gazebo/Light_controller", String("Dim, kitchen0, 31"))
    until(lambda: angen.call("/angen/step", Step, ticks=0).commands == before.commands + 1,
          "the command is counted")
    after = angen.call("/angen/step", Step, ticks=1)
    assert after.commands == before.commands + 1
    assert after.events > before.events
    angen.send("/gazebo/Light_controller", String("Off, kitchen0"))


def test_odometry_is_reported_at_each_tenth_of_a_second(angen: Angen, paused: None) -> None:
    twist = Twist()
    twist.linear.x = 0.2
    with Inbox("/odom", Odometry) as odometry:
        now = angen.call("/angen/step", Step, ticks=0).sim_time.to_nsec()
        angen.call("/angen/step", Step, ticks=(-now // 1_000_000) % 100)
        for command in (Twist(), twist, twist, Twist(), Twist(), Twist(), Twist()):
            angen.send("/cmd_vel", command)
            end = angen.call("/angen/step", Step, ticks=100).sim_time
            odometry.wait(lambda m: m.header.stamp == end, f"odometry of {end.to_sec()} s")


def test_no_client_can_ask_for_the_list_of_loggers_that_ends_a_node(angen: Angen) -> None:
    with pytest.raises(MasterException):
        Master("/test").lookupService("/angen/get_loggers")
    assert not angen.call("/angen/delete", Delete, name="nobody").success  # logs a line


def test_time_rises(angen: Angen) -> None:
    with Inbox("/clock", Clock) as clock:
        until(lambda: len(clock.messages) > 30, "30 clock messages")
    stamps = [m.clock.to_nsec() for m in clock.messages]
    assert stamps == sorted(stamps)
    assert all(stamp % 1_000_000 == 0 for stamp in stamps)


def test_reset_puts_time_and_world_back(angen: Angen, paused: None) -> None:
    now = angen.call("/angen/step", Step, ticks=2000).sim_time
    angen.call("/gazebo/reset_world", Empty)
    assert angen.call("/angen/step", Step, ticks=0).sim_time == now
    angen.call("/gazebo/reset_simulation", Empty)
    assert angen.call("/angen/step", Step, ticks=3).sim_time.to_nsec() == 3_000_000


def test_list_tells_kinds_topics_and_types(angen: Angen) -> None:
    entities = {(e.kind, e.name): e for e in angen.call("/angen/list", List, kind="").entities}
    assert entities["door", "bathroom0"].type == "angen_msgs/DoorState"
    assert entities["drive", "turtlebot"].topic == "/turtlebot/odom"
    assert entities["pir", "eye"].pose.position.y == pytest.approx(4.0)
    published = angen.master.topics()
    for entity in entities.values():
        if entity.topic:
            assert published[entity.topic] == entity.type, entity
    assert angen.names() == sorted(angen.names())
    assert angen.names("lamp") == ["kitchen0"]
    assert angen.names("unicorn") == []


def test_ready_says_that_everything_is_there(angen: Angen) -> None:
    assert angen.wait("/angen/ready", Bool).data
    services = {name for name, _ in angen.master.api.getSystemState("/test")[2][2]}
    assert {"/angen/spawn", "/angen/save", "/gazebo/pause_physics"} <= services


def test_diagnostics_warn_of_a_sensor_with_a_fault(angen: Angen) -> None:
    def status(message: DiagnosticArray, part: str) -> DiagnosticStatus:
        return next(s for s in message.status if s.name == f"angen: {part}")

    with Inbox("/diagnostics", DiagnosticArray) as inbox:
        before = inbox.wait(lambda m: True, "diagnostics", 20)
        assert [s.hardware_id for s in before.status] == ["angen"] * 3
        values = {v.key: v.value for v in status(before, "time").values}
        assert float(values["simulated time (s)"]) > 0 and values["requested rate"] == "1"
        broken = SENSOR.replace('so"/>', 'so"><fault>stuck from=0.5 lasts=1000</fault></plugin>')
        angen.spawn("broken", broken, 0, 0, 0.5, on="turtlebot::base_footprint")
        after = inbox.wait(lambda m: status(m, "sensors").level == DiagnosticStatus.WARN,
                           "a warning", 20)
    told = {v.key: v.value for v in status(after, "sensors").values}
    assert told["broken"] == "stuck, pir: begins"
    angen.delete("broken")


def test_stats_count(angen: Angen) -> None:
    def count(*kinds: str) -> int:
        return sum(len(angen.names(kind)) for kind in kinds)

    stats = angen.wait("/angen/stats", Stats)
    assert stats.step == 0.001
    assert stats.models == count("model") >= 5
    assert stats.devices == count("door", "lamp", "drive", "battery") >= 4
    assert stats.sensors == count("pir", "lidar", "camera", "depth", "contact") >= 5
    assert stats.links > stats.models and stats.failed_steps == 0
