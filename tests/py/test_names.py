"""The rule for names, as the tools use it; core/names_test has all of it."""
import pytest

import angen


def test_a_name_is_returned_and_what_is_none_is_an_error() -> None:
    assert angen.check_name('Küche 2') == 'Küche 2'
    with pytest.raises(angen.Error, match='the name'):
        angen.check_name('a::b')
    with pytest.raises(ValueError):
        angen.check_name('\udcff')  # is not UTF-8
