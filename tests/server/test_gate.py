"""Tokens, keys and presets from files, which SIGHUP reads anew; addresses with signatures."""
import collections
import hashlib
import http.client
import json
import os
import pty
import random
import re
import shutil
import signal
import subprocess
import tempfile
import threading
import time
import unittest

import daemon

KEY, OTHER_KEY = "000102030405060708090a0b0c0d0e0f", "f" * 64
SCENE = b'{"polygons": [{"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}]}'
MODEL = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
SECONDS = 30.0


class Daemon(daemon.Logged):
    """A daemon whose files are given as {flag: text}."""

    def __init__(self, files, *flags):
        for flag, text in files.items():
            self.write(flag, text)
            flags += (f"--{flag}", self.path(flag))
        super().__init__(*flags)

    def write(self, name, text):
        """Replaces a file in one step."""
        with open(self.path("new"), "w", encoding="utf-8") as file:
            os.chmod(self.path("new"), 0o600)
            file.write(text)
        os.rename(self.path("new"), self.path(name))

    def reloads(self):
        """Returns the lines of the log about SIGHUP."""
        return [line for line in self.lines() if line.get("event") == "reload"]

    def reload(self):
        """Sends SIGHUP. Returns the line of the log about it."""
        count, end = len(self.reloads()), time.monotonic() + SECONDS
        self.process.send_signal(signal.SIGHUP)
        while time.monotonic() < end:
            if len(lines := self.reloads()) > count:
                return lines[count]
            time.sleep(0.005)
        raise AssertionError("SIGHUP was not logged")

    def status(self, token=None, path="/v1/limits"):
        return self.request(path, headers={"Authorization": f"Bearer {token}"} if token else {})[0]

    def stop(self):
        super().stop()
        assert self.process.returncode == 0, self.process.returncode


class Reload(unittest.TestCase):
    def test_tokens_rotate(self):
        """SIGHUP takes tokens in and out; the token of the setting stays"""
        server = Daemon({"token-file": "old\n"}, "--token", "fixed")
        self.addCleanup(server.stop)
        self.assertEqual([server.status(token) for token in ("fixed", "old", "new", None)], [200, 200, 401, 401])
        server.write("token-file", "old\nnew\n")
        self.assertEqual(server.reload()["detail"], "tokens: 3 (before: 2), keys: 0, presets: 0")
        self.assertEqual([server.status(token) for token in ("fixed", "old", "new", None)], [200, 200, 200, 401])
        server.write("token-file", "new\n")
        server.reload()
        self.assertEqual([server.status(token) for token in ("fixed", "old", "new", None)], [200, 401, 200, 401])

    def test_faulty_file(self):
        """a faulty, empty or missing file changes nothing, and the log says why"""
        server = Daemon({"token-file": "secret\n"})
        self.addCleanup(server.stop)
        path = server.path("token-file")
        for text, fault in (("other\nse\tcret\n", f"{path}:2: a token has printable ASCII without spaces at its ends"),
                            ("", f"{path}: the file has no entry"), (None, f"{path}: No such file or directory")):
            if text is None:
                os.unlink(path)
            else:
                server.write("token-file", text)
            line = server.reload()
            self.assertEqual((line["level"], line["detail"]), ("error", f"tokens, keys and presets stay as they were: {fault}"))
            self.assertEqual([server.status("secret"), server.status("other")], [200, 401])
        self.assertNotIn("secret", server.log())

    def test_faults_at_start(self):
        """a daemon with a faulty file does not start"""
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write(f"{KEY}\n0123\n")
            file.flush()
            command = [os.path.join(daemon.build, "zrasterd"), "--port", "0", "--keys-file", file.name]
            run = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, check=False)
            self.assertEqual(run.returncode, 2)
            self.assertIn(f"zrasterd: {file.name}:2: a key has 16 to 128 bytes", run.stderr)

    def test_under_load(self):
        """SIGHUP again and again under load: no request fails"""
        server = Daemon({"token-file": "one\ntwo\n", "presets": "small = look=clay\n"})
        self.addCleanup(server.stop)
        statuses, stop = [], threading.Event()

        def ask(token, is_render):
            connection = http.client.HTTPConnection(server.address.split("//")[1])
            while not stop.is_set():
                if is_render:
                    headers = {"Authorization": f"Bearer {token}", "Content-Type": "application/json"}
                    connection.request("POST", "/v1/render", SCENE, headers)
                else:
                    connection.request("GET", "/v1/limits", headers={"Authorization": f"Bearer {token}"})
                answer = connection.getresponse()
                answer.read()
                statuses.append(answer.status)
            connection.close()

        threads = [threading.Thread(target=ask, args=(token, kind)) for token in ("one", "two") for kind in (True, False)]
        for thread in threads:
            thread.start()
        reloads = int(os.environ.get("GATE_RELOADS", "20"))
        for i in range(reloads):
            server.write("token-file", ("three\ntwo\none\n", "one\ntwo\n")[i % 2])
            server.reload()
        stop.set()
        for thread in threads:
            thread.join()
        self.assertEqual((set(statuses), len(server.reloads())), ({200}, reloads))
        print(f"# {reloads} reloads, {len(statuses)} requests")

    def test_terminal(self):
        """SIGHUP of a terminal that closes ends the daemon, as before it could be read anew"""
        main, terminal = pty.openpty()
        command = [os.path.join(daemon.build, "zrasterd"), "--port", "0"]
        process = subprocess.Popen(command, stdin=terminal, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertIn("listening", process.stdout.readline())
        process.send_signal(signal.SIGHUP)
        time.sleep(0.05)
        self.assertIsNone(process.poll())
        os.close(terminal)
        os.close(main)
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(SECONDS), 0)


def page_blocks(language):
    """The fenced blocks of the page about signed addresses."""
    with open("clients/docs/how-to/signed-addresses.md", encoding="utf-8") as page:
        return re.findall(rf"^```{language}\n(.*?)^```$", page.read(), re.S | re.M)


def sign(address, key=KEY):
    """Signs by the page's block."""
    (block,) = page_blocks("python")
    names = {}
    exec(block.replace('open("keys").readline()', repr(key)), names)
    return names["sign"](address)


def in_an_hour():
    return int(time.time()) + 3600


class Signatures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.assets = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.assets.cleanup)
        files = {"keys-file": f"{KEY}\n{OTHER_KEY}\n", "presets": "small = look=clay&width=32&height=32\n"}
        cls.daemon = Daemon(files, "--token", "secret", "--assets-dir", cls.assets.name, "--max-per-private-client", "0")
        cls.addClassCleanup(cls.daemon.stop)
        cls.hash = hashlib.sha256(MODEL).hexdigest()
        cls.path = f"/v1/renders/{cls.hash}"
        status = cls.daemon.send(f"/v1/scenes/{cls.hash}", MODEL, "PUT", Authorization="Bearer secret")[0]
        assert status in (200, 201), status

    def detail(self, address, **headers):
        """Returns status and detail of a refusal."""
        status, _, data = self.daemon.send(address, **headers)
        return status, json.loads(data)["detail"]

    def test_signed(self):
        """a signed address draws by each key, without a token, and its picture is that of the query"""
        address = f"{self.path}?width=32&height=32&look=clay"
        pictures = set()
        for wanted in (sign(address), sign(address, OTHER_KEY), sign(f"{address}&exp={in_an_hour()}"), sign(f"{self.path}/small")):
            status, headers, data = self.daemon.send(wanted)
            self.assertEqual((status, headers["Content-Type"]), (200, "image/png"), data)
            pictures.add((headers["ETag"], data))
            self.assertEqual(self.daemon.send(wanted, If_None_Match=headers["ETag"])[0], 304)
            self.assertEqual(self.daemon.send(wanted, method="HEAD")[0], 200)
        self.assertEqual(len(pictures), 1)

    def test_refused(self):
        """addresses without a signature, with a wrong one and with one that has expired are refused, and each says why"""
        address = f"{self.path}?look=clay&width=32"
        wrong = (403, "the signature does not match this address")
        self.assertEqual(self.detail(address), (403, "this address needs a signature, or a token"))
        self.assertEqual(self.detail(address, Authorization="Bearer wrong"), (403, "this address needs a signature, or a token"))
        self.assertEqual(self.detail(sign(address, "0" * 32)), wrong)
        self.assertEqual(self.detail(sign(address).replace("width=32", "width=33")), wrong)
        self.assertEqual(self.detail(sign(f"{address}&exp=1")), (403, "the signature of this address has expired"))
        self.assertEqual(self.detail(sign(f"{address}&exp=1", "0" * 32)), wrong)
        for odd in (f"{address}&signature=", sign(address).upper().replace("SIGNATURE", "signature").replace("/V1/RENDERS", "/v1/renders"),
                    sign(address) + "&a=b", sign(sign(address)), sign(f"{address}&exp=soon"), sign(f"{address}&exp=9&exp=9")):
            status, detail = self.detail(odd)
            self.assertEqual((status, detail.split(",")[0]), (403, "the last parameter of the address is signature"), odd)
        self.assertEqual(self.daemon.send(f"{self.path}/small", method="HEAD")[0], 403)

    def test_token(self):
        """a token stands for a signature; only shared caches must not keep the answer"""
        address = f"{self.path}?look=clay@1&width=32"
        status, headers, data = self.daemon.send(address, Authorization="Bearer secret")
        self.assertEqual((status, headers["Cache-Control"]), (200, "private, max-age=31536000, immutable"), data)
        status, headers, data = self.daemon.send(sign(address))
        self.assertEqual((status, headers["Cache-Control"]), (200, "public, max-age=31536000, immutable"), data)
        self.assertEqual(self.detail(sign(address, "0" * 32), Authorization="Bearer secret")[0], 403)
        asset = self.daemon.send(f"/v1/assets/{self.hash}", Authorization="Bearer secret")
        self.assertEqual((asset[0], asset[1]["Cache-Control"], asset[2]), (200, "private, max-age=31536000, immutable", MODEL))
        self.assertEqual(self.daemon.send(sign(f"/v1/assets/{self.hash}"))[0], 401)

    def test_end(self):
        """caches keep an answer no longer than its address is valid"""
        address = f"{self.path}?look=clay@1&width=32&exp={int(time.time()) + 100}"
        for headers in ({}, {"If_None_Match": self.daemon.send(sign(address))[1]["ETag"]}):
            caching = self.daemon.send(sign(address), **headers)[1]["Cache-Control"]
            match = re.fullmatch(r"public, max-age=(\d+), immutable, must-revalidate", caching)
            self.assertTrue(match and 60 < int(match[1]) <= 100, caching)

    def test_preset(self):
        """the picture of a preset may change, so caches ask again; an unknown one is refused with the known ones"""
        self.assertEqual(self.daemon.send(sign(f"{self.path}/small"))[1]["Cache-Control"], "public, max-age=300")
        status, detail = self.detail(sign(f"{self.path}/large"))
        self.assertEqual((status, detail), (404, "there is no preset 'large'; there are: small"))

    def test_log(self):
        """the log has no signature, be it right or wrong"""
        texts = [sign(f"{self.path}?look=clay&width=32&exp={in_an_hour()}"), sign(f"{self.path}?look=clay&exp=1"), sign(self.path, "0" * 32)]
        for text in texts:
            self.daemon.send(text)
        self.daemon.reload()
        lines = self.daemon.log()
        self.assertIn('"query":"look=clay&width=32"', lines)
        for secret in [text[-64:] for text in texts] + [KEY, OTHER_KEY]:
            self.assertNotIn(secret, lines)

    def test_mutants(self):
        """mutated addresses are not accepted"""
        numbers = random.Random(1)
        signed = sign(f"{self.path}?look=clay&width=32&exp={in_an_hour()}")
        connection = http.client.HTTPConnection(self.daemon.address.split("//")[1])
        statuses = collections.Counter()
        for _ in range(int(os.environ.get("GATE_MUTANTS", "2000"))):
            at, letter = numbers.randrange(1, len(signed)), numbers.choice("0123456789abcdefgzAZ&=?/%.-_~")
            mutant = numbers.choice((signed[:at] + letter + signed[at + 1:], signed[:at] + letter + signed[at:], signed[:at] + signed[at + 1:]))
            if mutant == signed or mutant.startswith("/?"):  # the page
                continue
            connection.request("GET", mutant)
            answer = connection.getresponse()
            answer.read()
            statuses[answer.status] += 1
        connection.close()
        self.assertLessEqual(set(statuses), {401, 403}, statuses)
        print(f"# {dict(statuses)}")

    def test_without_keys(self):
        """a daemon without keys refuses signatures, and draws for everybody or for holders of its token"""
        for flags, unsigned in (((), 200), (("--token", "secret"), 401)):
            server = Daemon({}, "--assets-dir", self.assets.name, *flags)
            self.addCleanup(server.stop)
            status, _, data = server.send(sign(f"{self.path}?look=clay&width=32"))
            self.assertEqual((status, json.loads(data)["detail"]),
                             (403, "this daemon has no keys for signatures; start zrasterd with --keys-file"))
            self.assertEqual(server.send(f"{self.path}?look=clay&width=32")[0], unsigned)

    def test_rotation(self):
        """SIGHUP takes keys in and out"""
        server = Daemon({"keys-file": f"{KEY}\n"}, "--assets-dir", self.assets.name)
        self.addCleanup(server.stop)
        old, new = sign(f"{self.path}?look=clay&width=32"), sign(f"{self.path}?look=clay&width=32", OTHER_KEY)
        self.assertEqual([server.send(address)[0] for address in (old, new)], [200, 403])
        server.write("keys-file", f"{OTHER_KEY}\n{KEY}\n")
        self.assertEqual(server.reload()["detail"], "tokens: 0, keys: 2 (before: 1), presets: 0")
        self.assertEqual([server.send(address)[0] for address in (old, new)], [200, 200])
        server.write("keys-file", f"{OTHER_KEY}\n")
        server.reload()
        self.assertEqual([server.send(address)[0] for address in (old, new)], [403, 200])

    def test_page_in_other_languages(self):
        """the page's examples for the shell and JavaScript sign as that for Python"""
        address = f"{self.path}?look=clay&width=32"
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "keys"), "w", encoding="utf-8") as file:
                file.write(f"{KEY}\n")
            (block,) = page_blocks("js")
            with open(os.path.join(folder, "sign.mjs"), "w", encoding="utf-8") as file:
                file.write(f"{block}\nprocess.stdout.write(sign(process.argv[2]));\n")
            (line,) = {line for shell in page_blocks("sh") for line in shell.splitlines() if line.startswith("signature=")}
            shell = f'address="$1"\n{line}\nprintf %s "$address&signature=$signature"\n'
            commands = [["sh", "-ec", shell, "sh"]] + ([["node", "sign.mjs"]] if shutil.which("node") else [])
            for command in commands:
                run = subprocess.run([*command, address], cwd=folder, capture_output=True, text=True, check=True)
                self.assertEqual(run.stdout, sign(address))


class OnlyPresets(unittest.TestCase):
    def test_only_presets(self):
        """with --only-presets, an address has the name of a preset and no parameters"""
        with tempfile.TemporaryDirectory() as assets:
            files = {"presets": "small = look=clay&width=32&height=32\nlarge = look=clay\n", "keys-file": f"{KEY}\n"}
            server = Daemon(files, "--assets-dir", assets, "--only-presets", "on")
            self.addCleanup(server.stop)
            path = f"/v1/renders/{hashlib.sha256(MODEL).hexdigest()}"
            server.send(path.replace("renders", "scenes"), MODEL, "PUT")
            self.assertEqual(server.send(sign(f"{path}/small"))[0], 200)
            self.assertEqual(server.send(sign(f"{path}/small?exp={in_an_hour()}"))[0], 200)
            for refused in (path, f"{path}?look=clay", f"{path}/small?width=33"):
                status, _, data = server.send(sign(refused))
                wanted = "this daemon draws addresses with a preset and without parameters: /v1/renders/{sha256}/PRESET; there are: small, large"
                self.assertEqual((status, json.loads(data)["detail"]), (403, wanted), refused)
            server.write("presets", "tiny = look=clay&width=8&height=8\n")
            server.reload()
            self.assertEqual([server.send(sign(f"{path}/{name}"))[0] for name in ("small", "tiny")], [404, 200])


if __name__ == "__main__":
    unittest.main()
