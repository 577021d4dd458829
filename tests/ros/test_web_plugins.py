"""Kinds of plug-ins of one's own on the page: cards, verbs, rows and plots without JavaScript."""
import subprocess
from typing import Iterator

import pytest
from browser import Page, Server
from harness import ROOT, own_node

EXAMPLES = ROOT / 'tests/examples'
WORLD = '''<sdf version="1.6"><world name="w">
<plugin name="turntable" filename="libturntable.so"/>
<model name="plate"><pose>2 2 0.5 0 0 0</pose>
  <link name="base"><collision name="c"><geometry><box><size>0.4 0.4 0.4</size></box></geometry>
  </collision><visual name="v"><geometry><box><size>0.4 0.4 0.4</size></box></geometry></visual>
  </link>
  <link name="disc"><pose>0 0 0.3 0 0 0</pose><collision name="c"><geometry><cylinder>
  <radius>0.3</radius><length>0.05</length></cylinder></geometry></collision></link>
  <joint name="hold" type="fixed"><parent>world</parent><child>base</child></joint>
  <joint name="spindle" type="revolute"><parent>base</parent><child>disc</child>
  <axis><xyz>0 0 1</xyz></axis></joint></model>
<model name="wall"><static>true</static><pose>3 0 1 0 0 0</pose><link name="link">
<collision name="c"><geometry><box><size>0.2 4 2</size></box></geometry></collision></link></model>
<model name="eye"><static>true</static><pose>0 0 1 0 0 0</pose><link name="link">
<sensor name="s" type="ray"><plugin name="p" filename="rangefinder.py"/></sensor></link></model>
</world></sdf>'''


@pytest.fixture(scope='module')
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """A page beside a node with a device in C++ and a sensor in Python that Angen does not know."""
    folder = tmp_path_factory.mktemp('plugins')
    built = folder / 'turntable'
    for command in (['cmake', '-S', str(EXAMPLES / 'turntable'), '-B', str(built),
                     '-DPYTHON_EXECUTABLE=/usr/bin/python3'], ['cmake', '--build', str(built)]):
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
    environment = {'ANGEN_PLUGIN_PATH': f'{built}:{EXAMPLES / "rangefinder"}'}
    with own_node(folder, WORLD, environment) as node, Server(node.master, folder) as server, \
            Page(folder, 1100, 800) as opened:
        opened.open(server.url)
        yield opened


def test_a_device_has_a_card_with_its_verbs(page: Page) -> None:
    page.until('return angen.home.entities.some((e) => e.kind === "turntable")')
    page.run('angen.show(angen.home.entities.find((e) => e.kind === "turntable"))')
    card = 'return document.querySelector("#card .state").textContent.startsWith(arguments[0])'
    page.until(card, 'still')
    assert 'A plate that turns.' in page.text('#card header')
    page.press('#card [data-verb="Start"]')
    page.until(card, 'turning')
    page.until('''return angen.home.linksOf("plate").map((link) => angen.home.pose(link)).some(
        (p) => Math.abs(2 * Math.atan2(p[5], p[6])) > 0.2)''')
    page.press('#card [data-verb="Stop"]')
    page.until(card, 'still')
    page.run('''const input = document.querySelector("#card input[type=number]");
        input.value = "1.5"; input.parentElement.querySelector("button").click()''')
    page.until(card, 'turning')  # Turn 1.5, typed with its unit beside it
    assert 'rad/s' in page.text('#card .verbs label')


def test_a_sensor_in_python_has_a_row_and_a_plot(page: Page) -> None:
    page.press('#tab-sensors')
    page.until('return document.querySelector("#panel").textContent.includes("eye")')
    page.run('angen.show(angen.home.entities.find((e) => e.kind === "rangefinder"))')
    assert 'Distance straight ahead' in page.text('#card header')
    page.press('#card button', 'Plot')
    value = page.until('''const one = angen.panels.plots.shown.find(
        (p) => p.key.startsWith("rangefinder/")); return one?.plot.data[1].at(-1)''')
    assert value == pytest.approx(2.9, abs=0.05)
