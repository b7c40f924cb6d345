"""Chromium shows animated PNG and WebP files: screenshots over time equal their frames. The screenshots stay in BUILD/browser.
The browser is driven through a pipe (the DevTools protocol), so it opens no port."""
import base64
import io
import json
import os
import shutil
import subprocess
import tempfile
import time
import unittest
import zipfile

import numpy
import support
from PIL import Image

BROWSER = shutil.which(os.environ.get("CHROMIUM", "chromium"))
OPTIONS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-dev-shm-usage", "--disable-background-networking",
           "--force-color-profile=srgb", "--force-device-scale-factor=1", "--remote-debugging-pipe"]  # fmt: skip
FRAMES, SECONDS, WIDTH, HEIGHT = 3, 2.1, 160, 120
SCENE = {
    "window": {"width": WIDTH, "height": HEIGHT},
    "turntable": {"frames": FRAMES, "seconds": SECONDS, "elevation": 20},
    "polygons": [
        {"vertices": [[-1, -1, 0], [1, -1, 0.5], [0, 1, 0]], "color": "#336699"},
        {"vertices": [[-1, 1, 0], [1, 1, 0.2], [0, -1, 0.3]], "color": "#cc8040"},
    ],
    "outputs": [
        {"channel": "color", "encoding": "png32"},
        {"channel": "color", "encoding": "apng"},
        {"channel": "color", "encoding": "webp", "lossless": True},
    ],
}


class Browser:
    """A browser with one page, while a `with` runs."""

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        (to_read, self.to), (self.back, back_write) = os.pipe(), os.pipe()

        def connect():  # the browser reads from 3 and writes to 4
            read, write = os.dup(to_read), os.dup(back_write)
            os.dup2(read, 3)
            os.dup2(write, 4)

        command = [BROWSER, *OPTIONS, f"--user-data-dir={self.folder.name}", "about:blank"]
        self.process = subprocess.Popen(command, preexec_fn=connect, pass_fds=(3, 4), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_read)
        os.close(back_write)
        self.count, self.rest, self.session = 0, b"", {}
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = {"sessionId": self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]}
        return self

    def call(self, method, **parameters):
        """Sends a command and returns its result. Events before it are left out."""
        self.count += 1
        message = {"id": self.count, "method": method, "params": parameters, **self.session}
        os.write(self.to, json.dumps(message).encode() + b"\0")
        while True:
            while b"\0" not in self.rest:
                got = os.read(self.back, 1 << 20)
                if not got:
                    raise RuntimeError("the browser has ended")
                self.rest += got
            text, self.rest = self.rest.split(b"\0", 1)
            answer = json.loads(text)
            if answer.get("id") == self.count:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]

    def screenshot(self):
        """Returns the PNG of the picture at the top left."""
        clip = {"x": 0, "y": 0, "width": WIDTH, "height": HEIGHT, "scale": 1}
        return base64.b64decode(self.call("Page.captureScreenshot", format="png", clip=clip)["data"])

    def evaluate(self, text):
        return self.call("Runtime.evaluate", expression=text, awaitPromise=True)["result"].get("value")

    def __exit__(self, *_):
        self.session = {}
        try:
            self.call("Browser.close")
            self.process.wait(20)
        except (RuntimeError, OSError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        os.close(self.to)
        os.close(self.back)
        self.folder.cleanup()


def pixels(data):
    return numpy.asarray(Image.open(io.BytesIO(data)).convert("RGB"))


@unittest.skipUnless(BROWSER, "there is no chromium")
class Animations(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = os.path.join(support.build, "browser")
        shutil.rmtree(cls.folder, ignore_errors=True)
        os.makedirs(cls.folder)
        with open(os.path.join(cls.folder, "scene.json"), "w") as file:
            json.dump(SCENE, file)
        subprocess.run([os.path.join(support.build, "zraster"), "scene.json", "-o", "all.zip"], cwd=cls.folder, check=True)
        with zipfile.ZipFile(os.path.join(cls.folder, "all.zip")) as files:
            files.extractall(cls.folder)
            cls.views = [pixels(files.read(f"{i + 1:04}.color.png")) for i in range(FRAMES)]

    def check(self, name):
        with Browser() as browser, open(os.path.join(self.folder, name + ".html"), "w") as page:
            page.write(f'<!DOCTYPE html><style>body{{margin:0}}img{{display:block}}</style><img src="{name}">')
            page.flush()
            browser.call("Page.enable")
            browser.call("Page.navigate", url=f"file://{self.folder}/{name}.html")
            within = time.monotonic() + 60
            while not browser.evaluate("document.images.length === 1 && document.images[0].complete"):
                self.assertLess(time.monotonic(), within, "the page does not load")
                time.sleep(0.05)
            self.assertEqual(browser.evaluate("document.images[0].naturalWidth"), WIDTH)
            seen = set()
            while len(seen) < FRAMES:
                self.assertLess(time.monotonic(), within, f"frames seen: {seen}")
                shot = browser.screenshot()
                found = [i for i, view in enumerate(self.views) if numpy.array_equal(pixels(shot), view)]
                self.assertEqual(len(found), 1, "a screenshot is no frame")
                if found[0] not in seen:
                    with open(os.path.join(self.folder, f"{name}.{found[0] + 1}.png"), "wb") as file:
                        file.write(shot)
                seen.update(found)
                time.sleep(0.05)

    def test_apng(self):
        """screenshots of an animated PNG are its frames, pixel for pixel, at several times"""
        self.check("color.apng")

    def test_webp(self):
        """so are those of an animated WebP"""
        self.check("color.webp")
