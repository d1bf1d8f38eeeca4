#!/usr/bin/env python3
"""The page of a cohort in a browser: what it shows, how it filters and scrolls, and that a review comes back, from the disk by a file
and from the loopback at once.

Usage: page_browser_test.py OSTIA [ROWS]
"""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import browser  # noqa: E402
import simulated  # noqa: E402

OSTIA = pathlib.Path(sys.argv[1]).resolve()
ROWS = int(sys.argv[2]) if len(sys.argv) > 2 else 5000
MEASURED, FAILED = 120, 40

if not browser.CHROMIUM or not browser.DRIVER:
    print("skipped: needs chromium and chromedriver")
    sys.exit(77)

SHOWN_NAMES = "return [...document.querySelectorAll('.row, .tile')].filter(one => one.style.display !== 'none').map(one => one.querySelector('.name').textContent)"
COUNTS = "return document.getElementById('counts').textContent"
# Frames a second of two seconds of scrolling by the wheel, and the longest gap between two of them.
SCROLL = """
const scroller = document.getElementById('scroller'), times = [];
const step = now => {
  times.push(now);
  scroller.dispatchEvent(new WheelEvent('wheel', { deltaY: 400, cancelable: true }));
  if (now - times[0] < 2000) requestAnimationFrame(step);
  else done({ rate: 1000 * (times.length - 1) / (now - times[0]), longest: Math.max(...times.slice(1).map((time, i) => time - times[i])) });
};
requestAnimationFrame(step);"""


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.holder.cleanup)
        cls.folder = pathlib.Path(cls.holder.name)
        cls.cohort = simulated.begin(OSTIA, cls.folder, ROWS)
        cls.scans = simulated.scans_of(cls.cohort)
        for number in range(MEASURED):
            simulated.finish(cls.cohort, cls.scans[number], number)
        for number in range(FAILED):
            simulated.fail(cls.cohort, cls.scans[MEASURED + number], "import", 3, f"slice {number} is missing")
        cls.ostia("cohort", "page", cls.cohort)
        cls.browser = browser.Browser(cls.folder)
        cls.addClassCleanup(cls.browser.close)

    @classmethod
    def ostia(cls, *words):
        return subprocess.run([OSTIA, *map(str, words)], check=True, capture_output=True, text=True).stdout

    def open(self, url=None):
        self.browser.open(url or (self.cohort / "page/index.html").as_uri())
        self.browser.wait("return document.body.dataset.ready")
        self.browser.wait("return [...document.querySelectorAll('.row')].some(one => one.querySelector('.name').textContent.startsWith('p-'))")

    def click(self, selector, text):
        found = self.browser.run(f"const one = [...document.querySelectorAll({json.dumps(selector)})].find(one => one.textContent.includes({json.dumps(text)}));"
                                 "if (one) one.click(); return Boolean(one)")
        self.assertTrue(found, text)

    def status(self):
        return json.loads(self.ostia("cohort", "status", self.cohort, "--json"))["review"]

    def test_it_opens_from_the_disk_and_shows_scans_with_their_figures(self):
        self.open()
        self.assertIn(f"{ROWS} scans, {MEASURED} whole", self.browser.run(COUNTS))
        self.assertEqual(self.browser.run(SHOWN_NAMES)[:3], self.scans[:3])
        values = self.browser.run("return [...document.querySelector('[data-place=\"13\"]').querySelectorAll('.value')].map(one => one.textContent)")
        self.assertEqual(values, ["3", "2", "91", "13", "0.7833"])
        shown = self.browser.run("return document.documentElement.innerHTML")
        for secret in ("Jane", "slice.dcm", str(self.folder)):
            self.assertNotIn(secret, shown)

    def test_failures_states_and_bars_filter(self):
        self.open()
        self.click("#reasons button", "slice # is missing")
        self.assertIn(f"{FAILED} shown", self.browser.run(COUNTS))
        self.browser.wait(f"return document.querySelector('[data-place=\"0\"] .name').textContent === '{self.scans[MEASURED]}'")
        self.browser.keys("c")
        self.assertNotIn("shown", self.browser.run(COUNTS))
        self.browser.run("document.querySelectorAll('#measures .bars')[0].children[2].click()")  # areas from 1 to 1.5 mm2
        self.assertIn(f"{MEASURED // 12} shown", self.browser.run(COUNTS))
        self.click("#stages button", str(FAILED))  # failed at import, and measured: there is none
        self.assertIn("; 0 shown", self.browser.run(COUNTS))

    def test_a_scan_is_found_by_its_name(self):
        self.open()
        self.browser.run(f"const box = document.getElementById('search'); box.value = '{self.scans[ROWS - 1]}'; box.dispatchEvent(new Event('input'))")
        self.browser.wait(f"return [...document.querySelectorAll('.name')].some(one => one.textContent === '{self.scans[ROWS - 1]}')")

    def test_the_end_is_reached_and_scrolling_is_smooth(self):
        self.open()
        self.browser.run("document.getElementById('scroller').dispatchEvent(new KeyboardEvent('keydown', { key: 'End', bubbles: true }))")
        self.browser.wait(f"return [...document.querySelectorAll('.name')].some(one => one.textContent === '{self.scans[-1]}')")
        self.browser.run("const one = document.getElementById('scroller'); one.scrollTop = one.scrollHeight / 2")
        self.browser.wait("return [...document.querySelectorAll('.row')].filter(one => one.style.display !== 'none').every(one => one.querySelector('.name').textContent.startsWith('p-'))")
        middle = self.scans.index(self.browser.run(SHOWN_NAMES)[0])
        self.assertLess(abs(middle - ROWS / 2), 0.02 * ROWS + 40)
        told = self.browser.run_until_told(SCROLL)
        print(f"{ROWS} rows: {told['rate']:.0f} frames a second, the longest took {told['longest']:.0f} ms", flush=True)
        self.assertLess(self.browser.run("return document.querySelectorAll('.row').length"), 100)

    def test_the_wall_shows_pictures(self):
        self.open()
        self.browser.keys("w")
        self.browser.wait("return document.querySelectorAll('.tile img[src]').length > 10 && [...document.querySelectorAll('.tile img[src]')].every(one => one.complete)")
        self.assertEqual(self.browser.run("return document.querySelector('.tile img[src]').naturalWidth"), 320)

    def review(self, keys):
        self.browser.run("const box = document.getElementById('reader'); box.value = 'Zoë \"R\" <b>'; box.dispatchEvent(new Event('change'))")
        self.browser.keys(keys)

    def test_reviews_come_back_from_the_disk_by_a_file(self):
        before = self.status()
        self.open()
        self.browser.keys("o")
        self.assertIn("who you are", self.browser.run("return document.getElementById('told').textContent"))
        self.browser.run("document.activeElement.blur()")
        self.review("jjjoa")  # the fourth and the fifth
        self.browser.run("document.getElementById('export').click()")
        file = self.folder / "reviews.json"
        for _ in range(500):
            if file.exists():
                break
            time.sleep(0.02)
        told = [(one["scan"], one["verdict"], one["reader"]) for one in json.loads(file.read_text())["reviews"]]
        self.assertEqual(told, [(self.scans[3], "ok", 'Zoë "R" <b>'), (self.scans[4], "again", 'Zoë "R" <b>')])
        self.ostia("cohort", "review", self.cohort, file)
        after = self.status()
        self.assertEqual((after["ok"] - before["ok"], after["again"] - before["again"]), (1, 1))
        self.browser.run("localStorage.clear()")
        self.open()
        self.browser.wait("return document.querySelector('[data-place=\"3\"] .verdict').textContent === 'OK'")

    def test_on_the_loopback_they_are_written_at_once_and_nobody_else_may(self):
        server = subprocess.Popen([OSTIA, "cohort", "serve", self.cohort, "--json"], stdout=subprocess.PIPE, text=True)
        try:
            lines = ""
            while not lines.rstrip().endswith("}"):
                lines += server.stdout.readline()
            url = json.loads(lines)["url"]
            before = self.status()
            self.open(url)
            self.review("jjjjjo")
            self.browser.wait("return document.querySelector('[data-place=\"5\"] .verdict').textContent === 'OK' && document.getElementById('export').disabled")
            self.assertEqual(self.status()["ok"], before["ok"] + 1)
            self.refusals(url)
        finally:
            server.send_signal(signal.SIGINT)
            self.assertEqual(server.wait(30), 0)
            server.stdout.close()

    def refusals(self, url):
        host, key = url.split("/")[2], url.split("/")[3]

        def code(path, **more):
            request = urllib.request.Request(f"http://{host}{path}", **more)
            try:
                with urllib.request.urlopen(request, timeout=10) as answer:
                    return answer.status
            except urllib.error.HTTPError as error:
                return error.code
        review = {"method": "POST", "data": b"{}"}
        kind = {"Content-Type": "application/json"}
        self.assertEqual(code(f"/{key}/page/index.html"), 200)
        self.assertEqual(code("/page/index.html"), 403)
        self.assertEqual(code(f"/{key}/page/index.html", headers={"Host": "evil.example"}), 403)
        self.assertEqual(code(f"/{key}/review", headers={**kind, "Origin": "http://evil.example"}, **review), 403)
        self.assertEqual(code(f"/{key}/review", headers={"Content-Type": "text/plain"}, **review), 405)
        self.assertEqual(code(f"/{key}/review", headers=kind, **review), 400)
        for path in ("cohort.sqlite", "../study.private/key", "page/../../study.private/key", "page/data/%2e%2e/cohort.sqlite", "logs"):
            self.assertEqual(code(f"/{key}/{path}"), 404, path)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
