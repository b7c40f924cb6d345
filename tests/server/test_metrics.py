"""/metrics: its formats, that its sums are those of the log, and the alerts and the dashboard that read it."""
import collections
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import daemon

DEPLOY = pathlib.Path("server/deploy")
RULES, DASHBOARD = DEPLOY / "prometheus/alerts.yml", DEPLOY / "grafana/zraster.json"
TRIANGLE = b'{"polygons": [{"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}]}'
OPEN = "application/openmetrics-text; version=1.0.0; charset=utf-8"
SAMPLE = re.compile(r'^([a-z_]+)(?:\{(.*)\})? (\S+)$')
# Neither in an alert nor in the dashboard.
LISTED = set()


def samples(text):
    """{(name, labels): value}, labels as written."""
    return {(m[1], m[2] or ""): float(m[3]) for m in map(SAMPLE.match, text.splitlines()) if m}


def families(text):
    return {line.split()[2] for line in text.splitlines() if line.startswith("# TYPE ")}


def counts_of_log(lines):
    """{labels of zraster_http_requests_total: lines of the log}."""
    counts = collections.Counter()
    known = {"GET", "HEAD", "POST", "PUT", "OPTIONS"}
    for line in lines:
        entry = json.loads(line)
        if "event" in entry:
            continue
        method = entry.get("method")
        counts['route="%s",method="%s",status="%s"' % (
            entry.get("route", "none"), method if method in known else "other", entry["status"])] += 1
    return dict(counts)


class Daemon(daemon.Daemon):
    """With its log in a file."""

    def __init__(self, *flags):
        self.log = tempfile.TemporaryFile("w+")
        self.process = subprocess.Popen([os.path.join(daemon.build, "zrasterd"), "--port", "0", *flags],
                                        stdout=subprocess.PIPE, stderr=self.log, text=True)
        self.address = re.search(r"http://\S+", self.process.stdout.readline()).group(0)

    def page(self, **headers):
        return self.send("/metrics", **headers)[2].decode()

    def crowd(self):
        """Two requests of one client at once: the second is one too many."""
        host, port = self.address.removeprefix("http://").split(":")
        head = b"POST /v1/render HTTP/1.1\r\nHost: a\r\nAuthorization: Bearer secret\r\nContent-Length: 9\r\n\r\n"
        with socket.create_connection((host, int(port))) as first:
            first.sendall(head)
            time.sleep(0.1)
            self.raw(head)

    def raw(self, data):
        host, port = self.address.removeprefix("http://").split(":")
        with socket.create_connection((host, int(port))) as connection:
            connection.sendall(data)
            connection.shutdown(socket.SHUT_WR)
            while connection.recv(65536):
                pass


class Metrics(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.daemon = Daemon("--token", "secret", "--body-max-bytes", "100000")

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()
        cls.daemon.log.close()

    def test_formats(self):
        """both formats, by Accept, without the token, and HEAD"""
        status, headers, plain = self.daemon.send("/metrics")
        self.assertEqual((status, headers["Content-Type"]), (200, "text/plain; version=0.0.4; charset=utf-8"))
        status, headers, text = self.daemon.send("/metrics", Accept=OPEN)
        self.assertEqual((status, headers["Content-Type"]), (200, OPEN))
        self.assertTrue(text.endswith(b"\n# EOF\n"))
        self.assertNotIn(b"# EOF", plain)
        status, headers, body = self.daemon.send("/metrics", method="HEAD")
        self.assertEqual((status, body), (200, b""))
        self.assertGreater(int(headers["Content-Length"]), 1000)

    def test_promtool(self):
        """promtool finds nothing to complain of"""
        if not shutil.which("promtool"):
            print("promtool is missing (the package prometheus)", file=sys.stderr)
            self.skipTest("promtool is missing (the package prometheus)")
        done = subprocess.run(["promtool", "check", "metrics"], input=self.daemon.page(), text=True, capture_output=True)
        self.assertEqual((done.returncode, done.stdout + done.stderr), (0, ""))
        with tempfile.TemporaryDirectory() as folder:
            for file in (RULES, "tests/metrics/alerts_test.yml"):
                shutil.copy(file, folder)
            for command in (["check", "rules", str(RULES)], ["check", "config", str(DEPLOY / "prometheus/prometheus.yml")],
                            ["test", "rules", folder + "/alerts_test.yml"]):
                done = subprocess.run(["promtool", *command], text=True, capture_output=True)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_each_alert_is_tested(self):
        """each alert fires in a test of promtool"""
        tested = set(re.findall(r"alertname: (\w+)\n +exp_alerts:(?! \[\])", open("tests/metrics/alerts_test.yml").read()))
        self.assertEqual(tested, set(re.findall(r"alert: (\w+)", RULES.read_text())))

    def test_names(self):
        """alerts and dashboard name metrics that there are, and use each that there is"""
        known = families(self.daemon.page())
        dashboard = json.loads(DASHBOARD.read_text())
        used = " ".join(target["expr"] for panel in dashboard["panels"] for target in panel["targets"])
        used += " ".join(line for line in RULES.read_text().splitlines() if "summary" not in line)
        names = {re.sub(r"_(bucket|sum|count)$", "", name) for name in re.findall(r"\b(?:zraster|process)_[a-z_]+", used)}
        self.assertEqual(names - known, set())
        self.assertEqual(known - names, LISTED)

    def test_sums_agree_with_the_log(self):
        """each line of the log is counted, of all methods, paths and faults"""
        other = Daemon("--token", "secret", "--body-max-bytes", "100000", "--max-per-private-client", "1")
        auth = {"Authorization": "Bearer secret"}
        for look in ("studio", "clay", "studio@1", "none-such"):
            other.request("/v1/render?look=" + look, TRIANGLE, auth)
        other.request("/v1/render", TRIANGLE)
        other.request("/v1/render", b"{", auth)
        other.request("/v1/render", b" " * 200000, auth)
        for method in ("GET", "PUT", "BREW", "get"):
            other.request("/made/up", None, auth, method)
        other.raw(b"GET / HTTP/2.0\r\n\r\n")
        other.raw(b"GET /healthz HTTP/1.1\r\nHost: a\r\nX: " + b"a" * 40000 + b"\r\n\r\n")
        other.raw(b"POST /v1/render HTTP/1.1\r\nHost: a\r\nAuthorization: Bearer secret\r\nContent-Length: 9\r\n\r\n{")
        other.crowd()
        time.sleep(0.2)
        page = samples(other.page())
        other.stop()
        other.log.seek(0)
        lines = other.log.read().splitlines()
        other.log.close()
        counted = {labels: value for (name, labels), value in page.items() if name == "zraster_http_requests_total"}
        logged = counts_of_log(lines)
        logged = {labels: n for labels, n in logged.items() if '"/metrics"' not in labels}
        self.assertEqual(counted, logged)
        self.assertGreaterEqual(sum(logged.values()), 14)
        timed = sum(n for (name, _), n in page.items() if name == "zraster_http_request_duration_seconds_count")
        self.assertEqual(timed, sum(logged.values()))
        self.assertEqual(page["zraster_http_refused_total", 'reason="client"'], 1)
        self.assertEqual(sum('"refused":"client"' in line for line in lines), 1)
        self.assertEqual({labels for name, labels in page if name == "zraster_pictures_total"},
                         {'look="%s"' % json.loads(line)["look"] for line in lines if '"look"' in line})

    def test_off(self):
        """--metrics=off"""
        other = Daemon("--metrics", "off")
        status, _, _ = other.send("/metrics")
        other.stop()
        other.log.close()
        self.assertEqual(status, 404)
