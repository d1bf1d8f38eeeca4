"""What a run of the workflow leaves in its cohort, beside results: the workflow itself as it was run (COHORT/workflow), and a record of each
run (COHORT/logs/runs/NUMBER.json, docs/schemas/cohort-run.schema.json): with what, on what, from when until when. It names neither
the machine nor who works there. Results of two versions do not get into one cohort unknowingly: see `begin`.
"""
import hashlib
import json
import os
import pathlib
import platform
import shutil
import subprocess
import time

PARTS = ("Snakefile", "*.py", "chains/*.json")


class OtherVersion(Exception):
    """This cohort was begun with another version."""


def files_of(folder):
    return sorted(one for part in PARTS for one in folder.glob(part))


def digest_of(folder):
    """Of a workflow: names and content of its files."""
    digest = hashlib.sha256()
    for one in files_of(folder):
        digest.update(f"{one.relative_to(folder)} {hashlib.sha256(one.read_bytes()).hexdigest()}\n".encode())
    return digest.hexdigest()


def now():
    return time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())


def version_of(ostia):
    """As `ostia --version` says it, the last word of its first line."""
    said = subprocess.run([ostia, "--version"], capture_output=True, text=True, check=True).stdout.split("\n", 1)[0].split()
    return said[-1] if said else ""


def machine():
    """The one that plans; under Slurm others work."""
    model = "unknown"
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                model = line.partition(":")[2].strip()
                break
    except OSError:
        pass
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 2**20
    return {"processor": model, "processors": os.cpu_count() or 1, "memory_mb": memory, "system": f"{platform.system()} {platform.machine()}"}


def records_of(cohort):
    """By number."""
    return {int(one.stem): one for one in (cohort / "logs" / "runs").glob("*.json") if one.stem.isdigit()}


def last_of(cohort):
    known = records_of(cohort)
    return json.loads(known[max(known)].read_text(encoding="utf-8")) if known else None


def write(cohort, record, write_whole):
    write_whole(cohort / "logs" / "runs" / f"{record['number']}.json", json.dumps(record, indent=1) + "\n")


def keep_workflow(cohort, folder):
    """A copy that is there whole, or as it was."""
    part, old, kept = (cohort / f"{hidden}workflow" for hidden in (".part-", ".old-", ""))
    for left in (part, old):
        shutil.rmtree(left, ignore_errors=True)
    for one in files_of(folder):
        target = part / one.relative_to(folder)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(one, target)
    if kept.exists():
        os.rename(kept, old)
    os.rename(part, kept)
    shutil.rmtree(old, ignore_errors=True)


def begin(cohort, folder, settings, engine, version, write_whole, may_be_other=False):
    """The record of this run. Raises OtherVersion where the last one was of another workflow or program, unless that is wanted."""
    last, digest = last_of(cohort), digest_of(folder)
    if last and not may_be_other:
        for what, is_now in (("program", version), ("workflow_sha256", digest)):
            if last[what] != is_now:
                name = "Ostia" if what == "program" else "a workflow of digest"
                raise OtherVersion(f"this cohort was worked on by {name} {last[what][:12]}, and this is {is_now[:12]}: go on with that one, begin another cohort, "
                                   "or say --config other_version=true, by which results of both stand beside each other")
    if not last or last["workflow_sha256"] != digest or not (cohort / "workflow").is_dir():
        keep_workflow(cohort, folder)
    record = {"v": 1, "kind": "cohort run", "number": max(records_of(cohort), default=0) + 1, "begun": now(), "ended": None, "well": None, "program": version,
              "workflow_sha256": digest, "engine": engine, "settings": settings, "machine": machine()}
    write(cohort, record, write_whole)
    return record


def end(cohort, record, well, write_whole):
    write(cohort, {**record, "ended": now(), "well": well}, write_whole)
