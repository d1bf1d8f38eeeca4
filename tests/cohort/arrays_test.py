#!/usr/bin/env python3
"""The plan of arrays.py: which scans are in which array, what is asked for, what is submitted; with a script in the place of sbatch.

Usage: arrays_test.py WORKFLOW
"""
import hashlib
import json
import os
import pathlib
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

WORKFLOW = pathlib.Path(sys.argv[1]).resolve()
ARRAYS = WORKFLOW / "arrays.py"
OSTIA = """#!/bin/sh
[ "$1" = --version ] && echo "ostia ${OSTIA_TEST_VERSION:-1.2.3}" && exit 0
[ -e "$(dirname "$0")/short" ] && exit 5
exit 3
"""
SBATCH = """#!/bin/sh
[ "$1" = --version ] && echo "slurm 22.05.8" && exit 0
echo "$@" >> "$(dirname "$0")/submitted"
cat >> "$(dirname "$0")/scripts"
wc -l < "$(dirname "$0")/submitted"
"""


class Arrays(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        for name, text in (("ostia", OSTIA), ("sbatch", SBATCH)):
            (self.folder / name).write_text(text)
            (self.folder / name).chmod(0o755)
        self.cohort = self.folder / "a study"

    def begin(self, scans):
        private = self.folder / "a study.private"
        for folder in (self.cohort / "logs", private):
            folder.mkdir(parents=True)
        (self.folder / "scan.nrrd").write_text("x")
        self.scans = ["p-" + hashlib.sha1(str(i).encode()).hexdigest()[:20] for i in range(scans)]
        self.fill(self.cohort / "cohort.sqlite", "scan(number INTEGER PRIMARY KEY, pseudonym TEXT, patient TEXT, kind TEXT)", [(i + 1, scan, "p-1", "mask") for i, scan in enumerate(self.scans)])
        self.fill(private / "sources.sqlite", "source(pseudonym TEXT, scan TEXT, kind TEXT, series TEXT)", [(scan, str(self.folder / "scan.nrrd"), "mask", "") for scan in self.scans])

    def fill(self, file, table, rows):
        with sqlite3.connect(file) as database:
            database.execute(f"CREATE TABLE {table}")
            database.executemany(f"INSERT INTO {table.partition('(')[0]} VALUES({','.join('?' * len(rows[0]))})", rows)
        database.close()

    def run_it(self, *more, code=0, **variables):
        environment = {**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}", **variables}
        done = subprocess.run([sys.executable, "-B", ARRAYS, self.cohort, "--ostia", self.folder / "ostia", *map(str, more)], env=environment, capture_output=True, text=True, timeout=280, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout + done.stderr

    def planned(self, run, number=1):
        folder = self.cohort / "logs/arrays" / str(run) / str(number)
        told = json.loads((folder / "plan.json").read_text())
        return told, [[line.split() for line in (folder / f"{i}.txt").read_text().splitlines()] for i in range(len(told))]

    def submitted(self):
        file = self.folder / "submitted"
        return file.read_text().splitlines() if file.exists() else []

    def do_task(self, array, task, number=1):
        self.run_it("--run", 1, "--round", number, "--array", array, SLURM_ARRAY_TASK_ID=str(task))

    def test_every_scan_is_in_one_task_of_arrays_that_slurm_takes(self):
        self.begin(2503)
        self.run_it("--dry-run", "--scans-per-task", 2)
        told, arrays = self.planned("dry")
        self.assertEqual([len(tasks) for tasks in arrays], [1000, 252])
        self.assertEqual([one["tasks"] for one in told], [1000, 252])
        self.assertEqual(sorted(scan for tasks in arrays for task in tasks for scan in task), sorted(self.scans))
        self.assertEqual(self.submitted(), [])

    def test_a_hundred_thousand_are_planned_in_five_minutes(self):
        self.begin(100000)
        begun = time.monotonic()
        self.run_it("--dry-run", "--scans-per-task", 1)
        self.assertLess(time.monotonic() - begun, 300)
        _, arrays = self.planned("dry")
        self.assertEqual((len(arrays), {len(tasks) for tasks in arrays}), (100, {1000}))

    def test_arrays_are_submitted_and_behind_them_what_plans_again(self):
        self.begin(5)
        self.run_it("--scans-per-task", 2, "--tasks-per-array", 2, "--tasks-at-once", 1)
        lines = self.submitted()
        self.assertEqual([word for line in lines for word in line.split() if word.startswith(("0-", "afterany"))], ["0-1%1", "0-0%1", "afterany:1:2"])
        self.assertEqual(json.loads((self.cohort / "logs/runs/1.json").read_text())["engine"]["name"], "slurm")
        for file in (path for path in self.cohort.rglob("*") if path.is_file()):
            self.assertNotIn(str(self.folder).encode(), file.read_bytes(), file)  # no path in what may be shared

    def test_what_was_short_is_asked_for_anew_with_twice_as_much_and_at_last_recorded(self):
        self.begin(2)
        (self.folder / "short").touch()
        self.run_it("--retries", 1, "--scans-per-task", 1)
        first, _ = self.planned(1)
        self.do_task(0, 0)
        self.assertFalse((self.cohort / "logs" / self.scans[0] / "import.json").exists())
        self.run_it("--run", 1, "--round", 2, "--retries", 1, "--scans-per-task", 1)
        second, arrays = self.planned(1, 2)
        self.assertEqual(arrays, [[[self.scans[1]], [self.scans[0]]]])  # by what they need
        self.assertGreater(second[0]["minutes"], first[0]["minutes"])
        self.assertIn("--retries 1", (self.folder / "scripts").read_text())
        self.run_it("--run", 1, "--round", 2, "--array", 0, "--retries", 1, SLURM_ARRAY_TASK_ID="1")
        record = json.loads((self.cohort / "logs" / self.scans[0] / "import.json").read_text())
        self.assertEqual((record["exit_code"], record["attempt"]), (5, 2))

    def test_what_is_done_is_not_planned_again_and_the_end_is_recorded(self):
        self.begin(3)
        self.run_it("--scans-per-task", 3)
        self.do_task(0, 0)
        self.assertEqual({path.name for path in (self.cohort / "logs" / self.scans[0]).glob("*.json")},
                         {f"{stage}.json" for stage in ("import", "extract", "lumen", "mesh", "measures", "pressure")})
        before = len(self.submitted())
        self.assertIn("round 2: 0 scans", self.run_it("--run", 1, "--round", 2))
        self.assertEqual(len(self.submitted()), before)
        self.assertTrue(json.loads((self.cohort / "logs/runs/1.json").read_text())["well"])

    def test_with_a_gate_what_follows_a_case_is_not_planned(self):
        self.begin(1)
        self.run_it("--needs-review")
        self.run_it("--run", 1, "--round", 1, "--array", 0, "--needs-review", SLURM_ARRAY_TASK_ID="0")
        self.assertEqual({path.name for path in (self.cohort / "logs" / self.scans[0]).glob("*.json")}, {"import.json", "extract.json"})

    def test_another_version_of_the_program_is_refused_unless_it_is_wanted(self):
        self.begin(1)
        self.run_it()
        said = self.run_it(OSTIA_TEST_VERSION="1.3.0", code=1)
        self.assertIn("worked on by Ostia 1.2.3, and this is 1.3.0", said)
        self.run_it("--other-version", OSTIA_TEST_VERSION="1.3.0")
        self.assertEqual(json.loads((self.cohort / "logs/runs/2.json").read_text())["program"], "1.3.0")

    def test_a_scratch_disk_that_takes_nothing_ends_the_task_before_anything_is_recorded(self):
        self.begin(1)
        self.run_it()
        self.run_it("--run", 1, "--round", 1, "--array", 0, "--scratch", self.folder / "gone", SLURM_ARRAY_TASK_ID="0", code=1)
        self.assertFalse((self.cohort / "logs" / self.scans[0]).exists())

    def test_what_is_no_cohort_or_no_array_is_refused(self):
        self.begin(1)
        self.assertIn("--tasks-per-array is 1 to 1000", self.run_it("--tasks-per-array", 1001, code=2))
        (self.cohort / "cohort.sqlite").unlink()
        self.assertIn("is no cohort", self.run_it(code=2))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
