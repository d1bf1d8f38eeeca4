#!/usr/bin/env python3
"""Twelve tiny patients, in four of whom there is no heart, as job arrays of a Slurm of one node, whose tasks and controller are killed:
every patient ends whole or named, nothing is half there or done twice, and the bits are those of the commands alone.

Usage: arrays_slurm_test.py OSTIA SOURCE [PATIENTS] [KILLS] [SEED]
"""
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import threading
import time
import unittest

OSTIA, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
PATIENTS, KILLS, SEED = (int(sys.argv[i]) if len(sys.argv) > i else usual for i, usual in ((3, 12), (4, 6), (5, 1)))
WORKFLOW = SOURCE / "apps/ostia/workflow"
sys.path[:0] = [str(SOURCE / "tests/docs"), str(SOURCE / "tests/cohort")]
import cohort_results  # noqa: E402
import slurm_cluster  # noqa: E402
import small_files  # noqa: E402

if slurm_cluster.missing():
    print(f"skipped: needs {slurm_cluster.missing()}")
    sys.exit(77)
LONGEST_S = 1500


def is_heartless(number):
    return number % 3 == 2


class SlurmArrays(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        small_files.write_image(self.folder / "chestless.nrrd")
        chestless = (self.folder / "chestless.nrrd").read_bytes()
        lines = ["id,scan,kind"]
        for number in range(PATIENTS):
            if is_heartless(number):
                (self.folder / f"{number}.nrrd").write_bytes(chestless)
            else:
                cohort_results.write_grown_mask(self.folder / f"{number}.nrrd", 0.5 + 0.3 * number / PATIENTS)
            lines.append(f"{number},{number}.nrrd,{'image' if is_heartless(number) else 'mask'}")
        (self.folder / "scans.csv").write_text("\n".join(lines) + "\n")
        self.cohort, self.killed = self.folder / "study", 0
        subprocess.run([OSTIA, "cohort", "init", self.folder / "scans.csv", "-o", self.cohort], check=True, capture_output=True)
        self.cluster = slurm_cluster.Cluster(self.folder / "cluster", cores=2, memory_mb=8000)
        self.addCleanup(self.cluster.stop)

    def kill_now_and_then(self, is_over):
        """Tasks twice for each time that the controller goes down."""
        chance = random.Random(SEED)
        while self.killed < KILLS and not is_over.wait(chance.uniform(1, 4)):
            tasks = self.cluster.jobs()
            if not tasks:
                continue
            if self.killed % 3 == 2:
                self.cluster.kill_controller()
            else:
                self.cluster.kill_job(chance.choice(tasks))
            self.killed += 1

    def submit(self):
        done = subprocess.run([sys.executable, "-B", WORKFLOW / "arrays.py", self.cohort, "--ostia", OSTIA, "--scans-per-task", "1"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def is_empty(self):
        """The queue; a controller that is down has said nothing."""
        asked = subprocess.run(["squeue", "-h", "-o", "%i"], capture_output=True, text=True, check=False)
        return asked.returncode == 0 and not asked.stdout.strip()

    def told(self):
        return json.loads(subprocess.run([OSTIA, "cohort", "status", self.cohort, "--verify", "--json"], check=True, capture_output=True).stdout)

    def run_to_the_end(self):
        """Submitted anew as long as something is left, as its user does: killed tasks may be more than there are rounds."""
        is_over, end = threading.Event(), time.monotonic() + LONGEST_S
        killer = threading.Thread(target=self.kill_now_and_then, args=(is_over,))
        killer.start()
        try:
            while time.monotonic() < end:
                self.submit()
                while not self.is_empty():
                    self.cluster.mend()
                    time.sleep(0.5)
                last = max((self.cohort / "logs/runs").glob("*.json"), key=lambda one: int(one.stem))
                if json.loads(last.read_text())["well"]:
                    return
        finally:
            is_over.set()
            killer.join()
        self.fail("it does not come to an end")

    def test_every_patient_ends_whole_or_named(self):
        begun = time.monotonic()
        self.run_to_the_end()
        seconds, told = time.monotonic() - begun, self.told()
        heartless = sum(map(is_heartless, range(PATIENTS)))
        self.assertEqual((told["scans"], told["whole"]), (PATIENTS, PATIENTS - heartless), told)
        self.assertEqual([(one["stage"], one["exit_code"], one["scans"]) for one in told["reasons"]], [("extract", 3, heartless)])
        self.assertEqual(cohort_results.half_made(self.cohort), [])
        self.assertGreater(self.killed, 0)
        print(f"{PATIENTS} patients, {self.killed} kills: {seconds:.0f} s, of which the commands took {sum(stage['seconds'] for stage in told['stages']):.0f} s of their own", flush=True)
        self.same_bits_as_done_once_more()

    def same_bits_as_done_once_more(self):
        """By the commands alone, on this machine: `cohort reproduce` of one whole patient."""
        subprocess.run([OSTIA, "cohort", "crate", self.cohort], check=True, capture_output=True)
        done = subprocess.run([OSTIA, "cohort", "reproduce", self.cohort, "-o", self.folder / "again", "--only", "1", "--json"], capture_output=True, text=True, check=False)
        found = json.loads(done.stdout)
        self.assertEqual((done.returncode, found["differs"], found["missing"]), (0, 0, 0), found)
        self.assertGreater(found["same"], 20 if found["steps"] > 1 else 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
