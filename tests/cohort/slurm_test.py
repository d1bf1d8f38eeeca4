#!/usr/bin/env python3
"""Synthetic patients through the whole workflow on a Slurm of one node, whose jobs and controller are killed at random moments:
every patient ends whole or named, none is lost, none is done twice, nothing is half there, and the bits are those of a run on
this machine alone.

Usage: slurm_test.py OSTIA SOURCE [PATIENTS] [KILLS] [SEED]
"""
import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest

OSTIA, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
PATIENTS, KILLS, SEED = (int(sys.argv[i]) if len(sys.argv) > i else usual for i, usual in ((3, 4), (4, 4), (5, 1)))
sys.path[:0] = [str(SOURCE / "tests/docs"), str(SOURCE / "tests/cohort")]
import cohort_results  # noqa: E402
import slurm_cluster  # noqa: E402
import small_files  # noqa: E402

if slurm_cluster.missing() or not shutil.which("snakemake"):
    print(f"skipped: needs {slurm_cluster.missing() or 'snakemake'}")
    sys.exit(77)


class Slurm(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        lines = ["id,scan,kind"]
        for number in range(PATIENTS):
            cohort_results.write_grown_mask(self.folder / f"{number}.nrrd", 0.5 + 0.3 * number / PATIENTS)
            lines.append(f"{number},{number}.nrrd,mask")
        small_files.write_image(self.folder / "chestless.nrrd")
        lines.append("heartless,chestless.nrrd,image")
        (self.folder / "scans.csv").write_text("\n".join(lines) + "\n")
        (self.folder / "work").mkdir()
        self.cohort = self.folder / "study"
        subprocess.run([OSTIA, "cohort", "init", self.folder / "scans.csv", "-o", self.cohort], check=True, capture_output=True)
        self.cluster = slurm_cluster.Cluster(self.folder / "cluster", cores=2, memory_mb=6000)
        self.addCleanup(self.cluster.stop)

    def snakemake(self, *more):
        workflow = SOURCE / "apps/ostia/workflow"
        return ["snakemake", "-s", workflow / "Snakefile", "--profile", workflow / "profiles/slurm", "--directory", self.folder / "work", "--cores", "2",
                "--resources", "mem_mb=5000", "--group-components", "scan=2", "--latency-wait", "10", "--max-status-checks-per-second", "2", *more,
                "--config", f"cohort={self.cohort}", f"ostia={OSTIA}"]

    def kill_now_and_then(self, is_over):
        chance = random.Random(SEED)
        for number in range(KILLS):
            if is_over.wait(chance.uniform(1, 8)):
                break
            jobs = self.cluster.jobs()
            if number % 4 == 3 or not jobs:
                self.cluster.kill_controller()
            else:
                self.cluster.kill_job(chance.choice(jobs))
            self.killed += 1

    def run_to_the_end(self):
        """The engine is started anew as long as it ends without all done, as its user does."""
        self.killed, is_over = 0, threading.Event()
        killer = threading.Thread(target=self.kill_now_and_then, args=(is_over,))
        killer.start()
        try:
            for _ in range(KILLS + 2):
                subprocess.run(self.snakemake("--unlock"), check=False, capture_output=True)
                done = subprocess.run(self.snakemake(), capture_output=True, text=True, check=False)
                if done.returncode == 0:
                    return
            self.fail(done.stderr[-3000:])
        finally:
            is_over.set()
            killer.join()

    def test_every_patient_ends_whole_or_named(self):
        begun = time.monotonic()
        self.run_to_the_end()
        seconds = time.monotonic() - begun
        told = json.loads(subprocess.run([OSTIA, "cohort", "status", self.cohort, "--verify", "--json"], check=True, capture_output=True).stdout)
        self.assertEqual((told["scans"], told["whole"]), (PATIENTS + 1, PATIENTS), told)
        self.assertEqual([(one["stage"], one["exit_code"], one["scans"]) for one in told["reasons"]], [("extract", 3, 1)])
        self.assertEqual(cohort_results.half_made(self.cohort), [])
        self.assertGreater(self.killed, 0)
        work = sum(stage["seconds"] for stage in told["stages"])
        print(f"{PATIENTS + 1} patients, {self.killed} kills: {seconds:.0f} s, of which the commands took {work:.0f} s of their own", flush=True)
        self.same_bits_as_alone()

    def same_bits_as_alone(self):
        """Of two patients: the whole cohort would take as long once more."""
        names = cohort_results.names_of(self.cohort)
        found = cohort_results.results(self.cohort)
        (self.folder / "two.csv").write_text("id,scan,kind\n" + "".join(f"{i},{i}.nrrd,mask\n" for i in range(2)))
        alone = self.folder / "alone"
        subprocess.run([OSTIA, "cohort", "init", self.folder / "two.csv", "-o", alone], check=True, capture_output=True)
        workflow = SOURCE / "apps/ostia/workflow"
        subprocess.run(["snakemake", "-s", workflow / "Snakefile", "--profile", workflow / "profiles/local", "--directory", self.folder / "work", "--cores", "1",
                        "--config", f"cohort={alone}", f"ostia={OSTIA}"], check=True, capture_output=True)
        for key, digests in cohort_results.results(alone).items():
            self.assertEqual(found[key], digests, key)
        self.assertEqual(len(set(names.values())), PATIENTS + 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
