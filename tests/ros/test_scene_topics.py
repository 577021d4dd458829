"""/angen/scene and /angen/scene_changes against other topics of the node."""
import math
from typing import Any

import pytest
from angen_msgs.msg import DoorState, Scene, SceneChanges, Summary
from gazebo_msgs.msg import LinkStates
from harness import WORLD, Angen, Inbox, until
from std_srvs.srv import Empty

from angen_apps.web.scene import as_dict, packed
from angen_tools.common.catalog import kinds, simulator

SCENE, CHANGES = '/angen/scene', '/angen/scene_changes'


class Followed:
    """The state of a client that takes all messages."""

    def __init__(self, scene: Any) -> None:
        self.scene = scene
        self.poses = [[link.pose.position.x, link.pose.position.y, link.pose.position.z]
                      for link in scene.links]
        self.levels: dict[str, float] = {}

    def take(self, messages: list[Any]) -> None:
        for message in messages:
            if message.revision != self.scene.revision:
                continue
            for i, link in enumerate(message.links):
                self.poses[link] = list(message.poses[7 * i:7 * i + 3])
            for light, level in zip(message.lights, message.levels):
                self.levels[self.scene.lights[light].name] = level


def scene_now() -> Any:
    with Inbox(SCENE, Scene) as inbox:
        return inbox.wait(lambda _: True, 'a scene')


def test_poses_are_those_of_link_states(angen: Angen) -> None:
    followed = Followed(scene_now())
    with Inbox(CHANGES, SceneChanges) as inbox:
        inbox.wait(lambda _: True, 'all poses')
        angen.command('door/all', 'Open')
        angen.wait('/angen/door/bathroom0', DoorState, lambda state: state.position < -0.5)
        angen.call('/gazebo/pause_physics', Empty)  # a door is between shut and open
        with Inbox('/gazebo/link_states', LinkStates) as states:
            truth = states.wait(lambda _: True, 'link states')
        names = [f'{link.model}::{link.name}' for link in followed.scene.links]

        def apart() -> dict[str, float]:
            """m between the followed pose of each link and its true one."""
            followed.take(list(inbox.messages))
            return {name: math.dist(followed.poses[names.index(name)],
                                    (pose.position.x, pose.position.y, pose.position.z))
                    for name, pose in zip(truth.name, truth.pose)}

        until(lambda: max(apart().values()) < 2e-3, 'the last poses')
        angen.call('/gazebo/unpause_physics', Empty)
    begun = Followed(followed.scene)
    assert any(math.dist(a, b) > 0.05 for a, b in zip(begun.poses, followed.poses))
    angen.command('door/all', 'Close')


def test_levels_are_those_of_lamps(angen: Angen) -> None:
    followed = Followed(scene_now())
    lamp = next(light for light in followed.scene.lights if light.model)
    with Inbox(CHANGES, SceneChanges) as inbox:
        inbox.wait(lambda _: True, 'all levels')
        angen.command('lamp/all', 'Dim 40')

        def is_dimmed() -> bool:
            followed.take(list(inbox.messages))
            return abs(followed.levels.get(lamp.name, 0.0) - 0.4) < 1e-6
        until(is_dimmed, 'the level')
    angen.command('lamp/all', 'Off')


def test_python_draws_what_the_topic_has(angen: Angen) -> None:
    told = packed(as_dict(scene_now()))
    with simulator() as module:
        here = packed(module.World.from_text(WORLD).scene)
    for scene in (told, here):
        del scene['revision']
        for link in scene['links']:
            if link['moves']:
                del link['pose']  # the node has run for a while
    assert told == here and len(told['shapes']) > 20
    cameras = [one for one in told['sensors'] if one['kind'] in ('camera', 'depth')]
    assert cameras and all(one['rays'] == 0 and one['yaw'][1] == -one['yaw'][0] > 0.3
                           and one['pitch'][1] == -one['pitch'][0] > 0.2 for one in cameras)


def test_another_scene_comes_when_models_do(angen: Angen) -> None:
    with Inbox(SCENE, Scene) as scenes, Inbox(CHANGES, SceneChanges) as changes:
        before = scenes.wait(lambda _: True, 'a scene')
        changes.wait(lambda _: True, 'its poses')
        angen.spawn('seen_pir', 'model://pir', 1.0, 1.0, 2.0)
        after = scenes.wait(lambda scene: any(link.model == 'seen_pir' for link in scene.links),
                            'the scene with it')
        assert after.revision != before.revision
        assert any(sensor.kind == 'pir' and sensor.name == 'seen_pir' for sensor in after.sensors)
        complete = changes.wait(lambda message: message.revision == after.revision, 'its poses')
        moving = {i for i, link in enumerate(after.links) if link.moves}
        assert set(complete.links) == moving and len(complete.lights) == len(after.lights)
        angen.delete('seen_pir')
        scenes.wait(lambda scene: scene.revision > after.revision and not any(
            link.model == 'seen_pir' for link in scene.links), 'the scene without it')


def test_a_summary_has_the_numbers_of_its_words(angen: Angen) -> None:
    angen.command('lamp/all', 'Dim 40')
    with Inbox('/angen/summary', Summary) as inbox:
        entry = until(lambda: next(
            (e for message in list(inbox.messages) for e in message.entries
             if e.kind == 'lamp' and '40 %' in e.text), None), 'a dimmed lamp')
    names = [field['name'] for field in kinds()['lamp']['fields']
             if field['type'] in ('flag', 'integer', 'number')]
    assert len(entry.values) == len(names)
    values = dict(zip(names, entry.values))
    assert values['on'] == 1.0 and values['level'] == pytest.approx(40.0)
    assert f"{values['luminous_flux']:.0f} lm" in entry.text
    angen.command('lamp/all', 'Off')
