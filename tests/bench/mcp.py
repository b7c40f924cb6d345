"""mcp.py BUILD ROUNDS MODEL...: the time of a call of /mcp beside that of /v1/render with the same scene: the least of each, in turns. Ends with 1
if a call takes more than 1.1 times as long, and 1 ms."""
import base64
import http.client
import json
import os
import re
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

    def run(path, headers, body):
        began = time.perf_counter()
        connection.request("POST", path, body, headers)
        answer = connection.getresponse()
        data = answer.read()
        assert answer.status == 200 and b'"isError":true' not in data, data[:500]
        return 1000 * (time.perf_counter() - began)

    print(f"{'model':24} {'views':>8} {'/v1/render':>11} {'/mcp':>9}  of 1.1 x + 1 ms")
    for model in models:
        for views in (None, ["front"], ["front", "top"]):
            plain, call = bodies(model, views)
            for _ in range(5):
                run(*plain), run(*call)
            times = [(run(*plain), run(*call)) for _ in range(rounds)]
            first, second = (min(column) for column in zip(*times))  # other programs only add
            share = second / (1.1 * first + 1)
            bad += share > 1
            print(f"{os.path.basename(model):24} {len(views) if views else 'sheet':>8} {first:8.2f} ms {second:6.2f} ms  {share:.2f}")
finally:
    daemon.terminate()
    daemon.wait()
sys.exit(bad > 0)
