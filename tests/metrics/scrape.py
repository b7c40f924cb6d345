#!/usr/bin/python3
"""scrape.py BUILD [SECONDS] [ROUNDS]: a real Prometheus scrapes a daemon twice a second under load. Its sums must be those of
the log, to the request. Then rounds of load with and without two scrapes a second: prints the ratio of throughputs."""
import collections
import json
import os
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import urllib.parse
import urllib.request

build, seconds, rounds = sys.argv[1], float((sys.argv + ["60"])[2]), int((sys.argv + ["", "20"])[3])
os.environ["ZRASTER_BUILD"] = build
sys.path[:0] = ["tests/python", "tests/server"]
import test_metrics as of

SCENE = b'{"polygons": [{"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}]}'
REQUESTS = [("/v1/render", SCENE), ("/v1/render", SCENE), ("/v1/render", b"{"), ("/healthz", None), ("/none", None)]


def load(daemon, until, count):
    for i in range(10 ** 9):
        if time.monotonic() > until:
            return
        path, body = REQUESTS[i % len(REQUESTS)]
        daemon.send(path, body)
        count[0] += 1


def loaded(daemon, duration):
    """Requests a second of two clients."""
    counts = [[0], [0]]
    began = time.monotonic()
    threads = [threading.Thread(target=load, args=(daemon, began + duration, count)) for count in counts]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return sum(count[0] for count in counts) / (time.monotonic() - began)


def free_port():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return taken.getsockname()[1]


def ask(port, query):
    url = f"http://127.0.0.1:{port}/api/v1/query?" + urllib.parse.urlencode({"query": query})
    return json.load(urllib.request.urlopen(url, timeout=5))["data"]["result"]


def scraped(daemon):
    port = free_port()
    with tempfile.TemporaryDirectory() as folder:
        with open(folder + "/prometheus.yml", "w") as file:
            json.dump({"global": {"scrape_interval": "500ms"}, "scrape_configs": [
                {"job_name": "zraster", "static_configs": [{"targets": [daemon.address.removeprefix("http://")]}]}]}, file)
        prometheus = subprocess.Popen(
            ["prometheus", "--config.file=" + folder + "/prometheus.yml", "--storage.tsdb.path=" + folder + "/data",
             f"--web.listen-address=127.0.0.1:{port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            rate = loaded(daemon, seconds)
            time.sleep(2)
            found = {'route="%(route)s",method="%(method)s",status="%(status)s"' % r["metric"]: int(r["value"][1])
                     for r in ask(port, "zraster_http_requests_total") if r["metric"]["route"] != "/metrics"}
            scrapes = int(ask(port, 'count_over_time(up{job="zraster"}[1h])')[0]["value"][1])
            ups = int(ask(port, 'sum_over_time(up{job="zraster"}[1h])')[0]["value"][1])
        finally:
            prometheus.terminate()
            prometheus.wait()
    daemon.log.seek(0)
    logged = {k: n for k, n in of.counts_of_log(daemon.log.read().splitlines()).items() if '"/metrics"' not in k}
    print(f"{sum(logged.values())} requests in {seconds:.0f} s ({rate:.0f} a second), {ups} of {scrapes} scrapes came")
    for labels in sorted(logged.keys() | found.keys()):
        print(f"  {{{labels}}}: log {logged.get(labels, 0)}, Prometheus {found.get(labels, 0)}")
    return found == logged and ups > 0


def costs(daemon):
    ratios = []
    for i in range(rounds):
        rates = {}
        for with_scrapes in ((True, False) if i % 2 else (False, True)):
            stop = threading.Event()
            scrape = threading.Thread(target=lambda: [daemon.page(Accept=of.OPEN) for _ in iter(lambda: stop.wait(0.5), True)])
            if with_scrapes:
                scrape.start()
            rates[with_scrapes] = loaded(daemon, 1.5)
            stop.set()
            if with_scrapes:
                scrape.join()
        ratios.append(rates[True] / rates[False])
    spread = statistics.stdev(ratios) / len(ratios) ** 0.5 if len(ratios) > 1 else float("nan")
    print(f"throughput with two scrapes a second over that without: median {statistics.median(ratios):.4f}, "
          f"mean {statistics.mean(ratios):.4f} +- {spread:.4f}, {rounds} rounds")
    began = time.process_time(), of.samples(daemon.page())["process_cpu_seconds_total", ""]
    for _ in range(200):
        daemon.page()
    used = of.samples(daemon.page())["process_cpu_seconds_total", ""] - began[1]
    print(f"a scrape takes {used / 201 * 1e6:.0f} us of the daemon's processor time: {used / 201 * 2 * 100:.4f} % of one for two a second")
    return used / 201 * 2 < 0.01


daemon = of.Daemon("--max-per-client", "0")
agree = scraped(daemon)
cheap = costs(daemon)
daemon.stop()
print("sums agree" if agree else "SUMS DIFFER", "and scrapes cost less than 1 %" if cheap else "AND SCRAPES COST MORE THAN 1 %", sep=", ")
sys.exit(not (agree and cheap))
