#!/usr/bin/python3
"""Says of a job of Slurm whether it is running, was a success or a failure, as Snakemake asks.

Usage: status.py JOB

A controller that does not answer says nothing about the job, which counts as running. A job that the controller no longer
knows has ended; whether its steps were done, their records say, so that it counts as a failure and is looked at again.
"""
import re
import subprocess
import sys

RUNNING = {"PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "SUSPENDED", "REQUEUED", "REQUEUE_HOLD", "RESIZING", "SIGNALING", "STAGE_OUT", "STOPPED"}


def main():
    done = subprocess.run(["scontrol", "-o", "show", "job", sys.argv[1]], capture_output=True, text=True, check=False)
    state = re.search(r"\bJobState=(\w+)", done.stdout)
    if state:
        print("running" if state.group(1) in RUNNING else "success" if state.group(1) == "COMPLETED" else "failed")
    else:
        print("failed" if "Invalid job id" in done.stderr else "running")
    return 0


if __name__ == "__main__":
    sys.exit(main())
