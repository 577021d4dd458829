"""Memory and time of large worlds; too large ones are rejected before they take it."""
import os
import resource
import subprocess
import sys

import pytest

import angen
from sdf_text import sdf_world
from spent import spent_on


def links(count: int) -> str:
    """A model of that many empty links."""
    return '<model name="m">' + '\n'.join(f'<link name="l{i}"/>' for i in range(count)) + '</model>'


def chain(count: int) -> str:
    """Links in a row, with a hinge between each two."""
    joints = '\n'.join(
        f'<joint name="j{i}" type="revolute"><parent>l{i - 1}</parent><child>l{i}</child><axis>'
        '<xyz>0 0 1</xyz></axis></joint>' for i in range(1, count))
    return links(count).replace('</model>', joints + '</model>')


def welded(count: int) -> str:
    """Links in a row, each fixed to the next, the last to the world."""
    names = [f'l{i}' for i in range(count)] + ['world']
    joints = '\n'.join(f'<joint name="j{i}" type="fixed"><parent>{names[i + 1]}</parent><child>'
                       f'{names[i]}</child></joint>' for i in range(count))
    return links(count).replace('</model>', joints + '</model>')


def sensors(count: int) -> str:
    """Sensors on one link."""
    each = '\n'.join(
        f'<sensor name="s{i}" type="ray"><ray><scan><horizontal><samples>9</samples></horizontal>'
        '</scan><range><max>6</max></range></ray><plugin name="p" filename="libpir_controller.so"/>'
        '</sensor>' for i in range(count))
    return f'<model name="m"><static>true</static><link name="l">{each}</link></model>'


def load(content: str) -> None:
    angen.World.from_text(sdf_world(content))


@pytest.mark.parametrize('make, count, megabytes', [
    (links, 3000, 50), (links, 9000, 100), (chain, 1500, 80), (welded, 2400, 80),
    (sensors, 1200, 150)])
def test_memory_of_a_large_model_grows_with_its_size(make, count, megabytes) -> None:
    """They took 165, 497, 220, 285 and 513 MB, and 9,000 links 14 s, with libsdformat's frames."""
    _, cpu, memory = spent_on(load, make(count))
    print(f'{make.__name__} {count}: {memory:.0f} MB, {cpu:.1f} s')
    assert memory < megabytes


def fan(side: int, count: int) -> str:
    """Lidars of side x side rays."""
    each = '\n'.join(
        f'<sensor name="s{i}" type="ray"><ray><scan><horizontal><samples>{side}</samples>'
        f'</horizontal><vertical><samples>{side}</samples></vertical></scan></ray>'
        '<plugin name="p" filename="libpir_controller.so"/></sensor>' for i in range(count))
    return f'<model name="m"><static>true</static><link name="l">\n{each}</link></model>'


@pytest.fixture
def limit():
    """Restores the limit of memory."""
    before = angen.memory_limit()
    yield angen.set_memory_limit
    angen.set_memory_limit(before)


def test_what_would_take_too_much_is_rejected_before_it_is_allocated(limit) -> None:
    """20 sensors of a million rays, by their file and line; and rejecting takes no memory."""
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(angen.Error, match=r'<text>:\d+: <model name="m"> would take about \d+ MB '
                                          r'of memory.*the limit is 4096 MB.*ANGEN_MEMORY_LIMIT'):
        angen.World.from_text(sdf_world(fan(1000, 20)))
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 50 * 1024
    limit(50)
    with pytest.raises(angen.Error, match='the limit is 50 MB'):
        angen.World.from_text(sdf_world(fan(1000, 1)))
    there = angen.World.from_text(sdf_world(''))
    with pytest.raises(angen.Error, match='the limit is 50 MB'):
        there.spawn(links(9000))
    there.spawn(links(10))
    for wrong in (0, -1, float('nan'), float('inf')):
        with pytest.raises(angen.Error, match='memory limit'):
            limit(wrong)


def test_the_limit_may_be_an_argument(limit) -> None:
    """The limit of a world, for the whole process from then on."""
    with pytest.raises(angen.Error, match='the limit is 20 MB'):
        angen.World.from_text(sdf_world(links(9000)), memory_limit=20)
    assert angen.memory_limit() == 20


def test_what_is_not_a_heightmap_is_named_as_that(tmp_path) -> None:
    path = tmp_path / 'm.world'
    (tmp_path / 'h.png').write_bytes(b'this is a text, and no picture at all')
    path.write_text(sdf_world(
        '<model name="m"><static>true</static><link name="l"><collision name="c"><geometry>'
        '<heightmap><uri>h.png</uri><size>1 1 1</size></heightmap></geometry></collision></link>'
        '</model>').replace('"test"', '"test" angen:strict="true"'))
    with pytest.raises(angen.Error, match=r'm.world:\d+: .*PNG'):
        angen.World(str(path))


@pytest.mark.parametrize('wrong', ['4GB', '-1', 'abc', '0'])
def test_a_wrong_limit_of_the_environment_is_an_error(wrong) -> None:
    load = 'import angen, sys; angen.World.from_text(sys.argv[1])'
    done = subprocess.run([sys.executable, '-c', load, sdf_world(links(1))],
                          env=dict(os.environ, ANGEN_MEMORY_LIMIT=wrong), capture_output=True,
                          text=True, check=False)
    assert f"ANGEN_MEMORY_LIMIT is '{wrong}'; give a number of MB" in done.stderr
