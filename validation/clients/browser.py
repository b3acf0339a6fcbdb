"""Chromium without a window, driven through a pipe by its DevTools protocol: one JSON text each way, ended by a zero byte."""

import base64
import json
import os
import shutil
import subprocess
import tempfile
import time

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
FLAGS = (
    "--headless --no-sandbox --disable-gpu --no-first-run --disable-background-networking --disable-sync "
    "--disable-component-update --enable-unsafe-swiftshader --hide-scrollbars --force-color-profile=srgb "
    "--remote-debugging-pipe"
).split()


def installed():
    """The path of a browser, or none."""
    return next((path for path in map(shutil.which, NAMES) if path), None)


class Browser:
    """A page of a size in a browser of its own, without a network."""

    def __init__(self, size=(800, 600), flags=()):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_read, self.to = os.pipe()
        self.back, to_write = os.pipe()

        def connect():
            # The protocol goes through the files 3 and 4; both may be taken by the pipes themselves.
            read, write = os.dup(to_read), os.dup(to_write)
            os.dup2(read, 3)
            os.dup2(write, 4)

        words = [installed(), *FLAGS, f"--window-size={size[0]},{size[1]}", f"--user-data-dir={self.folder.name}", *flags]
        self.process = subprocess.Popen(
            words, preexec_fn=connect, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        os.close(to_read)
        os.close(to_write)
        self.number, self.session, self.rest, self.requests, self.said = 0, None, b"", [], []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")
        self.resize(size)
        offline = dict(offline=True, latency=0, downloadThroughput=0, uploadThroughput=0)
        self.call("Network.emulateNetworkConditions", **offline)

    def resize(self, size):
        self.call("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1, mobile=False)

    def call(self, method, **params):
        """Calls a method of the protocol."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.to, json.dumps(message).encode() + b"\0")
        while True:
            reply = self.message()
            if reply.get("id") == self.number:
                assert "error" not in reply, (method, reply)
                return reply["result"]
            self.note(reply)

    def message(self):
        while b"\0" not in self.rest:
            more = os.read(self.back, 1 << 20)
            assert more, "the browser ended"
            self.rest += more
        text, self.rest = self.rest.split(b"\0", 1)
        return json.loads(text)

    def note(self, event):
        """Keeps what the page asks for and what it says."""
        params = event.get("params", {})
        if event["method"] == "Network.requestWillBeSent":
            self.requests.append(params["request"]["url"])
        elif event["method"] == "Runtime.exceptionThrown":
            self.said.append(json.dumps(params["exceptionDetails"])[:2000])
        elif event["method"] == "Runtime.consoleAPICalled":
            self.said.append(str([a.get("value", a.get("description")) for a in params["args"]]))
        elif event["method"] == "Log.entryAdded" and params["entry"]["level"] == "error":
            self.said.append(params["entry"]["text"])

    def open(self, address):
        self.call("Page.navigate", url=address)

    def evaluate(self, expression):
        """The value of an expression of JavaScript; promises are waited for."""
        reply = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in reply, (expression, reply)
        return reply["result"].get("value")

    def wait_for(self, expression, seconds=240):
        """Waits until an expression is true."""
        until = time.time() + seconds
        guarded = f"(() => {{ try {{ return ({expression}) || null }} catch {{ return null }} }})()"
        while True:
            value = self.evaluate(guarded)
            if value is not None:
                return value
            shown = self.evaluate("document.body.innerText")
            assert time.time() < until, (expression, shown, self.said)
            time.sleep(0.2)

    def drag(self, start, end, button="left"):
        """Drags from one place to another."""
        mask = {"left": 1, "right": 2}[button]

        def mouse(kind, place, buttons):
            params = dict(type=kind, x=place[0], y=place[1], button=button, buttons=buttons, clickCount=1)
            self.call("Input.dispatchMouseEvent", **params)

        mouse("mousePressed", start, mask)
        for part in (0.5, 1.0):
            mouse("mouseMoved", [a + part * (b - a) for a, b in zip(start, end)], mask)
        mouse("mouseReleased", end, 0)

    def wheel(self, place, delta):
        self.call("Input.dispatchMouseEvent", type="mouseWheel", x=place[0], y=place[1], deltaX=0, deltaY=delta)

    def touch(self, kind, places):
        """Fingers at some places: `touchStart`, `touchMove` or `touchEnd`."""
        points = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(places)]
        self.call("Input.dispatchTouchEvent", type=kind, touchPoints=points)

    def key(self, key, modifiers=0):
        """Presses a key; 8 is Shift."""
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, modifiers=modifiers)

    def screenshot(self):
        """The bytes of a PNG."""
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])

    def close(self):
        self.process.terminate()
        self.process.wait()
        os.close(self.to)
        os.close(self.back)
        self.folder.cleanup()
