"""What viewers get: markers and frames."""

from __future__ import annotations

from typing import Any

from angen_msgs.srv import Delete, Spawn
from conftest import Angen, Heard, until
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray


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


def test_only_what_changes_follows(angen: Angen) -> None:
    with Heard("/angen/markers", MarkerArray) as heard:
        until(lambda: heard.messages, "the whole world")
        whole = len(heard.messages[0].markers)
        moving = {"doors", "lights", "robots", "PIR rays"}
        angen.send("/gazebo/Light_controller", String("On, kitchen0"))
        until(lambda: any(m.ns == "lights" for a in heard.messages[1:] for m in a.markers),
              "the lamp's ball shines")
        angen.send("/gazebo/Light_controller", String("Off, kitchen0"))
        angen.send("/gazebo/Door_controller", String("Open, bathroom0"))
        until(lambda: any(m.ns == "doors" for a in heard.messages[1:] for m in a.markers),
              "the door moves")
        angen.send("/gazebo/Door_controller", String("Close, bathroom0"))
        for array in heard.messages[1:]:
            assert {m.ns for m in array.markers} <= moving and len(array.markers) < whole


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
