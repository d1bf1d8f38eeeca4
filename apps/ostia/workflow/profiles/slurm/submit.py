#!/usr/bin/python3
"""Hands a job of Snakemake to Slurm and prints its number.

Usage: submit.py [OPTION OF SBATCH ...] JOBSCRIPT

Processors, memory and time are those that the job's steps ask for together. Where the controller does not answer it is asked
again, ten minutes long: that it is started anew is no fault of a scan. OSTIA_SBATCH in the environment holds further options
(an account, a partition).
"""
import json
import os
import pathlib
import shlex
import subprocess
import sys
import time

PATIENCE_S = float(os.environ.get("OSTIA_SLURM_PATIENCE_S", 600))
MARGIN_MIN = 5  # for starting, and for a step that is stopped by its own clock to say so
OVERHEAD_MB = 300  # Snakemake and step.py beside the steps


def properties(script):
    for line in script.read_text(encoding="utf-8").splitlines():
        if line.startswith("# properties = "):
            return json.loads(line.removeprefix("# properties = "))
    sys.exit(f"submit.py: {script} is no job of Snakemake")


def words(job, script):
    asked = job["resources"]
    name = "ostia-" + (job.get("rule") or "scans")
    return ["sbatch", "--parsable", "--job-name", name, "--output", "/dev/null", "--cpus-per-task", str(max(1, job.get("threads", 1))),
            "--mem", str(int(asked.get("mem_mb", 1000)) + OVERHEAD_MB), "--time", str(int(asked.get("runtime", 60)) + MARGIN_MIN),
            *shlex.split(os.environ.get("OSTIA_SBATCH", "")), *sys.argv[1:-1], str(script)]


def main():
    script = pathlib.Path(sys.argv[-1])
    command, end = words(properties(script), script), time.monotonic() + PATIENCE_S
    while True:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode == 0:
            print(done.stdout.strip().split(";")[0])
            return 0
        is_down = "Unable to contact" in done.stderr or "Connection refused" in done.stderr or "timed out" in done.stderr.lower()
        if not is_down or time.monotonic() > end:
            sys.stderr.write(done.stderr)
            return 1
        time.sleep(1)


if __name__ == "__main__":
    sys.exit(main())
