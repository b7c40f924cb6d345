"""Interrupts: Ctrl-C, and other handlers of signals that raise."""
import _thread
import os
import random
import signal
import subprocess
import sys
import time
import unittest

import support
import zraster
from support import OBJ
from zraster import _interrupt, _library

PLACES = (
    "line" if sys.version_info[:2] == (3, 12) else "opcode"
)  # early versions of 3.12 have no events of instructions


class Interrupts(unittest.TestCase):
    def test_keyboard(self):
        """Ctrl-C ends a drawing at once, and the next call, one of a child too, draws"""
        code = (
            "import os, signal, support, time, zraster\n"
            "signal.signal(signal.SIGINT, signal.default_int_handler)\n"  # background jobs of a shell ignore it
            "wanted = zraster.render(support.OBJ).content\n"
            "def end():\n"
            "    print('drawing', flush=True)\n"
            "    try:\n"
            "        zraster.Scene(support.slow()).render()\n"
            "    except KeyboardInterrupt:\n"
            "        print(time.monotonic(), flush=True)\n"
            "    assert zraster.render(support.OBJ).content == wanted\n"
            "end()\n"
            "child = os.fork()\n"
            "if child == 0:\n"
            "    end()\n"
            "    os._exit(7)\n"
            "signal.signal(signal.SIGINT, signal.SIG_IGN)\n"
            "assert os.waitpid(child, 0)[1] == 7 << 8\n"
        )
        command = [sys.executable, "-c", code]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True) as process:
            for _ in range(2):
                self.assertEqual(process.stdout.readline(), "drawing\n")
                time.sleep(0.3)
                sent = time.monotonic()
                os.killpg(process.pid, signal.SIGINT)
                self.assertLess(float(process.stdout.readline()) - sent, 1)
        self.assertEqual(process.returncode, 0)

    def test_handlers(self):
        """a handler that raises ends a drawing, one that draws or returns does not; a given cancel is raised"""
        cancel = zraster.Cancel()
        drawn = []

        def handle(*_):
            drawn.append(zraster.render(OBJ, size=16).content)
            if len(drawn) == 2:
                raise TimeoutError("too long")
            signal.setitimer(signal.ITIMER_REAL, 0.1)

        before = signal.signal(signal.SIGALRM, handle)
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        began = time.monotonic()
        try:
            with self.assertRaisesRegex(TimeoutError, "too long"):
                zraster.render(support.slow(), cancel=cancel)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)
        self.assertLess(time.monotonic() - began, 2)
        self.assertEqual(drawn, [zraster.render(OBJ, size=16).content] * 2)
        with self.assertRaises(zraster.Cancelled):
            zraster.render(OBJ, cancel=cancel)


class Leftovers(unittest.TestCase):
    """An interrupt may come anywhere in a drawing. It leaves no thread, and no complaint of a destructor."""

    def setUp(self):
        zraster.render(OBJ, size=8)
        self.threads = _thread._count()
        self.is_due = False
        self.complaints = []
        self.addCleanup(setattr, sys, "unraisablehook", sys.unraisablehook)
        # Exceptions hold the frames of interrupted calls, and these hold threads, so their types are kept alone.
        sys.unraisablehook = lambda found: self.complaints.append(found.exc_type)

    def interrupt(self, *_):
        if self.is_due:
            self.is_due = False
            raise TimeoutError

    def is_interrupted(self, call):
        try:
            self.is_due = True
            call()
            self.is_due = False
        except TimeoutError:
            return True
        return False

    def count_threads(self):
        end = time.monotonic() + 5
        while _thread._count() > self.threads and time.monotonic() < end:
            time.sleep(0.001)
        return _thread._count()

    def draw_until(self, count):
        """Draws, and raises before the instruction `count` of the hand-over to another thread."""
        functions = (_interrupt.run, _interrupt._Call.__init__, _interrupt._Worker.__init__, _library.Handle.__init__)
        codes = [function.__code__ for function in functions]
        left = count

        def step(frame, event, _):
            nonlocal left
            if frame.f_code not in codes:
                return None
            frame.f_trace_opcodes = True
            left -= event == PLACES
            if left < 0:
                self.interrupt()
            return step

        sys.settrace(step)
        try:
            zraster.render(OBJ, size=8)
        finally:
            sys.settrace(None)

    def test_exit(self):
        """the end of the interpreter is silent"""
        code = "import sys, support, zraster; sys.kept = zraster._interrupt; zraster.render(support.OBJ, size=8)"
        ended = subprocess.run([sys.executable, "-c", code], stderr=subprocess.PIPE)
        self.assertEqual((ended.returncode, ended.stderr), (0, b""))

    def test_everywhere(self):
        """an interrupt before each instruction of the hand-over leaves no thread, and ends the call at once"""
        count = 0
        while True:
            began = time.monotonic()
            if not self.is_interrupted(lambda: self.draw_until(count)):
                break
            self.assertLess(time.monotonic() - began, 2)
            count += 1
        self.assertGreater(count, 15)
        self.assertLessEqual(self.count_threads(), self.threads)
        self.assertEqual(self.complaints, [])

    def test_often(self):
        """interrupts of tiny drawings, for a second, leave no thread"""
        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, self.interrupt))
        self.addCleanup(signal.setitimer, signal.ITIMER_REAL, 0)
        count, end = 0, time.monotonic() + 1
        while time.monotonic() < end:
            signal.setitimer(signal.ITIMER_REAL, random.uniform(2e-5, 1e-3))
            count += self.is_interrupted(lambda: zraster.render(OBJ, size=8))
        self.assertGreater(count, 50)
        self.assertLessEqual(self.count_threads(), self.threads)
        # Python itself reports an exception of a handler if a destructor runs at that moment.
        self.assertLessEqual(set(self.complaints), {TimeoutError})
