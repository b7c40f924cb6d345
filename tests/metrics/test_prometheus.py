"""A real Prometheus, with the files of server/deploy, scrapes a daemon twice a second under load: its sums are those of the log, its rules
evaluate, and each panel of the dashboard has values. PROMETHEUS_SECONDS=60 of load; figures go to standard error."""
import http.client
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.parse
import urllib.request

here = os.path.dirname(os.path.abspath(__file__))
root = os.path.join(here, "../..")
sys.path += [os.path.join(here, "../server"), os.path.join(here, "../fleet")]
import services
import test_metrics

SECONDS = float(os.environ.get("PROMETHEUS_SECONDS", "60"))
JSON = {"Content-Type": "application/json"}
# (method, path, body, headers), drawn at random.
REQUESTS = ([("POST", "/v1/render?look=studio@1&width=64&height=48", test_metrics.SCENE, JSON)] * 6 + [("POST", "/v1/render", test_metrics.SCENE, JSON)] * 6 +
            [("POST", "/v1/render", test_metrics.WARNED, JSON), ("POST", "/v1/render", b'{"odd":1}', JSON), ("POST", "/v1/render", b"{", JSON),
             ("POST", "/v1/render", b"{", {"Content-Encoding": "br"}), ("GET", "/v1/limits", None, {}), ("HEAD", "/", None, {}), ("OPTIONS", "/v1/render", None, {}),
             ("DELETE", "/v1/looks", None, {}), ("GET", "/none", None, {}), ("BREW", "/healthz", None, {}), ("GET", "/v1/assets/" + "0" * 64, None, {})])


class Prometheus:
    """Scrapes `target` and the status page of `haproxy` twice a second, in a folder of its own."""

    def __init__(self, target, haproxy):
        self.folder = tempfile.TemporaryDirectory()
        self.port = services.free_port()
        edits = (('"127.0.0.1:8081", "127.0.0.1:8082"', f'"{target}"'), ("127.0.0.1:8404", haproxy), ("scrape_interval: 15s", "scrape_interval: 500ms"),
                 ("scrape_timeout: 5s", "scrape_timeout: 500ms"), ("evaluation_interval: 15s", "evaluation_interval: 1s"))
        self.path = os.path.join(self.folder.name, "prometheus.yml")
        with open(self.path, "w", encoding="utf-8") as file:
            file.write(services.text_of("prometheus/prometheus.yml", edits))
        shutil.copy(os.path.join(root, "server/deploy/prometheus/alerts.yml"), self.folder.name)
        self.log = open(os.path.join(self.folder.name, "log"), "w+", encoding="utf-8")
        self.process = subprocess.Popen(["prometheus", f"--config.file={self.path}", f"--web.listen-address=127.0.0.1:{self.port}",
                                         f"--storage.tsdb.path={self.folder.name}/data", "--log.level=warn"], stdout=self.log, stderr=self.log, cwd=self.folder.name)
        if not services.wait_for(lambda: services.get(f"http://127.0.0.1:{self.port}/-/ready") == 200, 30.0):
            said = self.said()
            self.stop()
            raise RuntimeError(said)

    def said(self):
        self.log.seek(0)
        return self.log.read()[-1000:]

    def ask(self, path, **parameters):
        with urllib.request.urlopen(f"http://127.0.0.1:{self.port}/api/v1/{path}?{urllib.parse.urlencode(parameters)}", timeout=20) as answer:
            return json.load(answer)["data"]

    def query(self, expression):
        """Returns [(labels, value)]."""
        return [(one["metric"], float(one["value"][1])) for one in self.ask("query", query=expression)["result"]]

    def value(self, expression):
        return self.query(expression)[0][1]

    def stop(self):
        self.process.terminate()
        self.process.wait()
        self.log.close()
        self.folder.cleanup()


def send_until(to, end, seed):
    choose = random.Random(seed)
    while time.monotonic() < end:
        connection = http.client.HTTPConnection(to.host, int(to.port), timeout=20)
        for _ in range(50):
            method, path, body, headers = choose.choice(REQUESTS)
            connection.request(method, path, body, headers)
            connection.getresponse().read()
        connection.close()
        if seed == 0:
            to.raw(b"GET\r\n\r\n")
            to.raw(b"POST /v1/render HTTP/1.1\r\nHost: a\r\nContent-Type: application/json\r\nContent-Length: 1000\r\n\r\n{", reads=False)


class Scraped(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = test_metrics.Watched()
        cls.addClassCleanup(cls.daemon.stop)
        cls.proxy = None
        if services.HAProxy.command_there():
            cls.proxy = services.HAProxy((cls.daemon, cls.daemon)).start()
            cls.addClassCleanup(cls.proxy.stop)
        cls.prometheus = Prometheus(f"{cls.daemon.host}:{cls.daemon.port}", cls.proxy.environment["ZRASTER_STATUS"] if cls.proxy else "127.0.0.1:1")
        cls.addClassCleanup(cls.prometheus.stop)
        end = time.monotonic() + SECONDS
        threads = [threading.Thread(target=send_until, args=(cls.daemon, end, seed)) for seed in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        cls.at_end = time.time()
        time.sleep(3)

    def test_sums(self):
        """sums by route, method and status, and of times and bytes, are those of the log"""
        lines = [line for line in self.daemon.lines() if line.get("route") not in ("/metrics", "/readyz")]  # HAProxy asks for /readyz on and on
        log = test_metrics.counts(lines)
        counted = {(labels["route"], labels["method"], labels["status"]): value for labels, value in self.prometheus.query('zraster_http_requests_total{route!~"/metrics|/readyz"}')}
        self.assertEqual(counted, log)
        for route in {line.get("route", "none") for line in lines}:
            times = [line["totalMs"] / 1000 for line in lines if line.get("route", "none") == route]
            self.assertEqual(self.prometheus.value(f'zraster_http_request_duration_seconds_count{{route="{route}"}}'), len(times))
            self.assertAlmostEqual(self.prometheus.value(f'zraster_http_request_duration_seconds_sum{{route="{route}"}}'), sum(times), delta=1e-6 * len(times) + 1e-6)
        bodies = [line["bytesIn"] for line in lines if line["bytesIn"]]
        self.assertEqual((self.prometheus.value("zraster_http_request_body_bytes_count"), self.prometheus.value("zraster_http_request_body_bytes_sum")), (len(bodies), sum(bodies)))
        self.assertEqual({labels["look"]: value for labels, value in self.prometheus.query("zraster_pictures_total")}, test_metrics.looks(lines))
        self.assertEqual(self.prometheus.value("sum(zraster_http_aborted_total)"), sum(line.get("aborted", False) for line in lines))
        print(f"# {len(lines)} requests of {len(log)} kinds in {SECONDS:.0f} s: all sums agree", file=sys.stderr)

    def test_scrapes(self):
        """no scrape failed, Prometheus read OpenMetrics, and complained of nothing"""
        whole = f"[{SECONDS + 60:.0f}s]"
        count = self.prometheus.value(f'count_over_time(up{{job="zraster"}}{whole})')
        self.assertGreater(count, 1.8 * (SECONDS - 5))  # Prometheus begins 5 s late
        self.assertEqual(self.prometheus.value(f'min_over_time(up{{job="zraster"}}{whole})'), 1)
        types = {one["metric"]: one["type"] for one in self.prometheus.ask("targets/metadata", match_target='{job="zraster"}')}
        self.assertEqual((types["zraster_build"], types["zraster_http_request_duration_seconds"]), ("info", "histogram"))
        self.assertEqual(self.prometheus.said(), "")
        longest = self.prometheus.value(f'max_over_time(scrape_duration_seconds{{job="zraster"}}{whole})')
        mean = self.prometheus.value(f'avg_over_time(scrape_duration_seconds{{job="zraster"}}{whole})')
        series = self.prometheus.value('scrape_samples_scraped{job="zraster"}')
        print(f"# {count:.0f} scrapes of {series:.0f} samples: mean {1000 * mean:.1f} ms, longest {1000 * longest:.1f} ms", file=sys.stderr)

    def test_cost(self):
        """two scrapes a second take less than 1 % of a processor"""
        seconds = lambda: self.daemon.families()["process_cpu_seconds_total"].sum()
        before, count = seconds(), 500
        for _ in range(count):
            self.daemon.scrape(test_metrics.OPEN)
        each = (seconds() - before) / count
        self.assertLess(2 * each, 0.01)
        print(f"# a scrape takes {1e6 * each:.0f} us of processor time: two a second {200 * each:.3f} % of a processor", file=sys.stderr)

    def test_rules(self):
        """all rules evaluate, and none raises an alert"""
        groups = self.prometheus.ask("rules")["groups"]
        rules = [rule for group in groups for rule in group["rules"]]
        self.assertEqual(len(rules), 15)
        self.assertEqual({rule["name"]: rule.get("lastError") for rule in rules if rule["health"] != "ok"}, {})
        raised = {rule["name"] for rule in rules if rule["state"] != "inactive"}
        self.assertEqual(raised, set())

    def test_dashboard(self):
        """each query of the dashboard has a value"""
        with open(os.path.join(root, "server/deploy/grafana/zraster.json"), encoding="utf-8") as file:
            board = json.load(file)
        empty = []
        for panel in board["panels"]:
            for target in panel.get("targets", ()):
                expression = target["expr"].replace("$__rate_interval", "20s").replace("$job", "zraster").replace("$instance", ".+")
                if not self.prometheus.ask("query", query=expression, time=self.at_end)["result"]:
                    empty.append((panel["title"], target["expr"]))
        self.assertEqual(empty, [])
