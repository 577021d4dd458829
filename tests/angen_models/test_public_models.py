"""The models of names that public worlds include are what their script makes."""
from pathlib import Path

import pytest
from lxml import etree

import make_public_models as script

WORLDS = Path(script.__file__).parent


def test_files_are_what_the_script_makes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(script, 'MODELS_FOLDER', tmp_path)
    script.main()
    made = [path for path in tmp_path.rglob('*') if path.is_file()]
    assert len(made) == 2 * len(script.MODELS) + sum(1 for m in script.MODELS.values() if m.mesh)
    for path in made:
        there = WORLDS / 'models' / path.relative_to(tmp_path)
        assert path.read_bytes() == there.read_bytes(), f'{there}: run worlds/make_public_models.py'


@pytest.mark.parametrize('name', script.MODELS)
def test_each_stands_on_the_ground(name: str) -> None:
    model = etree.parse(str(WORLDS / 'models' / name / 'model.sdf')).find('model')
    lowest = []
    for part in model.iterfind('link/collision'):
        height = float(part.findtext('pose').split()[2])
        size = part.findtext('geometry/box/size') or part.findtext('geometry/cylinder/length')
        lowest.append(height - float(size.split()[-1]) / 2)
    assert min(lowest) == pytest.approx(0, abs=0.03)
