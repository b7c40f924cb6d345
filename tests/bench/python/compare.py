"""compare.py BUILD MESH: cost of the Python package beside libzraster's calls in C, and gain by a second thread of Python.
Both draw in turns; a row has the medians of the rounds. `make bench-python` runs it. With one thread, the ratio is that of
processor times, which other programs of the machine disturb less than the clock. Two threads are measured by the clock,
beside two processes in C, whose gain is the bound at that moment.
"""
import os
import statistics
import subprocess
import sys
import threading
import time

build, mesh = os.path.abspath(sys.argv[1]), sys.argv[2]
rounds = int(os.environ.get("ROUNDS", 31))
os.environ["ZRASTER_LIBRARY"] = os.path.join(build, "libzraster.so.0")
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../clients/python"))
sys.dont_write_bytecode = True
import zraster  # noqa: E402

with open(mesh, "rb") as file:
    body = file.read()


class Program:
    """The C program, which draws as often as it is asked."""

    def __init__(self, look, threads):
        query = f"look={look}&width=512&height=512"
        command = [os.path.join(build, "tests/bench/alone/library_draw"), mesh, query, str(threads)]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def draw(self, count):
        self.process.stdin.write(f"{count}\n")
        self.process.stdin.flush()
        return [int(time) / count / 1e6 for time in self.process.stdout.readline().split()]

    def end(self):
        self.process.stdin.close()
        self.process.wait()


def draw(look, renderer, count):
    """Returns milliseconds per picture, by the clock and of processors."""
    began, used = time.perf_counter_ns(), time.process_time_ns()
    for _ in range(count):
        zraster.render(body, look=look, size=512, renderer=renderer).content
    return [passed / count / 1e6 for passed in (time.perf_counter_ns() - began, time.process_time_ns() - used)]


def row(name, first, second, ratio, bar, is_met):
    print(
        f"{name:28} {first:22} {second:26} ratio {ratio:.3f}   (bar {bar})   {'ok' if is_met else 'SHORT'}", flush=True
    )


def beside_c(look, count):
    program, renderer = Program(look, 1), zraster.Renderer(threads=1)
    program.draw(count), draw(look, renderer, count)
    turns = [(*program.draw(count), *draw(look, renderer, count)) for _ in range(rounds)]
    program.end()
    by_clock, by_cpu = (statistics.median(turn[i + 2] / turn[i] for turn in turns) for i in (0, 1))
    c, python = (statistics.median(turn[i] for turn in turns) for i in (1, 3))
    row(f"{look}, Python beside C", f"C {c:.3f} ms", f"Python {python:.3f} ms", by_cpu, 1.03, by_cpu <= 1.03)
    print(f"{'':28} by the clock: ratio {by_clock:.3f}", flush=True)


def two_threads(look, count):
    """Threads of Python, each with a renderer of one thread."""
    renderers = [zraster.Renderer(threads=1) for _ in range(2)]
    programs = [Program(look, 1) for _ in range(2)]

    def at_once(work, workers):
        """Returns milliseconds per picture of two workers."""
        threads = [threading.Thread(target=work, args=(worker,)) for worker in workers]
        began = time.perf_counter_ns()
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        return (time.perf_counter_ns() - began) / count / 2 / 1e6

    def turn():
        one = draw(look, renderers[0], count)[0]
        two = at_once(lambda renderer: draw(look, renderer, count), renderers)
        return one, two, at_once(lambda program: program.draw(count), programs)

    turn()
    turns = [turn() for _ in range(rounds)]
    for program in programs:
        program.end()
    gain, bound = (statistics.median(one / times[i] for one, *times in turns) for i in (0, 1))
    one, two = (statistics.median(times[i] for times in turns) for i in (0, 1))
    row(f"{look}, two Python threads", f"1 thread {one:.3f} ms", f"2 threads {two:.3f} ms", gain, 1.7, gain >= 1.7)
    print(f"{'':28} two processes in C: ratio {bound:.3f}", flush=True)


print(f"{os.path.basename(mesh)}, 512x512, {rounds} rounds in turns; milliseconds per picture, from bytes to PNG")
beside_c("textbook", 8)
beside_c("studio", 2)
two_threads("textbook", 8)
two_threads("studio", 2)
