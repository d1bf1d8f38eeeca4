"""Validates what `ostia` writes against docs/schemas, and proves that a broken document fails.

Usage: schemas_test.py OSTIA SCHEMA_FOLDER [Schemas] [Experiments] [LongExperiments] [Archives]
"""

import copy
import http.server
import json
import pathlib
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import threading
import unittest

try:
    import jsonschema
except ImportError:
    print("skipped: needs python3-jsonschema")
    sys.exit(77)

PROGRAM, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
SCHEMAS = {path.name: json.loads(path.read_text()) for path in FOLDER.glob("*.schema.json")}


def validator(name):
    schema = SCHEMAS[name + ".schema.json"]
    resolver = jsonschema.RefResolver(base_uri=schema["$id"], referrer=schema, store=SCHEMAS)
    return jsonschema.Draft202012Validator(schema, resolver=resolver)


def run(*arguments, codes=(0,)):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=500, check=False)
    assert done.returncode in codes, f"{arguments}: {done.returncode}: {done.stderr}"
    return done.stdout


class Refusing(unittest.TestCase):
    def assert_refused(self, name, document):
        with self.assertRaises(jsonschema.ValidationError):
            validator(name).validate(document)


def element(group, number, kind, value):
    if isinstance(value, str):
        value = value.encode()
    value += (b"\0" if kind in ("UI", "OB") else b" ") * (len(value) % 2)
    head = group.to_bytes(2, "little") + number.to_bytes(2, "little") + kind.encode()
    return head + (b"\0\0" + len(value).to_bytes(4, "little") if kind in ("OB", "OW") else len(value).to_bytes(2, "little")) + value


def slice_of(number):
    """A CT slice of 4 x 4 voxels."""
    short = lambda value: value.to_bytes(2, "little")
    uid = f"1.2.3.4.{number}"
    meta = element(2, 2, "UI", CT_IMAGE) + element(2, 3, "UI", uid) + element(2, 0x10, "UI", "1.2.840.10008.1.2.1")
    return (bytes(128) + b"DICM" + element(2, 0, "UL", len(meta).to_bytes(4, "little")) + meta
            + element(8, 0x16, "UI", CT_IMAGE) + element(8, 0x18, "UI", uid) + element(8, 0x60, "CS", "CT")
            + element(0x10, 0x10, "PN", "PLANTED^NAME") + element(0x10, 0x20, "LO", "PLANTED-ID")
            + element(0x20, 0xD, "UI", "1.2") + element(0x20, 0xE, "UI", "1.2.3") + element(0x20, 0x13, "IS", str(number))
            + element(0x20, 0x32, "DS", f"0\\0\\{number}") + element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0")
            + element(0x28, 2, "US", short(1)) + element(0x28, 4, "CS", "MONOCHROME2") + element(0x28, 0x10, "US", short(4)) + element(0x28, 0x11, "US", short(4))
            + element(0x28, 0x30, "DS", "1\\1") + element(0x28, 0x100, "US", short(16)) + element(0x28, 0x101, "US", short(16))
            + element(0x28, 0x102, "US", short(15)) + element(0x28, 0x103, "US", short(0)) + element(0x7FE0, 0x10, "OW", bytes(32)))


CT_IMAGE = "1.2.840.10008.5.1.4.1.1.2"


class DicomWeb(http.server.BaseHTTPRequestHandler):
    """An archive of one series of three slices, which stores whatever it is sent."""

    def log_message(self, *_):
        pass

    def answer(self, kind, body):
        self.send_response(200)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def do_GET(self):
        one = {"0020000D": {"vr": "UI", "Value": ["1.2"]}, "00100020": {"vr": "LO", "Value": ["PLANTED-ID"]}, "00100010": {"vr": "PN", "Value": [{"Alphabetic": "PLANTED^NAME"}]},
               "0020000E": {"vr": "UI", "Value": ["1.2.3"]}, "00201209": {"vr": "IS", "Value": [3]}}
        if "/instances?" in self.path:
            self.answer("application/dicom+json", json.dumps([{**one, "00080018": {"vr": "UI", "Value": [f"1.2.3.4.{n}"]}} for n in range(3)]).encode())
        elif "?" in self.path:
            self.answer("application/dicom+json", json.dumps([one]).encode())
        else:
            self.answer('multipart/related; type="application/dicom"; boundary=b', b"".join(b"\r\n--b\r\n\r\n" + slice_of(n) for n in range(3)) + b"\r\n--b--")

    def do_POST(self):
        self.rfile.read(int(self.headers["Content-Length"]))
        self.answer("application/dicom+json", b"{}")


class Archives(Refusing):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), DicomWeb)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        self.servers = self.folder / "servers.json"
        servers = {"servers": [{"name": "archive", "transport": "dicomweb", "url": f"http://127.0.0.1:{server.server_port}/dicom-web"},
                               {"name": "gone", "host": "127.0.0.1", "port": 1, "title": "GONE", "attempts": 1}]}
        validator("pacs-servers").validate(servers)
        self.servers.write_text(json.dumps(servers))

    def holds(self, command, *arguments, codes=(0,)):
        printed = json.loads(run("pacs", command, *arguments, "--servers", self.servers, "--json", codes=codes))
        validator("pacs-" + command).validate(printed)
        for field in ("v", "kind", "warnings"):
            self.assert_refused("pacs-" + command, {k: v for k, v in printed.items() if k != field})
        return printed

    def test_what_is_printed(self):
        self.holds("echo", "archive")
        self.assertEqual(self.holds("find", "archive")["found"][0]["patient_name"], "PLANTED^NAME")
        self.assertEqual(self.holds("find", "archive", "--study", "1.2")["found"][0]["images"], 3)
        self.assertEqual(len(self.holds("find", "archive", "--study", "1.2", "--series", "1.2.3")["found"]), 3)
        got = self.holds("get", "archive", "--study", "1.2", "--series", "1.2.3", "-o", self.folder / "CT")
        self.assertEqual((got["images"], got["announced"], got["series"][0]["slices"]), (3, 3, 3))
        self.assertEqual(self.holds("send", "archive", self.folder / "CT")["sent"], 3)
        self.assertEqual(self.holds("send", "gone", self.folder / "CT", "--queue", self.folder / "outbox", codes=(5,))["not_sent"], 3)
        self.assertEqual({one["state"] for one in self.holds("queue", self.folder / "outbox")["items"]}, {"waiting"})
        self.holds("queue", self.folder / "outbox", "--send", codes=(5,))

    def test_no_log_names_the_patient(self):
        def said(*arguments):
            done = subprocess.run([PROGRAM, "pacs", *map(str, arguments), "--servers", str(self.servers)], capture_output=True, text=True, timeout=100, check=False)
            return done.stderr

        asked = ("--patient-name", "PLANTED^NAME", "--patient-id", "PLANTED-ID")
        for log in ("text", "json"):
            for line in (("find", "archive", *asked), ("find", "gone", *asked), ("find", "nowhere", *asked), ("find", "archive", *asked, "--from", "yesterday"),
                         ("get", "archive", "--study", "1.2", "--series", "1.2.3", "-o", self.folder / log), ("send", "gone", self.folder / log)):
                with self.subTest(f"{log} {line[0]} {line[1]}"):
                    self.assertNotIn("PLANTED", said(*line, "--log", log))

    def test_a_wrong_file_of_servers_is_refused(self):
        for wrong in ({"servers": [{"name": "a", "password": "x"}]}, {"servers": [{"transport": "dimse"}]}, {}):
            self.assert_refused("pacs-servers", wrong)
            self.servers.write_text(json.dumps(wrong))
            run("pacs", "echo", "a", "--servers", self.servers, codes=(3,))


class RunExperiments(Refusing):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.addCleanup(self.holder.cleanup)

    def assert_experiment(self, name, *options):
        out = pathlib.Path(self.holder.name) / name
        printed = json.loads(run("experiment", name, "-o", out, *options, "--json"))
        validator("experiment-" + name).validate(printed)
        self.assertEqual(printed, json.loads((out / "experiment.json").read_text()))
        self.assert_refused("experiment-" + name, {"v": 1, "kind": name})


class Experiments(RunExperiments):
    def test_experiment_wall_spread(self):
        self.assert_experiment("wall-spread", "--fitting", "2", "--judged", "1")

    def test_experiment_hard(self):
        self.assert_experiment("hard", "--cases", "1", "--voxel", "2", "--no-search")

    def test_experiment_chain(self):
        # A bright tube of 4 mm along z, in voxels of 1 mm.
        image = pathlib.Path(self.holder.name) / "tube.nrrd"
        header = ("NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 16 16 30\n"
                  "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nendian: little\n"
                  "encoding: raw\nspace origin: (0,0,0)\n\n")
        voxels = [300 if (x - 8) ** 2 + (y - 8) ** 2 < 5 else -800 for _ in range(30) for y in range(16) for x in range(16)]
        image.write_bytes(header.encode() + b"".join(v.to_bytes(2, "little", signed=True) for v in voxels))
        out = pathlib.Path(self.holder.name) / "chain"
        printed = json.loads(run("experiment", "chain", image, "-o", out, "--seed", "8,8,15", "--mesh", "4:1.2:0", "--json"))
        validator("experiment-chain").validate(printed)
        self.assertEqual(printed, json.loads((out / "experiment.json").read_text()))
        self.assert_refused("experiment-chain", {"v": 1, "kind": "chain"})

    @unittest.skipUnless(shutil.which("simpleFoam"), "openfoam is not installed")
    def test_experiment_pressure(self):
        folder = pathlib.Path(self.holder.name)
        none = [word for kind in ("concentric", "eccentric", "tapered", "bends", "series", "forks") for word in ("--" + kind, "0")]
        printed = json.loads(run("experiment", "pressure", "-o", folder / "pressure", "--keep", folder / "runs", *none, "--edge-ratio", "0.4", "--json"))
        validator("experiment-pressure").validate(printed)
        self.assertEqual(printed, json.loads((folder / "pressure" / "experiment.json").read_text()))
        self.assertEqual(len(printed["cases"]), 1)
        self.assert_refused("experiment-pressure", {"v": 1, "kind": "pressure"})


class LongExperiments(RunExperiments):
    """By what tests in C++ make by hand, tests/experiments holds these documents against their schemas, too."""

    def test_experiment_smoothness(self):
        self.assert_experiment("smoothness", "--orientations", "1", "--levels", "1", "--sample", "1")

    def test_experiment_reading(self):
        self.assert_experiment("reading", "--patients", "1", "--voxel", "2", "--tolerance", "2")

    def test_experiment_certainty(self):
        self.assert_experiment("certainty", "--patients", "1", "--scans", "1", "--voxel", "2")

    def test_experiment_orientations(self):
        self.assert_experiment("orientations", "--orientations", "2")


class Schemas(Refusing):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name) / "out"
        cls.printed = json.loads(run("model", "--builtin", "-o", cls.folder, "--edge-ratio", "0.6", "--json", codes=(0, 4)))
        cls.report = json.loads((cls.folder / "report.json").read_text())
        cls.manifest = json.loads((cls.folder / "manifest.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def test_schemas_are_schemas(self):
        self.assertGreaterEqual(len(SCHEMAS), 4)
        for name, schema in SCHEMAS.items():
            with self.subTest(name):
                jsonschema.Draft202012Validator.check_schema(schema)

    def test_report(self):
        validator("report").validate(self.report)
        validator("report").validate(self.printed)

    def test_manifest(self):
        validator("manifest").validate(self.manifest)

    def test_quality(self):
        for file in ("mesh.vtu", "lumen.stl"):
            validator("quality").validate(json.loads(run("mesh", "--check", self.folder / file, "--json", codes=(0, 4))))

    def test_info(self):
        validator("info").validate(json.loads(run("info", self.folder / "lumen.stl", "--json")))
        network = self.folder.parent / "network.swc"
        network.write_text("1 2 0 0 0 1 -1\n2 2 0 0 5 0.8 1\n3 2 1 0 9 0.5 2\n4 2 -1 0 9 0.6 2\n")
        validator("info").validate(json.loads(run("info", network, "--json")))
        for more in ([], ["--repair"], ["--hexahedra", self.folder.parent / "hexahedra.vtu"], ["--frusta"]):
            made = json.loads(run("reconstruct", network, "-o", network.with_suffix(".vtp"), "--json", *more))
            validator("reconstruct").validate(made)
        made.pop("segments")
        self.assert_refused("reconstruct", made)
        image = pathlib.Path(self.holder.name) / "image.nrrd"
        header = ("NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 3 4 5\n"
                  "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nendian: little\n"
                  "encoding: raw\nspace origin: (0,0,0)\n\n")
        image.write_bytes(header.encode() + b"".join(i.to_bytes(2, "little") for i in range(60)))
        validator("info").validate(json.loads(run("info", image, "--json")))
        empty = pathlib.Path(self.holder.name) / "empty"
        empty.mkdir()
        printed = run("info", empty, "--json", codes=(0, 3))
        if printed:
            validator("info").validate(json.loads(printed))

    def test_filter(self):
        image = pathlib.Path(self.holder.name) / "ramp.nrrd"
        header = ("NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 4 5\n"
                  "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nendian: little\n"
                  "encoding: raw\nspace origin: (0,0,0)\n\n")
        image.write_bytes(header.encode() + b"".join(i.to_bytes(2, "little") for i in range(80)))
        made = json.loads(run("filter", image, "-o", image.with_name("out.nrrd"), "--with", "gaussian:sigma_mm=1", "--with", "otsu", "--json"))
        validator("filter").validate(made)
        made["values"] = "anything"
        self.assert_refused("filter", made)
        validator("filters").validate(json.loads(run("filter", "--list", "--json")))

    def test_evaluate(self):
        lumen = self.folder / "lumen.stl"
        for arguments in (("surface", lumen, lumen), ("volume", lumen, lumen), ("lumen", "--floor")):
            validator("evaluate").validate(json.loads(run("evaluate", *arguments, "--json")))
        phases = pathlib.Path(self.holder.name) / "phases"
        phases.mkdir()
        for phase in ("p1.stl", "p2.stl"):
            (phases / phase).write_bytes(lumen.read_bytes())
        validator("evaluate").validate(json.loads(run("evaluate", "motion", phases, phases, "--json")))
        self.assert_refused("evaluate", {"v": 1, "kind": "surface"})

    def test_suite_and_tolerance(self):
        holder = pathlib.Path(self.holder.name)
        for name, dice in (("golden", 0.9), ("new", 0.8)):
            (holder / name).mkdir()
            (holder / name / "figures.json").write_text(json.dumps({"v": 1, "dice": dice}))
        tolerance = {"v": 1, "figures": [{"key": "dice", "direction": "higher_is_better", "absolute": 0.05}], "surfaces": [{"mean_mm": 0.1}]}
        (holder / "F.json").write_text(json.dumps(tolerance))
        validator("tolerance").validate(tolerance)
        validator("tolerance").validate(json.loads((FOLDER.parent.parent / "data/golden/tolerance.json").read_text()))
        printed = json.loads(run("evaluate", "suite", holder / "golden", holder / "new", "--tolerance", holder / "F.json", "--json", codes=(4,)))
        validator("suite").validate(printed)
        for broken in ({}, {"v": 1, "figures": [{"absolute": -1}]}, {"v": 1, "surface": []}):
            with self.subTest(broken):
                self.assert_refused("tolerance", broken)

    def test_phantom(self):
        folder = pathlib.Path(self.holder.name) / "phantom"
        printed = json.loads(run("phantom", "--preset", "tiny", "--truth-only", "--no-report", "--surface-spacing", "1", "-o", folder, "--json"))
        validator("phantom-suite").validate(printed)
        case = json.loads((folder / "dataset00" / "case.json").read_text())
        validator("phantom-case").validate(case)
        contours = json.loads((folder / "dataset00" / "contours.json").read_text())
        validator("contours").validate(contours)
        for broken in ({**contours, "unit": "cm"}, {**contours, "axes": "RAS"}, {**contours, "sections": [{"section": "s01"}]}):
            self.assert_refused("contours", broken)
        validator("manifest").validate(json.loads((folder / "manifest.json").read_text()))
        for name, document in (("phantom-case", case), ("phantom-suite", printed)):
            for field in document:
                broken = copy.deepcopy(document)
                del broken[field]
                with self.subTest(field):
                    self.assert_refused(name, broken)

    def test_beating_phantom(self):
        folder = pathlib.Path(self.holder.name) / "beating"
        printed = json.loads(run("phantom", "--preset", "tiny", "--truth-only", "--no-report", "--surface-spacing", "1", "--phases", "2", "-o", folder, "--json"))
        validator("phantom-suite").validate(printed)
        for schema, file in (("heartbeat", "heartbeat.json"), ("motion", "motion.json"), ("phantom-case", "case.json")):
            document = json.loads((folder / "dataset00" / file).read_text())
            validator(schema).validate(document)
            if schema == "phantom-case": continue
            for field in document:
                broken = copy.deepcopy(document)
                del broken[field]
                with self.subTest(file + " " + field):
                    self.assert_refused(schema, broken)

    def test_ffr(self):
        holder = pathlib.Path(self.holder.name)
        (holder / "artery.csv").write_text("x,y,z,radius\n" + "".join(f"0,0,{0.5 * i},{0.7 if 40 <= i <= 44 else 1.5}\n" for i in range(121)))
        made = json.loads(run("ffr", holder / "artery.csv", "-o", holder / "ffr", "--pulse", "--json"))
        validator("ffr").validate(made)
        self.assertTrue(made["lesions"])
        self.assertEqual(made, json.loads((holder / "ffr" / "ffr.json").read_text()))
        validator("manifest").validate(json.loads((holder / "ffr" / "manifest.json").read_text()))
        vessel = made["branches"][0]["vessel"]
        unsure = json.loads(run("ffr", holder / "artery.csv", "-o", holder / "unsure", "--uncertainty=16", "--json"))
        validator("ffr").validate(unsure)
        self.assertEqual(unsure["uncertainty"]["trees"], 16 + 6 * 8)
        opened = json.loads(run("ffr", holder / "artery.csv", "-o", holder / "opened", "--open", f"{vessel}:18-24:10", "--json"))
        validator("ffr").validate(opened)
        self.assertGreater(opened["what_if"]["lesions"][0]["ffr"], opened["lesions"][0]["ffr"])
        for field in set(made) - {"pulse"}:
            broken = copy.deepcopy(made)
            del broken[field]
            with self.subTest(field):
                self.assert_refused("ffr", broken)

    def test_dicom_objects(self):
        holder = pathlib.Path(self.holder.name)
        (holder / "dicom.csv").write_text("x,y,z,radius\n" + "".join(f"0,0,{0.5 * i},{0.7 if 24 <= i <= 26 else 1.5}\n" for i in range(49)))
        run("lumen", holder / "dicom.csv", "-o", holder / "dicom.stl", "--case", holder / "dicom.ostia")
        made = json.loads(run("dicom", holder / "dicom.ostia", "-o", holder / "objects", "--objects", "stl,sr", "--json"))
        validator("dicom-objects").validate(made)
        self.assertTrue(made["pseudonym"])
        told = json.loads(run("dicom", holder / "objects" / "measurements.dcm"))
        validator("dicom-measurements").validate(told)
        self.assertTrue(told["groups"])
        self.assert_refused("dicom-objects", {**made, "path": "/home"})
        self.assert_refused("dicom-measurements", {**told, "groups": [{}]})

    def test_doctor(self):
        holder = pathlib.Path(self.holder.name) / "looked_at"
        holder.mkdir()
        made = json.loads(run("doctor", holder, "--json", codes=(0, 4)))
        validator("doctor").validate(made)
        self.assertEqual(made["looked_at"], [{"kind": "folder", "strays": 0, "removed": 0}])
        self.assert_refused("doctor", {**made, "path": "/home"})

    def test_deidentified(self):
        holder = pathlib.Path(self.holder.name)
        (holder / "named").mkdir()
        for number in range(3):
            (holder / "named" / f"{number}.dcm").write_bytes(slice_of(number))
        made = json.loads(run("deidentify", holder / "named", "-o", holder / "anonymous", "--json"))
        validator("deidentified").validate(made)
        self.assertEqual(made["files"], 3)
        self.assertEqual(made, json.loads((holder / "anonymous" / "deidentified.json").read_text()))
        self.assert_refused("deidentified", {**made, "files": "3"})

    def test_case_report(self):
        holder = pathlib.Path(self.holder.name)
        (holder / "tube.csv").write_text("x,y,z,radius\n" + "".join(f"0,0,{0.5 * i},{0.7 if 24 <= i <= 26 else 1.5}\n" for i in range(49)))
        run("lumen", holder / "tube.csv", "-o", holder / "tube.stl", "--case", holder / "tube.ostia")
        report = json.loads(run("report", holder / "tube.ostia", "-o", holder / "report", "--json"))
        validator("case-report").validate(report)
        validator("manifest").validate(json.loads((holder / "report" / "manifest.json").read_text()))
        self.assertTrue(report["stenoses"])
        for field in report:
            broken = copy.deepcopy(report)
            del broken[field]
            with self.subTest(field):
                self.assert_refused("case-report", broken)
        for field, value in (("cad_rads", "6"), ("number", 0), ("diameter_percent", 101)):
            broken = copy.deepcopy(report)
            broken["stenoses"][0][field] = value
            with self.subTest(field):
                self.assert_refused("case-report", broken)

    def test_flow(self):
        holder = pathlib.Path(self.holder.name)
        run("case", self.folder / "mesh.vtu", "-o", holder / "flow", "--outlets", "resistance")
        record = json.loads((holder / "flow" / "flow-case.json").read_text())
        validator("flow-case").validate(record)
        faces = [*record["resistance_Pa_s_m3"], "inlet_vessel_1"]
        self.assertEqual(len(faces), 3)
        for name, kind, value in (("U", "Vector", "(0 0 0.1)"), ("pressureInPascal", "Scalar", "40"), ("wallShearStress", "Vector", "(0 0 -1e-3)")):
            file = holder / "flow" / "9" / name
            file.parent.mkdir(exist_ok=True)
            file.write_text(f"FoamFile {{ format ascii; class vol{kind}Field; }}\ninternalField uniform {value};\n"
                            f"boundaryField {{ wall {{ type calculated; value uniform {value}; }} }}\n")
        for face in faces:
            settled = record["resistance_Pa_s_m3"].get(face, 1e7) * 1e-6 / 1060.0  # over the density
            for name, value in (("flow", -2e-6 if face.startswith("inlet") else 1e-6), ("pressure", settled)):
                file = holder / "flow" / "postProcessing" / f"{name}_{face}" / "0" / "surfaceFieldValue.dat"
                file.parent.mkdir(parents=True)
                file.write_text(f"# Time v\n9 {value}\n")
        (holder / "flow" / "log.simpleFoam").write_text("SIMPLE solution converged in 9 iterations\n")
        result = json.loads(run("result", holder / "flow", "-o", holder / "flow-result", "--json"))
        validator("flow-result").validate(result)
        validator("manifest").validate(json.loads((holder / "flow-result" / "manifest.json").read_text()))
        for name, document in (("flow-case", record), ("flow-result", result)):
            for field in document:
                broken = copy.deepcopy(document)
                del broken[field]
                with self.subTest(field):
                    self.assert_refused(name, broken)
        result["verdict"] = {"passed": False, "reasons": []}
        self.assert_refused("flow-result", result)

    def test_motion(self):
        holder = pathlib.Path(self.holder.name)
        (holder / "beat").mkdir()
        for percent in (10, 40, 75):
            (holder / "beat" / f"p{percent}.stl").write_bytes((self.folder / "lumen.stl").read_bytes())
        printed = json.loads(run("motion", "fit", holder / "beat", "-o", holder / "beating", "--depth", "1", "--json"))
        validator("motion-fit").validate(printed)
        self.assertEqual(printed, json.loads((holder / "beating" / "report.json").read_text()))
        validator("manifest").validate(json.loads((holder / "beating" / "manifest.json").read_text()))
        cage = json.loads((holder / "beating" / "motion.json").read_text())
        validator("cage-motion").validate(cage)
        run("motion", "export", holder / "beating", "-o", holder / "moving", "--format", "json", "--times", "3")
        validator("motion").validate(json.loads((holder / "moving" / "points.json").read_text()))
        validator("manifest").validate(json.loads((holder / "moving" / "manifest.json").read_text()))
        validator("evaluate").validate(json.loads(run("motion", "evaluate", holder / "beating", holder / "beat", "--sample", "1", "--json")))
        for name, document in (("cage-motion", cage), ("motion-fit", printed)):
            for field in document:
                broken = copy.deepcopy(document)
                del broken[field]
                with self.subTest(field):
                    self.assert_refused(name, broken)
        for change in ({"unit": "m"}, {"template": {"percent": 100, "surface": None}}, {"template": {"percent": 75, "surface": "../a.vtp"}}):
            with self.subTest(change):
                self.assert_refused("cage-motion", {**cage, **change})

    def test_tree_measures(self):
        network = self.folder.parent / "measured.swc"
        network.write_text("1 2 0 0 0 1 -1\n2 2 0 0 5 0.8 1\n3 2 1 0 9 0.5 2\n4 2 -1 0 9 0.6 2\n")
        printed = json.loads(run("measure", network, "-o", self.folder.parent / "measures", "--json"))
        validator("tree-measures").validate(printed)
        for change in ({"kind": "tree"}, {"segments": -1}, {"fits": {}}):
            with self.subTest(change):
                self.assert_refused("tree-measures", {**printed, **change})

    def test_motion_measures(self):
        holder = pathlib.Path(self.holder.name)
        rest = [[x, y, z] for z in (0, 60) for y in (-20, 20) for x in (-20, 20)]
        cage = {"v": 1, "kind": "cage-motion", "unit": "mm", "axes": "LPS", "template": {"percent": 0, "surface": None},
                "grid": {"origin_mm": [-20, -20, 0], "cell_mm": [40, 40, 60], "cells": 1},
                "phases": [{"percent": percent, "origin": "fitted", "control_points": [[x, y, z * share] for x, y, z in rest]}
                           for percent, share in ((0, 1), (40, 0.8), (70, 0.95))]}
        validator("cage-motion").validate(cage)
        (holder / "cage.json").write_text(json.dumps(cage))
        rows = ["vessel,x,y,z,radius"]
        rows += [f"LAD,{0.02 * i * i},0,{i},1" for i in range(31)] + [f"RCA,-10,{0.1 * i},{i},1" for i in range(31)]
        (holder / "two.csv").write_text("\n".join(rows) + "\n")
        printed = json.loads(run("motion", "measure", holder / "cage.json", holder / "two.csv", "-o", holder / "measures", "--times", "5", "--json"))
        validator("motion-measures").validate(printed)
        validator("manifest").validate(json.loads((holder / "measures" / "manifest.json").read_text()))
        for field in printed:
            broken = copy.deepcopy(printed)
            del broken[field]
            with self.subTest(field):
                self.assert_refused("motion-measures", broken)
        for field, unit in (("stretch", "mm"), ("length", ""), ("twist", "rad")):
            broken = copy.deepcopy(printed)
            broken["branches"][0]["measures"][field]["unit"] = unit
            with self.subTest(field):
                self.assert_refused("motion-measures", broken)

    def test_what_commands_print(self):
        at = pathlib.Path(self.holder.name) / "printed"
        at.mkdir()
        header = ("NRRD0004\ntype: {}\ndimension: 3\nspace: left-posterior-superior\nsizes: 16 16 30\n"
                  "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nendian: little\n"
                  "encoding: raw\nspace origin: (0,0,0)\n\n")
        inside = [(x - 8) ** 2 + (y - 8) ** 2 < 8 and 3 < z < 26 for z in range(30) for y in range(16) for x in range(16)]
        (at / "ct.nrrd").write_bytes(header.format("short").encode() + b"".join((300 if i else -80).to_bytes(2, "little", signed=True) for i in inside))
        (at / "mask.nrrd").write_bytes(header.format("uint8").encode() + bytes(int(i) for i in inside))
        (at / "tree.swc").write_text("1 2 0 0 0 2 -1\n2 2 0 0 9 2 1\n3 2 3 2 18 1.5 2\n4 2 -3 2 18 1.5 2\n")
        (at / "lines.csv").write_text("x,y,z,radius\n" + "".join(f"8,8,{0.5 * i},2.5\n" for i in range(12, 48)))

        def holds(schema, *arguments, codes=(0,)):
            printed = json.loads(run(*arguments, "--json", codes=codes))
            validator(schema).validate(printed)
            for field in ("v", "kind"):
                self.assert_refused(schema, {k: v for k, v in printed.items() if k != field})
            return printed

        holds("import", "import", at / "ct.nrrd", "-o", at / "ct.mha")
        holds("segment", "segment", at / "ct.nrrd", "-o", at / "lumen.vtp", "--branch", "8,8,6:8,8,23", codes=(0, 4))
        holds("segment", "segment", at / "mask.nrrd", "-o", at / "mask.vtp")
        lines = holds("centerline", "centerline", at / "mask.vtp", "-o", at / "lines.vtp", "--source", "8,8,6", "--target", "8,8,23")
        self.assertEqual(lines["unreached"], [])
        holds("skeleton", "skeleton", at / "mask.nrrd", "-o", at / "skeleton.vtp")
        holds("lumen", "lumen", at / "lines.csv", "-o", at / "wall.vtp", "--case", at / "case.ostia")
        holds("replay", "replay", at / "case.ostia")
        for source, target in (("mask.vtp", "a.stl"), ("lines.csv", "a.vtp"), ("tree.swc", "b.vtp"), ("ct.nrrd", "a.mha"),
                               ("mask.nrrd", "b.mha"), ("case.ostia", "b.stl"), ("case.ostia", "c.csv"), ("../out/mesh.vtu", "a.msh"),
                               ("../out/mesh.vtu", "c.vtp")):
            with self.subTest(target):
                holds("convert", "convert", at / source, at / target)
        holds("convert", "convert", at / "mask.vtp", at / "d.vtp", "--repair", "--smooth", "2", "--subdivide", "1")
        holds("grow", "grow", at / "tree.swc", "-o", at / "grown.vtp", "--wall", "1", codes=(0, 4))
        holds("reconstruct", "reconstruct", at / "tree.swc", "-o", at / "tree.vtp", "--level", "1", "--sides", "4", "--hexahedra", at / "hexahedra.vtu")
        for kind in ("case.ostia", "hexahedra.vtu", "../out/mesh.vtu", "../out"):
            with self.subTest(kind):
                holds("info", "info", at / kind)
        holds("solver-case", "case", self.folder / "mesh.vtu", "-o", at / "flow")
        holds("solver-case", "case", at / "flow", "--iterations", "10")
        (at / "beat").mkdir()
        for percent in (10, 40, 75):
            (at / "beat" / f"p{percent}.stl").write_bytes((self.folder / "lumen.stl").read_bytes())
        run("motion", "fit", at / "beat", "-o", at / "beating", "--depth", "1")
        holds("info", "info", at / "beating")
        holds("motion-apply", "motion", "apply", at / "beating", self.folder / "lumen.stl", "-o", at / "b.vtp", "--phase", "40")
        holds("motion-apply", "motion", "apply", at / "beating", self.folder / "mesh.vtu", "-o", at / "b.vtu", "--phase", "40")
        holds("motion-export", "motion", "export", at / "beating", "-o", at / "moving", "--times", "3")
        chain = {"v": 1, "variables": {"mask": "mask.nrrd"}, "steps": [{"command": "skeleton", "input": "{mask}", "output": "lines.vtp"}]}
        (at / "chain.json").write_text(json.dumps(chain))
        for _ in range(2):  # the second time it is there already
            self.assertEqual(len(holds("run", "run", at / "chain.json", "-o", at / "run", "--set", f"mask={at / 'mask.nrrd'}")["steps"]), 1)
        (at / "table.csv").write_text(f"case,mask\none,{at / 'mask.nrrd'}\n")
        self.assertEqual(holds("batch", "batch", at / "table.csv", "--pipeline", at / "chain.json", "-o", at / "batch")["well"], 1)
        (at / "scans.csv").write_text("id,scan,kind\n1,mask.nrrd,mask\n2,gone.nrrd,mask\n")
        self.assertEqual(holds("cohort-init", "cohort", "init", at / "scans.csv", "-o", at / "study", codes=(3,))["made"], False)
        self.assertEqual(holds("cohort-init", "cohort", "init", at / "scans.csv", "-o", at / "study", "--skip-bad", codes=(4,))["scans"], 1)
        with sqlite3.connect(at / "study" / "cohort.sqlite") as database:
            scan = database.execute("SELECT pseudonym FROM scan").fetchone()[0]
        database.close()
        step = FOLDER.parent.parent / "apps/ostia/workflow/step.py"
        for stage in ("import", "extract", "lumen"):
            subprocess.run([sys.executable, "-B", step, at / "study", scan, stage, "--ostia", PROGRAM], check=True, timeout=100)
            validator("cohort-step").validate(json.loads((at / "study" / "logs" / scan / f"{stage}.json").read_text()))
        self.assertEqual(holds("cohort-status", "cohort", "status", at / "study")["stages"][0]["ok"], 1)
        self.assertEqual(holds("cohort-page", "cohort", "page", at / "study")["scans"], 1)
        made = json.loads((at / "study/cases" / scan / "manifest.json").read_text())["outputs"]["case.ostia"]
        reviews = {"v": 1, "kind": "cohort reviews", "reviews": [{"scan": scan, "verdict": "ok", "reader": "R", "time": "2026-03-01T12:00:00Z", "made": made}]}
        validator("cohort-reviews").validate(reviews)
        (at / "reviews.json").write_text(json.dumps(reviews))
        self.assertEqual(holds("cohort-review", "cohort", "review", at / "study", at / "reviews.json")["ok"], 1)
        workflow = FOLDER.parent.parent / "apps/ostia/workflow"
        subprocess.run([sys.executable, "-B", "-c", "import pathlib, sys\nsys.path.insert(0, sys.argv[1])\nimport runs, step\ncohort, folder = map(pathlib.Path, (sys.argv[2], sys.argv[1]))\n"
                        "run = runs.begin(cohort, folder, {'threads': 1, 'retries': 2, 'needs_review': False}, {'name': 'snakemake', 'version': '7.21.0', 'python': '3.11.2'}, "
                        "runs.version_of(sys.argv[3]), step.write_whole)\nruns.end(cohort, run, True, step.write_whole)", workflow, at / "study", PROGRAM], check=True, timeout=100)
        validator("cohort-run").validate(json.loads((at / "study/logs/runs/1.json").read_text()))
        self.assertEqual(holds("cohort-crate", "cohort", "crate", at / "study")["steps"], 3)
        self.assertEqual(holds("cohort-reproduce", "cohort", "reproduce", at / "study", "-o", at / "reproduced")["differs"], 0)
        validator("manifest").validate(json.loads((at / "reproduced" / "manifest.json").read_text()))
        holds("cohort-init", "cohort", "init", at / "scans.csv", "-o", at / "later", "--skip-bad", codes=(4,))
        self.assertEqual(holds("cohort-compare", "cohort", "compare", at / "study", at / "later", "-o", at / "changes")["matched"], 0)
        self.assertEqual(holds("cohort-table", "cohort", "table", at / "study", "-o", at / "tables")["scans"], 1)
        validator("manifest").validate(json.loads((at / "tables" / "manifest.json").read_text()))
        (at / "tables.made").mkdir()
        (at / "tables.made/measures.csv").write_text("scan,patient,level,entry,item,measure,value,unit\n" + "".join(f"p-{i},p-0,outlet,1,LAD,ffr,0.{i},1\n" for i in (5, 7, 9)))
        (at / "known.csv").write_text("scan,ischemia,ffr\np-5,1,0.6\np-7,0,0.7\np-9,0,0.9\n")
        self.assertEqual(holds("cohort-statistics", "cohort", "statistics", at / "tables.made", at / "known.csv", "-o", at / "statistics")["outcomes"][0]["area"], 1.0)
        validator("manifest").validate(json.loads((at / "statistics" / "manifest.json").read_text()))

    def test_every_command_has_json(self):
        def commands(words):
            text = run(*words, "--help")
            below = [line.split()[0] for line in text.partition("Subcommands:\n")[2].partition("\n\n")[0].splitlines() if line.startswith("  ") and line[2] != " "]
            if not below:
                yield words, text
            for word in below:
                yield from commands([*words, word])

        for words, text in commands([]):
            with self.subTest(" ".join(words)):
                self.assertIn("--json", text)

    def test_broken_documents_fail(self):
        for field in self.report:
            broken = copy.deepcopy(self.report)
            del broken[field]
            with self.subTest(field):
                self.assert_refused("report", broken)
        for change in ({"exit_code": 3}, {"outputs": {"a": "not a digest"}}, {"finished": "yesterday"}, {"path": "/home/x"}, {"v": 2}):
            with self.subTest(change):
                self.assert_refused("manifest", {**self.manifest, **change})
        quality = copy.deepcopy(self.manifest["quality"])
        quality["surface"]["min_angle_deg"] = "large"
        self.assert_refused("quality", quality)
        quality = copy.deepcopy(self.manifest["quality"])
        quality["verdict"] = {"passed": True, "reasons": ["a reason"]}
        self.assert_refused("quality", quality)
        self.assert_refused("info", {"kind": "surface"})


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
