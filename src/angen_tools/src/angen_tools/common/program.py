"""How the scripts start."""
from __future__ import annotations

import signal
from importlib import import_module


def run_main(module: str) -> None:
    """Runs main() of a module. Ctrl-C while the module is imported ends the process, and prints no
    traceback."""
    if signal.getsignal(signal.SIGINT) != signal.SIG_IGN:  # as in the background
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    import_module(module).main()
