"""A browser without a window, moved through its pipe: it listens on no port, and ends with us."""
import base64
import fcntl
import json
import os
import select
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any, Self

from angen_tools.common.failure import Failure

PROGRAMS = ('chromium', 'google-chrome')
OPTIONS = ('--headless=new', '--disable-dev-shm-usage', '--no-first-run', '--disable-extensions',
           '--enable-unsafe-swiftshader', '--use-angle=swiftshader', '--disable-gpu-watchdog',
           '--hide-scrollbars', '--remote-debugging-pipe')  # drawn by the processor: alike anywhere
PIPES = 'exec "$0" "$@" 3<&{read} 4>&{write} {read}<&- {write}>&-'
LIMIT = 180.0  # s of wall time, for one answer
END = 10.0


def program() -> str | None:
    """The browser of this machine, if there is one."""
    return next(filter(None, map(shutil.which, PROGRAMS)), None)


def pipe() -> list[int]:
    """Its ends, of numbers that the browser does not use itself."""
    ends = os.pipe()
    high = [fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, 10) for end in ends]
    for end in ends:
        os.close(end)
    return high


class Chromium:
    """One page. A context: its end ends the browser."""

    def __init__(self, width: int, height: int) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix='angen_chromium_',
                                                   ignore_cleanup_errors=True)
        self._buffer = b''
        self._last = 0
        self._session: dict[str, str] = {}
        (read, self._write), (self._read, write) = pipe(), pipe()
        words = [*OPTIONS, f'--user-data-dir={self._folder.name}',
                 *(['--no-sandbox'] if os.geteuid() == 0 else [])]
        with (Path(self._folder.name) / 'log').open('wb') as log:
            self._process = subprocess.Popen(
                ['bash', '-c', PIPES.format(read=read, write=write), program() or 'chromium',
                 *words], pass_fds=(read, write), stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                start_new_session=True)
        os.close(read)
        os.close(write)
        try:
            target = self._call('Target.createTarget', url='about:blank')['targetId']
            self._session = {'sessionId': self._call('Target.attachToTarget', targetId=target,
                                                     flatten=True)['sessionId']}
            self._call('Emulation.setDeviceMetricsOverride', width=width, height=height,
                       deviceScaleFactor=1, mobile=False)
        except BaseException:
            self.__exit__()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        os.close(self._write)  # it ends by itself when its pipe is closed
        os.close(self._read)
        try:
            self._process.wait(END)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._folder.cleanup()

    def open(self, url: str) -> None:
        self._call('Page.navigate', url=url)

    def run(self, script: str) -> Any:
        """The value of an expression, or of its promise."""
        answer = self._call('Runtime.evaluate', expression=script, awaitPromise=True,
                            returnByValue=True)
        if 'exceptionDetails' in answer:
            about = answer['exceptionDetails']
            raise Failure(f'the page failed: {about.get("exception", about).get("description")}')
        return answer['result'].get('value')

    def picture(self) -> bytes:
        """The page as PNG."""
        answer = self._call('Page.captureScreenshot', format='png', optimizeForSpeed=True)
        return base64.b64decode(answer['data'])

    def _call(self, method: str, **params: Any) -> dict[str, Any]:
        self._last += 1
        text = json.dumps({'id': self._last, 'method': method, 'params': params, **self._session})
        try:
            data = text.encode() + b'\0'
            while data:
                data = data[os.write(self._write, data):]
        except BrokenPipeError:
            raise self._ended() from None
        end = time.monotonic() + LIMIT
        while True:
            message = self._receive(end, method)
            if message.get('id') == self._last:
                break
        if 'error' in message:
            raise Failure(f'chromium: {method}: {message["error"]["message"]}')
        result: dict[str, Any] = message['result']
        return result

    def _receive(self, end: float, method: str) -> dict[str, Any]:
        while b'\0' not in self._buffer:
            if not select.select([self._read], [], [], max(0.0, end - time.monotonic()))[0]:
                raise Failure(f'chromium has not answered {method} within {LIMIT:g} s')
            part = os.read(self._read, 1 << 20)
            if not part:
                raise self._ended()
            self._buffer += part
        text, self._buffer = self._buffer.split(b'\0', 1)
        message: dict[str, Any] = json.loads(text)
        return message

    def _ended(self) -> Failure:
        lines = (Path(self._folder.name) / 'log').read_text(errors='replace').splitlines()
        return Failure(f'chromium has ended: {lines[-1] if lines else "without a message"}')
