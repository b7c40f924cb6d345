"""fleet.py BUILD [--requests N] [--only NAME]: two replicas behind HAProxy, nginx and Varnish with the files of server/deploy:
replicas that end under load, rolling restarts, caches, large bodies, slow clients, overload. Prints figures and TAP.
FLEET_ROOT=DIR: the proxies of another root, such as one of Debian 13."""
import argparse
import hashlib
import http.client
import os
import signal
import socket
import sys
import threading
import time

from load import JSON, Load, ask, other_text, scenes
from services import PROXIES, Folder, Replica, fill, wait_for

LARGE = 20 << 20
DELAY = ("--drain-delay-ms", "2000")  # that of compose.yaml


class Fleet:
    """Two replicas that share a folder of assets, and a proxy before them."""

    def __init__(self, build, kind, *flags, edits=()):
        self.folder = Folder()
        assets = os.path.join(self.folder.host, "assets")
        os.mkdir(assets)
        common = ("--assets-dir", assets, "--trusted-proxies", "127.0.0.1", "--workers", "4", *flags)
        self.replicas = [Replica(build, self.folder, i, *common) for i in (1, 2)]
        self.proxy = kind(self.replicas, edits)

    def __enter__(self):
        try:
            for part in (*self.replicas, self.proxy):
                part.start()
        except RuntimeError:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        self.proxy.stop()
        for replica in self.replicas:
            replica.stop()
        self.folder.remove()

    def ask(self, *arguments, **more):
        return ask(self.proxy.port, *arguments, **more)

    def count(self, text):
        return sum(replica.count(text) for replica in self.replicas)


def replace(fleet, number, how, down=0.2):
    """Ends a replica, starts it again, and lets the proxy find it."""
    replica = fleet.replicas[number]
    status = replica.end(how)
    assert how == signal.SIGKILL or status == 0, status
    time.sleep(down)
    replica.start()
    time.sleep(fleet.proxy.settle)


def once_under_load(fleet):
    """Kills a replica and starts it again, then terminates the other one, while requests come."""
    load = Load(fleet.proxy.port, fleet.replicas[0], clients=4).start()
    time.sleep(0.1)
    replace(fleet, 0, signal.SIGKILL)
    fleet.replicas[1].end()
    time.sleep(0.3)
    load.stop()
    fleet.replicas[1].start()
    return load.done > 100 and load.failed == 0 and load.others == 0, load.text()


def under_load(fleet, count, ends):
    """Ends replicas in turns, by the signals in turns, until so many requests are answered."""
    load = Load(fleet.proxy.port, fleet.replicas[0], count).start()
    ended = 0
    while load.runs():
        replace(fleet, ended % 2, ends[ended // 2 % len(ends)])
        ended += 1
    load.join()
    return load.done == count and load.failed == 0 and load.others == 0, f"{load.text()}; {ended} replicas ended"


def revalidated(fleet):
    """An asset that is kept for a second, by a changed file: after it, the replica answers 304, and clients get the bytes."""
    data = os.urandom(100000)
    path = "/v1/assets/" + hashlib.sha256(data).hexdigest()
    fleet.ask("PUT", path, data)
    answers = []
    for _ in range(3):
        answers.append(fleet.ask("GET", path))
        time.sleep(2.1)  # nginx counts in whole seconds
    whole, not_modified = (fleet.count(f'"method":"GET".*"path":"{path}".*"status":{status}') for status in (200, 304))
    return all(a[::2] == (200, data) for a in answers) and (whole, not_modified) == (1, 2), f"3 requests: {whole} by the replica, {not_modified} revalidated"


def cached(fleet):
    """An asset, and a picture with an address, are asked of a replica once."""
    data = os.urandom(100000)
    asset, scene = "/v1/assets/" + hashlib.sha256(data).hexdigest(), b'{"look": "studio@1", ' + next(scenes())[1:]
    address = "/v1/renders/" + hashlib.sha256(scene).hexdigest()
    good, texts = True, []
    fleet.ask("PUT", asset, data)
    fleet.ask("PUT", address.replace("renders", "scenes"), scene)
    picture = ask(fleet.replicas[0].port, "POST", "/v1/render", scene, JSON)[2]
    before = fleet.count(f'"path":"{address}"')
    for path, wanted in ((asset, data), (address, picture)):
        answers = [fleet.ask("GET", path) for _ in range(50)]
        wait_for(lambda path=path: fleet.count(f'"method":"GET".*"path":"{path}"') > 0)  # logs come later
        asked = fleet.count(f'"method":"GET".*"path":"{path}"')
        hits = sum(headers["X-Cache"] == "HIT" for _, headers, _ in answers)
        not_modified = fleet.ask("GET", path, headers={"If-None-Match": answers[0][1]["ETag"]})[0]
        good &= all(a[::2] == (200, wanted) for a in answers) and (asked, hits, not_modified) == (1, 49, 304)
        texts.append(f"50 requests of {path[:12]}: {asked} reached a replica, {hits} hits, {not_modified} for the ETag")
    return good and before == 0, "; ".join(texts)


def named(fleet):
    """A replica hears the client's address from the proxy, and none that the client makes up."""
    forged = {"X-Forwarded-For": "192.0.2.1", "Forwarded": "for=192.0.2.1"}
    status = fleet.ask("GET", "/healthz?named", headers=forged, source="127.0.0.8")[0]
    wait_for(lambda: fleet.count("/healthz.*named") > 0)  # logs come later
    right, wrong = (fleet.count(f'"client":"{address}"') for address in ("127.0.0.8", "192.0.2.1"))
    return (status, right, wrong) == (200, 1, 0), f"{right} line of the log has the client's address, {wrong} the forged one"


def large_body(fleet):
    """20 MB as an asset, and as a scene."""
    data = os.urandom(LARGE)
    path = "/v1/assets/" + hashlib.sha256(data).hexdigest()
    stored = fleet.ask("PUT", path, data)[0]
    status, _, got = fleet.ask("GET", path)
    body = next(scenes())
    padded = body[:-1] + b" " * (LARGE - len(body)) + b"}"
    drawn = fleet.ask("POST", "/v1/render", padded, JSON)
    same = drawn[2] == ask(fleet.replicas[0].port, "POST", "/v1/render", body, JSON)[2]
    text = f"PUT {stored}, GET {status} of {len(got)} bytes, POST {drawn[0]}"
    return stored in (200, 201) and (status, got) == (200, data) and drawn[0] == 200 and same, text


def cut_off(fleet, kills=16):
    """20 MB that are asked for while replicas are killed: the proxy waits for the whole, and asks the other replica."""
    data = os.urandom(LARGE)
    path = "/v1/assets/" + hashlib.sha256(data).hexdigest()
    fleet.ask("PUT", path, data)
    results, ends = [], threading.Event()

    def ask_again():
        while not ends.is_set():
            try:
                key = f"Bearer {len(results)} {threading.get_ident()}"  # keeps answers from the others
                results.append(fleet.ask("GET", path, headers={"Authorization": key})[::2] == (200, data))
            except (OSError, http.client.HTTPException):
                results.append(False)

    clients = [threading.Thread(target=ask_again) for _ in range(3)]
    for client in clients:
        client.start()
    for i in range(kills):
        replace(fleet, i % 2, signal.SIGKILL)
    ends.set()
    for client in clients:
        client.join()
    sent = fleet.count(f'"path":"{path}".*"status":200')
    return all(results), f"{sum(results)} of {len(results)} answers of 20 MB are whole; {kills} replicas were killed, which sent {sent}"


def slow_client(fleet, seconds=6):
    """A client of 1 kB/s gets its answer, and others do not wait for it."""
    body = next(scenes())
    body += b" " * (seconds * 1000 - len(body))
    statuses = []

    def send_slowly():
        with socket.create_connection(("127.0.0.1", fleet.proxy.port), timeout=30) as stream:
            stream.sendall(b"POST /v1/render HTTP/1.1\r\nHost: zraster\r\nConnection: close\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n" % len(body))
            for i in range(0, len(body), 100):
                stream.sendall(body[i:i + 100])
                time.sleep(0.1)
            statuses.append(stream.recv(64).split(b" ")[1])

    slow = [threading.Thread(target=send_slowly) for _ in range(12)]
    for thread in slow:
        thread.start()
    load = Load(fleet.proxy.port, fleet.replicas[0], 500, clients=3).start().join()
    others_waited = not any(thread.is_alive() for thread in slow)
    for thread in slow:
        thread.join()
    text = f"{statuses.count(b'200')} of 12 slow clients answered; meanwhile {load.text()}"
    return statuses.count(b"200") == 12 and load.failed == load.others == 0 and not others_waited, text


def overload(fleet):
    """503 with Retry-After from the proxy while no replica takes work, and 200 afterwards."""
    body = next(scenes())
    for replica in fleet.replicas:
        fill(replica.memory, True)
    answers = []
    end = time.monotonic() + 2
    while time.monotonic() < end:
        answers.append(fleet.ask("POST", "/v1/render", other_text(body, (1 << 23) + len(answers)), JSON))
    for replica in fleet.replicas:
        fill(replica.memory, False)
    statuses = sorted({status for status, _, _ in answers})
    retry = sum(headers["Retry-After"] is not None for _, headers, _ in answers)
    after = wait_for(lambda: fleet.ask("POST", "/v1/render", other_text(body, 1 << 22), JSON)[0] == 200, 5)
    text = f"{len(answers)} requests: statuses {statuses}, {retry} with Retry-After; free again: {'200' if after else 'refused'}"
    return statuses == [503] and retry == len(answers) and after, text


def no_metrics(fleet):
    """What Prometheus asks of replicas is not shown outside."""
    paths = ("/metrics", "/metrics?a", "//metrics", "/./metrics", "/%6detrics", "/metrics/", "/v1/../metrics")
    shown = [path for path in paths if fleet.ask("GET", path)[0] == 200]
    return not shown, f"{len(paths)} spellings: {len(shown)} shown"


class Tap:
    def __init__(self):
        self.count = self.failed = 0

    def put(self, text, result):
        good, figures = result
        self.count += 1
        self.failed += not good
        print(f"{'ok' if good else 'not ok'} {self.count} - {text}: {figures}", flush=True)

    def skip(self, text, why):
        self.count += 1
        print(f"ok {self.count} - {text} # SKIP {why}", flush=True)
        print(f"LEFT OUT: {text}: {why}", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("--requests", type=int, default=20000)
    parser.add_argument("--only", default="", choices=("", *(kind.program for kind in PROXIES)))
    arguments = parser.parse_args()
    build, count, tap = os.path.abspath(arguments.build), arguments.requests, Tap()
    for kind in PROXIES:
        if arguments.only not in ("", kind.program):
            continue
        if not kind.command_there():
            tap.skip(f"replicas behind {kind.name}", f"{kind.program} is missing")
            continue
        print(f"# {kind.version()}", flush=True)
        with Fleet(build, kind) as fleet:
            tap.put(f"{kind.name}, kill -9 and SIGTERM in turns", under_load(fleet, count, (signal.SIGKILL, signal.SIGTERM)))
            if kind.caches:
                tap.put(f"{kind.name}, cache", cached(fleet))
            for case in (named, *((cut_off,) if kind.waits_for_whole else ()), large_body, slow_client, overload, no_metrics):
                tap.put(f"{kind.name}, {case.__name__.replace('_', ' ')}", case(fleet))
        with Fleet(build, kind, *DELAY) as fleet:
            tap.put(f"{kind.name}, rolling restart", under_load(fleet, count, (signal.SIGTERM,)))
        if kind.without_retries:
            with Fleet(build, kind, *DELAY, edits=kind.without_retries) as fleet:
                tap.put(f"{kind.name}, rolling restart, nothing is sent again", under_load(fleet, count, (signal.SIGTERM,)))
        if kind.caches:
            with Fleet(build, kind, edits=kind.cached_for_a_second) as fleet:
                tap.put(f"{kind.name}, revalidation", revalidated(fleet))
    print(f"1..{tap.count}")
    return tap.failed != 0


if __name__ == "__main__":
    sys.exit(main())
