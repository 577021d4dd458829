"""What viewers get: markers and frames."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from angen_msgs.msg import DoorState, Stats
from angen_msgs.srv import Delete, Spawn
from harness import Angen, Heard, until
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
        with Heard("/angen/markers", MarkerArray) as heard:
            until(lambda: heard.messages, "markers")
            views.append(keyed(heard.messages[:1]))
    assert views[0].keys() == views[1].keys()
    groups = {group for group, _ in views[0]}
    assert {"doors", "lamps", "lights", "robots", "PIR rays", "sensors", "ground"} <= groups


def of_leaf(door: str) -> int:
    """How many visuals of a door of worlds/models move when it opens: all but the frame's."""
    root = etree.parse(str(WORLDS / "models" / door / "model.sdf"))
    return len(root.xpath("//link[@name!='base']/visual"))


def test_only_what_changes_follows(angen: Angen) -> None:
    angen.wait("/angen/stats", Stats, lambda stats: stats.awake_bodies == 0)
    with Heard("/angen/markers", MarkerArray) as heard:
        whole = keyed([until(lambda: heard.messages, "the whole world")[0]])
        angen.send("/gazebo/Light_controller", String("On, kitchen0"))
        until(lambda: any(m.ns == "lights" for a in heard.messages[1:] for m in a.markers),
              "the lamp's ball shines")
        angen.send("/gazebo/Light_controller", String("Off, kitchen0"))
        angen.send("/gazebo/Door_controller", String("Open, bathroom0"))
        angen.wait("/angen/door/bathroom0", DoorState, lambda state: state.mode == DoorState.OPEN)
        angen.send("/gazebo/Door_controller", String("Close, bathroom0"))
        angen.wait("/angen/door/bathroom0", DoorState, lambda state: state.mode == DoorState.CLOSED)
        changed = keyed(heard.messages[1:])
    lights = [key for key in changed if key[0] == "lights"]
    leaf = [key for key in changed if key[0] == "doors"]
    assert [(m.pose.position.x, m.pose.position.y) for m in map(changed.get, lights)] == [(0, 3)]
    assert len(leaf) == of_leaf("bathroom_door") and set(leaf) < set(whole)
    assert sorted(changed) == sorted(lights + leaf)


def test_what_is_deleted_disappears(angen: Angen) -> None:
    with Heard("/angen/markers", MarkerArray) as heard:
        until(lambda: heard.messages, "the whole world")
        before = keyed(heard.messages).keys()
        assert angen.call("/angen/spawn", Spawn, name="chair1", xml="model://pir").success
        until(lambda: len(keyed(heard.messages)) > len(before), "more markers")
        assert angen.call("/angen/delete", Delete, name="chair1").success
        until(lambda: keyed(heard.messages).keys() == before, "as before")


def test_frames_make_one_tree(angen: Angen) -> None:
    with Heard("/tf", TFMessage) as moving, Heard("/tf_static", TFMessage) as fixed:
        until(lambda: moving.messages and fixed.messages, "frames")
        parents = {t.child_frame_id: t.header.frame_id
                   for m in list(moving.messages) + list(fixed.messages) for t in m.transforms}
    assert parents["base_footprint"] == "odom" and parents["odom"] == "world"
    assert parents["eye"] == "eye/pir"
    for frame in parents:
        steps = 0
        while frame != "world":
            frame = parents[frame]
            steps += 1
            assert steps < 20, "a loop"


def test_no_transform_goes_out_twice_with_one_stamp(angen: Angen) -> None:
    """tf2 warns of those: TF_REPEATED_DATA."""
    with Heard("/tf", TFMessage) as moving:
        until(lambda: moving.messages, "frames")
        for i in range(3):
            name = f"walker{i}"
            assert angen.call("/angen/spawn", Spawn, name=name, xml="model://bathroom_door").success
            until(lambda: any(t.child_frame_id.startswith(name) for m in list(moving.messages)
                              for t in m.transforms), "the frames of what was spawned")
            assert angen.call("/angen/delete", Delete, name=name).success
        sent = [(t.child_frame_id, t.header.stamp) for m in list(moving.messages)
                for t in m.transforms]
    assert len(sent) == len(set(sent))
