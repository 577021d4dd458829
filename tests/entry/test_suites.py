"""The suites of ./angen test: those that run beside pytest, and what is told of all."""
import os
from pathlib import Path
import signal
import subprocess
import time

import pytest

ROOT = Path(__file__).resolve().parents[2]
# In place of each suite: one that says that it runs, and in which order.
SCRIPT = '''
source "$1/angen"; source "$1/.ci/checks.bash"; root=$2
trap 'say "stopped"; exit 130' INT
install() { :; }; prepare() { :; }
until_there() { until [[ -e $root/$1 ]]; do sleep 0.01; done; }
check_flake8() { until_there pytest; echo "beside: $(jobs)"; touch beside; }
check_mypy() { echo "$BASHPID" >mypy; while true; do sleep 1; done; }
check_tsc() { matched=1; [[ ! -e $root/fails ]]; }
check_ctest() { [[ ! -e $root/pytest ]] && echo "ctest ran"; }
check_pytest() { touch pytest; until_there "$waits_for"; echo "pytest ran"; }
waits_for=$3
run_test "${@:4}"'''


def start(folder: Path, waits_for: str, *words: str) -> subprocess.Popen[str]:
    return subprocess.Popen(['bash', '-c', SCRIPT, 'test', ROOT, folder, waits_for, *words],
                            text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def lines(text: str) -> list[str]:
    return [' '.join(line.split()[:2]) for line in text.splitlines() if line]


@pytest.mark.parametrize('fails', [False, True])
def test_the_others_run_while_pytest_does(tmp_path, fails):
    """pytest's part ends after one beside it, which begins after pytest's."""
    if fails:
        (tmp_path / 'fails').touch()
    done = start(tmp_path, 'beside', 'flake8', 'tsc', 'pytest')
    said, trouble = done.communicate(timeout=60)
    assert (done.returncode, trouble) == (int(fails), '')
    assert lines(said) == ['== pytest', 'pytest ran', '== flake8', 'beside: 1', '== tsc',
                           'flake8 ok', 'tsc FAILED' if fails else 'tsc ok', 'pytest ok']


def test_ctest_runs_before_pytest_which_uses_what_it_builds(tmp_path):
    done = start(tmp_path, 'beside', 'flake8', 'ctest', 'pytest')
    said, trouble = done.communicate(timeout=60)
    assert (done.returncode, trouble) == (0, '')
    assert lines(said) == ['== ctest', 'ctest ran', '== pytest', 'pytest ran', '== flake8',
                           'beside: 1', 'flake8 ok', 'ctest ok', 'pytest ok']


def test_a_word_that_only_a_suite_beside_it_has_is_found(tmp_path):
    done = start(tmp_path, 'beside', '-k', 'door', 'flake8', 'tsc', 'pytest')
    assert done.wait(60) == 0


def test_ctrl_c_ends_those_beside_it(tmp_path):
    done = start(tmp_path, 'end', 'mypy', 'pytest')
    number = tmp_path / 'mypy'
    while not (number.exists() and number.read_text().endswith('\n')):
        assert done.poll() is None
        time.sleep(0.01)
    done.send_signal(signal.SIGINT)
    (tmp_path / 'end').touch()  # pytest ends by the signal, too
    assert done.wait(60) == 130
    assert done.stderr.read() == 'angen: stopped\n'
    while True:  # ends when the process has
        try:
            os.kill(int(number.read_text()), 0)
        except ProcessLookupError:
            break
        time.sleep(0.01)
