"""Replicas of zrasterd and the proxies of server/deploy before them, on free ports of 127.0.0.1, for tests."""
import os
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import threading
import time
import urllib.error
import urllib.request

deploy = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../server/deploy")
# A root of another Debian, whose proxies run instead of those of this one; its /tmp is used.
root = os.environ.get("FLEET_ROOT", "")


given, lock = set(), threading.Lock()


def free_port():
    """Returns a port that nobody got before: a replica of another fleet on it would answer while its owner is down."""
    with lock:
        while True:
            with socket.socket() as probe:
                probe.bind(("127.0.0.1", 0))
                port = probe.getsockname()[1]
            if port not in given:
                given.add(port)
                return port


def get(address, timeout=5.0):
    """Returns the status, or 0 without an answer."""
    try:
        with urllib.request.urlopen(address, timeout=timeout) as answer:
            return answer.status
    except urllib.error.HTTPError as error:
        error.close()
        return error.code
    except OSError:
        return 0


def wait_for(condition, seconds=10.0):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


def program(name):
    """Returns the command of a proxy, or None where it is missing."""
    for folder in ("/usr/sbin", "/usr/bin"):
        if os.access(root + os.path.join(folder, name), os.X_OK):
            return (["chroot", root] if root else []) + [os.path.join(folder, name)]
    return None


class Folder:
    """A folder for programs of `root`: `path` is its name for them, `host` for this program."""

    def __init__(self):
        self.host = tempfile.mkdtemp(dir=root + "/tmp")
        os.chmod(self.host, 0o755)
        self.path = self.host[len(root):]

    def write(self, name, text):
        with open(os.path.join(self.host, name), "w", encoding="utf-8") as file:
            file.write(text)
        return os.path.join(self.path, name)

    def remove(self):
        shutil.rmtree(self.host, ignore_errors=True)


def fill(folder, is_full):
    """Lets a daemon with --cgroup FOLDER find that its memory is nearly used up, or is not."""
    texts = {"memory.max": "1000000000", "memory.current": "990000000" if is_full else "1000000", "memory.stat": "inactive_file 0\nfile 0\n"}
    for name, text in texts.items():
        temporary = os.path.join(folder, "new")
        with open(temporary, "w", encoding="utf-8") as file:
            file.write(text)
        os.rename(temporary, os.path.join(folder, name))


class Replica:
    """A daemon that can be ended and started again on its port. Its log is one file over all starts."""

    def __init__(self, build, folder, number, *flags):
        self.port = free_port()
        self.address = f"http://127.0.0.1:{self.port}"
        self.log = os.path.join(folder.host, f"replica-{number}.log")
        self.memory = os.path.join(folder.host, f"memory-{number}")
        self.command = [os.path.join(build, "zrasterd"), "--port", str(self.port), "--cgroup", self.memory, *flags]
        os.mkdir(self.memory)
        fill(self.memory, False)
        self.process = None

    def start(self):
        with open(self.log, "ab") as log:
            self.process = subprocess.Popen(self.command, stdout=subprocess.DEVNULL, stderr=log)
        if not wait_for(lambda: get(self.address + "/readyz") == 200):
            raise RuntimeError(f"no daemon at {self.address}: {open(self.log).read()[-400:]}")
        return self

    def end(self, number=signal.SIGTERM):
        """Returns its exit status."""
        self.process.send_signal(number)
        return self.process.wait(60)

    def count(self, pattern):
        """Returns the number of lines of its log that match."""
        with open(self.log, encoding="utf-8") as log:
            return sum(bool(re.search(pattern, line)) for line in log)

    def stop(self):
        if self.process and self.process.poll() is None:
            self.process.kill()
            self.process.wait()


def text_of(name, edits=()):
    with open(os.path.join(deploy, name), encoding="utf-8") as file:
        text = file.read()
    for old, new in edits:
        assert old in text, old
        text = text.replace(old, new)
    return text


class Proxy:
    """One of HAProxy, nginx and Varnish: `check` is the command that checks its file, `run` the one that serves."""

    name = caches = None
    settle = 0.2  # seconds until it sends requests to a replica that is back, and none is under way that found it away

    waits_for_whole = False
    without_retries = cached_for_a_second = ()  # texts of its file, and what a test puts in their place

    def __init__(self, replicas, edits=()):
        self.folder = Folder()
        self.edits = edits
        self.environment = dict(os.environ)
        self.process = None
        self.port = free_port()
        self.address = f"http://127.0.0.1:{self.port}"
        self.command = program(self.program)
        self.configure(*(f"127.0.0.1:{replica.port}" for replica in replicas))

    @classmethod
    def command_there(cls):
        return program(cls.program) is not None

    @classmethod
    def version(cls):
        option = "-V" if cls.program == "varnishd" else "-v"
        done = subprocess.run(program(cls.program) + [option], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        return done.stdout.split("\n")[0]

    def call(self, arguments, **more):
        return (subprocess.run if "check" in more else subprocess.Popen)(self.command + arguments, env=self.environment, **more)

    def problems(self):
        """Returns what its own check of the file complains of."""
        done = self.call(self.check, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return self.complaints(done.stdout) if done.returncode == 0 else done.stdout or f"status {done.returncode}"

    def complaints(self, text):
        return "".join(line for line in text.splitlines(True) if re.search(r"warn|alert|emerg", line, re.I))

    def start(self):
        with open(os.path.join(self.folder.host, "said"), "ab") as said:
            self.process = self.call(self.run, stdout=said, stderr=said, stdin=subprocess.DEVNULL)
        answers = wait_for(lambda: self.process.poll() is not None or get(self.address + "/healthz") == 200, 20.0)
        if answers and self.process.poll() is None:
            return self
        said = self.said()
        self.stop()
        raise RuntimeError(f"{self.name} {'ended' if answers else 'does not answer'}: {said}")

    def said(self):
        with open(os.path.join(self.folder.host, "said"), encoding="utf-8", errors="replace") as file:
            return file.read()[-800:]

    def stop(self):
        if self.process and self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        self.folder.remove()


class HAProxy(Proxy):
    name, program, package, caches, settle = "HAProxy", "haproxy", "haproxy", False, 1.0
    without_retries = (("    retries 3\n    option redispatch 1\n    retry-on conn-failure empty-response junk-response 502 503\n", "    retries 0\n    retry-on none\n"),)

    def configure(self, first, second):
        self.environment.update(ZRASTER_FRONT=f"127.0.0.1:{self.port}", ZRASTER_STATUS=f"127.0.0.1:{free_port()}", ZRASTER_1=first, ZRASTER_2=second)
        text = text_of("haproxy.cfg", self.edits)
        if os.geteuid() != 0:
            text = re.sub(r"(?m)^    (user|group) .*\n", "", text)
        path = self.folder.write("haproxy.cfg", text)
        self.check, self.run = ["-c", "-f", path], ["-db", "-f", path]


class Nginx(Proxy):
    name, program, package, caches = "nginx", "nginx", "nginx", True
    cached_for_a_second = (("proxy_cache_revalidate on;", "proxy_cache_revalidate on; proxy_ignore_headers Cache-Control; proxy_cache_valid 200 1s;"),)

    def configure(self, first, second):
        path = self.folder.path
        own = text_of("nginx.conf", (("listen 80;", f"listen 127.0.0.1:{self.port};"), ("/var/lib/nginx/", path + "/"),
                                     ("127.0.0.1:8081", first), ("127.0.0.1:8082", second), *self.edits))
        folders = " ".join(f"{name}_temp_path {path}/{name};" for name in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi"))
        user = "user root; " if os.geteuid() == 0 else ""
        whole = f"{user}daemon off; pid {path}/pid; error_log {path}/errors; events {{}}\nhttp {{ access_log off; {folders}\n{own}}}\n"
        file = self.folder.write("nginx.conf", whole)
        common = ["-p", path, "-e", path + "/errors", "-c", file]
        self.check, self.run = ["-t", *common], common


class Varnish(Proxy):
    name, program, package, caches, settle = "Varnish", "varnishd", "varnish", True, 1.2
    waits_for_whole = True
    cached_for_a_second = (("set beresp.grace = 1h;", "set beresp.ttl = 1s; set beresp.grace = 0s;"),)

    def configure(self, first, second):
        path = self.folder.path
        ports = [(f'.port = "{old}";', f'.port = "{new.split(":")[1]}";') for old, new in (("8081", first), ("8082", second))]
        text = text_of("varnish.vcl", (*ports, *self.edits))
        file = self.folder.write("varnish.vcl", text)
        jail = ["-j", "none"] if os.geteuid() == 0 else []
        self.check = [*jail, "-C", "-f", file, "-n", path + "/checked"]
        self.run = [*jail, "-F", "-a", f"127.0.0.1:{self.port}", "-f", file, "-n", path + "/running", "-s", "malloc,256m", "-s", "Transient=malloc,512m"]

    def complaints(self, text):
        return ""  # it prints C


PROXIES = (HAProxy, Nginx, Varnish)
