// The options of `ostia lumen` and `ostia replay`.

#include "options/shown_defaults.h"
#include "options/validators.h"
#include "vessel/lumen.h"

#include "ostia/lumen/start_surface.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace ostia::app {

void define_lumen(CLI::App& app, LumenModelCommand& c, ReplayCommand& r,
                  std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* lumen =
      app.add_subcommand("lumen", "A model of the lumen about centerlines, edited and made a surface");
  lumen->footer("Example:\n  ostia lumen lines.vtp -o lumen.vtp --image heart.nrrd --edits edits.jsonl");
  lumen->fallthrough();
  lumen->add_option("INPUT", c.input, "Case (.ostia) or centerlines (.vtp .vtk .csv, Rotterdam .txt)")
      ->required();
  lumen->add_option("-o,--output", c.output, "The surface: .vtp, .stl or .ply")->required();
  lumen->add_option("--edits", c.edits,
                    "Edits to be applied in order, one JSON object a line; - is standard input");
  lumen
      ->add_option("--start", c.start,
                   "The wall to start from: tube, image, surface or contours; left out: what is given of "
                   "--image, --surface, --contours, else a tube")
      ->check(CLI::IsMember({"tube", "image", "surface", "contours"}));
  lumen->add_option("--image", c.image, "CT the wall is found in on rays: DICOM folder or image");
  lumen->add_option("--surface", c.surface, "Surface the wall is taken from: .vtp .stl .ply .obj");
  lumen->add_option("--contours", c.contours, "Contours the wall is taken from, .json");
  lumen->add_option("--observer", c.observer, "Whose contours, where the file has several observers'");
  lumen->add_option("--vessel", c.vessel, "Name of the vessel that a Rotterdam line is, LAD say");
  lumen->add_option("--radius", c.radius_mm, "Radius of the starting tube, mm; left out: the centerlines'")
      ->check(above_zero());
  lumen
      ->add_option(
          "--spacing", c.spacing_mm,
          "Distance between samples of an even wall, mm" + default_text(lumen::SamplingOptions().spacing_mm))
      ->check(CLI::Range(0.1, 5.0));
  lumen->add_option("--kernel", c.kernel, "Radial basis function between the samples")
      ->check(CLI::IsMember({"morse-c0", "wendland-c2", "wendland-c4"}));
  lumen
      ->add_option("--cell", c.cell_mm,
                   "Cells of the surface, mm; left out: 0.25 or a quarter of the smallest radius")
      ->check(CLI::Range(0.05, 2.0));
  lumen->add_option("--case", c.case_output,
                    "Also a case with the start and every edit, those of an INPUT case before them, .ostia");
  lumen->add_option("--lines", c.lines_output, "Also the centerlines after editing: .vtp or .csv");
  lumen->add_flag("--json", c.json, "One JSON object on standard output");
  lumen->callback([&] { run = [&](const core::TaskContext& task) { return run_lumen(c, task); }; });

  CLI::App* replay =
      app.add_subcommand("replay", "The edits of a case once more: is the model the same to the last bit?");
  replay->footer("Example:\n  ostia replay heart.ostia");
  replay->fallthrough();
  replay->add_option("INPUT", r.input, "Case (.ostia) or journal (.jsonl)")->required();
  replay->add_option("--start", r.start,
                     "The case that a journal starts from; left out: the one of the same name beside it");
  replay->add_option("-o,--output", r.output, "The replayed case, .ostia, or its edits, .jsonl");
  replay->add_flag("--json", r.json, "One JSON object on standard output");
  replay->callback([&] { run = [&](const core::TaskContext& task) { return run_replay(r, task); }; });
}

}  // namespace ostia::app
