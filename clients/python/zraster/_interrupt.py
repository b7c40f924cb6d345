"""Calls that Ctrl-C ends.

Python runs handlers of signals in the main thread, and only between its own instructions. So another thread makes each
call of the main thread, which waits for a lock. Handlers interrupt this wait. If a handler raises, as that of Ctrl-C
does, the call is cancelled, and the exception passes on. This costs some 20 us per call.
"""
from __future__ import annotations

import _thread
import os
import threading
from queue import SimpleQueue
from typing import Any, Callable, List, Optional, Tuple

from ._renderer import Cancel

_END_MAX = 5.0  # seconds that a cancelled call has to end, usually in 10 ms


class _Call:
    """A call for a worker. It holds the arguments that the library borrows."""

    def __init__(self, function: Callable[[], Any]) -> None:
        self.function = function
        self.result: Optional[Tuple[Any, Optional[BaseException]]] = None
        self.done = _thread.allocate_lock()
        self.done.acquire()

    def make(self) -> None:
        try:
            self.result = self.function(), None
        except BaseException as error:
            self.result = None, error
        self.done.release()


class _Worker:
    """A thread that makes calls in order, until None. It ends with the last reference to this object, which an
    exception of a handler may drop anywhere."""

    def __init__(self) -> None:
        self.process = os.getpid()
        self.calls: SimpleQueue[Optional[_Call]] = SimpleQueue()
        _thread.start_new_thread(_make_all, (self.calls,))

    def __del__(self) -> None:
        if hasattr(self, "calls"):
            self.calls.put(None)


def _make_all(calls: SimpleQueue[Optional[_Call]]) -> None:
    call = calls.get()
    while call:
        call.make()
        call = None  # frees its arguments
        call = calls.get()


_idle: List[_Worker] = []  # at most one, unless a handler of a signal draws, too


def run(function: Callable[[], Any], cancel: Cancel) -> Any:
    """Returns the result of a call, or raises its error, or that of a handler of a signal. cancel: ends the call."""
    if threading.current_thread() is not threading.main_thread():
        return function()
    call = _Call(function)
    worker = _idle.pop() if _idle else None
    if worker is None or worker.process != os.getpid():  # no thread of the parent is in a child
        try:
            worker = _Worker()
        except RuntimeError:  # there are no more threads, or the interpreter ends
            return function()
    try:
        worker.calls.put(call)
        call.done.acquire()
    except BaseException:
        cancel.cancel()
        after = _Call(bool)  # does nothing, after the call has ended or if the worker did not get it
        worker.calls.put(after)
        worker.calls.put(None)
        after.done.acquire(True, _END_MAX)
        raise
    _idle.append(worker)
    (made, error), call.result = call.result, None  # type: ignore[misc]
    if error is None:
        return made
    try:
        raise error.with_traceback(None)  # its frames are not those of the caller
    finally:
        del error  # it holds this frame
