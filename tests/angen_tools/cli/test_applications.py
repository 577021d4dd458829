"""The commands of other packages: how the angen command finds them, and its errors without them."""
from pathlib import Path

import pytest

from angen_tools.cli import applications, main as cli


@pytest.fixture
def alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """An installation of angen_tools and nothing above it."""
    monkeypatch.setattr(applications, 'MODULES', ('no_apps.cli.commands', 'no_bench.commands'))


def test_commands_of_absent_packages_are_not_offered(
        alone: None, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        cli.run(['task', 'patrol'])
    assert end.value.code == 2 and "'task' is not known" in capsys.readouterr().err
    assert cli.make_parser().parse_args(['luxcheck']).run


def test_an_error_inside_of_a_package_is_not_hidden(
        monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / 'broken').mkdir()
    (tmp_path / 'broken/commands.py').write_text('import no_such_module')
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(applications, 'MODULES', ('broken.commands',))
    with pytest.raises(ModuleNotFoundError, match='no_such_module'):
        cli.make_parser()
