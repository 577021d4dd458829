"""Plug-ins in files of Python on the plug-in path, which no program has registered."""
import subprocess
import sys
from pathlib import Path

import pytest

import angen
from sdf_text import box

EXAMPLE = Path(__file__).resolve().parents[1] / 'examples/rangefinder/rangefinder.py'
MODEL = '''<model name="ranger"><static>true</static><pose>0 0 1 0 0 0</pose><link name="link">
  <sensor name="s" type="ray"><plugin name="p" filename="{file}">{extra}</plugin></sensor>
  </link></model>'''
SENSOR = '''import angen

class Eye(angen.Sensor):
    """Sees nothing."""
    rate = 10.0

    def read(self, view, ranges, rng):
        return {{'value': {value}}}

angen.register('{name}', 'eye_{kind}', Eye)
'''


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv('ANGEN_PLUGIN_PATH', str(tmp_path))
    return tmp_path


def script(folder: Path, name: str, value: str = '1.0', registers: str = '') -> None:
    (folder / name).write_text(SENSOR.format(name=registers or name, value=value,
                                             kind=Path(name).stem))


def test_the_example_measures_a_wall(world, folder):
    (folder / 'ranger1.py').write_text(
        EXAMPLE.read_text().replace("'rangefinder", "'ranger1"))
    w = world(box('wall', '3 0 1 0 0 0', '0.2 4 2', True)
              + MODEL.format(file='ranger1.py', extra='<reach>4</reach>'))
    w.step()
    assert w.sensor('ranger1', 'ranger')['range'] == pytest.approx(2.9, abs=1e-6)


def test_the_catalog_lists_it(folder):
    script(folder, 'listed.py')
    (folder / 'other.py').write_text('print("a program that is no plug-in is not run")\n')
    kinds = {each['library']: each['kind'] for each in angen.plugins()}
    assert kinds['listed.py'] == 'eye_listed' and 'other.py' not in kinds
    listed = subprocess.run(['angen', 'plugins'], check=True, text=True, capture_output=True).stdout
    assert 'eye_listed  sensor  listed.py  Sees nothing.' in listed


@pytest.mark.parametrize('name, text, message', [
    ('missing.py', '', 'missing.py is not found; searched'),
    ('syntax.py', '# angen.register(\nx = (1\n', r'syntax.py:2: SyntaxError'),
    ('raises.py', 'import angen\n\n\n1 / 0  # angen.register(\n',
     r'raises.py:4: ZeroDivisionError: division by zero'),
    ('quits.py', 'import sys  # angen.register(\nsys.exit(3)\n', r'quits.py:2: SystemExit: 3'),
    ('none.py', 'x = 1\n', r"no Angen plug-in in .*none.py; .* angen.register\('none.py', 'KIND'"),
    ('again.py', "import angen\nangen.World.from_text('''<sdf version='1.6'><world name='w'>"
     + MODEL.format(file='again.py', extra='') + "</world></sdf>''')  # angen.register(\n",
     "requests itself while it is loaded; put .* below if __name__"),
])
def test_what_is_wrong_with_a_file_is_one_line(world, folder, name, text, message):
    if text:
        (folder / name).write_text(text)
    with pytest.raises(angen.Error, match=message) as caught:
        world(MODEL.format(file=name, extra=''))
    assert '\n' not in str(caught.value).strip()


def test_a_file_registers_its_own_name(world, folder):
    script(folder, 'mine.py', registers='yours.py')
    with pytest.raises(angen.Error, match='mine.py:10: .*registers yours.py and is the file mine'):
        world(MODEL.format(file='mine.py', extra=''))


def test_a_method_that_raises_is_named_with_its_line(world, folder):
    script(folder, 'fails.py', value='1 / 0')
    w = world(MODEL.format(file='fails.py', extra=''))
    with pytest.raises(angen.Error, match=r'fails.py:8: ZeroDivisionError: division by zero'):
        w.run(1.0)


def test_a_file_elsewhere_is_not_run(world, folder, tmp_path_factory):
    other = tmp_path_factory.mktemp('elsewhere')
    script(other, 'elsewhere.py')
    with pytest.raises(angen.Error, match='is not on the plug-in path'):
        world(MODEL.format(file=other / 'elsewhere.py', extra=''))


def test_a_program_of_its_own_gives_the_same_readings(folder):
    """The file is loaded by a process that imports angen only, twice: equal fingerprints."""
    script(folder, 'noise.py', value='rng.gaussian()')
    program = ("import angen; w = angen.World.from_text('''<sdf version=\"1.6\"><world name=\"w\">"
               + MODEL.format(file='noise.py', extra='') + "</world></sdf>'''); w.run(2.0); "
               "print(w.fingerprint, w.sensor('eye_noise', 'ranger')['value'])")
    first, second = (subprocess.run([sys.executable, '-c', program], check=True, text=True,
                                    capture_output=True).stdout for _ in range(2))
    assert first == second and len(first.split()) == 2
