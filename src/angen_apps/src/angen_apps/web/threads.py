"""Calls that wait, in threads that do not outlive the program: asyncio's own pool is waited for."""
import asyncio
import threading
from concurrent.futures import Future
from typing import Any, Callable


async def in_thread(call: Callable[..., Any], *arguments: Any) -> Any:
    """The result or exception of `call`."""
    done: Future[Any] = Future()
    done.set_running_or_notify_cancel()  # who awaits it may be cancelled, the call continues

    def work() -> None:
        try:
            done.set_result(call(*arguments))
        except Exception as failure:  # the awaiting task gets it
            done.set_exception(failure)

    threading.Thread(target=work, daemon=True).start()
    return await asyncio.wrap_future(done)
