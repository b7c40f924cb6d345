"""compare.py BUILD MESH.obj: the look studio over HTTP, beside F3D (a process a picture) and VTK (its window kept), all with
antialiasing, occlusion and smooth normals, 512x512, in turns. Prints a row each: median milliseconds, and the ratio of
theirs to ours. What is not installed is left out, loudly. `make bench-rivals` installs and runs it."""
import http.client
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROUNDS = 9
build, mesh = sys.argv[1:3]
here = os.path.dirname(os.path.abspath(__file__))


def start_daemon():
    daemon = subprocess.Popen([f"{build}/zrasterd", "--port", "0", "--threads", "2"], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True)
    port = int(re.search(r":(\d+)$", daemon.stdout.readline().strip()).group(1))
    return daemon, http.client.HTTPConnection("127.0.0.1", port)


def ask_ours(connection, body):
    connection.request("POST", "/v1/render?width=512&height=512", body, {"Content-Type": "model/obj"})
    answer = connection.getresponse()
    answer.read()
    assert answer.status == 200, answer.status


def f3d_round(folder, path=mesh):
    command = ["f3d", path, "--output", f"{folder}/f3d.png", "--resolution", "512,512", "--ssao", "--fxaa",
               "--tone-mapping", "--no-background"]
    if shutil.which("xvfb-run") and not os.environ.get("DISPLAY"):
        sys.exit("DISPLAY is not set: this is to be run below xvfb-run")
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=120)
    assert os.path.getsize(f"{folder}/f3d.png") > 1000


def timed(work):
    begin = time.perf_counter()
    work()
    return 1000 * (time.perf_counter() - begin)


def row(name, ours, theirs, must, note):
    o, t = statistics.median(ours), statistics.median(theirs)
    mark = "ok" if t / o >= must else "SHORT"
    print(f"{name:<40}{o:9.1f}{t:10.1f}{t / o:8.1f}x{must:6.1f}x  {mark:<6}{note}")


def main():
    daemon, connection = start_daemon()
    body = open(mesh, "rb").read()
    try:
        with tempfile.TemporaryDirectory() as folder:
            print(f"{'studio, 512x512, over HTTP':<40}{'ours ms':>9}{'theirs ms':>10}{'ratio':>9}{'must':>7}")
            for _ in range(3):
                ask_ours(connection, body)
            if shutil.which("f3d"):
                version = subprocess.run(["f3d", "--version"], capture_output=True, text=True).stdout.split("\n")[0]
                f3d_round(folder)
                pairs = [(timed(lambda: ask_ours(connection, body)), timed(lambda: f3d_round(folder)))
                         for _ in range(ROUNDS)]
                row("F3D, a process a picture", *zip(*pairs), 12, f"{version} --ssao --fxaa --tone-mapping, Xvfb kept")
            else:
                print("LEFT OUT: F3D is not installed", file=sys.stderr)
            try:
                import vtk  # noqa: F401
            except ImportError:
                print("LEFT OUT: VTK for Python is not installed", file=sys.stderr)
                return
            theirs = subprocess.Popen([sys.executable, f"{here}/vtk_window.py", mesh], stdin=subprocess.PIPE,
                                      stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            version = theirs.stdout.readline().strip()

            def vtk_round():
                theirs.stdin.write("\n")
                theirs.stdin.flush()
                assert int(theirs.stdout.readline()) > 1000

            for _ in range(2):
                vtk_round()
            pairs = [(timed(lambda: ask_ours(connection, body)), timed(vtk_round)) for _ in range(ROUNDS)]
            theirs.stdin.close()
            theirs.wait()
            row("VTK, its window kept", *zip(*pairs), 2, f"{version}, SSAO, FXAA, normals split at 35 degrees")
    finally:
        daemon.terminate()
        daemon.wait()


if __name__ == "__main__":
    main()
