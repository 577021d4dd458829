"""angen pid: the plain controllers follow their closed forms."""
import json

import pytest

from angen_tools.cli.main import run
from angen_tools.offline import pid


@pytest.mark.parametrize('kind', ['door', 'elevator'])
def test_all_follow_their_closed_forms(kind, tmp_path, capsys):
    assert run(['pid', kind, '--json', '--out', str(tmp_path)]) == 0
    p, pi, full, own = json.loads(capsys.readouterr().out)
    assert all(one['deviation'] < 0.01 for one in (p, pi, full))
    assert p['settles_s'] is None and pi['settles_s'] is None, 'P alone and P + I swing'
    assert pi['overshoot'] > p['overshoot'] > 0.7
    assert full['settles_s'] < 12.0 and full['overshoot'] > 0.2
    assert own['settles_s'] < full['settles_s'] and own['overshoot'] < 0.001
    assert (tmp_path / f'pid_{kind}.png').stat().st_size > 10_000


def test_p_alone_swings_with_its_period():
    """2 pi sqrt(I / P) = 1.744 s."""
    swing = pid.answer(pid.PLANTS['door'], 'P', 'P')
    below = swing.x < -0.7
    crossed = [t for t, was, now in zip(swing.t, below, below[1:]) if was != now]
    assert crossed[4] - crossed[0] == pytest.approx(2 * 1.744, abs=0.01)


def test_a_wrong_simulation_is_found(monkeypatch, tmp_path, capsys):
    right = pid.closed_form
    monkeypatch.setattr(pid, 'closed_form', lambda *args: 1.02 * right(*args))
    assert run(['pid', 'door', '--out', str(tmp_path)]) == 1
