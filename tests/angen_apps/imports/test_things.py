"""Types of pieces of furniture."""
import pytest

from angen_apps.imports.things import table, what_is
from angen_apps.plan.symbols import SYMBOLS


@pytest.mark.parametrize('catalog, thing', [
    ('eTeks#dishwasher', 'dishwasher'),
    ('Scopia#dishwasher', 'dishwasher'),
    ('eTeks#clothesWasher', 'washing_machine'),
    ('eTeks#cooker', 'stove'),
    ('eTeks#kitchenCabinet', 'cabinet'),
    ('eTeks#bedsideTable', 'nightstand'),
])
def test_a_piece_of_the_catalog_is_a_thing_with_a_symbol(catalog, thing):
    found = what_is(table(), catalog, '')
    assert found is not None and found.thing == thing and thing in SYMBOLS
