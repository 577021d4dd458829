"""The port of a page that this machine serves."""
import socket

from angen_tools.common.failure import Failure


def port(text: str) -> int:
    """A port that a user may open."""
    if text.isascii() and text.isdigit() and 1024 <= int(text) <= 65535:
        return int(text)
    raise ValueError(f"'{text}' is not a port; give 1024 to 65535")


def require_free(host: str, number: int) -> None:
    """Failure if this machine cannot serve an address."""
    try:
        kind, _, _, _, address = socket.getaddrinfo(host, number, type=socket.SOCK_STREAM)[0]
        with socket.socket(kind, socket.SOCK_STREAM) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind(address)
    except OSError as error:
        raise not_served(host, number, error) from None


def not_served(host: str, number: int, error: OSError) -> Failure:
    return Failure(f'{host}:{number} cannot be served: {error.strerror}; choose another with '
                   '--port, or port:= of ./angen run')


def free_port() -> int:
    """A port of 127.0.0.1 that nobody uses now."""
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return int(probe.getsockname()[1])
