"""The progress of a command, on stderr."""
import sys
import time
from typing import Any, Self

REFRESH = 0.1  # s of wall time between two pictures of the bar
SILENT = 10.0  # s of wall time between two lines


class Progress:
    """A bar in a terminal. Elsewhere a line whenever `every` more of the whole is done, or with 0
    at each update, or with None each 10 s. A context: its end removes the bar."""

    def __init__(self, what: str, every: float | None = None) -> None:
        self._what, self._every = what, every
        self._reported = -1
        self._shown = time.monotonic()
        self._bar: Any = None  # rich's
        if sys.stderr.isatty():
            from rich.progress import BarColumn
            from rich.progress import Progress as Bar
            from rich.progress import TaskProgressColumn, TextColumn

            from angen_tools.common.output import console
            self._bar = Bar(TextColumn('{task.description}', markup=False), BarColumn(),
                            TaskProgressColumn(), TextColumn('{task.fields[text]}', markup=False),
                            console=console(sys.stderr), transient=True, auto_refresh=False)
            self._task = self._bar.add_task(what, total=1.0, text='')
            self._bar.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def update(self, share: float, text: str = '') -> None:
        """`share` of the whole is done; `text`: the present step."""
        if self._bar is not None:
            self._bar.update(self._task, completed=share, text=text)
            if self._is_time(REFRESH):
                self._bar.refresh()
        elif self._is_due(share):
            print(f'angen: {self._what} {100 * share:3.0f} %  {text}'.rstrip(), file=sys.stderr,
                  flush=True)

    def _is_due(self, share: float) -> bool:
        if not self._every:
            return self._every is not None or self._is_time(SILENT)
        reached = int(share / self._every + 1e-9)
        due, self._reported = reached > self._reported, max(reached, self._reported)
        return due

    def _is_time(self, seconds: float) -> bool:
        """Whether the last picture or line is that old."""
        now = time.monotonic()
        due = now - self._shown > seconds
        self._shown = now if due else self._shown
        return due

    def note(self, line: str) -> None:
        """Prints a line that stays, above the bar."""
        self._shown = time.monotonic()
        if self._bar is not None:
            self._bar.console.print(f'angen: {line}')
        else:
            print(f'angen: {line}', file=sys.stderr, flush=True)

    def close(self) -> None:
        """Removes the bar."""
        if self._bar is not None:
            self._bar.stop()
            self._bar = None


class Steps:
    """The progress of a known number of steps; where stderr is not a terminal a line for each."""

    def __init__(self, count: int) -> None:
        self._count, self._begun = count, 0
        self._progress = Progress('bench', 0.0)

    def next(self, what: str) -> None:
        """The next step begins; `what` it is."""
        self._begun += 1
        self._progress.update((self._begun - 1) / self._count,
                              f'{self._begun}/{self._count}  {what}')

    def close(self) -> None:
        """Removes the bar."""
        self._progress.close()
