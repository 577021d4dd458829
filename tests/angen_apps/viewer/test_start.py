"""The screen on which rviz opens."""
import os
import subprocess

import pytest

from angen_apps.viewer.start import screen


def test_the_size_of_the_screen_is_that_of_the_display(monkeypatch: pytest.MonkeyPatch) -> None:
    read, write = os.pipe()
    server = subprocess.Popen(['Xvfb', '-displayfd', str(write), '-screen', '0', '1024x600x24',
                               '-nolisten', 'tcp'], pass_fds=[write], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL)
    os.close(write)
    try:
        with open(read) as number:
            monkeypatch.setenv('DISPLAY', f':{number.readline().strip()}')
        assert screen() == (1024, 600)
    finally:
        server.terminate()
        server.wait()


def test_without_a_display_there_is_no_screen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('DISPLAY', raising=False)
    assert screen() is None
