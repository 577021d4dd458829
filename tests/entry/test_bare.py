"""The script that runs commands on a bare Debian 12; debootstrap makes only empty folders here."""
import os
from pathlib import Path
import shutil
import subprocess

import pytest

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.skipif(os.getuid() != 0, reason='only root can make a bare machine')
# debootstrap OPTION OPTION SUITE FOLDER MIRROR; unshare ... SCRIPT NAME ROOT COMMAND
FAKES = {
    'debootstrap': 'mkdir -p "$4/etc/dpkg/dpkg.cfg.d" "$4/root"',
    'unshare': 'while [ $# -gt 2 ]; do shift; done; cd "$1/root/angen" && exec sh -c "$2"',
}


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A clone with one file that is committed and one that is not."""
    (tmp_path / 'bin').mkdir()
    for name, text in FAKES.items():
        (tmp_path / 'bin' / name).write_text(f'#!/bin/sh\n{text}\n')
        (tmp_path / 'bin' / name).chmod(0o755)
    made = tmp_path / 'checkout'
    (made / '.ci').mkdir(parents=True)
    shutil.copy(ROOT / '.ci/bare', made / '.ci')
    (made / 'committed').touch()
    for words in (['init', '-q'], ['add', '.'], ['commit', '-qm', 'First']):
        subprocess.run(['git', '-c', 'user.name=a', '-c', 'user.email=a@example.org', *words],
                       cwd=made, check=True)
    (made / 'edited').touch()
    return made


def bare(checkout: Path, *commands: str) -> subprocess.CompletedProcess[str]:
    path = f'{checkout.parent}/bin:{os.environ["PATH"]}'
    return subprocess.run([checkout / '.ci/bare', *commands], capture_output=True, text=True,
                          env=dict(os.environ, PATH=path))


def test_commands_run_in_a_clone_of_the_last_commit(checkout: Path) -> None:
    result = bare(checkout, 'ls', 'touch left')
    assert result.returncode == 0, result.stderr
    lines = result.stdout.splitlines()
    assert lines[0] == 'committed' and 'edited' not in lines
    assert [line.split(' after ')[0] for line in lines[1:]] == 2 * ['bare: exit code 0']


def test_the_machine_is_bare_each_time(checkout: Path) -> None:
    assert bare(checkout, 'touch ../left').returncode == 0
    assert bare(checkout, 'test ! -e ../left').returncode == 0


def test_a_folder_goes_with_it(checkout: Path, tmp_path: Path) -> None:
    (tmp_path / 'made').mkdir()
    (tmp_path / 'made/angen.deb').write_text('it')
    result = bare(checkout, '--with', str(tmp_path / 'made'), 'cat ../with/angen.deb')
    assert result.returncode == 0 and result.stdout.startswith('it')


def test_the_first_failure_ends_it_with_its_exit_code(checkout: Path) -> None:
    result = bare(checkout, 'exit 3', 'echo second')
    assert result.returncode == 3 and 'second' not in result.stdout
    assert result.stdout.startswith('bare: exit code 3 after 0 s: exit 3')


def test_dpkg_fails_while_something_is_compiled(checkout: Path, tmp_path: Path) -> None:
    bare(checkout, 'true')
    settings = (checkout / 'build-bare/root/etc/dpkg/dpkg.cfg.d/compiling').read_text().splitlines()
    hooks = dict(line.split('=', 1) for line in settings)
    assert set(hooks) == {'pre-invoke', 'post-invoke'}
    shutil.copy('/bin/sleep', tmp_path / 'ninja')
    with subprocess.Popen([tmp_path / 'ninja', '60']) as compiler:
        for hook in hooks.values():  # as dpkg does it, without the quotes
            assert subprocess.run(['sh', '-c', hook.strip('"')], capture_output=True,
                                  check=False).returncode != 0
        compiler.kill()
