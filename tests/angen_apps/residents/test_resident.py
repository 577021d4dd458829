"""Residents who use the things of a home."""
from __future__ import annotations

from angen_apps.data.site import apartment
from angen_apps.residents.activities import Step
from tests.angen_apps.residents.test_mover import home_of


def test_whoever_opens_a_front_steps_out_of_its_way(tmp_path):
    apartment(tmp_path / 'home.world')
    site, household, anna = home_of(tmp_path / 'home.world')
    steps = [Step(at=('fridge',), opens='fridge'), Step(at=('wardrobe',), opens='wardrobe')]
    modes: dict[str, str] = {}

    def script():
        for step in steps:
            for spot in household.places.spots(step):
                anna.enter(household.places.anywhere())
                yield from anna.go(spot.stand, spot.storey)
                (kind, name, shut), = anna._use(step, spot)
                yield from anna._make_way(kind, name, spot)
                modes[name] = site.simulator.state(kind, name)['mode']
                household.do('anna', kind, name, shut)
                yield anna.now + 6.0
                assert site.simulator.state(kind, name)['mode'] == 'CLOSED'

    household.add(script())
    household.run(300.0)
    assert len(modes) == 2 and set(modes.values()) == {'OPEN'}, modes
