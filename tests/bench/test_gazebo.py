"""The probe in Gazebo and the chroot that it runs in."""
import os
import subprocess
from pathlib import Path

import pytest

from angen_bench.gazebo import parse
from angen_tools.cli import main as cli

SCRIPT = Path(__file__).resolve().parents[2] / 'bench/angen_bench/chroot/make_chroot'


@pytest.mark.parametrize('line,said', [
    ('probe sample 12.5 3.25 40 4\n', ('sample', [12.5, 3.25, 40.0, 4.0])),
    ('probe first 12.5', ('first', [12.5])),
    ('[Wrn] a probe of something', None), ('probe', None), ('probe gone', None),
    ('probe first soon', None), ('', None)])
def test_lines_of_the_probe_are_recognized(line: str, said: tuple[str, list[float]] | None
                                           ) -> None:
    assert parse(line) == said


def test_the_chroot_is_made_by_root_alone() -> None:
    other_user = ['setpriv', '--reuid=65534', '--clear-groups'] if os.geteuid() == 0 else []
    made = subprocess.run([*other_user, 'bash', '-s', '/nowhere'], input=SCRIPT.read_text(),
                          capture_output=True, text=True, check=False)
    assert (made.returncode, made.stderr) == (1, '')
    assert made.stdout == ('Gazebo runs in a chroot, which root alone can make: run it as root, '
                           'with sudo\n')


def make_chroot(folder: Path, debootstrap: str) -> subprocess.CompletedProcess[str]:
    """Runs the script where the only debootstrap is one that does that, or none."""
    for program in ('bash', 'dirname', 'readlink', 'mkdir', 'rm'):
        (folder / program).symlink_to(f'/usr/bin/{program}')
    if debootstrap:
        (folder / 'debootstrap').write_text(f'#!/bin/sh\n{debootstrap}\n')
        (folder / 'debootstrap').chmod(0o755)
    return subprocess.run(['/usr/bin/bash', str(SCRIPT), str(folder / 'chroot')],
                          env={'PATH': str(folder)}, capture_output=True, text=True, check=False)


as_root = pytest.mark.skipif(os.geteuid() != 0, reason='needs root')


@as_root
def test_a_missing_debootstrap_is_named(tmp_path: Path) -> None:
    made = make_chroot(tmp_path, '')
    assert made.returncode == 1
    assert made.stdout == 'Gazebo needs debootstrap: apt-get install debootstrap\n'


@as_root
def test_without_a_mirror_nothing_is_left_but_the_log(tmp_path: Path) -> None:
    made = make_chroot(tmp_path, 'echo "no net for $4"; exit 1')
    assert made.returncode == 1
    assert made.stdout.splitlines() == [
        f'debootstrap has not reached a mirror of Debian 11; see {tmp_path}/chroot.log']
    assert not (tmp_path / 'chroot').exists() and not (tmp_path / 'chroot.part').exists()
    assert 'no net for http://archive.debian.org' in (tmp_path / 'chroot.log').read_text()


def test_the_bench_says_the_rejection_in_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                                  capsys: pytest.CaptureFixture[str]) -> None:
    script = tmp_path / 'make_chroot'
    script.write_text('#!/bin/sh\necho "it cannot be made"\nexit 1\n')
    script.chmod(0o755)
    monkeypatch.setattr('angen_bench.gazebo.script', lambda: script)
    words = ['bench', 'sensors', '--kind', 'pir', '--vs', 'gazebo', '--out', str(tmp_path / 'out')]
    assert cli.run(words) == 1
    assert capsys.readouterr().err == 'angen: it cannot be made\n'
    assert not (tmp_path / 'out').exists()
