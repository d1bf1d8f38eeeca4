#include "command_table.h"

#include "mesh/cli_mesh.h"
#include "options/shown_defaults.h"
#include "options/validators.h"
#include "phantom/cli_phantom.h"
#include "tree/tree_input.h"
#include "vessel/cli_segment.h"

#include "ostia/centerline/extract_centerlines.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <filesystem>
#include <string>

namespace ostia::app {
namespace {

void add_common(CLI::App& app, CommonOptions& o) {
  app.add_option("--threads", o.threads, "Threads to use; 0: all cores. Results do not depend on it")
      ->check(CLI::Range(0, 1024));
  app.add_option("--seed", o.seed, "Seed of everything random");
  app.add_option("--config", "A JSON file of options, {\"edge-ratio\": 0.3, ...}; the command line wins");
  app.add_option("--log", o.log, "Format of the log on standard error")
      ->check(CLI::IsMember({"text", "json"}));
  app.add_option("--progress", o.progress, "auto: a bar on a terminal; plain: a line a stage")
      ->check(CLI::IsMember({"auto", "plain", "none"}));
  app.add_flag("--quiet", o.quiet, "Errors alone on standard error");
}

void add_input(CLI::App& app, InputOptions& o, const std::string& what, bool required = true) {
  auto* input = app.add_option("INPUT", o.input, what);
  if (required) input->required();
}

void add_dicom(CLI::App& app, InputOptions& o) {
  app.add_option("--series", o.series, "UID of the DICOM series, where the folder holds several");
  app.add_flag("--resample", o.resample, "Interpolate over missing or uneven slices");
  app.add_option("--pixel-spacing", o.pixel_spacing_mm, "mm, where the DICOM files have none")
      ->check(above_zero());
  app.add_option("--slice-spacing", o.slice_spacing_mm, "mm, where the DICOM files have no positions")
      ->check(above_zero());
}

void add_units(CLI::App& app, InputOptions& o) {
  app.add_option("--units", o.units,
                 "Unit of length of a surface and of the points given with it; left out: recognised by "
                 "the calibre of its vessels")
      ->check(CLI::IsMember({"m", "cm", "mm"}));
  app.add_flag("--strict", o.strict, "Refuse a surface that has faults instead of mending it");
}

void add_keep(CLI::App& app, std::filesystem::path& folder) {
  app.add_option(
      "--keep", folder,
      "Where it fails: folder for what was made until then (lumen, centerlines, level set); left out: "
      "the hidden folder .unfinished-NAME beside the output");
}

void add_coords(CLI::App& app, InputOptions& o) {
  app.add_option("--coords", o.coords, "Frame of the points given: lps or ras (mm), ijk (voxels)")
      ->check(CLI::IsMember({"lps", "ras", "ijk"}));
}

void add_ends(CLI::App& app, EndOptions& o) {
  app.add_option("--source", o.source,
                 "Where the centerlines begin, x,y,z in the input's unit, or a file of one point (.mrk.json, "
                 ".fcsv, .csv); left out: the largest open end");
  app.add_option("--target", o.targets,
                 "Where a centerline ends, or a file of such points; repeat; left out: the other open ends")
      ->allow_extra_args(false);
  app.add_option("--seed-units", o.seed_units,
                 "Unit of --source and --target; left out: the input's own, and of markups what they say")
      ->check(CLI::IsMember({"m", "cm", "mm"}));
  app.add_option("--step", o.step_mm,
                 "Distance between the centerline's points, mm" +
                     default_text(centerline::CenterlineOptions().step_mm))
      ->check(above_zero());
}

CLI::App* command(CLI::App& app, const std::string& name, const std::string& text,
                  const std::string& example) {
  CLI::App* sub = app.add_subcommand(name, text);
  sub->footer("Example:\n  " + example);
  sub->fallthrough();
  return sub;
}

}  // namespace

void define(CLI::App& app, Commands& c, Run& run) {
  app.require_subcommand(1);
  capture_defaults(app);
  add_common(app, c.common);

  CLI::App* info = command(app, "info", "What an image, a DICOM folder, a surface or a tree is",
                           "ostia info CT/ --preview slices");
  add_input(
      *info, c.info.input,
      "DICOM folder or zip, image, surface, tree of vessels, case, volume mesh, motion, or a folder that "
      "a command has made");
  add_dicom(*info, c.info.input);
  add_coords(*info, c.info.input);
  info->add_flag("--json", c.info.json, "One JSON object on standard output");
  info->add_option("--preview", c.info.preview,
                   "Folder for slices with rulers in world mm, to read seeds off");
  info->add_option("--preview-slices", c.info.preview_slices, "How many axial slices")
      ->check(CLI::Range(0, 100));
  info->add_option("--position", c.info.position, "Point through which the preview's three planes go, x,y,z");
  info->callback([&] { run = [&](const core::TaskContext& task) { return run_info(c.info, task); }; });

  CLI::App* volume =
      command(app, "import", "A DICOM series as one volume in HU", "ostia import CT/ -o heart.nrrd");
  add_input(*volume, c.import.input, "DICOM folder or zip, or image");
  add_dicom(*volume, c.import.input);
  volume->add_option("-o,--output", c.import.output, ".nrrd, .mhd or .mha")->required();
  volume->add_flag("--json", c.import.json, "One JSON object on standard output");
  volume->callback([&] { run = [&](const core::TaskContext& task) { return run_import(c.import, task); }; });

  define_evaluate(app, c.evaluate, run);
  define_experiment(app, c.experiment, c.common.seed, run);
  define_lumen(app, c.lumen, c.replay, run);
  define_report(app, c.report, run);
  define_compare(app, c.compare, run);
  define_carry(app, c.carry, run, add_dicom);
  define_calcium(app, c.calcium, run, add_dicom);
  define_fat(app, c.fat, run);
  define_territories(app, c.territories, run);
  define_dicom(app, c.dicom, run);
  define_deidentify(app, c.deidentify, run);
  define_filter(app, c.filter, run, add_dicom);
  define_doctor(app, c.doctor, run);
  define_skeleton(app, c.skeleton, run);
  define_grow(app, c.grow, c.common.seed, run);
  define_reconstruct(app, c.reconstruct, run);
  define_extract(app, c.extract, run, add_dicom);
  define_run(app, c.chain, c.batch, c.common, run);
  define_plugin(app, c.plugin, run);
  define_case(app, c.solver_case, run);
  define_result(app, c.result, run);
  define_ffr(app, c.ffr, c.common.seed, run);
  define_motion(app, c.motion, run);
  define_pacs(app, c.pacs, run);
  define_cohort(app, c.cohort, run);

  CLI::App* segment = command(app, "segment", "The lumen of the vessels between seed points",
                              "ostia segment heart.nrrd -o lumen.vtp --branch 8,-187,675:6,-178,720\n"
                              "  ostia segment heart.nrrd -o aorta.nrrd --aorta");
  add_input(*segment, c.segment.input, "DICOM folder or zip, image or mask");
  add_dicom(*segment, c.segment.input);
  add_coords(*segment, c.segment.input);
  segment->add_option("-o,--output", c.segment.output, ".vtp, .stl or .ply")->required();
  add_lumen(*segment, c.segment.lumen);
  segment->add_option("--levelset", c.segment.level_set,
                      "Also the level set, negative inside, mm: .nrrd, .mhd or .mha");
  add_aorta(*segment, c.segment);
  add_keep(*segment, c.segment.keep);
  segment->add_flag("--json", c.segment.json, "One JSON object on standard output");
  segment->callback([&, segment] {
    require_aorta_alone(*segment);
    run = [&](const core::TaskContext& task) { return run_segment(c.segment, task); };
  });

  CLI::App* centerline =
      command(app, "centerline", "Centerlines of a surface", "ostia centerline lumen.stl -o lines.vtp");
  add_input(*centerline, c.centerline.input, "Surface, open or closed");
  add_units(*centerline, c.centerline.input);
  add_coords(*centerline, c.centerline.input);
  add_ends(*centerline, c.centerline.ends);
  centerline->add_option("-o,--output", c.centerline.output, ".vtp, .csv or .mrk.json")->required();
  centerline->add_option("--canal", c.centerline.canal,
                         "Also the envelope of the inscribed spheres: .vtp, .stl or .ply");
  centerline->add_flag("--json", c.centerline.json, "One JSON object on standard output");
  centerline->callback(
      [&] { run = [&](const core::TaskContext& task) { return run_centerline(c.centerline, task); }; });

  CLI::App* mesh = command(app, "mesh", "A volume mesh with named faces, and layers of prisms on the wall",
                           "ostia mesh lumen.stl -o mesh --edge-ratio 0.3\n"
                           "  ostia mesh lumen.stl -o mesh --layers 3 --layer-thickness 0.5 --export "
                           "openfoam,gmsh4\n"
                           "  ostia mesh --check mesh/mesh.vtu");
  add_input(*mesh, c.mesh.input, "Surface, open or closed, a mask of coronary arteries, or a case", false);
  add_mask(*mesh, c.mesh.of_mask);
  add_units(*mesh, c.mesh.input);
  add_coords(*mesh, c.mesh.input);
  add_ends(*mesh, c.mesh.ends);
  add_mesh(*mesh, c.mesh.mesh);
  add_mesh_command(*mesh, c.mesh);
  add_keep(*mesh, c.mesh.keep);
  mesh->callback([&] { run = [&](const core::TaskContext& task) { return run_mesh(c.mesh, task); }; });

  CLI::App* convert = command(app, "convert", "One file format as another",
                              "ostia convert lumen.vtp lumen.stl\n"
                              "  ostia convert centerlines.vtp axes.mrk.json\n"
                              "  ostia convert grown.gxl tree.vtp --repair");
  add_input(*convert, c.convert.input, "Image, surface, centerlines, tree, case or volume mesh");
  convert->add_option("OUTPUT", c.convert.output, "By its extension")->required();
  add_units(*convert, c.convert.input);
  convert->add_flag(
      "--repair", c.convert.tree.repair,
      "Surfaces: drop bad triangles and loose parts, join equal points, take apart what only "
      "touches, turn outward, cut self-intersections out. Trees: drop bad segments, join equal points, "
      "fill missing radii in, turn and order the segments from the root");
  add_tree_input(*convert, c.convert.tree, "Trees: ", "Repair of trees: ");
  convert->add_option("--fill-holes", c.convert.fill_holes_mm, "Repair: also close holes up to this wide, mm")
      ->check(above_zero());
  convert->add_flag(
      "--landmarks", c.convert.landmarks,
      "To markups: where vessels begin, divide and end, and a case's measurements, instead of axes");
  convert->add_flag("--keep-parts", c.convert.keep_parts, "Repair: all parts stay, specks too");
  convert->add_flag("--largest-part", c.convert.largest_part, "Repair: only the largest part stays")
      ->excludes("--keep-parts");
  convert
      ->add_option("--smooth", c.convert.smooth,
                   "Surfaces: steps of smoothing without shrinking; 30 is usual")
      ->check(CLI::Range(1, 1000));
  convert
      ->add_option("--subdivide", c.convert.subdivide,
                   "Surfaces: four smooth triangles of one, so many times")
      ->check(CLI::Range(1, 8));
  convert
      ->add_option("--format", c.convert.format,
                   "Volume meshes: what they become, where the output's name does not say it")
      ->check(CLI::IsMember(mesh_format_names()));
  convert->add_option("--grid", c.convert.grid,
                      "Cases: the CT, or a mask, on whose voxels labels are written (.nrrd, .nii.gz, ...)");
  convert
      ->add_option("--labels", c.convert.labels,
                   "With --grid: lumen (the default), segments (AHA and SCCT numbers), wall, plaque")
      ->check(CLI::IsMember({"lumen", "segments", "wall", "plaque"}));
  convert->add_flag("--json", c.convert.json, "What was done as one JSON object on standard output");
  convert->callback(
      [&] { run = [&](const core::TaskContext& task) { return run_convert(c.convert, task); }; });

  CLI::App* measure = command(
      app, "measure",
      "Lengths, areas, volumes, orders, angles, scaling laws and overlaps of a tree; sections "
      "and bifurcations of a lumen",
      "ostia measure tree.vtp -o measures\n  ostia measure lumen.vtp -o measures --sections --bifurcations");
  add_input(*measure, c.measure.input,
            "Tree of vessels (.vtp, .vtk, .swc, .csv, .gxl), case or surface, or a folder of them");
  add_units(*measure, c.measure.input);
  add_coords(*measure, c.measure.input);
  add_ends(*measure, c.measure.ends);
  add_branch_measures(*measure, c.measure);
  measure->add_option("-o,--output", c.measure.output, "Folder that is made")->required();
  measure->add_flag("--json", c.measure.json, "measures.json on standard output");
  measure->callback(
      [&] { run = [&](const core::TaskContext& task) { return run_measure(c.measure, task); }; });

  CLI::App* model = command(app, "model", "From an image, a mask or a surface to a mesh with named faces",
                            "ostia model CT/ -o out --branch 8,-187,675:6,-178,720");
  add_input(*model, c.model.input, "DICOM folder or zip, image, mask or surface", false);
  add_mask(*model, c.model.of_mask);
  add_dicom(*model, c.model.input);
  add_units(*model, c.model.input);
  add_coords(*model, c.model.input);
  add_lumen(*model, c.model.lumen);
  add_ends(*model, c.model.ends);
  add_mesh(*model, c.model.mesh);
  model->add_option("-o,--output", c.model.output, "Folder that is made")->required();
  model->add_flag("--builtin", c.model.builtin, "The built-in case instead of an input");
  model->add_flag("--json", c.model.json, "The report as JSON on standard output");
  add_keep(*model, c.model.keep);
  model->callback([&] {
    c.model.seed = c.common.seed;
    run = [&](const core::TaskContext& task) { return run_model(c.model, task); };
  });

  CLI::App* phantom = command(app, "phantom", "Synthetic coronary CT angiograms of exactly known truth",
                              "ostia phantom -o suite --preset small --cases 3");
  add_phantom(*phantom, c.phantom);
  phantom->callback([&] {
    c.phantom.seed = c.common.seed;
    run = [&](const core::TaskContext& task) { return run_phantom(c.phantom, task); };
  });
  show_defaults(app);
}

}  // namespace ostia::app
