"""views.py BUILD MESH.obj: 36 views of a mesh in one request, beside VTK and three in Chromium, whose windows and scenes are
kept. All have one plain lit look, smooth normals, one sample a pixel and 512x512 pixels. Ours are PNGs in a ZIP over HTTP;
theirs are read back. Rounds are in turns. `make bench-views` installs and runs it; it leaves a picture of each in BUILD."""
import http.client
import http.server
import io
import os
import queue
import re
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import zipfile

from loading import mesh_of

ROUNDS, FRAMES, SIDE, MUST = int(os.environ.get("ROUNDS", 9)), 36, 512, 5
build, mesh = sys.argv[1:3]
here = os.path.dirname(os.path.abspath(__file__))
pictures = f"{build}/bench"
ENVIRONMENT = {**os.environ, "LP_NUM_THREADS": "2"}


class Ours:
    """The daemon, which gets the mesh with each request, or keeps it under its hash."""

    def __init__(self, folder, is_kept):
        command = [f"{build}/zrasterd", "--port", "0", "--threads", "2", "--assets-dir", folder]
        self.daemon = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        port = int(re.search(r":(\d+)$", self.daemon.stdout.readline().strip()).group(1))
        self.connection = http.client.HTTPConnection("127.0.0.1", port)
        self.body = open(mesh, "rb").read()
        self.type, self.query = "model/obj", f"?width={SIDE}&height={SIDE}&look=textbook&shading=gouraud&turntable={FRAMES}"
        if is_kept:
            hash_ = re.search(rb"[0-9a-f]{64}", self.ask("/v1/assets", self.body)).group(0).decode()
            text = (f'{{"window":{{"width":{SIDE},"height":{SIDE}}},"look":"textbook","turntable":{{"frames":{FRAMES}}},'
                    f'"meshes":[{{"asset":"sha256:{hash_}","shading":"gouraud"}}]}}')
            self.body, self.type, self.query = text.encode(), "application/json", ""

    def ask(self, path, body):
        self.connection.request("POST", path, body, {"Content-Type": self.type})
        answer = self.connection.getresponse()
        data = answer.read()
        assert answer.status in (200, 201), data[:400]
        return data

    def draw(self):
        begin = time.perf_counter()
        data = self.ask("/v1/render" + self.query, self.body)
        taken = 1000 * (time.perf_counter() - begin)
        names = zipfile.ZipFile(io.BytesIO(data)).namelist()
        assert len(names) == FRAMES, names
        with open(f"{pictures}/views-ours.png", "wb") as file:
            file.write(zipfile.ZipFile(io.BytesIO(data)).read(names[0]))
        return taken

    def close(self):
        self.daemon.terminate()
        self.daemon.wait()


class Vtk:
    def __init__(self):
        command = ["/usr/bin/python3", f"{here}/vtk_views.py", mesh, str(FRAMES), f"{pictures}/views-vtk.ppm"]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True, env=ENVIRONMENT)
        self.name = self.process.stdout.readline().strip()

    def draw(self):
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        return float(self.process.stdout.readline())

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class Three:
    """A page in Chromium that draws when it is asked."""

    def __init__(self, folder):
        points, corners = mesh_of(mesh)
        files = {"/": open(f"{here}/three_views.html", "rb").read(), "/points": points.tobytes(),
                 "/corners": corners.tobytes(), "/frames": str(FRAMES).encode()}
        self.turns, self.said = queue.Queue(), queue.Queue()
        rival = self

        class Handler(http.server.BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def answer(self, data, type_):
                self.send_response(200)
                self.send_header("Content-Type", type_)
                self.send_header("Content-Length", str(len(data)))
                self.end_headers()
                self.wfile.write(data)

            def do_GET(self):
                if self.path.startswith("/three/"):
                    name = os.path.basename(self.path)
                    with open(f"{build}/loaders/node_modules/three/build/{name}", "rb") as file:
                        return self.answer(file.read(), "text/javascript")
                if self.path == "/next":
                    rival.turns.get()
                self.answer(files.get(self.path, b""), "text/html" if self.path == "/" else "application/octet-stream")

            def do_POST(self):
                data = self.rfile.read(int(self.headers["Content-Length"]))
                self.answer(b"", "text/plain")
                if self.path != "/picture":
                    return rival.said.put(data.decode())
                rows = [data[4 * SIDE * y:4 * SIDE * (y + 1)] for y in reversed(range(SIDE))]
                rgb = b"".join(bytes(row[i] for i in range(len(row)) if i % 4 < 3) for row in rows)
                with open(f"{pictures}/views-three.ppm", "wb") as file:
                    file.write(b"P6 %d %d 255\n" % (SIDE, SIDE) + rgb)

            def log_message(self, *_):
                pass

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.server.daemon_threads = True
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        command = ["chromium", "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                   f"--user-data-dir={folder}/chromium", f"http://127.0.0.1:{self.server.server_port}/"]
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.name = self.said.get(timeout=120)

    def draw(self):
        self.turns.put(None)
        return float(self.said.get(timeout=600))

    def close(self):
        self.process.terminate()
        self.process.wait()


def print_row(name, ours, theirs):
    o, t = statistics.median(ours), statistics.median(theirs)
    mark = "ok" if t / o >= MUST else "SHORT"
    print(f"{name:<76}{o:9.1f}{t:10.1f}{t / o:8.1f}x{MUST:6.1f}x  {mark}")


def main():
    os.makedirs(pictures, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        sides = [Ours(folder, False), Ours(folder, True), Vtk(), Three(folder)]
        try:
            for side in sides:
                for _ in range(2):
                    side.draw()
            rounds = [[side.draw() for side in sides] for _ in range(ROUNDS)]
            print(f"{'36 views in one request, 512x512, 2 threads':<76}{'ours ms':>9}{'theirs ms':>10}{'ratio':>9}{'must':>7}")
            sent, kept, *theirs = zip(*rounds)
            for side, times in zip(sides[2:], theirs):
                print_row(f"mesh sent; {side.name[:60]}", sent, times)
                print_row(f"mesh by its hash; {side.name[:50]}", kept, times)
        finally:
            for side in sides:
                side.close()


if __name__ == "__main__":
    main()
