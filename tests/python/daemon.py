"""A daemon on a free port of 127.0.0.1, for tests that need only the standard library."""
import functools
import json
import os
import re
import subprocess
import tempfile
import unittest
import urllib.error
import urllib.request

build = os.environ["ZRASTER_BUILD"]


class Daemon:
    def __init__(self, *flags, log=subprocess.DEVNULL):
        command = [os.path.join(build, "zrasterd"), "--port", "0", *flags]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=log, text=True)
        self.address = re.search(r"http://\S+", self.process.stdout.readline()).group(0)

    def stop(self):
        self.process.terminate()
        self.process.wait()
        self.process.stdout.close()

    def request(self, path, body=None, headers=None, method=None):
        """Returns status, headers and bytes."""
        request = urllib.request.Request(self.address + path, body, headers or {}, method=method)
        try:
            with urllib.request.urlopen(request) as answer:
                return answer.status, answer.headers, answer.read()
        except urllib.error.HTTPError as error:
            with error:
                return error.code, error.headers, error.read()

    def send(self, path, body=None, method=None, **headers):
        """The same with headers as keywords: Content_Type="text/plain"."""
        return self.request(path, body, {name.replace("_", "-"): value for name, value in headers.items()}, method)


class Logged(Daemon):
    """A daemon whose log is read. It has a folder, in which the log is, too."""

    def __init__(self, *flags):
        with open(self.path("log"), "wb") as log:
            super().__init__(*flags, log=log)

    @functools.cached_property
    def folder(self):
        return tempfile.TemporaryDirectory()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def log(self):
        with open(self.path("log"), encoding="utf-8") as file:
            return file.read()

    def lines(self):
        """Returns the whole lines of the log, parsed."""
        return [json.loads(line) for line in self.log().splitlines(keepends=True) if line.endswith("\n")]

    def stop(self):
        super().stop()
        self.folder.cleanup()


class Case(unittest.TestCase):
    """Tests of one daemon, which the class starts with its flags: a Daemon, or a kind of it."""

    flags, kind = [], Daemon

    @classmethod
    def setUpClass(cls):
        cls.daemon = cls.kind(*cls.flags)
        cls.addClassCleanup(cls.daemon.stop)
