"""Models of millions of triangles and points: processor time and memory of one process each, beside F3D's.

large.py BUILD FOLDER [ROW...]: rows such as stl-10M:studio or cloud-5M:studio; without any, those of ROWS; growth: those of
GROWTH.
Memory is the peak of the resident set without the file, which is mapped. F3D runs on a display of its own.
"""
import os
import shutil
import sys
import time

from large_files import path_of

UNITS = {"k": 1000, "M": 1000000}
ROWS = ("stl-10M:studio", "stl-10M:textbook", "stl-30M:studio", "glb-10M:studio", "ply-10M:studio", "obj-10M:studio", "cloud-5M:studio", "cloud-5M:textbook",
        "cloud-50M:studio", "cloud-50M:textbook")
GROWTH = tuple(f"stl-{count}:{look}" for look in ("textbook", "studio", "clay", "metal", "technical") for count in ("1k", "10k", "100k", "1M", "10M"))
WITH_F3D = ("stl-10M:studio", "cloud-5M:studio")


def measure(command, out):
    """Runs a command. Returns its processor time and its wall time in seconds, and its peak memory in bytes."""
    began = time.perf_counter()
    process = os.posix_spawnp(command[0], command, os.environ, file_actions=[(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)])
    _, status, usage = os.wait4(process, 0)
    wall = time.perf_counter() - began
    if status != 0 or os.path.getsize(out) < 1000:
        sys.exit(f"{' '.join(command)}: status {status}")
    return usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss * 1024


def count_of(name):
    kind, number = name.split("-")
    return kind, int(number[:-1]) * UNITS[number[-1]]


def line(name, count, cpu, wall, peak):
    print(f"{name:28} {cpu:8.2f} s {wall:8.2f} s {peak * 1e-9:7.2f} GB {peak / count:7.0f} B {cpu * 1e9 / count:8.0f} ns", flush=True)


def main(build, folder, rows):
    print(f"{'':28} {'processor':>10} {'wall':>10} {'memory':>10} {'each':>9} {'each':>11}")
    for row in rows:
        name, look = row.split(":")
        kind, count = count_of(name)
        path, out = path_of(folder, kind, count), os.path.join(folder, "out.png")
        command = [os.path.join(build, "zraster"), path, "-o", out, "--look", look, "--size", "1024x768", "-q", "--plain"]
        cpu, wall, peak = min(measure(command, out) for _ in range(3 if count < 1000000 else 1))
        line(row, count, cpu, wall, peak - os.path.getsize(path))
        if row not in WITH_F3D:
            continue
        if not shutil.which("f3d") or not shutil.which("xvfb-run"):
            print(f"LEFT OUT: {row} by F3D: f3d and xvfb are missing")
            continue
        rival = ["xvfb-run", "-a", "f3d", path, "--output", out, "--resolution", "1024,768", "--ssao", "--fxaa", "--tone-mapping"]
        line("  F3D", count, *measure(rival, out))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], GROWTH if sys.argv[3:] == ["growth"] else sys.argv[3:] or ROWS)
