"""The files of the page, compressed: over a slow network its first view waits for them."""
import gzip
import mimetypes
from pathlib import Path

from aiohttp import ETag, web

from angen_apps.web.threads import in_thread

LEVEL = 6


class Files:
    """Those of one folder and no others; a file that changes is read again."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder.resolve()
        self._packed: dict[Path, tuple[str, bytes]] = {}  # with the tag of its version

    async def get(self, request: web.Request) -> web.StreamResponse:
        """The file that the request names below /page/."""
        return await self.answer(request, request.match_info['name'])

    async def answer(self, request: web.Request, name: str) -> web.StreamResponse:
        path = self._file(name)
        if path is None:
            raise web.HTTPNotFound()
        stat = path.stat()
        tag = f'{stat.st_mtime_ns:x}-{stat.st_size:x}'
        if ETag(tag) in (request.if_none_match or ()):
            response = web.Response(status=304)
        else:
            if self._packed.get(path, ('',))[0] != tag:
                self._packed[path] = tag, await in_thread(packed, path)
            kind = mimetypes.guess_type(path.name)[0] or 'application/octet-stream'
            response = web.Response(
                body=self._packed[path][1], content_type=kind, headers={'Content-Encoding': 'gzip'},
                charset='utf-8' if kind.startswith('text/') else None)
        response.etag = ETag(tag)
        return response

    def _file(self, name: str) -> Path | None:
        try:
            path = (self._folder / name).resolve()
            return path if path.is_relative_to(self._folder) and path.is_file() else None
        except (OSError, ValueError):  # such as a name that is too long, or with a zero byte
            return None


def packed(path: Path) -> bytes:
    return gzip.compress(path.read_bytes(), LEVEL)
