"""What the commands can, Python can: every command of the program, and every function of the package."""
import inspect

import pytest

import ostia
from ostia import _ostia, commands

READ_AND_WRITE = ["read_image", "read_mask", "read_labels", "read_float_image", "write_image", "read_surface", "read_faced_surface", "write_surface",
                  "read_centerlines", "write_centerlines", "read_graph", "write_graph", "read_volume_mesh", "export_mesh", "read_contours", "write_contours",
                  "read_markups", "write_markups", "landmarks", "read_surface_fields", "write_surface_fields", "read_mesh_fields", "write_mesh_fields"]
# The functions of the package that do a command's work in process.
REACH = {
    "info": ["read_ct", "read_surface", "read_centerlines", "VesselGraph.facts", "VesselGraph.faults", "surface_shape", "mesh_quality", "Case.journal"],
    "import_": ["read_ct", "write_image"],
    "convert": READ_AND_WRITE + ["repair_surface", "repair_graph", "smoothed_in_volume", "taubin_smoothed", "loop_subdivided", "label_volume"],
    "segment": ["segment_vessels", "segment_mask", "lumen_surface", "segment_aorta"],
    "centerline": ["extract_centerlines"],
    "extract": ["extract", "extract_mask", "FoundModel.save"],
    "skeleton": ["skeleton_of"],
    "lumen": ["model_of_tubes", "model_of_surface", "model_of_image", "model_of_contours", "apply_edit", "LumenModel.surface", "Case.create", "Case.edit"],
    "replay": ["Case.replay"],
    "mesh": ["extract_centerlines", "mesh_lumen", "target_edge_lengths", "remesh", "tetrahedralize", "fill_with_layers", "end_planes", "sizes_from_field",
             "export_model_mesh", "export_model_surface", "mesh_quality"],
    "model": ["read_ct", "segment_vessels", "lumen_surface", "extract_centerlines", "mesh_lumen", "export_mesh", "builtin_case"],
    "measure": ["measure_tree", "measure_branches", "find_overlaps"],
    "grow": ["grow_tree"],
    "reconstruct": ["reconstruct_surface", "write_quad_surface", "sweep_hexahedra", "write_hex_mesh", "frusta"],
    "report": ["write_report", "find_stenoses", "lumen_profile", "find_plaque", "scan_quality", "Case.annotate", "Case.measurements", "Case.marks", "Case.report_notes"],
    "compare": ["compare_cases"],
    "carry": ["carry_case"],
    "calcium": ["score_calcium"],
    "fat": ["measure_fat"],
    "filter": ["filter_image", "list_filters"],
    "territories": ["find_territories"],
    "case": ["write_openfoam_case", "write_svmultiphysics_case", "continue_openfoam_case", "waveform"],
    "result": ["read_flow_result", "flow_report", "write_flow_result"],
    "ffr": ["pressure", "write_pressure", "pressure_wall", "export_network", "solve_network", "condition_inputs", "Case.pressure_inputs", "Case.what_ifs"],
    "motion_fit": ["fit_motion", "surfaces_from_images", "write_motion"],
    "motion_apply": ["read_motion", "Motion.carried", "carried_quality"],
    "motion_evaluate": ["Motion.carried", "evaluate_motion"],
    "motion_export": ["export_motion"],
    "motion_measure": ["measure_motion"],
    "phantom": ["phantom_case", "write_phantom", "sample_case"],
    "evaluate_centerline": ["evaluate_centerline", "ReferenceLine.read"],
    "evaluate_lumen": ["evaluate_lumen", "lumen_floor", "diameter_stenosis", "bland_altman", "detect_stenoses"],
    "evaluate_surface": ["evaluate_surface", "surface_shape"],
    "evaluate_volume": ["evaluate_volume"],
    "evaluate_motion": ["evaluate_motion", "evaluate_motion_points"],
    "evaluate_suite": ["evaluate_suite"],
    "experiment_editing": ["experiment_editing"],
    "experiment_extraction": ["experiment_extraction"],
    "experiment_orientations": ["experiment_orientations"],
    "experiment_smoothness": ["experiment_smoothness"],
    "experiment_chain": ["experiment_chain"],
    "experiment_carotid": ["experiment_carotid"],
    "experiment_sensitivity": ["experiment_sensitivity"],
    "experiment_robustness": ["experiment_robustness"],
    "experiment_certainty": ["experiment_certainty"],
    "experiment_hard": ["experiment_hard"],
    "experiment_reading": ["experiment_reading"],
    "experiment_motion": ["experiment_motion"],
    "experiment_wall_spread": ["experiment_wall_spread"],
}
# Reached by ostia.commands alone, and why.
BY_COMMAND_ALONE = {
    "run_pipeline": "a chain of commands; in Python the script is the chain",
    "batch": "a chain of commands for every row of a table; in Python a loop over the table",
    "experiment_pressure": "runs OpenFOAM beside the program for days",
    "cohort_init": "makes a folder from a table, for a workflow of commands; its SQLite files are what a script reads",
    "cohort_status": "counts what commands have left in that folder; its JSON is what a script reads",
    "cohort_page": "makes a page for a browser of what is in that folder",
    "cohort_serve": "serves that page to a browser until it is interrupted",
    "cohort_review": "takes in a file that the page exported; its rows are in that folder's SQLite file",
    "cohort_compare": "makes a page of two such folders; its JSON and CSV are what a script reads",
    "cohort_crate": "tells in a JSON file of that folder how its results were made",
    "cohort_reproduce": "runs commands on scans of that folder once more and compares files",
    "cohort_statistics": "makes a page of those tables and a table beside them; its CSV files are what a script reads",
    "cohort_table": "gathers reports of that folder into CSV and SQLite, which a script reads",
    "pacs_echo": "asks a server on the network whether it answers",
    "pacs_find": "asks a server on the network; its JSON is what a script reads",
    "pacs_get": "fetches from a server; read_ct reads the folder that it makes",
    "pacs_send": "sends files to a server",
    "pacs_queue": "shows and sends what waits for a server",
    "dicom": "writes the files that a PACS keeps; its numbers are those of write_report",
    "deidentify": "copies files for others",
    "doctor": "looks at the machine and the installed programs",
    "plugin_list": "lists a person's own Python functions, which a script imports",
    "plugin_run": "runs one of them on a copy of a case; a script calls it",
}
# No command's work.
BESIDE = ["version", "set_threads", "threads", "example_surface", "r_peaks", "picture"]


def function_of(name):
    found = _ostia
    for part in name.split("."):
        found = getattr(found, part)
    return found


def test_every_command_is_in_one_of_the_tables():
    assert set(commands.names) == REACH.keys() | BY_COMMAND_ALONE.keys()
    assert not REACH.keys() & BY_COMMAND_ALONE.keys()
    assert all(REACH.values()) and all(len(reason) > 10 for reason in BY_COMMAND_ALONE.values())


def test_every_command_is_reached_at_least_by_its_own_name():
    assert all(callable(getattr(commands, name)) for name in commands.names)


@pytest.mark.parametrize("command", sorted(REACH))
def test_what_does_a_commands_work_is_there(command):
    for name in REACH[command]:
        found = function_of(name)
        assert callable(found) or isinstance(found, property), name


def test_every_function_does_some_commands_work():
    told = {name for names in REACH.values() for name in names} | set(BESIDE)
    functions = {name for name in dir(_ostia) if not name.startswith("_") and callable(getattr(_ostia, name)) and not inspect.isclass(getattr(_ostia, name))}
    assert functions - told == set()
    assert {name for name in told if "." not in name} - functions == set()


def test_a_command_that_is_new_would_be_told():
    """The first test would fail: its sets are equal, not one within the other."""
    assert set(commands.names) | {"a_new_one"} != REACH.keys() | BY_COMMAND_ALONE.keys()
    assert not hasattr(ostia, "a_new_one")
