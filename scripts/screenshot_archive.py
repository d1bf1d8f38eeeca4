#!/usr/bin/env python3
"""An archive on this machine for the manual's pictures: scripts/screenshot_archive.py BIN WORK

Orthanc with a series of a synthetic patient; in WORK/config a description of it and of a server that is not there,
in WORK/state/outbox an object for the latter. WORK/archive-ready appears when it answers; runs until it is ended."""
import json
import pathlib
import signal
import subprocess
import sys
import time
import urllib.request

binaries, work = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
web, dicom, nobody = 18042, 14242, 14243


def ostia(*arguments, check=True):
    subprocess.run([binaries / "ostia", *map(str, arguments)], check=check, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


config = {
    "StorageDirectory": str(work / "store"), "IndexDirectory": str(work / "store"), "HttpPort": web, "DicomPort": dicom,
    "DicomAet": "ORTHANC", "RemoteAccessAllowed": False, "AuthenticationEnabled": False,
    "DicomAlwaysAllowFind": True, "DicomAlwaysAllowGet": True, "DicomAlwaysAllowStore": True,
}
(work / "orthanc.json").write_text(json.dumps(config))
server = subprocess.Popen(["/usr/sbin/Orthanc", str(work / "orthanc.json")], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
signal.signal(signal.SIGTERM, lambda *_: (server.terminate(), sys.exit(0)))
servers = [{"name": "hospital", "host": "127.0.0.1", "port": dicom, "title": "ORTHANC"},
           {"name": "night shift", "host": "127.0.0.1", "port": nobody, "title": "NOBODY", "attempts": 1}]
(work / "config/ostia").mkdir(parents=True, exist_ok=True)
(work / "config/ostia/pacs.json").write_text(json.dumps({"servers": servers}))
ostia("phantom", "--preset", "tiny", "--cases", 1, "--seed", 7, "--formats", "dicom", "--no-report", "-o", work / "phantom")
for file in sorted((work / "phantom").rglob("*.dcm")):
    request = urllib.request.Request(f"http://127.0.0.1:{web}/instances", file.read_bytes(), {"Content-Type": "application/dicom"})
    for _ in range(30):
        try:
            urllib.request.urlopen(request).read()
            break
        except OSError:
            time.sleep(1)
some = sorted((work / "phantom").rglob("*.dcm"))[0]
ostia("pacs", "send", "night shift", some, "--servers", work / "config/ostia/pacs.json", "--queue", work / "state/outbox", check=False)
(work / "archive-ready").touch()
server.wait()
