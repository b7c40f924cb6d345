"""GET /metrics of a real daemon: both forms, sums beside the log, bounded names; and what uses them: alerts, dashboard, manual."""
import collections
import glob
import http.client
import json
import os
import re
import select
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import daemon
import openmetrics

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../fleet"))
import services

root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
deploy = os.path.join(root, "server/deploy")
PROMTOOL = shutil.which("promtool")
needs_promtool = unittest.skipUnless(PROMTOOL, "promtool is missing (the package prometheus, some 320 MB); make prometheus installs it")
OPEN = "application/openmetrics-text; version=1.0.0"
METHODS = ("GET", "HEAD", "POST", "PUT", "OPTIONS")
SCENE = b'{"window":{"width":40,"height":30},"polygons":[{"vertices":[[0,0,0],[1,0,0],[0,1,0]]}]}'
WARNED = b'{"window":{"width":40,"height":30},"polygons":[{"vertices":[[0,0,0],[0,0,0],[0,0,0]]}]}'
STEPS = ("parse", "queue", "render", "encode")


def read(*path):
    with open(os.path.join(root, *path), encoding="utf-8") as file:
        return file.read()


def promtool(*arguments, **more):
    done = subprocess.run([PROMTOOL, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **more)
    return done.returncode, done.stdout


class Watched(daemon.Logged):
    """A daemon whose metrics are read beside its log."""

    def __init__(self, *flags):
        super().__init__("--assets-dir", self.folder.name, *flags)
        self.host, self.port = self.address.removeprefix("http://").split(":")

    def scrape(self, accept="text/plain"):
        status, headers, data = self.send("/metrics", Accept=accept)
        assert status == 200, status
        return headers, data.decode()

    def families(self):
        return openmetrics.parse(self.scrape()[1])

    def lines(self):
        """Returns the lines about requests."""
        return [one for one in super().lines() if "method" in one or "status" in one]

    def raw(self, data, reads=True):
        """Sends bytes as they are on a connection of their own."""
        with socket.create_connection((self.host, int(self.port)), timeout=10) as stream:
            stream.sendall(data)
            while reads and stream.recv(1 << 16):
                pass

    def leave(self, data):
        """Sends bytes and leaves; returns once the daemon has logged that."""
        left = lambda: sum(line.get("aborted", False) for line in self.lines())
        before = left()
        self.raw(data, reads=False)
        end = time.monotonic() + 10
        while left() == before:
            assert time.monotonic() < end
            time.sleep(0.02)

    def agreed(self):
        """Returns the families of a scrape, and the lines of the requests before it, once all of them are there."""
        for _ in range(200):
            families = self.families()
            count = families["zraster_http_requests_total"].sum()
            for _ in range(50):
                lines = self.lines()
                if len(lines) > count:
                    break
                time.sleep(0.01)
            scrapes = [i for i, line in enumerate(lines) if line.get("route") == "/metrics"]
            if len(lines) == count + 1 and scrapes[-1] == len(lines) - 1:
                break
            time.sleep(0.02)
        return families, lines[:-1]


def counts(lines):
    """Returns how many lines of the log there are by route, method and status."""
    method_of = lambda line: line["method"] if line.get("method") in METHODS else "other"
    return dict(collections.Counter((line.get("route", "none"), method_of(line), str(line["status"])) for line in lines))


def looks(lines):
    return dict(collections.Counter(line["look"] for line in lines if "look" in line))


class Case(daemon.Case):
    kind = Watched


def send_mix(to):
    """Requests of many kinds: good ones, wrong ones, aborted ones, and bytes that are no HTTP."""
    for _ in range(3):
        to.send("/v1/render?look=studio@1&width=40&height=30", SCENE, "POST", Content_Type="application/json")
        to.send("/v1/render", SCENE, "POST", Content_Type="application/json")
    to.send("/v1/render", WARNED, "POST", Content_Type="application/json")
    to.send("/v1/render", b'{"polygons":[', "POST", Content_Type="application/json")
    to.send("/v1/render", b'{"odd":1}', "POST", Content_Type="application/json")
    to.send("/v1/render", b"{", "POST", Content_Encoding="br")
    to.send("/v1/render?look=odd", SCENE, "POST", Content_Type="application/json")
    to.send("/v1/assets", SCENE, "POST")
    to.send("/v1/assets/" + "0" * 64)
    to.send("/v1/assets/odd")
    for path in ("/", "/healthz", "/readyz", "/v1/limits", "/v1/looks", "/none", "/v1/none"):
        to.send(path)
        to.send(path, method="HEAD")
        to.send(path, method="OPTIONS")
        to.send(path, method="DELETE")
    to.send("/healthz", method="BREW")
    to.raw(b"\r\n\r\nGET\r\n\r\n")
    to.raw(b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03")
    to.raw(b"GET /healthz HTTP/1.1\r\nHost: a\r\nA" + b"x" * 100000 + b": b\r\n\r\n")
    to.raw(b"GET /healthz HTTP/3.7\r\nHost: a\r\n\r\n")
    to.raw(b"POST /v1/render HTTP/1.1\r\nHost: a\r\nContent-Length: 10\r\nContent-Length: 11\r\n\r\n")
    to.leave(b"POST /v1/render HTTP/1.1\r\nHost: a\r\nContent-Type: application/json\r\nContent-Length: 1000\r\n\r\n{")
    to.raw(b"POST /v1/render HTTP/1.1\r\nHost: a\r\nContent-Length: 5000000000\r\n\r\n")
    to.raw(b"GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n" * 5 + b"GET /healthz HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n")


class Forms(Case):
    def test_text(self):
        """the text format 0.0.4 is the default, and has what a strict reader asks for"""
        send_mix(self.daemon)
        for accept in ("*/*", "text/plain", "text/plain;version=0.0.4;q=0.5, */*;q=0.1", "application/openmetrics-text;version=1.0.0;q=0.2, text/plain;version=0.0.4;q=0.5"):
            headers, text = self.daemon.scrape(accept)
            self.assertEqual(headers["Content-Type"], "text/plain; version=0.0.4; charset=utf-8", accept)
            self.assertEqual(headers["Cache-Control"], "no-store")
            self.assertNotIn("# EOF", text)
            openmetrics.parse(text)

    def test_open(self):
        """OpenMetrics is chosen by Accept, as Prometheus sends it, and has the same families and series"""
        send_mix(self.daemon)
        for accept in (OPEN, "application/openmetrics-text;version=1.0.0,application/openmetrics-text;version=0.0.1;q=0.75,text/plain;version=0.0.4;q=0.5,*/*;q=0.1"):
            headers, text = self.daemon.scrape(accept)
            self.assertEqual(headers["Content-Type"], "application/openmetrics-text; version=1.0.0; charset=utf-8", accept)
            opened = openmetrics.parse(text, True)
        plain = self.daemon.families()
        names = lambda families: {sample for family in families.values() for sample in family.samples if "/metrics" not in str(sample)}
        self.assertEqual(names(opened), names(plain))
        self.assertEqual(opened["zraster_build"].type, "info")

    @needs_promtool
    def test_promtool(self):
        """promtool check metrics finds nothing to complain of"""
        send_mix(self.daemon)
        self.assertEqual(promtool("check", "metrics", input=self.daemon.scrape()[1]), (0, ""))

    def test_vary(self):
        """HEAD has the headers of GET; other methods are refused; caches are told of Accept"""
        got, asked = self.daemon.send("/metrics"), self.daemon.send("/metrics", method="HEAD")
        self.assertEqual((got[0], asked[0], asked[2]), (200, 200, b""))
        self.assertEqual(got[1]["Content-Type"], asked[1]["Content-Type"])
        self.assertIn("accept", got[1]["Vary"].lower())
        self.assertEqual(self.daemon.send("/metrics", b"", "POST")[0], 405)

    def test_two_accepts(self):
        """several headers Accept count as one list"""
        connection = http.client.HTTPConnection(self.daemon.host, int(self.daemon.port), timeout=10)
        connection.putrequest("GET", "/metrics")
        for kind in ("text/html", "application/openmetrics-text"):
            connection.putheader("Accept", kind)
        connection.endheaders()
        self.assertIn("application/openmetrics-text", connection.getresponse().headers["Content-Type"])
        connection.close()

    def test_reader(self):
        """the strict reader would find what is wrong"""
        good = '# HELP a_seconds h\n# TYPE a_seconds histogram\n# UNIT a_seconds seconds\na_seconds_bucket{le="1.0"} 1\na_seconds_bucket{le="+Inf"} 2\na_seconds_sum 3\na_seconds_count 2\n# EOF\n'
        openmetrics.parse(good, True)
        for old, new in (("# EOF\n", ""), ("# UNIT a_seconds seconds\n", ""), ("# HELP a_seconds h\n", ""), ("# TYPE a_seconds histogram\n", ""), ('le="1.0"', 'le="1"'),
                         ("} 1\n", "} 3\n"), ("_count 2", "_count 3"), ("a_seconds_sum 3\n", ""), ('le="+Inf"', 'le="2.0"'), ("sum 3\n", "sum 3\na_seconds_sum 3\n"),
                         ("sum 3\n", "sum 3\n# HELP a_seconds h\n"), ("a_seconds_sum", "b_seconds_sum"), ("histogram", "counter"), ("sum 3", "sum -3"), ("sum 3", "sum  3"),
                         ('{le="1.0"}', '{le="1.0",}'), ('{le="1.0"}', '{le="1.0"x="a"}'), ("histogram", "odd"), ("sum 3", "sum 3\n\n")):
            with self.subTest(old=old, new=new), self.assertRaises(ValueError):
                self.assertIn(old, good)
                openmetrics.parse(good.replace(old, new, 1), True)
        for text in ("# HELP a h\n# TYPE a counter\na 1\n", "# HELP a_total h\n# TYPE a_total info\na_total 1\n", "# HELP a h\n# TYPE a gauge\na 1\n# HELP b h\n# TYPE b gauge\nb 1\n# HELP a h\n", "a 1\n"):
            with self.subTest(text=text), self.assertRaises(ValueError):
                openmetrics.parse(text)


class Access(unittest.TestCase):
    def test_off(self):
        """--metrics=off: no such path"""
        one = daemon.Daemon("--metrics=off")
        try:
            self.assertEqual(one.send("/metrics")[0], 404)
        finally:
            one.stop()

    def test_open_to_all(self):
        """no token is asked for, as at /healthz"""
        one = daemon.Daemon("--token=secret")
        try:
            self.assertEqual([one.send(path)[0] for path in ("/metrics", "/healthz", "/v1/limits")], [200, 200, 401])
        finally:
            one.stop()


class Sums(Case):
    flags = ["--render-timeout-ms=500", "--cost-max-ms=86400000", "--workers=1", "--body-max-bytes=10000000"]

    def test_agree_with_the_log(self):
        """sums by route, method and status are those of the log's lines; so are times, bytes, looks, warnings and aborted requests"""
        send_mix(self.daemon)
        polygons = ",".join('{"vertices":[[-1,-1,%d],[1,-1,%d],[1,1,%d],[-1,1,%d]]}' % (i, i, i, i) for i in range(2000))
        slow = '{"algorithm":"edgelist","window":{"width":1024,"height":1024},"view":{"preset":"front"},"polygons":[%s]}' % polygons
        self.assertEqual(self.daemon.send("/v1/render", slow.encode(), "POST", Content_Type="application/json")[0], 504)
        families, lines = self.daemon.agreed()
        self.assertGreater(len(lines), 50)
        log = counts(lines)
        counted = {tuple(dict(labels)[name] for name in ("route", "method", "status")): value for (_, labels), value in families["zraster_http_requests_total"].samples.items()}
        self.assertEqual(counted, log)
        self.assertLessEqual({"200", "204", "400", "404", "405", "415", "422", "504"}, {key[2] for key in log})
        self.assertLessEqual({"none", "/v1/render", "/healthz"}, {key[0] for key in log})
        self.assertIn("other", {key[1] for key in log})

        def check(name, values, exact, **labels):
            family = families[name]
            place = tuple(labels.items())
            self.assertEqual(family.samples[name + "_count", place], len(values), (name, labels))
            self.assertAlmostEqual(family.samples[name + "_sum", place], sum(values), delta=0 if exact else 2e-6 * len(values) + 1e-9, msg=f"{name} {labels}")

        for route in {line.get("route", "none") for line in lines}:
            check("zraster_http_request_duration_seconds", [line["totalMs"] / 1000 for line in lines if line.get("route", "none") == route], False, route=route)
        for step in STEPS:
            check("zraster_http_request_step_seconds", [line[step + "Ms"] / 1000 for line in lines if step + "Ms" in line], False, step=step)
        check("zraster_http_request_body_bytes", [line["bytesIn"] for line in lines if line["bytesIn"]], True)
        check("zraster_http_answer_body_bytes", [line["bytesOut"] for line in lines if line["bytesOut"]], True)
        self.assertEqual({dict(labels)["look"]: value for (_, labels), value in families["zraster_pictures_total"].samples.items()}, looks(lines))
        self.assertEqual(families["zraster_picture_warnings_total"].sum(), sum(line.get("warnings", 0) for line in lines))
        self.assertGreater(families["zraster_picture_warnings_total"].sum(), 0)
        self.assertEqual(families["zraster_http_aborted_total"].sum(), sum(line.get("aborted", False) for line in lines))
        self.assertGreater(families["zraster_http_aborted_total"].sum(reason="client_left"), 0)
        self.assertEqual(families["zraster_http_timeouts_total"].sum(), 1)

    def resident(self):
        return int(re.search(r"VmRSS:\s+(\d+)", read(f"/proc/{self.daemon.process.pid}/status"))[1]) * 1024

    def test_now(self):
        """gauges tell what is: workers, readiness, memory, files, connections, and the version"""
        before, families, after = self.resident(), self.daemon.families(), self.resident()
        self.assertEqual([families[name].sum() for name in ("zraster_workers", "zraster_ready", "zraster_http_connections_limit", "zraster_log_lines_lost_total")], [1, 1, 1024, 0])
        self.assertGreaterEqual(families["zraster_http_connections"].sum(), 1)
        resident = families["process_resident_memory_bytes"].sum()
        self.assertTrue(0.8 * min(before, after) < resident < 1.2 * max(before, after), (before, resident, after))
        self.assertLess(abs(families["process_open_fds"].sum() - len(os.listdir(f"/proc/{self.daemon.process.pid}/fd"))), 4)
        self.assertLess(abs(families["process_start_time_seconds"].sum() - os.stat(f"/proc/{self.daemon.process.pid}").st_mtime), 60)
        version = json.loads(self.daemon.send("/v1/limits")[2])["version"]
        self.assertEqual(dict(next(iter(families["zraster_build_info"].samples))[1])["version"], version)


class Kept(Case):
    def test_kept(self):
        """kept values are those of /healthz"""
        model = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n#" + b"a" * 100000  # files of 64 KiB and more are kept
        for _ in range(4):
            self.assertEqual(self.daemon.send("/v1/render?width=20&height=20", model, "POST")[0], 200)
        told = json.loads(self.daemon.send("/healthz")[2])
        families = self.daemon.families()
        names = {"hits": "zraster_kept_hits_total", "misses": "zraster_kept_misses_total", "dropped": "zraster_kept_dropped_total", "count": "zraster_kept_entries", "bytes": "zraster_kept_bytes"}
        for kind in ("images", "texts", "meshes", "answers"):
            self.assertEqual({key: families[name].sum(kind=kind) for key, name in names.items()}, told[kind], kind)
        self.assertGreater(told["meshes"]["hits"], 0)


class Refusals(unittest.TestCase):
    def test_reasons(self):
        """refused requests are counted by reasons, as in the log: full memory, a client's share, connections whose place was needed, and an end"""
        memory = tempfile.TemporaryDirectory()
        self.addCleanup(memory.cleanup)
        services.fill(memory.name, False)
        one = Watched("--cgroup", memory.name, "--max-connections=8", "--max-per-private-client=1", "--drain-delay-ms=10000", "--drain-timeout-ms=1")
        self.addCleanup(one.stop)
        self.addCleanup(one.process.kill)

        def repeat(status, *arguments):
            return any(one.send(*arguments)[0] == status or time.sleep(0.05) for _ in range(100))

        with socket.create_connection((one.host, int(one.port)), timeout=10) as stream:
            stream.sendall(b"POST /v1/render HTTP/1.1\r\nHost: a\r\nContent-Length: 9\r\n\r\n{")
            self.assertTrue(repeat(429, "/v1/render", SCENE, "POST"))
        self.assertEqual(one.families()["zraster_memory_limit_bytes"].sum(), int(read(os.path.join(memory.name, "memory.max"))))
        services.fill(memory.name, True)
        self.assertTrue(repeat(503, "/v1/render", SCENE, "POST"))
        self.assertEqual(one.families()["zraster_ready"].sum(), 0)
        streams = [socket.create_connection((one.host, int(one.port)), timeout=10) for _ in range(14)]
        for stream in streams:
            stream.sendall(b"GET /healthz HTTP/1.1\r\nHost: ")
        self.assertTrue(select.select(streams, [], [], 30)[0], "no connection ends")
        for stream in streams:
            stream.close()
        services.fill(memory.name, False)
        self.assertTrue(repeat(200, "/readyz"))
        one.process.terminate()
        self.assertTrue(repeat(503, "/readyz"))
        families, lines = one.agreed()
        counted = {dict(labels)["reason"]: value for (_, labels), value in families["zraster_http_refused_total"].samples.items() if value}
        self.assertEqual(counted, dict(collections.Counter(line["refused"] for line in lines if "refused" in line)))
        self.assertLessEqual({"container", "client", "connections", "draining"}, set(counted))


class Names(Case):
    def odd(self, mark):
        """2000 requests with odd paths, methods, looks and headers."""
        connection = http.client.HTTPConnection(self.daemon.host, int(self.daemon.port), timeout=20)
        for i in range(1000):
            for method, path, body in ((f"ODD{mark}{i}" if i % 2 else ("GET", "PUT", "BREW")[i % 3], f"/{mark}/{i}%0a%22" if i % 3 else f"/v1/assets/{mark}{i}", None),
                                       ("POST", f"/v1/render?look={mark}{i}&{mark}{i}=1", SCENE)):
                connection.request(method, path, body, {"Content-Type": "application/json", f"X-{mark}{i}": "a", "Host": f"{mark}{i}"})
                connection.getresponse().read()
        connection.close()

    def test_bounded(self):
        """the names of series do not depend on what clients send"""
        self.odd("a")
        first = {sample for family in self.daemon.families().values() for sample in family.samples}
        self.odd("b")
        again = {sample for family in self.daemon.families().values() for sample in family.samples}
        self.assertEqual({one for one in again - first if "/metrics" not in str(one)}, set())
        self.assertLess(len(again), 1000)
        self.assertEqual([one for one in again if re.search(r"(?i)odd|[ab]\d|%0a", str(one[1]))], [])


class Uses(Case):
    """What names metrics, beside those that the daemon has."""

    def setUp(self):
        send_mix(self.daemon)
        self.families = self.daemon.families()
        self.labels = {}
        for family in self.families.values():
            for name, labels in family.samples:
                self.labels.setdefault(name, set()).update(key for key, _ in labels)

    def expressions(self):
        """(place, expression) of each alert and panel."""
        board = json.loads(read("server/deploy/grafana/zraster.json"))
        found = [(panel["title"], target["expr"]) for panel in board["panels"] for target in panel.get("targets", ())]
        found += [("annotation", one["expr"]) for one in board["annotations"]["list"]]
        found += [("variable", one["definition"]) for one in board["templating"]["list"] if "definition" in one]
        rules = read("server/deploy/prometheus/alerts.yml")
        alerts = re.findall(r"(?ms)^      - alert: (\w+)\n.*?^        expr: (?:>-\n)?(.*?)^        for:", rules)
        assert len(alerts) == rules.count("- alert: ")
        return found + alerts

    def test_names(self):
        """each metric and label of alerts, dashboard and autoscaler is one of the daemon"""
        expressions = self.expressions()
        self.assertGreater(len(expressions), 50)
        expressions.append(("hpa.yaml", re.search(r"metric: \{name: (\w+)\}", read("server/deploy/kubernetes/hpa.yaml"))[1]))
        for place, text in expressions:
            text = re.sub(r"#.*", "", text)
            names = re.findall(r"\b(?:zraster|process)_[a-z_]+\b(?!\w)", re.sub(r'"[^"]*"', '""', text))
            self.assertTrue(names or "haproxy" in text or "up{" in text, (place, text))
            for name in names:
                self.assertIn(name, self.labels, place)
            for name, selector in re.findall(r"\b((?:zraster|process)_[a-z_]+)\{([^}]*)\}", text):
                used = set(re.findall(r"(\w+) *(?:=~|!~|!=|=) *\"", selector)) - {"job", "instance"}
                self.assertLessEqual(used, self.labels[name], (place, name))
            for group in re.findall(r"\bby \(([^)]*)\)", text):
                used = {one.strip() for one in group.split(",")} - {"job", "instance"}
                self.assertLessEqual(used, set().union(*(self.labels[name] for name in names)), place)

    def test_values(self):
        """words of labels that alerts and dashboard compare with are those of the daemon"""
        values = {}
        for family in self.families.values():
            for _, labels in family.samples:
                for key, value in labels:
                    values.setdefault(key, set()).add(value)
        values["status"] |= {"500", "503", "504"}
        for place, text in self.expressions():
            for key, operator, value in re.findall(r'\b(reason|status|route|queue|phase|kind|step) *(=~|!~|!=|=) *"([^"]*)"', text):
                for word in value.split("|"):
                    self.assertTrue(any(re.fullmatch(word if "~" in operator else re.escape(word), one) for one in values[key]), (place, key, word, values[key]))

    def test_page(self):
        """the page about monitoring has each metric, each alert, and nothing that is not there"""
        page = read("clients/docs/how-to/monitoring.md")
        endings = ("_bucket", "_sum", "_count")
        own = {name for name in self.families}
        told = set(re.findall(r"\b(?:zraster|process)_[a-z_]+\b", page))
        self.assertEqual(own - told, set())
        self.assertEqual({name for name in told - own if not (name.endswith(endings) and name.rsplit("_", 1)[0] in own)}, set())
        alerts = set(re.findall(r"- alert: (\w+)", read("server/deploy/prometheus/alerts.yml")))
        self.assertEqual(set(re.findall(r"`(Zraster\w+)`", page)), alerts)

    def test_dashboard(self):
        """panels of the dashboard have ids and places of their own, a unit, and the chosen data source"""
        board = json.loads(read("server/deploy/grafana/zraster.json"))
        self.assertEqual([one["type"] for one in board["templating"]["list"]], ["datasource", "query", "query"])
        panels, places = board["panels"], set()
        self.assertEqual(len({panel["id"] for panel in panels}), len(panels))
        for panel in panels:
            place = panel["gridPos"]
            cells = {(place["x"] + x, place["y"] + y) for x in range(place["w"]) for y in range(place["h"])}
            self.assertFalse(cells & places, panel["title"])
            self.assertLessEqual(place["x"] + place["w"], 24)
            places |= cells
            for target in panel.get("targets", ()):
                self.assertEqual((panel["datasource"]["uid"], target["datasource"]["uid"]), ("${datasource}",) * 2)
                unit = panel["fieldConfig"]["defaults"]["unit"]
                self.assertEqual("_seconds_bucket" in target["expr"] or "_seconds_sum" in target["expr"], unit == "s" and "time()" not in target["expr"], panel["title"])
                self.assertEqual("_bytes" in target["expr"], unit in ("bytes", "Bps"), panel["title"])
        self.assertEqual([panel["title"] for panel in panels if panel["type"] == "row"], ["Traffic", "Latency", "Work", "Memory", "Kept", "Process"])

    def test_tests(self):
        """each alert has a test, a severity, a summary, and says what to do"""
        rules, tests = read("server/deploy/prometheus/alerts.yml"), read("server/deploy/prometheus/alerts_test.yml")
        alerts = re.split(r"(?m)^      - alert: ", rules)[1:]
        self.assertGreater(len(alerts), 9)
        for text in alerts:
            name = text.split("\n", 1)[0]
            self.assertRegex(tests, rf"(?s)alertname: {name}\n        eval_time: \d+m\n        exp_alerts:\n          - exp_labels")
            self.assertRegex(text, r"(?s)for: \d+[mh]\n        labels: \{severity: (critical|warning)\}\n        annotations:\n          summary: .*          description: ")

    def test_memory_limit(self):
        """the limit of memory in the alerts is that of the manifests"""
        limit = re.search(r"limits: \{cpu: \"\d+\", memory: (\d+)Gi\}", read("server/deploy/kubernetes/deployment.yaml"))[1]
        self.assertRegex(read("server/deploy/prometheus/alerts.yml"), rf"> 0\.85 \* {limit} \* 1024 \^ 3")

    @needs_promtool
    def test_rules(self):
        """promtool accepts rules and settings, and the tests of the rules pass"""
        folder = os.path.join(deploy, "prometheus")
        for arguments in (("check", "config", "prometheus.yml"), ("check", "rules", "alerts.yml"), ("test", "rules", "alerts_test.yml")):
            status, said = promtool(*arguments, cwd=folder)
            self.assertEqual(status, 0, said)
        self.assertEqual(len(glob.glob(folder + "/*")), 3)

    @needs_promtool
    def test_expressions(self):
        """expressions of the dashboard are PromQL"""
        board = [text for place, text in self.expressions() if place != "variable"]
        rules = [{"record": f"r{i}", "expr": text.replace("$__rate_interval", "5m")} for i, text in enumerate(board)]
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "rules.yml")
            with open(path, "w", encoding="utf-8") as file:
                json.dump({"groups": [{"name": "board", "rules": rules}]}, file)
            status, said = promtool("check", "rules", path)
        self.assertEqual(status, 0, said)

    def test_haproxy(self):
        """the metrics of HAProxy that alerts name are those that it has with haproxy.cfg"""
        if not services.HAProxy.command_there():
            self.skipTest("haproxy is missing (the package haproxy)")
        proxy = services.HAProxy((self.daemon, self.daemon)).start()
        try:
            host, port = proxy.environment["ZRASTER_STATUS"].split(":")
            connection = http.client.HTTPConnection(host, int(port), timeout=10)
            connection.request("GET", "/metrics")
            text = connection.getresponse().read().decode()
            connection.close()
        finally:
            proxy.stop()
        used = set(re.findall(r"\b(haproxy_\w+)\{", read("server/deploy/prometheus/alerts.yml")))
        self.assertEqual(len(used), 2)
        for name in used:
            self.assertRegex(text, rf'(?m)^{name}\{{proxy="zraster"[,}}]')
        self.assertRegex(text, r'(?m)^haproxy_server_status\{proxy="zraster",server="zraster-1",state="UP"\} 1$')
