"""A building of several floors on the page: closed below the top one, each open by itself."""
from pathlib import Path
from typing import Any

from browser import Page, Server
from harness import Cli, Master

FLOORS = 4
SHOWN = '''const {home, view} = angen, found = {};
    view.shapes.parts.flat().forEach((part) => {
        const e = view.viewpoint.camera.matrixWorld.clone();
        if (part.slot < 0 || !["wall", "thing"].includes(part.cls)) return;
        part.mesh.getMatrixAt(part.slot, e);
        const {model} = home.scene.links[part.link];
        const key = `${part.cls} ${home.storeyOf(model, e.elements[14], 0.05)}`;
        const top = e.elements[14] + Math.abs(e.elements[10]) / 2;
        const {count = 0, top: highest = 0} = found[key] ?? {};
        found[key] = {count: count + 1, top: Math.max(highest, top)};
    });
    return found'''


def test_floors_are_closed_below_the_top_one(master: Master, rospy_node: None, tmp_path: Path
                                             ) -> None:
    world = tmp_path / 'home.world'
    Cli(master).does('world', 'home', '--floors', str(FLOORS), '--rooms', '2', '--seed', '3',
                     '-o', str(world))
    with master.serving(world, tmp_path), Server(master, tmp_path) as server, \
            Page(tmp_path, 900, 600) as page:
        page.open(server.url)
        page.first_view()
        elevations = page.run('return angen.home.storeys.map((s) => s.elevation)')
        assert len(elevations) == FLOORS and elevations[1] < 4.0  # not the floors of rviz
        whole: dict[str, Any] = page.run(SHOWN)
        for number, elevation in enumerate(elevations[:-1]):
            assert whole[f'wall {number}']['top'] > elevation + 2.0
        top = FLOORS - 1
        assert elevations[top] + 1.0 < whole[f'wall {top}']['top'] < elevations[top] + 1.3  # cut
        assert whole[f'thing {top}']['count'] > 5
        page.run('angen.setStorey(1)')
        page.first_view()
        one = page.run(SHOWN)
        assert set(one) <= {'wall 1', 'thing 1'}
        assert one['thing 1']['count'] > 2 * whole.get('thing 1', {'count': 0})['count']
        assert one['wall 1']['top'] < elevations[1] + 1.3
