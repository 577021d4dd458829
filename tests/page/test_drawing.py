"""The edits of the page's drawing, run by node, which TypeScript's compiler brings along."""
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_edits(tmp_path: Path) -> None:
    shutil.copy(ROOT / 'src/angen_apps/page/js/drawing.js', tmp_path / 'drawing.mjs')
    shutil.copy(Path(__file__).with_name('drawing.mjs'), tmp_path / 'test.mjs')
    done = subprocess.run(['node', tmp_path / 'test.mjs'], capture_output=True, text=True,
                          check=False)
    assert done.returncode == 0, done.stderr
    assert 'undo of 500 random edits gives the empty lot' in done.stdout
