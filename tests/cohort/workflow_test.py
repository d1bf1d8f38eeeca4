#!/usr/bin/env python3
"""Three synthetic patients and a scan that holds no heart through the whole workflow: once in one go, once killed in the middle
and gone on with. Every scan ends whole or named, and both runs come to the same bits.

Usage: workflow_test.py OSTIA SOURCE
"""
import hashlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

OSTIA, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
WORKFLOW = SOURCE / "apps/ostia/workflow"
sys.path[:0] = [str(SOURCE / "tests/docs"), str(SOURCE / "tests/cohort")]
import cohort_results  # noqa: E402
import small_files  # noqa: E402

if not shutil.which("snakemake"):
    print("skipped: needs snakemake")
    sys.exit(77)


def ostia(*words, codes=(0,)):
    done = subprocess.run([OSTIA, *map(str, words)], capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode in codes, f"{words}: {done.returncode}: {done.stderr}"
    return done.stdout


def snakemake(cohort, *more):
    return ["snakemake", "-s", str(WORKFLOW / "Snakefile"), "--profile", str(WORKFLOW / "profiles/local"), "--directory", str(cohort.parent / "work"),
            "--config", f"cohort={cohort}", f"ostia={OSTIA}", *more]


def status(cohort):
    return json.loads(ostia("cohort", "status", cohort, "--verify", "--json"))


class Workflow(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        small_files.write_mask(self.folder / "one's.nrrd")
        for number, voxel in (("two", 0.55), ("three", 0.6)):  # the same vessel, larger
            cohort_results.write_grown_mask(self.folder / f"{number}.nrrd", voxel)
        small_files.write_image(self.folder / "chestless.nrrd")
        (self.folder / "scans.csv").write_text("id,scan,kind\n1,one's.nrrd,mask\n2,two.nrrd,mask\n3,three.nrrd,mask\n4,chestless.nrrd,image\n")
        (self.folder / "work").mkdir()

    def cohort(self, name):
        ostia("cohort", "init", self.folder / "scans.csv", "-o", self.folder / name)
        return self.folder / name

    def unlock(self, cohort):
        """A killed one has left its lock."""
        subprocess.run(snakemake(cohort, "--unlock"), check=False, capture_output=True)

    def finish(self, cohort):
        self.unlock(cohort)
        done = subprocess.run(snakemake(cohort, "--cores", "2"), capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr[-3000:])

    def kill_in_the_middle(self, cohort, records):
        """Everything at once, as when a machine goes down."""
        self.unlock(cohort)
        running = subprocess.Popen(snakemake(cohort, "--cores", "2"), start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while running.poll() is None and len(list((cohort / "logs").glob("*/*.json"))) < records:
            time.sleep(0.05)
        self.assertIsNone(running.poll(), "it was done before it was killed")
        os.killpg(running.pid, signal.SIGKILL)
        running.wait()

    def test_what_follows_a_case_waits_for_a_person_and_is_made_of_what_that_person_corrected(self):
        (self.folder / "one.csv").write_text("id,scan,kind\n1,one's.nrrd,mask\n")
        cohort = self.folder / "gated"
        ostia("cohort", "init", self.folder / "one.csv", "-o", cohort)

        def go_on():
            done = subprocess.run(snakemake(cohort, "needs_review=true", "--cores", "2"), capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr[-3000:])
            return done.stdout + done.stderr, {stage["stage"]: stage["ok"] + stage["quality"] for stage in status(cohort)["stages"]}
        said, done = go_on()
        self.assertIn("1 scans wait for a person's OK", said)
        self.assertEqual((done["extract"], done["lumen"], done["pressure"]), (1, 0, 0))
        case = next((cohort / "cases").glob("p-*/case.ostia"))
        made = json.loads((case.parent / "manifest.json").read_text())["outputs"]["case.ostia"]
        for signed in ("A", "B"):  # each changes the case, as a correction does
            (self.folder / "words.txt").write_text(f"as {signed} sees it")
            ostia("report", case, "-o", self.folder / f"report{signed}", "--impression", self.folder / "words.txt", "--sign", signed, "--date", "2026-03-01", "--change", "checked", codes=(0, 4))
            review = {"scan": case.parent.name, "verdict": "ok", "reader": signed, "time": "2026-03-01T12:00:00Z", "made": made}
            (self.folder / "reviews.json").write_text(json.dumps({"v": 1, "kind": "cohort reviews", "reviews": [review]}))
            ostia("cohort", "review", cohort, self.folder / "reviews.json")
            _, done = go_on()
            self.assertEqual(set(done.values()), {1}, done)
            of_lumen = json.loads(next((cohort / "lumens").glob("p-*/manifest.json")).read_text())["inputs"]
            self.assertEqual(list(of_lumen.values()), [hashlib.sha256(case.read_bytes()).hexdigest()])

    def test_killed_and_gone_on_with_it_comes_to_the_same(self):
        whole = self.cohort("whole")
        self.finish(whole)
        killed = self.cohort("killed")
        for records in (3, 9):
            self.kill_in_the_middle(killed, records)
        self.finish(killed)
        for cohort in (whole, killed):
            told = status(cohort)
            self.assertEqual((told["scans"], told["whole"]), (4, 3), told)
            self.assertEqual([(one["stage"], one["exit_code"], one["scans"]) for one in told["reasons"]], [("extract", 3, 1)])
            self.assertEqual(cohort_results.half_made(cohort), [])
        expected, found = cohort_results.results(whole), cohort_results.results(killed)
        self.assertEqual(len(expected), 3 * 6 + 1)
        self.assertEqual(found.keys(), expected.keys())
        for key, digests in expected.items():
            self.assertEqual(found[key], digests, key)
        for cohort in (whole, killed):
            ostia("cohort", "table", cohort, "-o", f"{cohort}.tables")
        rows = [len((self.folder / f"{name}.tables/measures.csv").read_text().splitlines()) for name in ("whole", "killed")]
        self.assertEqual(rows[0], rows[1])
        self.assertGreater(rows[0], 3 * 4)
        shared = b"".join(p.read_bytes() for p in killed.rglob("*") if p.is_file())
        for secret in (b"one's", b"chestless", str(self.folder).encode()):
            self.assertNotIn(secret, shared)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
