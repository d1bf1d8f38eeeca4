// The options of `ostia evaluate` and its subcommands.

#include "evaluate/evaluate.h"
#include "options/validators.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace ostia::app {
namespace {

using RunOne = ExitCode (*)(const EvaluateCommand&, const core::TaskContext&);

struct Subcommand {
  const char* name;
  const char* text;
  const char* reference;
  const char* result;
  const char* example;
  RunOne run;
};

CLI::App* add(CLI::App& evaluate, EvaluateCommand& c, const Subcommand& what,
              std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* sub = evaluate.add_subcommand(what.name, what.text);
  sub->footer(std::string("Example:\n  ") + what.example);
  sub->fallthrough();
  sub->add_option("REFERENCE", c.reference, what.reference);
  sub->add_option("RESULT", c.result, what.result);
  sub->add_flag("--json", c.json, "One JSON object on standard output");
  sub->callback([&c, &run, one = what.run] {
    run = [&c, one](const core::TaskContext& task) { return one(c, task); };
  });
  return sub;
}

void add_units(CLI::App& app, EvaluateCommand& c) {
  app.add_option("--units", c.units, "Unit of length of both files")->check(CLI::IsMember({"m", "cm", "mm"}));
}

void add_requirements(CLI::App& app, EvaluateCommand& c) {
  app.add_option(
         "--require", c.requirements,
         "FIGURE<=NUMBER or FIGURE>=NUMBER, as in msd_mm<=0.3; repeat. Exit code 4 where one is not met")
      ->allow_extra_args(false);
}

void add_report(CLI::App& app, EvaluateCommand& c) {
  app.add_option("-o,--output", c.report, "A report with pictures and plots, .html");
}

void add_scores(CLI::App& evaluate, EvaluateCommand& c,
                std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* centerline =
      add(evaluate, c,
          {"centerline",
           "Overlap (OV, OF, OT) and accuracy (AI) of centerlines, as the Rotterdam challenge scores",
           "reference.txt, a vessel's or a data set's folder, or the folder of a suite",
           "result.txt, centerlines (.vtp .csv) or the folder of a model; a folder of these for a suite",
           "ostia evaluate centerline suite/dataset00/vessel1/reference.txt out/centerlines.vtp",
           run_evaluate_centerline},
          run);
  add_units(*centerline, c);
  centerline
      ->add_option(
          "--rules", c.rules,
          "How OF and OT are counted: challenge, the default, as its own program does; paper, by the "
          "words of Schaap et al.")
      ->check(CLI::IsMember({"challenge", "paper"}));
  add_requirements(*centerline, c);
  add_report(*centerline, c);
  CLI::App* lumen =
      add(evaluate, c,
          {"lumen", "Dice and distances of annotated lumen sections, healthy and diseased apart",
           "contours.json, a data set's folder, or the folder of a suite",
           "surface, contours (.json) or the folder of a model; a folder of these for a suite",
           "ostia evaluate lumen suite/dataset00 out -o lumen.html", run_evaluate_lumen},
          run);
  add_units(*lumen, c);
  add_requirements(*lumen, c);
  add_report(*lumen, c);
  lumen->add_flag("--floor", c.floor,
                  "Instead of a result: how exact surfaces ruled between contours are, by their spacing");
  lumen->add_flag("--stenoses", c.find_stenoses,
                  "Also how stenoses are detected and graded, section by section");
  lumen
      ->add_option("--stenosis-threshold", c.stenosis_threshold,
                   "Least diameter stenosis that counts, 0 to 1")
      ->check(CLI::Range(0.01, 0.99));
}

void add_shapes(CLI::App& evaluate, EvaluateCommand& c,
                std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* surface = add(evaluate, c,
                          {"surface", "Distances between two surfaces, both ways",
                           "surface or a data set's folder", "surface or the folder of a model",
                           "ostia evaluate surface truth.vtp out/lumen.vtp --json", run_evaluate_surface},
                          run);
  add_units(*surface, c);
  add_requirements(*surface, c);
  add_report(*surface, c);
  surface->add_option("--picture", c.picture,
                      "The surface coloured by signed distance alone: .png .svg .pdf");
  surface->add_flag("--covered", c.covered_only,
                    "Only where the result's centerlines run: for a model of some vessels of a whole tree");
  surface->add_flag("--curvature", c.curvature, "Also the root mean squares of the principal curvatures");
  surface->add_option("--sample", c.sample_mm, "Density of the points that are asked, mm")
      ->check(above_zero());
  CLI::App* volume =
      add(evaluate, c,
          {"volume", "Overlap of two masks, or of what two closed surfaces enclose",
           "mask, closed surface or a data set's folder", "mask, closed surface or model folder",
           "ostia evaluate volume truth.nrrd mask.nrrd", run_evaluate_volume},
          run);
  add_units(*volume, c);
  add_requirements(*volume, c);
  volume->add_flag("--covered", c.covered_only, "Only where the result's centerlines run");
  volume->add_option("--resolution", c.resolution_mm, "Voxels in which surfaces are compared, mm")
      ->check(above_zero());
}

}  // namespace

void define_evaluate(CLI::App& app, EvaluateCommand& c,
                     std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* evaluate =
      app.add_subcommand("evaluate", "How good a result is: held against a reference; --json of each");
  evaluate->footer("Example:\n  ostia evaluate suite golden/ new/ --tolerance tolerance.json -o report");
  evaluate->fallthrough();
  evaluate->require_subcommand(1);
  add_scores(*evaluate, c, run);
  add_shapes(*evaluate, c, run);
  CLI::App* motion = add(*evaluate, c,
                         {"motion", "Two motions, phase by phase: of the same points, or of surfaces",
                          "moving points (.json), or a folder of surfaces, one a phase", "the same",
                          "ostia evaluate motion truth.json result.json", run_evaluate_motion},
                         run);
  add_units(*motion, c);
  add_requirements(*motion, c);
  CLI::App* suite =
      add(*evaluate, c,
          {"suite", "Two runs of any set of cases: is the new one as good as the golden one?",
           "Folder of the golden run", "Folder of the new run",
           "ostia evaluate suite golden/ new/ --tolerance tolerance.json -o report", run_evaluate_suite},
          run);
  suite->add_option("--tolerance", c.tolerance, "Rules of what may differ by how much, .json");
  suite->add_option("-o,--output", c.report,
                    "Report: a file.html, or a folder for report.html and suite.json");
}

}  // namespace ostia::app
