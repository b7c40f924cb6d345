"""agent_loop.py ZRASTER: an agent's loop with a script in the place of the model. It makes a flange, looks at it by `zraster mcp`,
finds by the picture that a hole is missing, mends the model, and looks again. Needs nothing but Python."""
import base64
import json
import math
import struct
import subprocess
import sys
import tempfile
import zlib

SIDE, THICK, RING, HOLE = 60.0, 6.0, 20.0, 4.0  # millimetres
META = {"io.modelcontextprotocol/protocolVersion": "2026-07-28", "io.modelcontextprotocol/clientCapabilities": {}}


# ---- the model that the agent makes ----


def flange(holes):
    """Returns a square plate with round holes on a ring, at these angles, as OBJ."""
    vertices, faces = [], []
    cells, step = 60, SIDE / 60
    inside = lambda x, y: all(math.hypot(x - RING * math.cos(a), y - RING * math.sin(a)) > HOLE for a in map(math.radians, holes))
    is_solid = lambda i, k: 0 <= i < cells and 0 <= k < cells and inside((i + 0.5) * step - SIDE / 2, (k + 0.5) * step - SIDE / 2)

    def quad(*corners):
        vertices.extend(corners)
        faces.append(range(len(vertices) - 3, len(vertices) + 1))

    for i in range(cells):
        for k in range(cells):
            if not is_solid(i, k):
                continue
            x0, y0 = i * step - SIDE / 2, k * step - SIDE / 2
            x1, y1 = x0 + step, y0 + step
            quad((x0, y0, THICK), (x1, y0, THICK), (x1, y1, THICK), (x0, y1, THICK))
            quad((x0, y1, 0), (x1, y1, 0), (x1, y0, 0), (x0, y0, 0))
            for di, dk, (a, b) in ((1, 0, ((x1, y0), (x1, y1))), (-1, 0, ((x0, y1), (x0, y0))), (0, 1, ((x1, y1), (x0, y1))), (0, -1, ((x0, y0), (x1, y0)))):
                if not is_solid(i + di, k + dk):
                    quad((*a, 0), (*b, 0), (*b, THICK), (*a, THICK))
    lines = [f"v {x:.6g} {y:.6g} {z:.6g}" for x, y, z in vertices] + ["f " + " ".join(map(str, face)) for face in faces]
    return "\n".join(lines) + "\n"


# ---- the tools ----


class Tools:
    def __init__(self, zraster, root):
        command = [zraster, "mcp", "--root", root]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.count = 0

    def call(self, name, **arguments):
        self.count += 1
        params = {"name": name, "arguments": arguments, "_meta": META}
        self.process.stdin.write(json.dumps({"jsonrpc": "2.0", "id": self.count, "method": "tools/call", "params": params}) + "\n")
        self.process.stdin.flush()
        result = json.loads(self.process.stdout.readline())["result"]
        if result["isError"]:
            raise RuntimeError(result["content"][0]["text"])
        return result

    def close(self):
        self.process.stdin.close()
        self.process.wait()


# ---- looking: what a model does with a picture ----


def read_png(data):
    """Returns width, and rows of RGB bytes of a PNG of 8 bits a channel, with or without a palette."""
    at, body, palette = 8, b"", None
    while at < len(data):
        size, kind = struct.unpack(">I", data[at : at + 4])[0], data[at + 4 : at + 8]
        chunk = data[at + 8 : at + 8 + size]
        at += 12 + size
        if kind == b"IHDR":
            width, _, _, color = struct.unpack(">2I2B", chunk[:10])
        palette = chunk if kind == b"PLTE" else palette
        body += chunk if kind == b"IDAT" else b""
    step, raw, rows = 1 if color == 3 else 3, zlib.decompress(body), []
    before = bytearray(width * step)
    for begin in range(0, len(raw), width * step + 1):
        row, way = bytearray(raw[begin + 1 : begin + 1 + width * step]), raw[begin]
        for i in range(len(row)):
            a, b, c = (row[i - step] if i >= step else 0), before[i], (before[i - step] if i >= step else 0)
            paeth = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[way]) & 255
        rows.append(row)
        before = row
    if palette:
        rows = [b"".join(palette[3 * p : 3 * p + 3] for p in row) for row in rows]
    return width, rows


def count_islands(width, rows):
    """Returns the middles of the background's islands that do not touch the border."""
    height, paper = len(rows), bytes(rows[0][:3])
    left = {(x, y) for y in range(height) for x in range(width) if bytes(rows[y][3 * x : 3 * x + 3]) == paper}
    islands = []
    while left:
        todo = [left.pop()]
        cells = []
        while todo:
            x, y = todo.pop()
            cells.append((x, y))
            for near in ((x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)):
                if near in left:
                    left.remove(near)
                    todo.append(near)
        if all(0 < x < width - 1 and 0 < y < height - 1 for x, y in cells):
            islands.append((sum(x for x, _ in cells) / len(cells), sum(y for _, y in cells) / len(cells)))
    return islands


# ---- the loop ----


def main(zraster):
    holes = [45, 135, 225]  # the error: the hole at 315 degrees was forgotten
    with tempfile.TemporaryDirectory() as root:
        tools = Tools(zraster, root)
        for attempt in range(1, 4):
            with open(root + "/flange.obj", "w") as file:
                file.write(flange(holes))
            model = {"model": {"path": "flange.obj"}, "up": "z"}
            facts = tools.call("facts", **model)["structuredContent"]
            assert facts["box"]["size"] == [SIDE, SIDE, THICK] and facts["closed"], facts
            print(f"attempt {attempt}: box {facts['box']['size']} and closed, as it should be; volume {facts['volume']:.6g}")
            view = {**model, "views": ["top"], "look": "textbook", "width": 300, "height": 300}
            seen = tools.call("render", **view)
            print("looks at:", seen["content"][1]["text"].replace("\n", " "))
            image = next(block for block in seen["content"] if block["type"] == "image")
            islands = count_islands(*read_png(base64.b64decode(image["data"])))
            if len(islands) == 4:
                print(f"sees 4 holes: done after {attempt} attempts")
                break
            scale = seen["structuredContent"]["views"][0]["unitsPerPixel"]
            found = {round(math.degrees(math.atan2(150 - y, x - 150)) / 45) * 45 % 360 for x, y in islands}
            missing = min({45, 135, 225, 315} - found)
            x = round(150 + RING / scale * math.cos(math.radians(missing)))
            y = round(150 - RING / scale * math.sin(math.radians(missing)))
            picked = tools.call("pick", **view, x=x, y=y)["structuredContent"]["fragments"][0]
            print(f"sees {len(islands)} holes; at pixel ({x}, {y}), where one should be, is {picked['part']} at {picked['point']}: mends it")
            holes.append(missing)
        else:
            sys.exit("the error was not found")
        tools.close()


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "zraster")
