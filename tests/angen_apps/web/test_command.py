"""The address that angen web prints."""
import io
import json

import pytest
import qrcode

from angen_apps.web.command import show_address

URL = 'http://192.0.2.2:8080/?token=abc'
QUIET = 4  # modules around a code that readers expect
DARK_COLOR, LIGHT_COLOR = '\x1b[48;5;232m', '\x1b[38;5;255m'  # behind, before; of no theme
LIGHT = {'\xa0': (False, False), '▀': (True, False), '▄': (False, True), '█': (True, True)}


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_the_code_is_dark_on_light_in_terminals_of_any_theme(
        monkeypatch: pytest.MonkeyPatch) -> None:
    out = Terminal()
    monkeypatch.setattr('sys.stdout', out)
    show_address(URL, True, False)
    address, *lines = out.getvalue().splitlines()
    assert address == f'angen web: {URL}'
    dark = []
    for line in lines:
        assert LIGHT_COLOR in line and (DARK_COLOR in line or line is lines[-1])
        for half in (0, 1):
            dark.append([not LIGHT[cell][half] for cell in line if cell in LIGHT])
    expected = qrcode.QRCode(border=QUIET)
    expected.add_data(URL)
    size = len(expected.get_matrix())
    assert dark[:size] == expected.get_matrix()


def test_the_address_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    show_address(URL, True, True)
    assert json.loads(capsys.readouterr().out) == {'address': URL}
    show_address(URL, True, True, others={'look': 'http://b/'})
    assert json.loads(capsys.readouterr().out) == {'address': URL, 'look': 'http://b/'}


def test_addresses_that_may_do_less(capsys: pytest.CaptureFixture[str]) -> None:
    show_address(URL, False, False, others={'switch': 'http://a/', 'look': 'http://b/'})
    assert capsys.readouterr().out.splitlines() == [
        f'angen web: {URL}', 'angen web: to switch, not to build: http://a/',
        'angen web: to look only: http://b/']
