#!/usr/bin/env python3
"""A cohort's steps as job arrays of Slurm, without another engine: for very many scans.

Usage: arrays.py COHORT [--ostia PROGRAM] [--private FOLDER] [--threads N] [--retries N] [--scans-per-task N] [--tasks-per-array N]
                 [--tasks-at-once N] [--needs-review] [--other-version] [--scratch FOLDER] [--dry-run]

A task does all that is left to do of some scans, one step after the other (step.py); an array is up to a thousand tasks. Scans are sorted by
what they need, so that the tasks of an array need the same. Behind the arrays stands a job that plans again what they have left:
steps that were short of memory or time, with twice as much, and those of tasks that were killed; after as many rounds as a step may be
tried it ends. What is done, and by whom something is worked at, is known as everywhere: manifests, records and locks. The plan of a
round is COHORT/logs/arrays/RUN/ROUND/. OSTIA_SBATCH in the environment holds further options of sbatch. --scratch is a folder on each node for
what steps put aside ('$TMPDIR' unless given); each task has one of its own in it, which goes with the task.
"""
import argparse
import json
import os
import pathlib
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.dont_write_bytecode = True
import asks  # noqa: E402
import runs  # noqa: E402
import step as steps  # noqa: E402

HERE = pathlib.Path(__file__).resolve()
MOST_TASKS = 1000  # of an array; Slurm takes no more unless it is told to (MaxArraySize)
MARGIN_MIN, OVERHEAD_MB = 5, 100
PATIENCE_S = float(os.environ.get("OSTIA_SLURM_PATIENCE_S", 600))


def scans_of(cohort):
    return [row[0] for row in steps.asked_of(cohort, "SELECT pseudonym FROM scan ORDER BY number")]


def shortages_of(cohort, scan):
    """By stage how often it was short of memory or time."""
    try:
        return json.loads((cohort / "logs" / scan / "short.json").read_text())
    except (OSError, ValueError):
        return {}


def left_to_do(cohort, scan, may_follow):
    """Stages that have no record."""
    try:
        there = set(os.listdir(cohort / "logs" / scan))
    except OSError:
        there = set()
    return [stage for stage, (_, before) in steps.STAGES.items() if f"{stage}.json" not in there and (may_follow or before != steps.REVIEWED)]


class Planner:
    def __init__(self, told):
        self.told, self.cohort = told, told.cohort
        self.asks = asks.kept(self.cohort / "logs" / "asks.json",
                              lambda: asks.models(self.cohort, steps.STAGES, lambda *which: steps.file_read_by(self.cohort, *which), steps.manifest_of), True)

    def of_scan(self, scan, stages):
        """(MB, minutes): the most memory of a step, and the time of all."""
        short, mb, minutes = shortages_of(self.cohort, scan), 0, 0
        for stage in stages:
            source = steps.file_read_by(self.cohort, stage, scan)
            size, attempt = source.stat().st_size / 2**20 if source and source.is_file() else None, short.get(stage, 0) + 1
            mb = max(mb, asks.asked(self.asks[stage], "mb", size, attempt))
            minutes += asks.asked(self.asks[stage], "minutes", size, attempt)
        return mb, minutes

    def arrays(self):
        """Each a list of tasks, which are lists of scans; with what a task of it asks for."""
        approved = steps.approved_cases(self.cohort)
        wanted = []
        for scan in scans_of(self.cohort):
            if (self.cohort / "logs" / scan).is_dir():
                steps.forget_what_is_gone(self.cohort, scan, approved)
            stages = left_to_do(self.cohort, scan, not self.told.needs_review or scan in approved)
            if stages:
                wanted.append((*self.of_scan(scan, stages), scan))
        wanted.sort(key=lambda one: one[:2])  # those of one size keep their order
        each = self.told.scans_per_task
        tasks = [wanted[i:i + each] for i in range(0, len(wanted), each)]
        for i in range(0, len(tasks), self.told.tasks_per_array):
            some = tasks[i:i + self.told.tasks_per_array]
            yield ([[scan for *_, scan in task] for task in some], max(mb for task in some for mb, *_ in task),
                   max(sum(minutes for _, minutes, _ in task) for task in some))


def write_plan(folder, arrays):
    """One file an array, a line a task; and what each array asks for."""
    folder.mkdir(parents=True)
    told = []
    for number, (tasks, mb, minutes) in enumerate(arrays):
        (folder / f"{number}.txt").write_text("".join(" ".join(task) + "\n" for task in tasks))
        told.append({"tasks": len(tasks), "scans": sum(map(len, tasks)), "mem_mb": mb + OVERHEAD_MB, "minutes": minutes + MARGIN_MIN})
    (folder / "plan.json").write_text(json.dumps(told, indent=1) + "\n")
    return told


def submit(line, words):
    """The job's number. What it runs is handed over, not written down: it has paths in it, which a cohort has not. A controller that does not answer is
    asked again, ten minutes long."""
    command, end = ["sbatch", "--parsable", "--output", "/dev/null", *shlex.split(os.environ.get("OSTIA_SBATCH", "")), *map(str, words)], time.monotonic() + PATIENCE_S
    while True:
        done = subprocess.run(command, input=f"#!/bin/sh\n{line}\n", capture_output=True, text=True, check=False)
        if done.returncode == 0:
            return done.stdout.strip().split(";")[0]
        if not any(sign in done.stderr for sign in ("Unable to contact", "Connection refused", "timed out", "Socket timed")) or time.monotonic() > end:
            sys.exit(f"arrays.py: {done.stderr.strip()}")
        time.sleep(1)


def again(told, *more):
    """The words that begin this script in a job."""
    words = [HERE, told.cohort, "--ostia", told.ostia, "--private", told.private, "--threads", told.threads, "--retries", told.retries, "--scans-per-task", told.scans_per_task,
             "--tasks-per-array", told.tasks_per_array, "--tasks-at-once", told.tasks_at_once, *(["--needs-review"] if told.needs_review else []),
             *(["--scratch", told.scratch] if told.scratch else []), *more]
    return "exec " + shlex.join([sys.executable, "-B", *map(str, words)])


def folder_of(told):
    """Tasks of another run may still be there: each run has its own."""
    return told.cohort / "logs" / "arrays" / told.run / str(told.round)


def plan(told):
    """This round; where nothing is left, or there were as many as there may be, the end."""
    folder = folder_of(told)
    shutil.rmtree(folder, ignore_errors=True)  # of a dry run, or of a job that was started again
    arrays = write_plan(folder, Planner(told).arrays())
    print(f"round {told.round}: {sum(one['scans'] for one in arrays)} scans, {sum(one['tasks'] for one in arrays)} tasks in {len(arrays)} arrays", flush=True)
    if told.dry_run:
        return 0
    if not arrays or told.round > told.retries + 1:
        runs.end(told.cohort, json.loads(runs.records_of(told.cohort)[int(told.run)].read_text()), not arrays, steps.write_whole)
        return 0
    jobs = []
    for number, one in enumerate(arrays):
        limit = f"%{told.tasks_at_once}" if told.tasks_at_once else ""
        line = again(told, "--run", told.run, "--round", told.round, "--array", number)
        jobs.append(submit(line, ["--job-name", "ostia-scans", "--array", f"0-{one['tasks'] - 1}{limit}", "--cpus-per-task", told.threads, "--mem", one["mem_mb"], "--time", one["minutes"],
                            "--no-requeue"]))  # what a task leaves is the next round's
    submit(again(told, "--run", told.run, "--round", told.round + 1), ["--job-name", "ostia-plan", "--dependency", "afterany:" + ":".join(jobs), "--mem", 500, "--time", 60, "--requeue"])
    return 0


class Task:
    def __init__(self, told):
        self.told = told
        line = int(os.environ["SLURM_ARRAY_TASK_ID"])
        self.scans = (folder_of(told) / f"{told.array}.txt").read_text().splitlines()[line].split()
        self.asks = json.loads((told.cohort / "logs" / "asks.json").read_text())
        self.approved = steps.approved_cases(told.cohort) if told.needs_review else {}

    def run(self):
        with tempfile.TemporaryDirectory(prefix="ostia-task-", dir=self.told.scratch) as scratch:
            for scan in self.scans:
                for stage in left_to_do(self.told.cohort, scan, not self.told.needs_review or scan in self.approved):
                    self.step(scan, stage, scratch)
        return 0

    def step(self, scan, stage, scratch):
        cohort, before = self.told.cohort, steps.STAGES[stage][1]
        if before and not (cohort / "logs" / scan / f"{before}.json").is_file():
            return  # short of memory or time just now: this one's turn is in the next round
        short = shortages_of(cohort, scan)
        attempt, source = short.get(stage, 0) + 1, steps.file_read_by(cohort, stage, scan)
        minutes = asks.asked(self.asks[stage], "minutes", source.stat().st_size / 2**20 if source and source.is_file() else None, attempt)
        words = [sys.executable, "-B", HERE.with_name("step.py"), cohort, scan, stage, "--ostia", self.told.ostia, "--private", self.told.private, "--threads", self.told.threads,
                 "--attempt", attempt, "--most-attempts", self.told.retries + 1, "--seconds", 60 * minutes, *(["--needs-review"] if self.told.needs_review else [])]
        code = subprocess.run([str(word) for word in words], env={**os.environ, "TMPDIR": scratch}, check=False).returncode
        if code == steps.SHORTAGE:
            steps.write_whole(cohort / "logs" / scan / "short.json", json.dumps({**short, stage: attempt}) + "\n")


def main():
    parser = argparse.ArgumentParser(description="A cohort's steps as job arrays of Slurm")
    parser.add_argument("cohort", type=pathlib.Path)
    parser.add_argument("--ostia", default="ostia", help="the program, as all nodes find it")
    parser.add_argument("--private", type=pathlib.Path, help="where sources.sqlite is; beside the cohort unless given")
    parser.add_argument("--threads", type=int, default=1, help="of a step")
    parser.add_argument("--retries", type=int, default=2, help="of a step that was short of memory or time")
    parser.add_argument("--scans-per-task", type=int, default=10)
    parser.add_argument("--tasks-per-array", type=int, default=MOST_TASKS)
    parser.add_argument("--tasks-at-once", type=int, default=0, help="of an array; 0: as many as there is room for")
    parser.add_argument("--needs-review", action="store_true", help="what follows a case waits for a person's OK")
    parser.add_argument("--other-version", action="store_true", help="go on with what another version has begun")
    parser.add_argument("--scratch", help="a folder on each node for what steps put aside")
    parser.add_argument("--dry-run", action="store_true", help="write the plan, and submit nothing")
    parser.add_argument("--run", default="dry", help=argparse.SUPPRESS)
    parser.add_argument("--round", type=int, default=1, help=argparse.SUPPRESS)
    parser.add_argument("--array", type=int, help=argparse.SUPPRESS)
    told = parser.parse_args()
    if not 1 <= told.tasks_per_array <= MOST_TASKS or told.scans_per_task < 1 or told.threads < 1 or told.retries < 0:
        parser.error(f"--tasks-per-array is 1 to {MOST_TASKS}, --scans-per-task and --threads 1 or more, --retries 0 or more")
    told.cohort = told.cohort.absolute()
    told.private = (told.private or told.cohort.with_name(told.cohort.name + ".private")).absolute()
    if not (told.cohort / "cohort.sqlite").is_file():
        parser.error(f"{told.cohort} is no cohort; `ostia cohort init` makes one")
    if told.array is not None:
        return Task(told).run()
    if told.round == 1 and not told.dry_run:
        version = subprocess.run(["sbatch", "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]
        try:
            begun = runs.begin(told.cohort, HERE.parent, {"threads": told.threads, "retries": told.retries, "needs_review": told.needs_review},
                       {"name": "slurm", "version": version, "python": platform.python_version()}, runs.version_of(told.ostia), steps.write_whole, told.other_version)
            told.run = str(begun["number"])
        except runs.OtherVersion as error:
            sys.exit(f"arrays.py: {error}".replace("--config other_version=true", "--other-version"))
    return plan(told)


if __name__ == "__main__":
    sys.exit(main())
