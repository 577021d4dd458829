"""The page of angen web before its node, with an empty world, without rooms, with many lamps."""
from pathlib import Path
from typing import Iterator

import pytest
from browser import Page, Server
from harness import ROOT, Angen, Master, end
from selenium.webdriver.common.action_chains import ActionChains

LAMPS = 300
MOST = 70_000  # triangles
LAMP = '<include><uri>model://ceiling_lamp</uri><name>l{n}_lamp</name>' \
    '<pose>{x} {y} 2.5 0 0 0</pose></include>'
WORLD = '<sdf version="1.6"><world name="lamps">' + ''.join(
    LAMP.format(n=n, x=3 * (n % 20), y=3 * (n // 20)) for n in range(LAMPS)) + '</world></sdf>'
NOTHING = 'return !document.querySelector("#nothing").hidden && ' \
    'document.querySelector("#nothing").textContent === arguments[0]'


IN_3D = 'angen.view.viewpoint.screen([x, y, -0.2])'
ON_PLAN = '''(() => { const p = new DOMPoint(x, -y).matrixTransform(angen.plan.root.getScreenCTM());
    return [p.x, p.y]; })()'''


def add_pir(page: Page, place: tuple[float, float, float]) -> None:
    """Spawns from the card of a place in no room, and deletes again."""
    page.until('return document.querySelector("#card h2")?.textContent === "Outside of all rooms"')
    page.press('#add')
    made = page.until('return angen.home.entities.find((e) => e.kind === "pir")')
    assert made['name'] == 'pir_1'
    assert tuple(made['pose'][:3]) == pytest.approx(place, abs=0.1)
    page.run('angen.show(angen.home.entities.find((e) => e.kind === "pir"))')
    page.press('#card button', 'Delete')
    page.until('return !angen.home.entities.some((e) => e.kind === "pir")')


@pytest.fixture(scope='module')
def page(master: Master, rospy_node: None, tmp_path_factory: pytest.TempPathFactory
         ) -> Iterator[Page]:
    """Opened while there is no node."""
    with Server(master, tmp_path_factory.mktemp('web')) as server, \
            Page(tmp_path_factory.mktemp('browser'), 900, 600) as opened:
        opened.driver.get(server.url)
        yield opened


def test_the_page_waits_for_its_node_and_says_that_a_world_is_empty(
        master: Master, page: Page, tmp_path: Path) -> None:
    page.until(NOTHING, 'Waiting for a simulator: ./angen run starts one')
    process = master.node(ROOT / 'worlds/empty.world', tmp_path / 'log')
    try:
        for view, place, z in (('3d', IN_3D, -0.2), ('plan', ON_PLAN, 0.0)):  # the ground is lower
            page.press(f'#view-{view}')
            page.until(NOTHING, 'This world has no rooms and no devices. '
                       'Click the ground to add a sensor.')
            page.first_view()
            page.click(*page.run(f'const [x, y] = [1, 2]; return {place}'))
            add_pir(page, (1.0, 2.0, z + 1.2))
        page.press('#tab-sensors')  # and by keys
        page.press('#panel button', 'Add a sensor …')
        ActionChains(page.driver, duration=0).send_keys(  # right, right, up, Enter
            '\ue014', '\ue014', '\ue013', '\ue007').perform()
        page.until('return document.activeElement.id === "add"')
        add_pir(page, (0.5, 0.25, 1.2))
        page.press('#tab-rooms')
    finally:
        end(process)
    page.press('#view-3d')


def test_many_lamps_are_drawn_by_few_triangles_and_the_view_stays(
        master: Master, page: Page, tmp_path: Path) -> None:
    (tmp_path / 'lamps.world').write_text(WORLD)
    node = Angen(master, master.node(tmp_path / 'lamps.world', tmp_path / 'log'), tmp_path / 'log')
    try:
        page.until('return angen.home.entities.filter((e) => e.kind === "lamp").length '
                   '=== arguments[0]', LAMPS)
        page.first_view()
        assert page.run('return document.querySelector("#nothing").hidden')
        page.run('angen.view.frames = 0; angen.view.dirty = true')
        page.until('return angen.view.frames > 0')
        assert 0 < page.run('return angen.view.renderer.info.render.triangles') < MOST
        page.run('angen.view.viewpoint.camera.position.z += 5')
        camera = page.run('return angen.view.viewpoint.camera.position.toArray()')
        node.spawn('eye', 'model://pir', 1.0, 1.0, 2.0)
        page.until('return angen.view.shapes.parts.length === angen.home.scene.links.length && '
                   'angen.home.linksOf("eye").length > 0 && !angen.view.viewpoint.goal')
        assert page.run('return angen.view.viewpoint.camera.position.toArray()') == pytest.approx(
            camera, abs=1e-3)
    finally:
        end(node.process)
