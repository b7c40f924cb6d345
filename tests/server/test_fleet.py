"""The files of server/deploy: each is accepted by its own program, and serves two replicas while they end. `make fleet` is longer."""
import concurrent.futures
import hashlib
import hmac
import http.server
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../fleet"))
import fleet
import services

build = os.environ["ZRASTER_BUILD"]
deploy = services.deploy


def value(name, pattern):
    """Returns the one number that the pattern finds in a file of server/deploy."""
    found = set(re.findall(pattern, services.text_of(name)))
    assert len(found) == 1, (name, pattern, found)
    return float(found.pop())


def limits():
    """Returns the daemon's settings by their flags, at their defaults."""
    text = subprocess.run([os.path.join(build, "zrasterd"), "--help"], stdout=subprocess.PIPE, check=True, text=True).stdout
    return {flag: int(number) for flag, number in re.findall(r"--([a-z-]+)=N\n[^(]*\(default: (\d+)\)", text.replace("\n      ", "\n"))}


def faults(kind, parts):
    """Returns what goes wrong with two replicas behind the proxy."""
    with fleet.Fleet(build, kind) as service:
        problems = service.proxy.problems()
        results = [(not problems, problems), fleet.once_under_load(service), *(part(service) for part in parts)]
        return [text for good, text in results if not good]


KEY = bytes(range(32))


def faults_at_end(kind):
    """Returns what goes wrong with a signed address that a cache keeps: beyond its end, it is refused."""
    with tempfile.NamedTemporaryFile("w") as keys:
        keys.write(KEY.hex() + "\n")
        keys.flush()
        with fleet.Fleet(build, kind, "--keys-file", keys.name) as service:
            scene = b'{"polygons": [{"vertices": [[0,0,0], [1,0,0], [0,1,0]]}]}'
            name = hashlib.sha256(scene).hexdigest()
            service.ask("PUT", "/v1/scenes/" + name, scene)
            end = int(time.time()) + 3
            address = f"/v1/renders/{name}?compress=small&exp={end}"
            address += "&signature=" + hmac.new(KEY, address.encode(), hashlib.sha256).hexdigest()
            answers = [service.ask("GET", address) for _ in range(2)]
            time.sleep(end + 0.2 - time.time())
            late = service.ask("GET", address)[0]
            got = [(status, headers.get("X-Cache")) for status, headers, _ in answers]
            return [] if got == [(200, "MISS"), (200, "HIT")] and late == 403 else [got, late]


class Proxies(unittest.TestCase):
    PARTS = {services.HAProxy: (fleet.named, fleet.no_metrics), services.Nginx: (fleet.cached, fleet.named, fleet.no_metrics), services.Varnish: (fleet.cached, fleet.named, fleet.no_metrics)}

    @classmethod
    def setUpClass(cls):
        """All at once: they wait most of the time."""
        cls.pool = concurrent.futures.ThreadPoolExecutor()
        cls.faults = {kind: cls.pool.submit(faults, kind, parts) for kind, parts in cls.PARTS.items() if kind.command_there()}
        cls.ends = {kind: cls.pool.submit(faults_at_end, kind) for kind in (services.Nginx, services.Varnish) if kind.command_there()}

    @classmethod
    def tearDownClass(cls):
        cls.pool.shutdown()

    def case(self, kind):
        if kind not in self.faults:
            self.skipTest(f"{kind.program} is missing (the package {kind.package})")
        self.assertEqual(self.faults[kind].result(), [])

    def test_end_of_signature(self):
        """nginx and Varnish keep the picture of a signed address until its end, and no longer"""
        if not self.ends:
            self.skipTest("nginx and Varnish are missing (the packages nginx and varnish)")
        for kind, result in self.ends.items():
            with self.subTest(proxy=kind.program):
                self.assertEqual(result.result(), [])

    def test_haproxy(self):
        """HAProxy accepts haproxy.cfg; a replica is killed, another one terminated: no request fails"""
        self.case(services.HAProxy)

    def test_nginx(self):
        """nginx accepts nginx.conf; a replica is killed, another one terminated: no request fails; assets are cached"""
        self.case(services.Nginx)

    def test_varnish(self):
        """Varnish accepts varnish.vcl; a replica is killed, another one terminated: no request fails; assets are cached"""
        self.case(services.Varnish)


class Together(http.server.BaseHTTPRequestHandler):
    """A replica whose answers may not be kept. /together answers 200 once two requests are there."""

    def do_GET(self):
        if self.path == "/together":
            try:
                self.server.both.wait(5)
            except threading.BrokenBarrierError:
                self.path = "/alone"
        self.send_response(409 if self.path == "/alone" else 200)
        self.send_header("Cache-Control", "no-store")
        self.send_header("Content-Length", "0")
        self.end_headers()

    def log_message(self, *_):
        pass


class Waiting(unittest.TestCase):
    @unittest.skipUnless(services.Varnish.command_there(), "varnishd is missing (the package varnish)")
    def test_private_answers(self):
        """requests for an answer that Varnish may not keep do not wait for one another"""
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Together)
        self.addCleanup(server.server_close)
        server.both, server.port = threading.Barrier(1), server.server_port
        threading.Thread(target=server.serve_forever, args=(0.02,)).start()
        self.addCleanup(server.shutdown)
        proxy = services.Varnish((server, server))
        self.addCleanup(proxy.stop)
        address = proxy.start().address + "/together"
        self.assertEqual(services.get(address), 200)  # from now on, Varnish has an entry that the answer may not be kept
        server.both = threading.Barrier(2)
        with concurrent.futures.ThreadPoolExecutor() as pool:
            statuses = list(pool.map(services.get, [address] * 2, [10.0] * 2))
        self.assertEqual(statuses, [200, 200])


class Numbers(unittest.TestCase):
    def test_limits(self):
        """sizes and times of the proxies fit the daemon's"""
        daemon = limits()
        body = daemon["body-max-bytes"]
        self.assertEqual(value("haproxy.cfg", r"req\.body_size gt (\d{8})"), body)
        self.assertEqual(value("nginx.conf", r"client_max_body_size (\d+)m;") * 2**20, body)
        self.assertEqual(value("varnish.vcl", r"Content-Length, 0\) > (\d+)"), body)
        self.assertEqual(value("varnish.vcl", r"cache_req_body\((\d+)MB\)") * 2**20, body)
        slowest = max(daemon["render-timeout-ms"], daemon["body-timeout-ms"]) / 1000
        for name, pattern in (("haproxy.cfg", r"timeout server (\d+)s"), ("nginx.conf", r"proxy_read_timeout (\d+)s"), ("varnish.vcl", r"first_byte_timeout = (\d+)s")):
            self.assertGreater(value(name, pattern), slowest)
        self.assertEqual(value("haproxy.cfg", r"timeout http-request (\d+)s") * 1000, daemon["header-timeout-ms"])
        self.assertEqual(value("haproxy.cfg", r"timeout client (\d+)s") * 1000, daemon["write-timeout-ms"])
        self.assertLess(value("haproxy.cfg", r"body_size gt (\d{5}) "), value("haproxy.cfg", r"tune.bufsize (\d+)"))


class Compose(unittest.TestCase):
    def setUp(self):
        try:
            import yaml
        except ImportError:
            self.skipTest("yaml is missing (the package python3-yaml)")
        self.services = yaml.safe_load(services.text_of("compose.yaml"))["services"]
        self.replicas = [service for name, service in self.services.items() if name.startswith("zraster-")]

    def test_hardened(self):
        """each container is read-only, without capabilities and new privileges, with limits and a pinned image"""
        for service in self.services.values():
            self.assertTrue(service["read_only"])
            self.assertEqual((service["cap_drop"], service["security_opt"]), (["ALL"], ["no-new-privileges:true"]))
            self.assertTrue(service["mem_limit"] and service["pids_limit"] and service["cpus"])
            self.assertRegex(service["image"], r":\d")
        for replica in self.replicas:
            self.assertEqual(replica["user"], re.search(r"(?m)^USER (\S+)$", open("Dockerfile", encoding="utf-8").read())[1])
            self.assertIn("zrasterd " + replica["image"].split(":")[1], subprocess.run([os.path.join(build, "zrasterd"), "--version"], stdout=subprocess.PIPE, check=True, text=True).stdout)

    def test_numbers(self):
        """a replica has time to drain and memory for its renders; HAProxy sends it no more than it takes, and notices its end"""
        self.assertEqual(len(self.replicas), 2)
        for replica in self.replicas:
            settings = {name: int(text) for name, text in replica["environment"].items() if text.isdigit()}
            workers, delay = settings["ZRASTER_WORKERS"], settings["ZRASTER_DRAIN_DELAY_MS"]
            self.assertGreaterEqual(int(replica["stop_grace_period"].rstrip("s")) * 1000, delay + settings["ZRASTER_DRAIN_TIMEOUT_MS"] + 4000)
            # One small request is drawn beside those of the workers.
            base = int(replica["mem_limit"].rstrip("g")) * 2**30 - (workers + 1) * settings["ZRASTER_REQUEST_MEMORY_BYTES"]
            self.assertGreaterEqual(base, 2**30)
            self.assertLess(value("haproxy.cfg", r" maxconn (\d+) observe"), 2 * workers)
            self.assertGreater(delay, value("haproxy.cfg", r"inter (\d+)ms fastinter") + (value("haproxy.cfg", r" fall (\d)") - 1) * value("haproxy.cfg", r"fastinter (\d+)ms"))
            self.assertEqual(replica["cpus"], workers)

    def test_addresses(self):
        """HAProxy is told the addresses of the replicas, and its file is there"""
        haproxy = self.services["haproxy"]
        told = {haproxy["environment"][f"ZRASTER_{i}"] for i in (1, 2)}
        self.assertEqual({r["environment"]["ZRASTER_TRUSTED_PROXIES"] for r in self.replicas}, {haproxy["networks"]["inside"]["ipv4_address"]})
        self.assertEqual(told, {f"{r['networks']['inside']['ipv4_address']}:{r['environment']['ZRASTER_PORT']}" for r in self.replicas})
        for volume in haproxy["volumes"]:
            self.assertTrue(os.path.exists(os.path.join(deploy, volume.split(":")[0])), volume)
        self.assertEqual(set(haproxy["depends_on"]), {"zraster-1", "zraster-2"})

    def test_compose(self):
        """docker compose accepts the file"""
        for command in (["docker", "compose"], ["docker-compose"]):
            if shutil.which(command[0]) and subprocess.run([*command, "version"], capture_output=True, check=False).returncode == 0:
                done = subprocess.run([*command, "-f", os.path.join(deploy, "compose.yaml"), "config", "-q"], capture_output=True, text=True, check=False)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                return
        self.skipTest("docker compose is missing (the package docker-compose of Debian 13)")


class Unit(unittest.TestCase):
    def setUp(self):
        with open(".packages/zrasterd.service.in", encoding="utf-8") as file:
            self.text = file.read().replace("@bindir@", build)

    def analyze(self, *arguments):
        if not shutil.which("systemd-analyze"):
            self.skipTest("systemd-analyze is missing (the package systemd)")
        folder = services.Folder()
        self.addCleanup(folder.remove)
        path = os.path.join(folder.host, "zrasterd.service")
        folder.write("zrasterd.service", self.text)
        return subprocess.run(["systemd-analyze", *arguments, path], capture_output=True, text=True, check=False)

    def test_valid(self):
        """systemd-analyze verifies the unit"""
        done = self.analyze("verify", "--man=no")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_security(self):
        """the unit's exposure is at most 2.0 for systemd-analyze"""
        done = self.analyze("security", "--offline=true", "--no-pager")
        level = re.search(r"Overall exposure level for zrasterd.service: ([\d.]+)", done.stdout)
        self.assertIsNotNone(level, done.stdout + done.stderr)
        print(f"# exposure of the unit: {level[1]}")
        self.assertLessEqual(float(level[1]), 2.0)

    def test_times(self):
        """the unit gives the daemon time to drain: 20 s of delay, the timeout, and 4 s for cancelled work"""
        self.assertGreaterEqual(float(re.search(r"(?m)^TimeoutStopSec=(\d+)$", self.text)[1]), 20 + limits()["drain-timeout-ms"] / 1000 + 4)


if __name__ == "__main__":
    unittest.main()
