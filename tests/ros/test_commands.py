"""Commands on topics, and the states that follow."""
import time

from angen_msgs.msg import Command, DoorState, Event, LampState
from harness import Angen, Inbox, RawText, until
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from std_msgs.msg import String

DOOR = "/angen/door/bathroom0"
LAMP = "/angen/lamp/kitchen0"


def test_a_door_opens_and_shuts(angen: Angen) -> None:
    with Inbox(DOOR, DoorState) as door:
        angen.send("/gazebo/Door_controller", String("Open, bathroom0"))
        opened = door.wait(lambda m: m.mode == DoorState.OPEN, "the door is open")
        assert abs(opened.position + 1.57) < 0.02
        assert opened.name == "bathroom0"
        door.messages.clear()
        angen.send("/gazebo/Door_controller", String("close, all"))
        shut = door.wait(lambda m: m.mode == DoorState.CLOSED, "the door is shut")
        assert abs(shut.position) < 0.02


def test_a_lamp_dims_by_either_topic(angen: Angen) -> None:
    with Inbox(LAMP, LampState) as lamp:
        angen.send("/gazebo/Light_controller", String("Dim, kitchen0, 40"))
        assert lamp.wait(lambda m: m.level == 40, "40 percent").on
        angen.send("/angen/command", Command(target="kitchen0", text="Off"))
        lamp.wait(lambda m: m.level == 0 and not m.on, "dark")


def rests(door: Inbox) -> bool:
    """Whether it has published nothing for a second."""
    count = len(door.messages)
    time.sleep(1.0)
    return len(door.messages) == count


def test_what_is_rejected_changes_nothing_and_is_reported(angen: Angen) -> None:
    wrong = {
        "/gazebo/Door_controller": ["Open", "Opn, bathroom0", "Set, bathroom0, soon",
                                    "Open, cellar8", ""],
        "/gazebo/Light_controller": ["Dim, kitchen0", "Dim, kitchen0, 1000"],
        "/gazebo/Elevator_controller": ["FloorX", "Floor1"],
    }
    with Inbox(DOOR, DoorState) as door, Inbox("/angen/events", Event) as events:
        before = door.wait(lambda m: True, "the latched state")
        until(lambda: rests(door), "the door of a node that has just begun rests")
        published = len(door.messages)
        rejections = 0
        for topic, texts in wrong.items():
            for text in texts:
                angen.send(topic, String(text))
                rejections += 1
        until(lambda: sum(e.event == "rejected" for e in events.messages) >= rejections,
              "an event for each rejection")
        assert len(door.messages) == published
        assert {(m.mode, m.target) for m in door.messages} == {(before.mode, before.target)}
    details = [e.detail for e in events.messages if e.event == "rejected"]
    assert any("cellar8" in d and "bathroom0" in d for d in details), details
    for event in events.messages:  # whatever was wrong, the names that would be right are listed
        if event.event == "rejected" and event.kind == "door":
            assert "bathroom0" in event.detail, event.detail
    assert any("radians" in d for d in details), details
    lines = [line for line in angen.log().splitlines() if "cellar8" in line]
    assert len(lines) == 1 and "bathroom0" in lines[0], lines


def test_text_that_is_not_utf8_is_rejected(angen: Angen) -> None:
    with Inbox("/angen/events", Event) as events:
        angen.send("/gazebo/Door_controller", String(RawText(b"Open, \xff\xfe")))
        rejected = events.wait(lambda e: e.event == "rejected", "an event")
        assert "not UTF-8" in rejected.detail


def test_a_robot_drives_by_cmd_vel(angen: Angen) -> None:
    twist = Twist()
    twist.linear.x = 0.3
    with Inbox("/odom", Odometry) as odometry:
        first = odometry.wait(lambda m: True, "odometry of a robot at rest")

        def driven() -> bool:
            angen.send("/cmd_vel", twist)
            return odometry.messages[-1].pose.pose.position.x > first.pose.pose.position.x + 0.1

        until(driven, "0.1 m forward")
        last = odometry.messages[-1]
        assert last.header.frame_id == "odom" and last.child_frame_id == "base_footprint"


def test_a_twist_that_is_not_finite_is_rejected(angen: Angen) -> None:
    twist = Twist()
    twist.linear.x = float("nan")
    with Inbox("/angen/events", Event) as events:
        angen.send("/turtlebot/cmd_vel", twist)
        events.wait(lambda e: e.event == "rejected" and e.source == "turtlebot", "an event")
