"""Tokens, keys and presets from files, which SIGHUP reads anew; addresses with signatures."""
import http.client
import json
import os
import pty
import signal
import subprocess
import tempfile
import threading
import time
import unittest

import daemon

KEY, OTHER_KEY = "000102030405060708090a0b0c0d0e0f", "f" * 64
SCENE = b'{"polygons": [{"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}]}'
SECONDS = 30.0


class Daemon(daemon.Daemon):
    """A daemon whose files are given as {flag: text}, and whose log can be read."""

    def __init__(self, files, *flags):
        self.folder = tempfile.TemporaryDirectory()
        for flag, text in files.items():
            self.write(flag, text)
            flags += (f"--{flag}", self.path(flag))
        self.log = open(self.path("log"), "w+", encoding="utf-8")
        command = [os.path.join(daemon.build, "zrasterd"), "--port", "0", *flags]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=self.log, text=True)
        self.address = self.process.stdout.readline().split()[-1]

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, text):
        """Replaces a file in one step."""
        with open(self.path("new"), "w", encoding="utf-8") as file:
            os.chmod(self.path("new"), 0o600)
            file.write(text)
        os.rename(self.path("new"), self.path(name))

    def lines(self, event):
        with open(self.path("log"), encoding="utf-8") as log:
            lines = [json.loads(line) for line in log.read().splitlines(keepends=True) if line.endswith("\n")]
        return [line for line in lines if line.get("event") == event]

    def reload(self):
        """Sends SIGHUP. Returns the line of the log about it."""
        count, end = len(self.lines("reload")), time.monotonic() + SECONDS
        self.process.send_signal(signal.SIGHUP)
        while time.monotonic() < end:
            if len(self.lines("reload")) > count:
                return self.lines("reload")[count]
            time.sleep(0.005)
        raise AssertionError("SIGHUP was not logged")

    def status(self, token=None, path="/v1/limits"):
        return self.request(path, headers={"Authorization": f"Bearer {token}"} if token else {})[0]

    def stop(self):
        super().stop()
        self.log.close()
        self.folder.cleanup()
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
        for text, fault in (("other\nse cret\n", f"{path}:2: a token has printable ASCII without spaces"),
                            ("", f"{path}: the file has no entry"), (None, f"{path}: No such file or directory")):
            if text is None:
                os.unlink(path)
            else:
                server.write("token-file", text)
            line = server.reload()
            self.assertEqual((line["level"], line["detail"]), ("error", f"tokens, keys and presets stay as they were: {fault}"))
            self.assertEqual([server.status("secret"), server.status("other")], [200, 401])
        with open(server.path("log"), encoding="utf-8") as log:
            self.assertNotIn("secret", log.read())

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
        end, reloads = time.monotonic() + float(os.environ.get("GATE_SECONDS", "1")), 0
        while time.monotonic() < end:
            server.write("token-file", ("one\ntwo\n", "three\ntwo\none\n")[reloads % 2])
            server.reload()
            reloads += 1
        stop.set()
        for thread in threads:
            thread.join()
        self.assertEqual(set(statuses), {200})
        self.assertGreater(reloads, 10)
        print(f"# {reloads} reloads, {len(statuses)} requests")

    def test_terminal(self):
        """SIGHUP of a terminal that closes ends the daemon, as before it could be read anew"""
        main, terminal = pty.openpty()
        command = [os.path.join(daemon.build, "zrasterd"), "--port", "0"]
        process = subprocess.Popen(command, stdin=terminal, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(process.stdout.close)
        self.assertIn("listening", process.stdout.readline())
        process.send_signal(signal.SIGHUP)
        time.sleep(0.05)
        self.assertIsNone(process.poll())
        os.close(terminal)
        os.close(main)
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(SECONDS), 0)


if __name__ == "__main__":
    unittest.main()
