// The options of `ostia motion` and its subcommands.

#include "motion/motion.h"
#include "options/validators.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace ostia::app {
namespace {

using MotionRun = std::function<ExitCode(const core::TaskContext&)>;

template <class Command>
CLI::App* add(CLI::App& motion, const char* name, const char* text, const char* example, Command& command,
              ExitCode (*one)(const Command&, const core::TaskContext&), MotionRun& run) {
  CLI::App* sub = motion.add_subcommand(name, text);
  sub->footer(std::string("Example:\n  ") + example);
  sub->fallthrough();
  sub->callback([&command, &run, one] {
    run = [&command, one](const core::TaskContext& task) { return one(command, task); };
  });
  return sub;
}

void add_motion(CLI::App& app, std::filesystem::path& motion) {
  app.add_option("MOTION", motion, "motion.json, or the folder that `ostia motion fit` has made")->required();
}

void add_frames(CLI::App& app, int& frames) {
  app.add_option("--frames", frames,
                 "The numbers in the names count frames, this many a cycle; left out: they are percent of "
                 "the cycle since the R peak")
      ->check(CLI::Range(3, 1000));
}

void add_units(CLI::App& app, std::string& units, const char* text = "Unit of length of the surfaces") {
  app.add_option("--units", units, text)->check(CLI::IsMember({"m", "cm", "mm"}));
}

void add_fit(CLI::App& motion, MotionFitCommand& c, MotionRun& run) {
  CLI::App* fit =
      add(motion, "fit", "From images, surfaces, masks or cases at several phases to one surface that beats",
          "ostia motion fit phases/ -o beating --depth 4", c, run_motion_fit, run);
  fit->add_option(
         "INPUT", c.input,
         "Folder of surfaces, masks, cases (.ostia) or images, one a phase, of folders phase-NN with "
         "lumen.vtp or an image, or of DICOM files of several phases; the last number in a name is "
         "its phase")
      ->required();
  fit->add_option("-o,--output", c.output, "Folder that is made")->required();
  fit->add_option("--template", c.shape,
                  "Surface, mask or case at --template-phase: it is what is carried, and in images it is "
                  "looked for, phase by phase");
  fit->add_option("--template-phase", c.template_percent,
                  "Percent of the cycle: the nearest phase's surface is carried to the others; default 75")
      ->check(CLI::Range(0.0, 100.0));
  fit->add_option("--depth", c.depth, "Of the cage: 2^depth cells a side, 1 to 5; default 4")
      ->check(CLI::Range(1, 5));
  fit->add_option(
         "--weights", c.weights,
         "Of the cage's energy: length,area,volume, or one number for all three; default 10, more is stiffer")
      ->delimiter(',')
      ->check(zero_or_above());
  fit->add_option("--method", c.method,
                  "How a phase is registered: gauss-newton, or gradient-descent, slow, to compare with")
      ->check(CLI::IsMember({"gauss-newton", "gradient-descent"}));
  fit->add_option("--by", c.by,
                  "What carries the template through images, before its wall is looked for: cage, or "
                  "b-splines, ITK's, by all of the image about it")
      ->check(CLI::IsMember({"cage", "b-splines"}));
  fit->add_option("--surface", c.surface,
                  "How masks get their surface: isosurface, or poisson, smoother, through that one's points")
      ->check(CLI::IsMember({"isosurface", "poisson"}));
  add_frames(*fit, c.frames);
  add_units(*fit, c.units);
  fit->add_flag("--json", c.json, "The report as JSON on standard output");
}

void add_apply(CLI::App& motion, MotionApplyCommand& c, MotionRun& run) {
  CLI::App* apply =
      add(motion, "apply", "A surface, a volume mesh or centerlines at any time of the cycle",
          "ostia motion apply beating lumen.vtp -o systole.vtp --phase 37.5", c, run_motion_apply, run);
  add_motion(*apply, c.motion);
  apply->add_option("INPUT", c.input, "Surface, volume mesh or centerlines, at the template's phase")
      ->required();
  apply
      ->add_option("-o,--output", c.output,
                   ".vtp, .stl or .ply for a surface, .vtu for a mesh, .vtp or .csv for lines")
      ->required();
  apply->add_option("--phase", c.percent, "Percent of the cycle since the R peak; 125 is 25")->required();
  add_units(*apply, c.units, "Unit of length of the input; what is written is in mm");
  apply->add_flag("--json", c.json, "One JSON object on standard output");
}

void add_evaluate(CLI::App& motion, MotionEvaluateCommand& c, MotionRun& run) {
  CLI::App* evaluate = add(motion, "evaluate", "A motion against surfaces by phase, those left out of it too",
                           "ostia motion evaluate beating phases/ --every 2", c, run_motion_evaluate, run);
  add_motion(*evaluate, c.motion);
  evaluate->add_option("REFERENCE", c.reference, "Folder of surfaces or masks, one a phase")->required();
  auto* keep = evaluate
                   ->add_option("--keep", c.keep,
                                "Phases of the motion that are used, percent, separated by commas; all are "
                                "judged")
                   ->delimiter(',');
  evaluate->add_option("--every", c.every, "The same: every so many, from the first on")
      ->check(CLI::Range(1, 1000))
      ->excludes(keep);
  evaluate->add_option("--surface", c.surface, "What is carried; left out: the template beside the motion");
  add_frames(*evaluate, c.frames);
  add_units(*evaluate, c.common.units);
  evaluate->add_option("--sample", c.common.sample_mm, "Density of the points that are asked, mm")
      ->check(above_zero());
  evaluate->add_option("--resolution", c.common.resolution_mm, "Voxels in which the insides are compared, mm")
      ->check(above_zero());
  evaluate
      ->add_option("--require", c.common.requirements,
                   "FIGURE<=NUMBER or FIGURE>=NUMBER, as in msd_mm<=0.3; repeat. Exit code 4 where one is "
                   "not met")
      ->allow_extra_args(false);
  evaluate->add_flag("--json", c.common.json, "One JSON object on standard output");
}

void add_export(CLI::App& motion, MotionExportCommand& c, MotionRun& run) {
  CLI::App* out =
      add(motion, "export", "The same triangles or elements at many times, for solvers and pictures",
          "ostia motion export beating --mesh mesh/mesh.vtu -o moving --format vtu,openfoam --rr 0.8", c,
          run_motion_export, run);
  add_motion(*out, c.motion);
  out->add_option("-o,--output", c.output, "Folder that is made")->required();
  out->add_option("--mesh", c.mesh, "A volume mesh at the template's phase, for vtu and openfoam");
  out->add_option("--surface", c.surface, "What is carried; left out: the template beside the motion");
  add_units(*out, c.units, "Unit of length of the --surface");
  out->add_option("--format", c.formats,
                  "vtp and stl: the surface; vtu and openfoam: the mesh; csv: displacements; json: points; "
                  "separated by commas. Default vtp, with a mesh vtu")
      ->delimiter(',')
      ->check(CLI::IsMember({"vtp", "stl", "vtu", "openfoam", "csv", "json"}));
  out->add_option("--times", c.times, "How many, evenly over the cycle; default 20")
      ->check(CLI::Range(1, 10000));
  out->add_option("--rr", c.rr_seconds, "Length of the cycle, s; default 0.8")->check(CLI::Range(0.1, 10.0));
  out->add_flag("--json", c.json, "One JSON object on standard output");
}

void add_measure(CLI::App& motion, MotionMeasureCommand& c, MotionRun& run) {
  CLI::App* measure =
      add(motion, "measure",
          "How a tree's branches move: displacement, speed, stretch, curvature, torsion, twist, "
          "distances, angles, rest periods",
          "ostia motion measure beating centerlines.vtp -o measures --rr 0.8", c, run_motion_measure, run);
  add_motion(*measure, c.motion);
  measure->add_option("LINES", c.input, "Centerlines or case (.ostia), at the template's phase")->required();
  measure
      ->add_option("-o,--output", c.output,
                   "Folder that is made: measures.json, tables, pictures, report.html")
      ->required();
  measure->add_option("--rr", c.rr_seconds, "Length of the cycle, s; default 0.8")
      ->check(CLI::Range(0.1, 10.0));
  measure->add_option("--times", c.times, "How many, evenly over the cycle; default 50")
      ->check(CLI::Range(3, 1000));
  measure
      ->add_option("--reach", c.reach_mm,
                   "Half of the piece of axis that curvature and torsion are taken from, mm; default 4")
      ->check(CLI::Range(0.5, 50.0));
  measure->add_option("--rest", c.rest_mm, "Motion within a rest period, mm; default 1")
      ->check(CLI::Range(1e-6, 100.0));
  measure->add_flag("--json", c.json, "measures.json on standard output");
}

}  // namespace

void define_motion(CLI::App& app, MotionCommands& c, MotionRun& run) {
  CLI::App* motion = app.add_subcommand(
      "motion", "A beating vessel: fit its motion, apply, measure, evaluate and export it; --json of each");
  motion->footer("Example:\n  ostia motion fit phases/ -o beating");
  motion->fallthrough();
  motion->require_subcommand(1);
  add_fit(*motion, c.fit, run);
  add_apply(*motion, c.apply, run);
  add_evaluate(*motion, c.evaluate, run);
  add_export(*motion, c.out, run);
  add_measure(*motion, c.measure, run);
}

}  // namespace ostia::app
