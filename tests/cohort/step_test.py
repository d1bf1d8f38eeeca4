#!/usr/bin/env python3
"""The workflow's step.py with scripts in the place of `ostia`: which ends are results, which are tried again, what is recorded.

Usage: step_test.py WORKFLOW
"""
import hashlib
import json
import os
import pathlib
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

STEP = pathlib.Path(sys.argv[1]).resolve() / "step.py"
SCAN = "p-0123456789abcdef0123"
ODD = "it's \"c\" $(touch x).nrrd"
ERROR = '{"level":"error","message":"no heart was found"}'


class Steps(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.cohort = self.folder / "a study"
        private = self.folder / "a study.private"
        self.cohort.mkdir()
        private.mkdir()
        self.scan = self.folder / ODD
        self.scan.write_text("voxels")
        self.fill(self.cohort / "cohort.sqlite", "CREATE TABLE scan(number INTEGER, pseudonym TEXT, patient TEXT, kind TEXT)", (1, SCAN, "p-1", "mask"))
        self.fill(private / "sources.sqlite", "CREATE TABLE source(number INTEGER, pseudonym TEXT, scan TEXT, kind TEXT, series TEXT)",
                  (1, SCAN, str(self.scan), "mask", ""))

    def fill(self, file, table, row):
        with sqlite3.connect(file) as database:
            database.execute(table)
            database.execute(f"INSERT INTO {table.split()[2].partition('(')[0]} VALUES({','.join('?' * len(row))})", row)
        database.close()

    def reviewed(self, *reviews):
        """Of a case whose digest is "made"."""
        (self.cohort / "cases" / SCAN).mkdir(parents=True, exist_ok=True)
        (self.cohort / "cases" / SCAN / "manifest.json").write_text(json.dumps({"outputs": {"case.ostia": "made"}}))
        with sqlite3.connect(self.cohort / "cohort.sqlite") as database:
            database.execute("CREATE TABLE IF NOT EXISTS review(number INTEGER PRIMARY KEY, scan INTEGER, verdict TEXT, reader TEXT, time TEXT, made TEXT, result TEXT)")
            for verdict, made in reviews:
                database.execute("INSERT INTO review(scan, verdict, reader, time, made, result) VALUES(1, ?, 'R', 'now', ?, 'corrected')", (verdict, made))
        database.close()

    def words(self, script, stage="import", attempt=1, more=()):
        program = self.folder / "ostia"
        program.write_text("#!/bin/sh\n" + script)
        program.chmod(0o755)
        return [sys.executable, "-B", STEP, self.cohort, SCAN, stage, "--ostia", program, "--attempt", str(attempt), "--most-attempts", "2", *more]

    def step(self, script, stage="import", attempt=1, more=()):
        return subprocess.run(self.words(script, stage, attempt, more), cwd=self.folder, capture_output=True, text=True, timeout=60, check=False)

    def record(self, stage="import"):
        file = self.cohort / "logs" / SCAN / f"{stage}.json"
        return json.loads(file.read_text()) if file.exists() else None

    def test_results_end_well_and_are_recorded(self):
        for code in (0, 3, 4):
            with self.subTest(code):
                self.assertEqual(self.step(f"echo '{ERROR}' >&2; exit {code}").returncode, 0)
                self.assertEqual(self.record()["exit_code"], code)
                self.assertIsNone(self.record()["input_sha256"])
        self.step(f"echo '{ERROR}' >&2; exit 3")
        self.assertEqual(self.record()["message"], "no heart was found")

    def test_a_name_that_needs_quoting_arrives_as_it_is(self):
        self.step(f"printf '%s\\n' \"$@\" > '{self.folder}/told'")
        self.assertIn(f"--set=scan={self.scan}", (self.folder / "told").read_text().splitlines())
        self.assertFalse((self.folder / "x").exists())

    def test_a_shortage_is_tried_again_and_recorded_at_last(self):
        for script, code, ended_by in (("exit 5", 5, None), ("kill -9 $$", None, 9)):
            with self.subTest(script):
                self.assertEqual(self.step(script, attempt=1).returncode, 5)
                self.assertIsNone(self.record())
                self.assertEqual(self.step(script, attempt=2).returncode, 0)
                self.assertEqual((self.record()["exit_code"], self.record()["signal"]), (code, ended_by))
                (self.cohort / "logs" / SCAN / "import.json").unlink()

    def test_faults_are_collected_with_the_inputs_digest(self):
        for script, code, ended_by in (("exit 6", 6, None), ("kill -11 $$", None, 11)):
            with self.subTest(script):
                self.assertEqual(self.step(script).returncode, 0)
                self.assertEqual((self.record()["exit_code"], self.record()["signal"]), (code, ended_by))
                self.assertEqual(self.record()["input_sha256"], hashlib.sha256(b"voxels").hexdigest())

    def test_what_takes_too_long_is_short_of_time(self):
        slow = "exec sleep 60"
        self.assertEqual(self.step(slow, more=("--seconds", "0.2")).returncode, 5)
        self.assertIsNone(self.record())
        self.assertEqual(self.step(slow, attempt=2, more=("--seconds", "0.2")).returncode, 0)
        self.assertEqual((self.record()["exit_code"], self.record()["message"]), (5, "stopped: it took longer than 0.2 s"))

    def test_what_follows_a_case_waits_for_a_persons_ok(self):
        gate = ("--needs-review",)
        self.assertEqual(self.step("exit 0", more=gate).returncode, 0)
        self.assertEqual(self.step("exit 0", stage="extract", more=gate).returncode, 0)
        for reviews in ((), (("again", "made"),), (("ok", "made of another"),), (("ok", "made"), ("again", "made")), (("none", "made"),)):
            with self.subTest(reviews):
                self.reviewed(*reviews)
                self.assertEqual(self.step("exit 0", stage="lumen", more=gate).returncode, 1)
                self.assertIsNone(self.record("lumen"))
        self.reviewed(("ok", "made"))
        self.assertEqual(self.step("exit 0", stage="lumen", more=gate).returncode, 0)
        self.assertEqual(self.record("lumen")["exit_code"], 0)

    def test_a_second_one_waits_until_the_first_is_done(self):
        """Both write when they begin and end; between a beginning and its end there is nothing else."""
        told = self.folder / "told"
        words = self.words(f"echo begin >> '{told}'; sleep 0.3; echo end >> '{told}'")
        both = [subprocess.Popen(words) for _ in range(2)]
        self.assertEqual([one.wait(60) for one in both], [0, 0])
        self.assertEqual(told.read_text().split(), ["begin", "end"] * 2)

    def test_what_has_no_result_before_it_is_left_out(self):
        self.step("exit 3")
        self.assertEqual(self.step("exit 0", stage="extract").returncode, 0)
        self.assertIsNone(self.record("extract")["exit_code"])
        self.assertEqual(self.record("extract")["message"], "left out: import has no result")
        self.step("exit 4")
        self.step("exit 0", stage="extract")
        self.assertEqual(self.record("extract")["exit_code"], 0)

    def test_a_step_that_is_stopped_records_nothing_and_its_command_ends(self):
        for number in (signal.SIGTERM, signal.SIGKILL):
            with self.subTest(number):
                pid_file = self.folder / "pid"
                pid_file.unlink(missing_ok=True)
                step = subprocess.Popen(self.words(f"echo $$ > '{pid_file}.part'; mv '{pid_file}.part' '{pid_file}'; exec sleep 60"))
                while not pid_file.exists():
                    time.sleep(0.02)
                step.send_signal(number)
                step.wait(60)
                child = int(pid_file.read_text())
                while self.lives(child):  # the test's own limit ends this
                    time.sleep(0.02)
                self.assertIsNone(self.record())

    def lives(self, pid):
        try:
            os.kill(pid, 0)
        except ProcessLookupError:
            return False
        status = pathlib.Path(f"/proc/{pid}/stat")
        try:
            return status.read_text().rpartition(")")[2].split()[0] != "Z"
        except FileNotFoundError:
            return False


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
