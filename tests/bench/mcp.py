"""mcp.py BUILD ROUNDS MODEL...: the time of a call of /mcp beside that of /v1/render with the same scene, in turns: the least of each, and
the median of the daemon's processor time, which other programs hardly change. Ends with 1 if that is more than 1.1 times as much and 1 ms."""
import base64
import glob
import http.client
import json
import os
import re
import statistics
import subprocess
import sys
import time

build, rounds, models = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
outputs = [{"channel": "color", "encoding": "png"}, {"channel": "info"}]


def bodies(path, views):
    """Returns the two requests for a picture: path, headers, body."""
    with open(path, "rb") as file:
        model = file.read()
    scene = {
        "outputs": outputs, "meshes": [{"asset": "model"}], "window": {"width": 640, "height": 480}, "look": "studio", "up": "y",
        "view": {"preset": "isometric", "orthographic": {}}, **({"views": views} if views else {"sheet": "balanced", "window": {"width": 1024, "height": 768}}),
    }
    parts = b"".join(b'--b\r\nContent-Disposition: form-data; name="%s"\r\n\r\n%s\r\n' % part for part in ((b"scene", json.dumps(scene).encode()), (b"model", model)))
    arguments = {"model": {"base64": base64.b64encode(model).decode()}, **({"views": views, "width": 640, "height": 480} if views else {})}
    call = {"jsonrpc": "2.0", "id": 1, "method": "tools/call", "params": {"name": "render", "arguments": arguments}}
    return (
        ("/v1/render", {"Content-Type": "multipart/form-data; boundary=b"}, parts + b"--b--\r\n"),
        ("/mcp", {"Content-Type": "application/json"}, json.dumps(call).encode()),
    )


daemon = subprocess.Popen([os.path.join(build, "zrasterd"), "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
bad = 0
try:
    host = re.search(r"http://(\S+)", daemon.stdout.readline()).group(1)
    connection = http.client.HTTPConnection(host)

    def spent():
        """Returns the processor time of the daemon's threads, in ms."""
        total = 0
        for path in glob.glob(f"/proc/{daemon.pid}/task/*/schedstat"):
            with open(path) as file:
                total += int(file.read().split()[0])
        return total / 1e6

    def run(path, headers, body):
        before, began = spent(), time.perf_counter()
        connection.request("POST", path, body, headers)
        answer = connection.getresponse()
        data = answer.read()
        assert answer.status == 200 and b'"isError":true' not in data, data[:500]
        return 1000 * (time.perf_counter() - began), spent() - before

    print(f"{'model':20} {'views':>6} | least time: {'/v1/render':>10} {'/mcp':>9} | processor: {'/v1/render':>10} {'/mcp':>9}  of 1.1 x + 1 ms")
    for model in models:
        for views in (None, ["front"], ["front", "top"]):
            plain, call = bodies(model, views)
            for _ in range(5):
                run(*plain), run(*call)
            pairs = [(run(*plain), run(*call)) for _ in range(rounds)]
            least = [min(pair[k][0] for pair in pairs) for k in (0, 1)]
            work = [statistics.median(pair[k][1] for pair in pairs) for k in (0, 1)]
            share = work[1] / (1.1 * work[0] + 1)
            bad += share > 1
            name = os.path.basename(model)
            print(f"{name:20} {len(views) if views else 'sheet':>6} | {least[0]:20.2f} ms {least[1]:6.2f} ms | {work[0]:18.2f} ms {work[1]:6.2f} ms  {share:.2f}")
finally:
    daemon.terminate()
    daemon.wait()
sys.exit(bad > 0)
