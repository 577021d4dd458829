"""angen luxcheck: right of the simulator as it is, and not of one that is wrong."""
import pytest

from angen_tools.cli.main import run
from angen_tools.offline import luxcheck


def test_the_simulator_agrees_with_theory(capsys):
    assert run(['luxcheck']) == 0
    printed = capsys.readouterr().out
    assert 'WRONG' not in printed
    for theory in ('250.00', '178.89', '88.39', '628.32', '1740.84', '230.84', '104.17', '416.67',
                   '937.50'):
        assert theory in printed


def test_two_percent_too_much_light_is_found(monkeypatch, capsys):
    right = luxcheck.lamp
    for others in ('cube_cases', 'source_cases', 'furniture_cases'):
        monkeypatch.setattr(luxcheck, others, list)
    monkeypatch.setattr(luxcheck, 'lamp', lambda flux, *rest: right(1.02 * flux, *rest))
    assert run(['luxcheck']) == 1
    assert capsys.readouterr().out.count('WRONG') == 6


@pytest.mark.parametrize('measured, passes', [(100.9, True), (99.1, True), (101.1, False)])
def test_a_case_passes_within_its_limit(measured, passes):
    assert luxcheck.Case('x', 100.0, measured, 0.01).passes is passes
