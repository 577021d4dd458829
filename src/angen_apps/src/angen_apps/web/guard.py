"""Access to the server: the Host and Origin of requests, the token, and limits."""
from __future__ import annotations

import hmac
import ipaddress
import secrets
import time
from typing import Awaitable, Callable

from aiohttp import web

COOKIE = 'angen_token_{}'  # by port: browsers send cookies to all ports of a host
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

    def __init__(self, host: str, port: int, names: set[str]) -> None:
        """`names`: of this machine, where others may reach it."""
        self.token = '' if is_loopback(host) else secrets.token_urlsafe(24)
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
        if self.token:
            given = request.query.get('token')
            if given is not None and self._fits(given) and request.path == '/':
                rest = [(key, value) for key, value in request.query.items() if key != 'token']
                answer = web.HTTPFound(request.rel_url.with_query(rest))
                answer.set_cookie(self._cookie, self.token, httponly=True, samesite='Strict')
                raise answer
            if not self._fits(given or request.cookies.get(self._cookie) or ''):
                raise web.HTTPUnauthorized(
                    text='Open the address that angen web has printed, with its token.\n')
        return await handler(request)

    def _fits(self, token: str) -> bool:
        return hmac.compare_digest(token.encode(), self.token.encode())


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
