"""Requests to a proxy over persistent connections while replicas end and start. Each answer is compared with that of a
daemon alone."""
import hashlib
import http.client
import itertools
import json
import threading
import time

SCENE = {"window": {"width": 64, "height": 48}}
JSON = {"Content-Type": "application/json"}


def scenes(count=24):
    """Returns bodies whose pictures differ."""
    for i in range(count):
        color = "#%02x%02x40" % (40 + i * 8, 255 - i * 10)
        yield json.dumps({**SCENE, "polygons": [{"vertices": [[0, 0, 0], [1 + i / 8, 0, 0], [0, 1, 0]], "color": color}]}).encode()


def other_text(body, number):
    """Returns the scene with white space behind it that differs for each number: the same picture by another text."""
    return body + "".join("\t" if number >> bit & 1 else " " for bit in range(24)).encode()


def ask(port, method, path, body=None, headers=None, source="127.0.0.1"):
    """Returns status, headers and bytes over a connection of its own."""
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=90, source_address=(source, 0))
    try:
        connection.request(method, path, body, headers or {})
        answer = connection.getresponse()
        return answer.status, answer.headers, answer.read()
    finally:
        connection.close()


class Load:
    """A number of requests by several clients, or those of the time until stop(): three renders of four, and assets, a schema
    and the looks."""

    PATHS = ("/v1/scene.schema.json", "/v1/looks")

    def __init__(self, port, replica, count=1 << 22, clients=12):
        self.port, self.count, self.clients = port, count, clients
        self.lock = threading.Lock()
        self.done, self.failed, self.others, self.faults = 0, 0, 0, []
        self.slowest = 0.0
        self.numbers = itertools.count()
        self.requests = []
        asset = b"solid of the fleet" * 1000
        path = "/v1/assets/" + hashlib.sha256(asset).hexdigest()
        assert ask(replica.port, "PUT", path, asset)[0] in (200, 201, 204)
        bodies = list(scenes())
        for i, body in enumerate(bodies):
            self.requests.append(("POST", "/v1/render", body))
            if i % 3 == 2:
                self.requests.append(("GET", (path, *self.PATHS)[i // 3 % 3], None))
        self.answers = []
        for method, target, body in self.requests:
            status, _, data = ask(replica.port, method, target, body, JSON)
            assert status == 200, (target, status, data)
            self.answers.append(data)

    def client(self):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=90)
        while (number := next(self.numbers)) < self.count:
            index = number % len(self.requests)
            method, path, body = self.requests[index]
            began = time.monotonic()
            try:
                connection.request(method, path, body and other_text(body, number), JSON)
                answer = connection.getresponse()
                status, data = answer.status, answer.read()
                fault = "" if status == 200 else f"{status} {data[:200]!r}"
            except (OSError, http.client.HTTPException) as error:
                data, fault = None, repr(error)
                connection.close()
            took = time.monotonic() - began
            with self.lock:
                self.done += 1
                self.slowest = max(self.slowest, took)
                if fault:
                    self.failed += 1
                    self.faults.append(f"{method} {path}: {fault}")
                elif data != self.answers[index]:
                    self.others += 1
        connection.close()

    def start(self):
        self.began = time.monotonic()
        self.threads = [threading.Thread(target=self.client) for _ in range(self.clients)]
        for thread in self.threads:
            thread.start()
        return self

    def runs(self):
        return any(thread.is_alive() for thread in self.threads)

    def stop(self):
        self.count = 0
        return self.join()

    def join(self):
        for thread in self.threads:
            thread.join()
        self.seconds = time.monotonic() - self.began
        return self

    def text(self):
        faults = f" ({self.faults[0]})" if self.faults else ""
        return (f"{self.done} requests, {self.failed} failed{faults}, {self.others} with other bytes, "
                f"{self.done / self.seconds:.0f}/s, the slowest {self.slowest * 1000:.0f} ms")
