"""Access to the server: the Host and Origin of requests, tokens and their roles, and limits."""
import hmac
import ipaddress
import secrets
import time
from typing import Any, Awaitable, Callable, Sequence

from aiohttp import web

ROLE = 'role'  # its name in a request
COOKIE = 'angen_token_{}'  # by port: browsers send cookies to all ports of a host
LOOK, SWITCH, BUILD = 'look', 'switch', 'build'  # roles of tokens
MAY: dict[str, frozenset[Any]] = {  # their orders; a role that is not here has all
    LOOK: frozenset(), SWITCH: frozenset({'command', 'drive', 'goal', 'halt'})}
REASONS = {LOOK: 'this link only shows the home', SWITCH: 'this link switches and sends; it does '
           'not build, delete, save or change the time'}
Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]
HEADERS = {
    'Content-Security-Policy': "default-src 'self'; img-src 'self' blob: data:; "
                               "style-src 'self' 'unsafe-inline'; connect-src 'self'; "
                               "frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
    'X-Content-Type-Options': 'nosniff',
    'Referrer-Policy': 'no-referrer',
    'Cache-Control': 'no-cache',
}


def is_loopback(host: str) -> bool:
    """Whether only this machine reaches an address."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == 'localhost'


def url_host(host: str) -> str:
    """An address as URLs have it."""
    return f'[{host}]' if ':' in host else host


class Guard:
    """A middleware. A browser sends the name that the user typed as Host: other names are those of
    another site that points to this machine (DNS rebinding)."""

    def __init__(self, host: str, port: int, names: set[str],
                 roles: Sequence[str] = (BUILD,)) -> None:
        """`names`: of this machine, where others may reach it; then each of the roles has a
        token."""
        self.tokens = {role: secrets.token_urlsafe(24) for role in roles
                       if not is_loopback(host)}
        self._cookie = COOKIE.format(port)
        everyone = {'localhost', '127.0.0.1', '[::1]', url_host(host), *map(url_host, names)}
        self._hosts = {f'{name}:{port}'.lower() for name in everyone}

    @web.middleware
    async def middleware(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Rejects requests that are not from a page of this server; adds HEADERS to answers."""
        try:
            response = await self._answer(request, handler)
        except web.HTTPException as answer:
            answer.headers.update(HEADERS)
            raise
        if not response.prepared:
            response.headers.update(HEADERS)
        return response

    async def _answer(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        host = request.headers.get('Host', '').lower()
        if host not in self._hosts:
            raise web.HTTPForbidden(text='This server does not have that name.\n')
        origin = request.headers.get('Origin')
        if origin is not None and origin.lower() != f'http://{host}':
            raise web.HTTPForbidden(text='Pages of other sites may not use this server.\n')
        request[ROLE] = BUILD
        if self.tokens:
            given = request.query.get('token')
            role = self._role(given or request.cookies.get(self._cookie) or '')
            if role is None:
                raise web.HTTPUnauthorized(
                    text='Open the address that angen web has printed, with its token.\n')
            if given and request.path == '/':
                rest = [(key, value) for key, value in request.query.items() if key != 'token']
                answer = web.HTTPFound(request.rel_url.with_query(rest))
                answer.set_cookie(self._cookie, given, httponly=True, samesite='Strict')
                raise answer
            request[ROLE] = role
        return await handler(request)

    def _role(self, given: str) -> str | None:
        """The role of a token; None: it is none."""
        found = None
        for role, token in self.tokens.items():  # all of them: the time tells nothing
            if hmac.compare_digest(given.encode(errors='replace'), token.encode()):
                found = role
        return found

    def access(self, role: str) -> dict[str, Any]:
        """What a page of a role is told of itself: the tokens are those that it may pass on."""
        own = self.tokens if role == BUILD else {role: self.tokens[role]}
        return {'role': role, 'may': sorted(MAY[role]) if role in MAY else None,
                'reason': REASONS.get(role, ''), 'tokens': own}


def refusal(role: str, order: Any) -> str:
    """Why a role may not give an order; else nothing."""
    may = role not in MAY or (isinstance(order, str) and order in MAY[role])
    return '' if may else REASONS[role]


class Budget:
    """Limits the messages of a browser: `burst` at once, `rate` per second."""

    def __init__(self, rate: float, burst: float) -> None:
        self._rate, self._burst = rate, burst
        self._left = burst
        self._at = time.monotonic()

    def take(self) -> bool:
        """Whether one more is accepted."""
        now = time.monotonic()
        self._left = min(self._burst, self._left + (now - self._at) * self._rate)
        self._at = now
        if self._left < 1.0:
            return False
        self._left -= 1.0
        return True
