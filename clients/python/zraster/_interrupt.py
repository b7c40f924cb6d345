"""Calls that Ctrl-C ends.

Python runs handlers of signals in the main thread, and only between its own instructions. So another thread makes a call of
the main thread, which waits in a lock: handlers interrupt that. If one raises, as that of Ctrl-C does, the call is cancelled,
and the exception passes on. It costs some 20 us.
"""
from __future__ import annotations

import _thread
import os
import threading
from typing import Any, Callable, List, Optional, Tuple

from ._renderer import Cancel

_END_MAX = 5.0  # seconds that a cancelled call has to end, usually in 10 ms


class _Worker:
    """A thread that makes one call at a time. It holds what the call borrows, until the call has ended."""

    def __init__(self) -> None:
        self.process = os.getpid()
        self.asked, self.done = _thread.allocate_lock(), _thread.allocate_lock()
        self.asked.acquire()
        self.done.acquire()
        self.call: Optional[Callable[[], Any]] = None
        self.result: Optional[Tuple[Any, Optional[BaseException]]] = None
        self.is_last = False
        _thread.start_new_thread(self._loop, ())

    def _loop(self) -> None:
        while not self.is_last:
            self.asked.acquire()
            call, self.call = self.call, None
            try:
                self.result = call(), None  # type: ignore[misc]
            except BaseException as error:
                self.result = None, error
            del call
            self.done.release()

    def run(self, call: Callable[[], Any], cancel: Cancel) -> Any:
        self.call = call
        try:
            self.asked.release()
            self.done.acquire()
        except BaseException:
            self.is_last = True
            cancel.cancel()
            if self.result is None:
                self.done.acquire(True, _END_MAX)
            raise
        (made, error), self.result = self.result, None  # type: ignore[misc]
        _idle.append(self)
        if error is None:
            return made
        try:
            raise error.with_traceback(None)  # its frames are not those of the caller
        finally:
            del error  # it holds this frame


_idle: List[_Worker] = []  # at most one, unless a handler of a signal draws, too


def run(call: Callable[[], Any], cancel: Cancel) -> Any:
    """Returns the result of a call, or raises its error, or that of a handler of a signal. cancel: ends the call."""
    if threading.current_thread() is not threading.main_thread():
        return call()
    worker = _idle.pop() if _idle else None
    if worker is None or worker.process != os.getpid():  # no thread of the parent is in a child
        try:
            worker = _Worker()
        except RuntimeError:  # there are no more threads, or the interpreter ends
            return call()
    return worker.run(call, cancel)
