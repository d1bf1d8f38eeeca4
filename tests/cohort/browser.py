"""Chromium without a window, by WebDriver (https://www.w3.org/TR/webdriver2/) alone."""
import json
import re
import shutil
import subprocess
import urllib.request

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")


class Browser:
    def __init__(self, downloads):
        self.driver = subprocess.Popen([DRIVER, "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        line = next(one for one in self.driver.stdout if "started successfully on port" in one)
        self.base = "http://127.0.0.1:" + re.search(r"port (\d+)", line).group(1)
        options = {"binary": CHROMIUM, "args": ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1400,900"],
                   "prefs": {"download.default_directory": str(downloads)}}
        answer = self.ask("POST", "/session", {"capabilities": {"alwaysMatch": {"browserName": "chrome", "goog:chromeOptions": options}}})
        self.base += "/session/" + answer["sessionId"]

    def ask(self, method, path, body=None):
        request = urllib.request.Request(self.base + path, method=method, headers={"Content-Type": "application/json"},
                                         data=None if body is None else json.dumps(body).encode())
        with urllib.request.urlopen(request, timeout=120) as answer:
            return json.loads(answer.read())["value"]

    def open(self, url):
        self.ask("POST", "/url", {"url": url})

    def run(self, script):
        """Body of a function whose result is handed back."""
        return self.ask("POST", "/execute/sync", {"script": script, "args": []})

    def run_until_told(self, script):
        """Likewise; the result is what it calls `done` with."""
        return self.ask("POST", "/execute/async", {"script": "const done = arguments[arguments.length - 1];" + script, "args": []})

    def keys(self, text):
        actions = [{"type": kind, "value": key} for key in text for kind in ("keyDown", "keyUp")]
        self.ask("POST", "/actions", {"actions": [{"type": "key", "id": "keyboard", "actions": actions}]})

    def wait(self, script):
        self.run_until_told(f"const look = () => {{ const value = (() => {{ {script} }})(); if (value) done(value); else setTimeout(look, 20); }}; look();")

    def close(self):
        try:
            self.ask("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait(30)
