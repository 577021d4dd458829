"""Topics of viewers: markers and frames."""
import time
from pathlib import Path
from typing import Any

from angen_msgs.msg import DoorState, Stats
from harness import Angen, Inbox, until
from lxml import etree
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

WORLDS = Path(__file__).resolve().parents[2] / "worlds"


def keyed(arrays: list[Any]) -> dict[tuple[str, int], Marker]:
    """The markers that a viewer holds after these messages."""
    held: dict[tuple[str, int], Marker] = {}
    for array in arrays:
        for marker in array.markers:
            if marker.action == Marker.DELETE:
                held.pop((marker.ns, marker.id), None)
            else:
                held[marker.ns, marker.id] = marker
    return held


def test_every_newcomer_gets_the_whole_world(angen: Angen) -> None:
    views = []
    for _ in range(2):
        with Inbox("/angen/markers", MarkerArray) as inbox:
            until(lambda: inbox.messages, "markers")
            views.append(keyed(inbox.messages[:1]))
    assert views[0].keys() == views[1].keys()
    groups = {group for group, _ in views[0]}
    assert {"doors 0", "lamps 0", "lights 0", "robots", "sensors 0", "ground", "labels 0",
            "door labels 0", "labels", "idle PIR rays 0"} <= groups
    assert "PIR rays 0" not in groups
    texts = {marker.text for marker in views[0].values() if "labels" in marker.ns}
    assert texts == {"lamp kitchen0", "door bathroom0", "turtlebot"}


def of_leaf(door: str) -> int:
    """The number of a door's visuals that move when it opens: all but the frame's."""
    root = etree.parse(str(WORLDS / "models" / door / "model.sdf"))
    return len(root.xpath("//link[@name!='base']/visual"))


def test_only_what_changes_follows(angen: Angen) -> None:
    angen.wait("/angen/stats", Stats, lambda stats: stats.awake_bodies == 0)
    with Inbox("/angen/markers", MarkerArray) as inbox:
        whole = keyed([until(lambda: inbox.messages, "the whole world")[0]])
        angen.send("/gazebo/Light_controller", String("On, kitchen0"))
        until(lambda: any(m.ns == "lights 0" for a in inbox.messages[1:] for m in a.markers),
              "the lamp's ball shines")
        angen.send("/gazebo/Light_controller", String("Off, kitchen0"))
        angen.send("/gazebo/Door_controller", String("Open, bathroom0"))
        angen.wait("/angen/door/bathroom0", DoorState, lambda state: state.mode == DoorState.OPEN)
        angen.send("/gazebo/Door_controller", String("Close, bathroom0"))
        angen.wait("/angen/door/bathroom0", DoorState, lambda state: state.mode == DoorState.CLOSED)
        changed = keyed(inbox.messages[1:])
    lights = [key for key in changed if key[0] == "lights 0"]
    leaf = [key for key in changed if key[0] == "doors 0"]
    assert [(m.pose.position.x, m.pose.position.y) for m in map(changed.get, lights)] == [(0, 3)]
    assert len(leaf) == of_leaf("bathroom_door") and set(leaf) < set(whole)
    assert sorted(changed) == sorted(lights + leaf)


def test_a_spawn_sends_what_it_adds_and_no_more(angen: Angen) -> None:
    angen.wait("/angen/stats", Stats, lambda stats: stats.awake_bodies == 0)
    with Inbox("/angen/markers", MarkerArray) as inbox:
        until(lambda: inbox.messages, "the whole world")
        whole = keyed(inbox.messages).keys()
        before = len(inbox.messages)
        angen.spawn("newcomer", "model://pir", 0.0, 3.0, 2.0)
        until(lambda: len(keyed(inbox.messages)) > len(whole), "its markers")
        again = keyed(inbox.messages[before:]).keys() & whole
        assert not {key for key in again if "rays" not in key[0]}
        angen.delete("newcomer")


def test_frames_are_sent_again_only_with_a_new_one(angen: Angen) -> None:
    """All of them, within a second: a second listener in a process is given the last message."""
    def children(message: TFMessage) -> set[str]:
        return {t.child_frame_id for t in message.transforms}

    with Inbox("/tf_static", TFMessage) as inbox:
        frames = children(until(lambda: inbox.messages, "frames")[-1])
        for name in ("one", "two", "three"):
            sent = len(inbox.messages)
            angen.spawn(name, "model://pir")
            assert name in children(until(lambda: inbox.messages[sent:], "its frame")[0])
            frames |= {name}
            until(lambda: children(inbox.messages[-1]) >= frames, "all of them")
            assert len(inbox.messages) <= sent + 2  # its own, then all
            angen.delete(name)
            frames -= {name}
        with angen.paused():  # the world's time
            for name in ("four", "five"):
                angen.spawn(name, "model://pir")
            until(lambda: children(inbox.messages[-1]) >= frames | {"four", "five"},
                  "all in a pause")
            angen.delete("four", "five")
        sent, began = len(inbox.messages), time.monotonic()
        for i in range(20):
            angen.spawn(f"more_{i}", "model://pir")
        more = {f"more_{i}" for i in range(20)}
        until(lambda: children(inbox.messages[-1]) >= frames | more, "all of many")
        assert set().union(*map(children, inbox.messages[sent:])) >= more
        whole = [m for m in inbox.messages[sent:] if children(m) >= frames]
        assert len(whole) <= 2 + time.monotonic() - began
        angen.delete(*more)


def box(name: str, middle: str, size: str) -> str:
    return (f'<link name="{name}"><pose>{middle} 0 0 0</pose><visual name="v"><geometry><box>'
            f'<size>{size}</size></box></geometry></visual></link>')


def test_a_lit_lamp_lights_the_room_around_it(angen: Angen) -> None:
    parts = box("floor_hall", "0 3 -0.1", "4.1 3.1 0.2") + "".join(
        box(f"wall_{i}", f"{i} 9 1", "0.1 0.1 2") for i in range(10))
    room = ('<angen:room xmlns:angen="angen" name="hall"><angen:use>hall</angen:use>'
            '<angen:polygon>-2 1.5 2 1.5 2 4.5 -2 4.5</angen:polygon></angen:room>')
    house = (f'<sdf version="1.6"><model name="house"><static>true</static>{room}{parts}'
             '</model></sdf>')

    def lit(inbox: Inbox) -> list[Marker]:
        held = keyed(list(inbox.messages))
        return [marker for (group, _), marker in held.items() if group == "lit rooms 0"]

    with Inbox("/angen/markers", MarkerArray) as inbox:
        until(lambda: inbox.messages, "the whole world")
        angen.spawn("house", house)
        until(lambda: "hall" in {m.text for m in keyed(list(inbox.messages)).values()}, "its label")
        assert not lit(inbox)
        angen.send("/gazebo/Light_controller", String("Dim, kitchen0, 10"))
        dim = max(c.a for c in until(lambda: lit(inbox), "light in the room")[0].colors)
        angen.send("/gazebo/Light_controller", String("On, kitchen0"))
        until(lambda: max(c.a for c in lit(inbox)[0].colors) > 1.5 * dim, "more light")
        groups = {group for group, _ in keyed(list(inbox.messages))}
        assert groups >= {"lit rooms south 0", "lit rooms west 0"}  # on outermost walls
        angen.send("/gazebo/Light_controller", String("Off, kitchen0"))
        until(lambda: not lit(inbox), "no light")
        angen.delete("house")
        until(lambda: "hall" not in {m.text for m in keyed(list(inbox.messages)).values()},
              "no hall")


def test_rays_change_groups_while_a_sensor_fires(angen: Angen) -> None:
    def of_beams(inbox: Inbox) -> set[str]:
        return {group for group, _ in keyed(list(inbox.messages)) if "switch beams" in group}

    wall = ('<sdf version="1.6"><model name="wall"><static>true</static><link name="link">'
            '<collision name="c"><geometry><box><size>0.1 1 1</size></box></geometry></collision>'
            '</link></model></sdf>')
    with Inbox("/angen/markers", MarkerArray) as inbox:
        angen.spawn("beam", "model://optical_switch", -20.0, -20.0, 5.0)
        until(lambda: of_beams(inbox) == {"idle switch beams 0"}, "rays of a sensor at rest")
        angen.spawn("wall", wall, -19.75, -20.0, 5.0)
        until(lambda: of_beams(inbox) == {"switch beams 0"}, "rays of a sensor that fires")
        angen.delete("wall")
        until(lambda: of_beams(inbox) == {"idle switch beams 0"}, "rays of a sensor at rest")
        angen.delete("beam")
        until(lambda: not of_beams(inbox), "no rays")


def test_rays_are_blue_or_in_the_color_that_is_given(angen: Angen) -> None:
    def color_of(inbox: Inbox) -> tuple[float, ...] | None:
        for (group, _), marker in keyed(list(inbox.messages)).items():
            if group.startswith("idle switch beams"):
                ink = marker.color
                return ink.r, ink.g, ink.b, ink.a
        return None

    for given, expected in (("", (0.0, 0.0, 1.0, 1.0)),
                            ("<color>1 0.5 0 0.25</color>", (1.0, 0.5, 0.0, 0.25))):
        beam = ('<sdf version="1.6"><model name="tinted"><static>true</static><link name="link">'
                '<sensor name="s" type="ray"><plugin name="s" '
                f'filename="liboptical_switch_controller.so">{given}</plugin></sensor></link>'
                '</model></sdf>')
        with Inbox("/angen/markers", MarkerArray) as inbox:
            angen.spawn("tinted", beam, -20.0, -20.0, 5.0)
            assert until(lambda: color_of(inbox), "the beam's color") == expected
            angen.delete("tinted")
            until(lambda: color_of(inbox) is None, "no rays")


def test_no_transform_goes_out_twice_with_one_stamp(angen: Angen) -> None:
    """tf2 warns of those: TF_REPEATED_DATA."""
    with Inbox("/tf", TFMessage) as moving:
        until(lambda: moving.messages, "frames")
        for i in range(3):
            name = f"walker{i}"
            angen.spawn(name, "model://bathroom_door")
            until(lambda: any(t.child_frame_id.startswith(name) for m in list(moving.messages)
                              for t in m.transforms), "the frames of the spawned model")
            angen.delete(name)
        sent = [(t.child_frame_id, t.header.stamp) for m in list(moving.messages)
                for t in m.transforms]
    assert len(sent) == len(set(sent))
