"""Runs scripts of this folder, which import the page's modules, in node."""
import shutil
import subprocess
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / 'src/angen_apps/page'


def run(folder: Path, script: str, *arguments: Path) -> str:
    """What a script prints, from a folder to which it and the modules are copied."""
    for part in ('js', 'vendor'):
        shutil.copytree(PAGE / part, folder / part)
    (folder / 'package.json').write_text('{"type": "module"}')
    for name in ('browserless.mjs', script):
        shutil.copy(Path(__file__).with_name(name), folder / name)
    done = subprocess.run(['node', folder / script, *arguments], capture_output=True, text=True,
                          check=False)
    assert done.returncode == 0, done.stderr[-1000:]
    return done.stdout
