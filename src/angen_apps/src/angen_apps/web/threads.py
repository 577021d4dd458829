"""Calls that wait, in threads that do not outlive the program: asyncio's own pool is waited for."""
from __future__ import annotations

import asyncio
import contextlib
import threading
from typing import Any, Callable


async def in_thread(call: Callable[..., Any], *arguments: Any) -> Any:
    """The result or exception of `call`."""
    loop = asyncio.get_running_loop()
    done: asyncio.Future[Any] = loop.create_future()

    def settle(result: Any, error: BaseException | None) -> None:
        if done.cancelled():
            return
        if error is not None:
            done.set_exception(error)
        else:
            done.set_result(result)

    def work() -> None:
        result, error = None, None
        try:
            result = call(*arguments)
        except Exception as failure:  # the awaiting task gets it
            error = failure
        with contextlib.suppress(RuntimeError):  # the loop has ended
            loop.call_soon_threadsafe(settle, result, error)

    threading.Thread(target=work, daemon=True).start()
    return await done
