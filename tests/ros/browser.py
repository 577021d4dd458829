"""A browser without a window, for tests of the page of angen web."""
import os
import signal
import subprocess
from pathlib import Path
from typing import Any, Self

from harness import SLOWNESS, HasEnvironment, end, free_port, until
from selenium.common.exceptions import StaleElementReferenceException
from selenium.webdriver import Chrome
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains

ROOT = Path(__file__).resolve().parents[2]
SERVER = ROOT / 'src/angen_apps/scripts/web'
LIMIT = 180.0 * SLOWNESS  # s of wall time; the processor draws the page
OPTIONS = ('--headless=new', '--no-sandbox', '--disable-dev-shm-usage', '--no-first-run',
           '--enable-unsafe-swiftshader', '--use-angle=swiftshader', '--disable-extensions',
           '--disable-gpu-watchdog')  # it ends a renderer that waits for 10 s on a busy machine


class Server:
    """angen web beside a node."""

    program = [str(SERVER)]

    def __init__(self, master: HasEnvironment, folder: Path, *options: str) -> None:
        self.port = free_port()
        self.url = f'http://127.0.0.1:{self.port}/'
        self._log = folder / 'web.log'
        with self._log.open('w') as out:
            self.process = subprocess.Popen(
                ['/usr/bin/python3', '-u', *self.program, '--port', str(self.port), *options],
                env=master.environment, text=True, stdout=out, stderr=out)
        try:
            until(self._serves, 'the address', LIMIT)
        except BaseException:
            self.end()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        assert self.end() == 0, self.log()
        assert 'Traceback' not in self.log()

    def _serves(self) -> bool:
        assert self.process.poll() is None, self.log()
        return f':{self.port}/' in self.log()

    def log(self) -> str:
        return self._log.read_text()

    def end(self) -> int:
        return end(self.process, LIMIT)


class Page:
    """A page that is open."""

    def __init__(self, folder: Path, width: int, height: int, language: str = 'en') -> None:
        options = Options()
        for option in (*OPTIONS, f'--window-size={width},{height}',
                       f'--user-data-dir={folder / "chromium"}'):
            options.add_argument(option)
        options.set_capability('goog:loggingPrefs', {'browser': 'ALL'})
        options.add_experimental_option('prefs', {'intl.accept_languages': language})
        self.driver = Chrome(options=options, service=Service('/usr/bin/chromedriver'))
        self.driver.set_script_timeout(LIMIT)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        try:
            assert kind or self.errors() == []
        finally:
            self.close()

    def run(self, script: str, *arguments: Any) -> Any:
        return self.driver.execute_script(script, *arguments)

    def open(self, url: str) -> None:
        self.driver.get(url)
        self.until('return window.angen?.home.entities.length > 0 && !!window.angen.home.scene')

    def until(self, script: str, *arguments: Any) -> Any:
        """Returns the value of a script once it is true."""
        return until(lambda: self.run(script, *arguments), script, LIMIT)

    def first_view(self) -> None:
        """Returns when the whole home is drawn, and the camera rests."""
        self.until('return angen.view.framed && !angen.view.viewpoint.goal '
                   '&& angen.view.frames > 0')

    def click(self, x: float, y: float) -> None:
        """At a place of the window, as a mouse does."""
        actions = ActionChains(self.driver, duration=0)
        actions.w3c_actions.pointer_action.move_to_location(round(x), round(y))
        actions.w3c_actions.pointer_action.click()
        actions.perform()

    def press(self, selector: str, text: str = '') -> None:
        """The first element of a selector, with that text."""
        script = '''return [...document.querySelectorAll(arguments[0])].find(
            (e) => !e.disabled && (!arguments[1] || e.textContent.trim() === arguments[1]))'''

        def pressed() -> bool:
            element = self.run(script, selector, text)
            if element is None:
                return False
            try:
                self.run('arguments[0].scrollIntoView({block: "center"})', element)
                element.click()
            except StaleElementReferenceException:  # a panel was drawn again
                return False
            return True

        until(pressed, f'{selector} {text} is pressed', LIMIT)

    def text(self, selector: str) -> str:
        return str(self.run('return document.querySelector(arguments[0])?.textContent ?? ""',
                            selector))

    def errors(self) -> list[str]:
        """The errors of the page in the console."""
        return [entry['message'] for entry in self.driver.get_log('browser')
                if entry['level'] == 'SEVERE' and 'WebSocket connection' not in entry['message']]

    def close(self) -> None:
        process = self.driver.service.process
        self.driver.quit()
        if process.poll() is None:
            os.kill(process.pid, signal.SIGKILL)
