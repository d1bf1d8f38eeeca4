"""A cohort of many rows with results as the workflow leaves them, made without computing any."""
import hashlib
import json
import pathlib
import sqlite3
import struct
import subprocess
import zlib

STAGES = {"import": ("inputs", "scan.nrrd", None), "extract": ("cases", "case.ostia", "import"), "lumen": ("lumens", "lumen.vtp", "extract"),
          "mesh": ("meshes", "mesh/mesh.vtu", "extract"), "measures": ("measures", "report/report.json", "extract"),
          "pressure": ("flow", "pressure/ffr.json", "extract")}


def begin(ostia, folder, rows):
    """Rows of one small folder, told apart by their series."""
    (folder / "CT").mkdir()
    (folder / "CT/slice.dcm").write_text("x")
    with open(folder / "scans.csv", "w", encoding="utf-8") as table:
        table.write("id,scan,series\n")
        table.writelines(f"Jane Doe {i},CT,1.2.{i}\n" for i in range(rows))
    subprocess.run([ostia, "cohort", "init", folder / "scans.csv", "-o", folder / "study"], check=True, capture_output=True)
    return folder / "study"


def scans_of(cohort):
    database = sqlite3.connect(cohort / "cohort.sqlite")
    scans = [row[0] for row in database.execute("SELECT pseudonym FROM scan ORDER BY number")]
    database.close()
    return scans


def png(width, height, red):
    """Of one colour."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress((b"\0" + bytes([red, 90, 160]) * width) * height)) + chunk(b"IEND", b""))


def digest(content):
    return hashlib.sha256(content).hexdigest()


def finish(cohort, scan, number):
    """All stages; the figures follow from the number."""
    area, stenosis, ffr = 1 + number % 12, number * 7 % 100, 1 - number % 30 / 60
    content = {stage: f"{stage} of {scan}".encode() for stage in STAGES}
    content["measures"] = json.dumps({"v": 1, "kind": "case report", "cad_rads": {"category": str(number % 5)}, "vessels": [{"plaque": {"plaque_mm3": number % 900}}],
                                      "segments": [{"label": "pRCA (1)", "least_area_mm2": area}], "stenoses": [{"number": 1, "diameter_percent": stenosis}]}).encode()
    content["pressure"] = json.dumps({"v": 1, "kind": "ffr", "outlets": [{"name": "RCA", "ffr": ffr}]}).encode()
    for stage, (folder, result, before) in STAGES.items():
        at = cohort / folder / scan
        file = at / result
        file.parent.mkdir(parents=True)
        file.write_bytes(content[stage])
        if stage == "measures":
            (file.parent / "images").mkdir()
            (file.parent / "images/tree.png").write_bytes(png(320, 240, number % 256))
        made_of = digest(content[before]) if before else digest(b"x")
        (at / "manifest.json").write_text(json.dumps({"v": 1, "command": "run", "exit_code": 0, "seconds": 1.5, "peak_mb": 100.0,
                                                      "inputs": {"input 1": made_of}, "outputs": {result: digest(content[stage])}}))


def fail(cohort, scan, stage, code, message):
    (cohort / "logs" / scan).mkdir(exist_ok=True)
    (cohort / "logs" / scan / f"{stage}.json").write_text(json.dumps({"v": 1, "kind": "cohort step", "scan": scan, "stage": stage, "exit_code": code, "signal": None,
                                                                      "message": message, "seconds": 1.0, "attempt": 1, "input_sha256": None}))
