#!/usr/bin/env python3
"""One step of one scan of a cohort: an ordinary `ostia run`, and a record of how it ended.

Usage: step.py COHORT PSEUDONYM STAGE [--ostia PROGRAM] [--private FOLDER] [--threads N] [--attempt N] [--most-attempts N] [--needs-review] [--seconds N]

The result is a folder with a manifest, made whole or not at all by `ostia run`, which finds what is done already. The
record is COHORT/logs/PSEUDONYM/STAGE.json (docs/schemas/cohort-step.schema.json). Exit codes 0, 3 and 4 of the command are results and
end here with 0. Code 5 and SIGKILL (an operating system that is short of memory sends it) end with 5, so that the step is
tried again with more, until the last attempt, which is recorded. So are 6 and other signals, with the input's digest. A command that
takes longer than --seconds is stopped and is short of time, which is code 5, too. Where this script itself is stopped nothing is
recorded, and the command is stopped with it. With --needs-review a stage behind the case waits for a person's OK: nothing is done
or recorded without it, and the exit code is 1.
"""
import argparse
import ctypes
import fcntl
import hashlib
import json
import os
import pathlib
import signal
import sqlite3
import subprocess
import sys
import time

# stage: (folder, the stage before it)
STAGES = {"import": ("inputs", None), "extract": ("cases", "import"), "lumen": ("lumens", "extract"), "mesh": ("meshes", "extract"),
          "measures": ("measures", "extract"), "pressure": ("flow", "extract")}
REVIEWED = "extract"  # its result is what a person says OK to
BY_KIND = {"import", "extract", "measures"}
RESULTS, SHORTAGE = (0, 3, 4), 5


def digest_of(path):
    """As Ostia knows an input: of a folder that of its files' digests in their order."""
    def of_file(file):
        digest = hashlib.sha256()
        with open(file, "rb") as stream:
            for block in iter(lambda: stream.read(1 << 20), b""):
                digest.update(block)
        return digest.hexdigest()
    if not path.is_dir():
        return of_file(path)
    return hashlib.sha256("".join(sorted(of_file(p) for p in path.rglob("*") if p.is_file())).encode()).hexdigest()


def die_with_parent():
    """In the child: what outlives this script would hold the result's folder against the next attempt."""
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def write_whole(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".part-{os.getpid()}-{path.name}")
    with open(part, "w", encoding="utf-8") as stream:
        stream.write(text)
        stream.flush()
        os.fsync(stream.fileno())
    os.replace(part, path)


def source_of(private, pseudonym):
    database = sqlite3.connect((private / "sources.sqlite").resolve().as_uri() + "?mode=ro", uri=True)
    try:
        row = database.execute("SELECT scan, kind, series FROM source WHERE pseudonym = ?", (pseudonym,)).fetchone()
    finally:
        database.close()
    if row is None:
        sys.exit(f"step.py: {pseudonym} is not in the private folder of this cohort")
    return pathlib.Path(row[0]), row[1], row[2]


def asked_of(cohort, query, *values):
    database = sqlite3.connect((cohort / "cohort.sqlite").resolve().as_uri() + "?mode=ro", uri=True)
    try:
        return database.execute(query, values).fetchall()
    finally:
        database.close()


def kind_of(cohort, pseudonym):
    return asked_of(cohort, "SELECT kind FROM scan WHERE pseudonym = ?", pseudonym)[0][0]


def manifest_of(cohort, stage, pseudonym):
    """Nothing where there is none that can be read."""
    try:
        return json.loads((cohort / STAGES[stage][0] / pseudonym / "manifest.json").read_text())
    except (OSError, ValueError):
        return {}


def is_made(cohort, pseudonym):
    """There is a case."""
    return "case.ostia" in manifest_of(cohort, REVIEWED, pseudonym).get("outputs", {})


def approved_cases(cohort, pseudonym=None):
    """By scan the digest of the case that a person called OK last, where the case that was reviewed is the one that is there."""
    if not asked_of(cohort, "SELECT 1 FROM sqlite_master WHERE name = 'review'"):
        return {}
    only = "" if pseudonym is None else " WHERE s.pseudonym = ?"
    rows = asked_of(cohort, "SELECT s.pseudonym, r.verdict, r.made, r.result FROM review r JOIN scan s ON s.number = r.scan" + only + " ORDER BY r.number",
                    *([] if pseudonym is None else [pseudonym]))
    last = {scan: (verdict, made, result) for scan, verdict, made, result in rows}
    return {scan: result for scan, (verdict, made, result) in last.items()
            if verdict == "ok" and manifest_of(cohort, REVIEWED, scan).get("outputs", {}).get("case.ostia") == made}


def file_read_by(cohort, stage, pseudonym):
    """The file in the cohort that a step reads; the first one reads none."""
    if STAGES[stage][1] is None:
        return None
    return cohort / "inputs" / pseudonym / "scan.nrrd" if stage == REVIEWED else cohort / "cases" / pseudonym / "case.ostia"


def forget_what_is_gone(cohort, pseudonym, approved):
    """A step whose record names a result that is no more there is to be done again; likewise what was made of a case that a person has corrected since."""
    for stage, (_, before) in STAGES.items():
        record = cohort / "logs" / pseudonym / f"{stage}.json"
        if not record.is_file():
            continue
        try:
            if json.loads(record.read_text())["exit_code"] not in (0, 4):
                continue
        except (ValueError, KeyError, TypeError):
            pass  # none of step.py's: it says nothing
        made_of = manifest_of(cohort, stage, pseudonym).get("inputs")
        if made_of is None or (before == REVIEWED and pseudonym in approved and approved[pseudonym] not in made_of.values()):
            record.unlink()


def last_error(lines):
    """The log is JSON, a line an entry, and holds no path."""
    message = ""
    for line in lines.splitlines():
        try:
            entry = json.loads(line)
        except ValueError:
            continue
        if isinstance(entry, dict) and entry.get("level") == "error":
            message = entry.get("message", "")
    return message


class Step:
    def __init__(self, told):
        self.told, self.cohort = told, told.cohort
        self.folder, self.before = STAGES[told.stage]
        self.record = self.cohort / "logs" / told.pseudonym / f"{told.stage}.json"
        self.chain = None  # nothing is run yet

    def made_before(self):
        """The record of the stage before says that it has a result."""
        if self.before is None:
            return True
        record = self.record.with_name(f"{self.before}.json")
        return record.is_file() and json.loads(record.read_text()).get("exit_code") in (0, 4)

    def values(self):
        """Variables of the chain, and its input."""
        kind = kind_of(self.cohort, self.told.pseudonym)
        name = self.told.stage + (f"-{kind}" if self.told.stage in BY_KIND else "")
        image = self.cohort / "inputs" / self.told.pseudonym / "scan.nrrd"
        case = self.cohort / "cases" / self.told.pseudonym / "case.ostia"
        if self.told.stage == "import":
            scan, _, series = source_of(self.told.private, self.told.pseudonym)
            if series:
                return "import-series", {"scan": scan, "series": series}, scan
            return name, {"scan": scan}, scan
        if self.told.stage == "extract":
            return name, {"scan": image}, image
        return name, {"case": case, "scan": image} if name == "measures-image" else {"case": case}, case

    def run(self):
        """One at a time works at a step: what an engine that was killed has left running is waited for, and then found done."""
        with open(self.record.with_suffix(".lock"), "w", encoding="utf-8") as lock:
            fcntl.lockf(lock, fcntl.LOCK_EX)
            return self.run_alone()

    def run_alone(self):
        if not self.made_before():
            return self.keep(None, None, f"left out: {self.before} has no result", 0.0, None)
        if self.told.needs_review and self.before == REVIEWED and self.told.pseudonym not in approved_cases(self.cohort, self.told.pseudonym):
            print(f"step.py: {self.told.pseudonym} waits for a person's OK", file=sys.stderr)
            return 1
        self.chain, variables, source = self.values()
        words = [self.told.ostia, "run", str(pathlib.Path(__file__).resolve().parent / "chains" / f"{self.chain}.json"),
                 "-o", str(self.cohort / self.folder / self.told.pseudonym), "--log", "json", "--progress", "none",
                 "--threads", str(self.told.threads)] + [f"--set={name}={value}" for name, value in variables.items()]
        begun = time.monotonic()
        code, log = self.call(words)
        seconds = time.monotonic() - begun
        ended_by = -code if code is not None and code < 0 else None
        if code is None:
            code, log = SHORTAGE, json.dumps({"level": "error", "message": f"stopped: it took longer than {self.told.seconds} s"})
        short = code == SHORTAGE or ended_by == signal.SIGKILL
        if short and self.told.attempt < self.told.most_attempts:
            return SHORTAGE
        failed_inside = code not in RESULTS + (SHORTAGE,)
        message = "" if code == 0 else last_error(log) or (f"ended by signal {ended_by}" if ended_by else f"exit code {code}")
        return self.keep(code if code >= 0 else None, ended_by, "" if code == 4 else message, seconds, digest_of(source) if failed_inside and source.exists() else None)

    def call(self, words):
        """Exit code, or nothing where it took too long; and the log."""
        child = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace", preexec_fn=die_with_parent)

        def stop(number, _):
            child.send_signal(number)
            child.wait()
            os._exit(128 + number)
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            signal.signal(number, stop)
        late = False
        try:
            log = child.communicate(timeout=self.told.seconds)[1]
        except subprocess.TimeoutExpired:
            child.kill()
            late, log = True, child.communicate()[1]
        with open(self.record.with_suffix(".log"), "a", encoding="utf-8") as stream:
            stream.write(log)
        return None if late else child.returncode, log

    def keep(self, code, ended_by, message, seconds, digest):
        write_whole(self.record, json.dumps({"v": 1, "kind": "cohort step", "scan": self.told.pseudonym, "stage": self.told.stage, "exit_code": code,
                                             "signal": ended_by, "message": message, "seconds": round(seconds, 3), "attempt": self.told.attempt,
                                             "input_sha256": digest, "chain": self.chain, "threads": self.told.threads}, indent=1) + "\n")
        return 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("cohort", type=pathlib.Path)
    parser.add_argument("pseudonym")
    parser.add_argument("stage", choices=STAGES)
    parser.add_argument("--ostia", default="ostia")
    parser.add_argument("--private", type=pathlib.Path)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--attempt", type=int, default=1)
    parser.add_argument("--most-attempts", type=int, default=3)
    parser.add_argument("--needs-review", action="store_true")
    parser.add_argument("--seconds", type=float)
    told = parser.parse_args()
    told.cohort = told.cohort.absolute()
    if told.private is None:
        told.private = told.cohort.with_name(told.cohort.name + ".private")
    (told.cohort / "logs" / told.pseudonym).mkdir(parents=True, exist_ok=True)
    return Step(told).run()


if __name__ == "__main__":
    sys.exit(main())
