"""The port of a page."""
import socket

import pytest

from angen_tools.common.failure import Failure
from angen_tools.common.port import port, require_free


@pytest.mark.parametrize('text', ['eighty', '80', '99999', '-1', '8080.5', ''])
def test_a_port_is_one_that_a_user_may_open(text: str) -> None:
    assert port('8080') == 8080
    with pytest.raises(ValueError, match='give 1024 to 65535'):
        port(text)


def test_a_port_in_use_is_named_before_anything_waits() -> None:
    with socket.socket() as taken:
        taken.bind(('127.0.0.1', 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(Failure, match=f'127.0.0.1:{port} cannot be served: Address already'):
            require_free('127.0.0.1', port)
    require_free('127.0.0.1', port)
    with pytest.raises(Failure, match='nope.invalid:8080 cannot be served: '):
        require_free('nope.invalid', 8080)
