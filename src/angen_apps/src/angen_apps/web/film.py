"""angen web --video: the page at even simulated times, as a video."""
import asyncio
import json
import shutil
import subprocess
import threading
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Iterator

from angen_apps.web.chromium import Chromium, program
from angen_apps.web.guard import Guard
from angen_apps.web.played import Lined
from angen_apps.web.server import Server, listen
from angen_tools.common.clock import DAY, time_of_day
from angen_tools.common.failure import Failure
from angen_tools.common.files import check_output, writing
from angen_tools.common.port import free_port
from angen_tools.common.progress import Progress
from angen_tools.common.wait import wait

ENCODERS = {  # options of ffmpeg, by the ending of the file
    'mp4': ['-c:v', 'libx264', '-crf', '20', '-pix_fmt', 'yuv420p', '-movflags', '+faststart'],
    'webm': ['-c:v', 'libvpx-vp9', '-crf', '32', '-b:v', '0', '-pix_fmt', 'yuv420p',
             '-deadline', 'realtime', '-cpu-used', '5'],
    'gif': ['-filter_complex',
            'split[a][b];[a]palettegen=max_colors=96[p];[b][p]paletteuse=dither=none']}
RATE = {'gif': 10}  # frames per second, if they are others than USUAL
USUAL = 25
SHOWS = '''!!window.angen?.home.scene && angen.home.entities.length > 0
    && Object.keys(angen.home.kinds).length > 0 && !!angen.player.bar
    && angen.player.loaded >= angen.player.end'''
LIMIT = 180.0  # s of wall time, for the page to show a home
TURN = 0.1


@dataclass(frozen=True)
class Film:
    """What is filmed; `start` in s, or as a time of day; None: where the page begins to play."""

    path: Path
    start: str | float | None
    seconds: float  # length of the video
    speed: float | None  # simulated s per s
    size: tuple[int, int]
    view: str

    @property
    def rate(self) -> int:
        """Frames per second."""
        return RATE.get(self.kind, USUAL)

    @property
    def kind(self) -> str:
        return self.path.suffix[1:].lower()

    def check(self) -> None:
        """Failure if it cannot be made here."""
        if self.kind not in ENCODERS:
            raise Failure(f'--video {self.path}: its name must end with '
                          + ', '.join(f'.{kind}' for kind in ENCODERS))
        if not self.path.absolute().parent.is_dir():
            raise Failure(f'--video {self.path}: its folder cannot be written: it is missing')
        check_output(self.path)
        missing = [name for name, found in (('chromium', program()),
                                            ('ffmpeg', shutil.which('ffmpeg'))) if not found]
        if missing:
            raise Failure(f'--video needs {" and ".join(missing)}: '
                          f'sudo apt install {" ".join(missing)}')


def begin_of(film: Film, line: dict[str, Any], home: dict[str, Any]) -> float:
    """The time of the first frame, in s since the start of the recording."""
    if film.start is None:
        return float(line.get('begin', 0.0))
    if isinstance(film.start, float):
        return film.start
    clock = str(home.get('start') or '').partition('T')[2][:8]
    return (time_of_day(film.start) - (time_of_day(clock) if clock else 0.0)) % DAY


@contextmanager
def encoder(film: Film) -> Iterator[Callable[[bytes], None]]:
    """Takes PNG pictures for ffmpeg, which makes the file if no error ends this context."""
    with writing(film.path, binary=True) as file:
        process = subprocess.Popen(
            ['ffmpeg', '-loglevel', 'error', '-nostdin', '-y', '-f', 'image2pipe', '-c:v', 'png',
             '-framerate', str(film.rate), '-i', '-', *ENCODERS[film.kind], '-f', film.kind,
             f'/dev/fd/{file.fileno()}'], stdin=subprocess.PIPE, stderr=subprocess.PIPE,
            pass_fds=(file.fileno(),))
        assert process.stdin is not None

        def end() -> Failure:
            _, errors = process.communicate()
            lines = errors.decode(errors='replace').splitlines()
            return Failure(f'ffmpeg: {lines[-1] if lines else "it ended without a message"}')

        def put(picture: bytes) -> None:
            try:
                process.stdin.write(picture)  # type: ignore[union-attr]
            except BrokenPipeError:
                raise end() from None

        try:
            yield put
            failure = end()  # it has no more pictures to wait for
            if process.returncode:
                raise failure
        finally:
            if process.poll() is None:
                process.kill()
                process.communicate()


def serve(source: Lined, page: Path, kinds: dict[str, Any]) -> int:
    """Serves a source in a thread, until this process ends; returns its port."""
    port, ready = free_port(), threading.Event()

    async def started(_: int) -> None:
        ready.set()

    def work() -> None:
        server = Server(source, Guard('127.0.0.1', port, set()), page, kinds)
        asyncio.run(listen(server, '127.0.0.1', port, started))

    threading.Thread(target=work, daemon=True).start()
    wait(ready.is_set, 'the page is not served', LIMIT)
    return port


def shoot(source: Lined, film: Film, page: Path, kinds: dict[str, Any]) -> None:
    """Makes the file; prints what it is."""
    source.is_filmed = True
    with Progress('web', 0.1) as progress:
        while not source.is_whole():
            progress.update(source.share(), 'reads the recording' if source.is_past
                            else 'records the running building')
            threading.Event().wait(TURN)
        line, home = source.store.part('line'), source.store.part('home') or {}
        begin = begin_of(film, line, home)
        if begin >= line['end']:
            raise Failure(f'--start: the recording ends at {line["end"]:.1f} s')
        speed = film.speed or float(line.get('speed', 1.0))
        length = min(film.seconds, (line['end'] - begin) / speed)
        count = max(1, round(length * film.rate))
        with Chromium(*film.size) as chromium, encoder(film) as put:
            chromium.open(f'http://127.0.0.1:{serve(source, page, kinds)}/?quality=high')
            wait(lambda: bool(chromium.run(SHOWS)), 'the page does not show the home', LIMIT)
            words = f'angen, "{film.view}", {begin}, {json.dumps(source.is_past)}'
            chromium.run(f'import("/page/js/film.js").then((m) => m.begin({words}))')
            for k in range(count):
                chromium.run(f'angen.film({begin + k * speed / film.rate}, {1 / film.rate})')
                put(chromium.picture())
                progress.update((k + 1) / count, f'frame {k + 1} of {count}')
    print(f'{film.path}: {length:.1f} s from {begin:.1f} s on, {speed:g} times as fast, '
          f'{film.size[0]} x {film.size[1]}, {film.path.stat().st_size / 1e6:.2f} MB', flush=True)
