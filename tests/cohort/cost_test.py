#!/usr/bin/env python3
"""The cost of a large cohort from the steps of a small one, against sums by hand.

Usage: cost_test.py WORKFLOW
"""
import json
import pathlib
import sqlite3
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
import cost  # noqa: E402
import steps_done  # noqa: E402

SCANS = ["p-0123456789abcdef0123", "p-0123456789abcdef0124", "p-0123456789abcdef0125"]


class Cost(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.cohort = pathlib.Path(holder.name) / "study"
        self.cohort.mkdir()
        with sqlite3.connect(self.cohort / "cohort.sqlite") as database:
            database.execute("CREATE TABLE scan(number INTEGER, pseudonym TEXT)")
            database.executemany("INSERT INTO scan VALUES(?, ?)", enumerate(SCANS, 1))
        database.close()

    def make(self, scan, folder, seconds, peak_mb, size):
        (self.cohort / "logs" / scan).mkdir(parents=True, exist_ok=True)
        (self.cohort / folder / scan / "deep").mkdir(parents=True)
        (self.cohort / folder / scan / "manifest.json").write_text(json.dumps({"seconds": seconds, "peak_mb": peak_mb}))
        (self.cohort / folder / scan / "deep/result").write_bytes(b"x" * (size - (self.cohort / folder / scan / "manifest.json").stat().st_size))

    def test_it_is_the_sum_by_hand(self):
        self.make(SCANS[0], "inputs", 10.0, 100.0, 1000)
        self.make(SCANS[1], "inputs", 20.0, 200.0, 3000)
        self.make(SCANS[0], "meshes", 100.0, 4000.0, 10000)
        all_scans, done = steps_done.measured(self.cohort)
        self.assertEqual(all_scans, 2)  # the third was not begun
        found = cost.cost(done, all_scans, 1000, 10, 8, 10000)
        first, mesh = found["stages"]["import"], found["stages"]["mesh"]
        self.assertEqual((first["steps"], first["at_once"], mesh["steps"], mesh["at_once"]), (1000, 8, 500, 2))  # 10,000 MB hold two of 5,000
        self.assertAlmostEqual(first["node_hours"], 1000 * (15 + cost.OVERHEAD_S) / 8 / 3600)
        self.assertAlmostEqual(mesh["node_hours"], 500 * (100 + cost.OVERHEAD_S) / 2 / 3600)
        self.assertAlmostEqual(found["gb"], (1000 * 2000 + 500 * 10000) / 1e9)
        self.assertEqual(found["files"], 1000 * 4 + 500 * 4)
        self.assertAlmostEqual(found["days"], found["node_hours"] / 10 / 24)

    def test_a_step_that_is_larger_than_a_node_is_still_one(self):
        self.assertEqual(cost.at_once(32, 1000, 4000), 1)

    def ask(self, *more):
        return subprocess.run([sys.executable, "-B", f"{sys.argv[1]}/cost.py", self.cohort, *more], capture_output=True, text=True, timeout=60, check=False)

    def test_it_says_it_and_refuses_what_it_cannot_use(self):
        said = self.ask("--scans", "10", "--nodes", "1")
        self.assertEqual(said.returncode, 1)
        self.assertIn("has no step that is done", said.stderr)
        self.make(SCANS[0], "inputs", 10.0, 100.0, 1000)
        self.assertIn("| import | 1 | 10.4 | 100 | 32 |", self.ask("--scans", "10", "--nodes", "1").stdout)
        self.assertEqual(json.loads(self.ask("--scans", "10", "--nodes", "1", "--json").stdout)["steps"], 10)
        self.assertEqual(self.ask("--scans", "0", "--nodes", "1").returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
