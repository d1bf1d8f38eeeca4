// The options of `ostia ffr`.

#include "flow/ffr.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

namespace ostia::app {

void define_ffr(CLI::App& app, FfrCommand& c, const std::uint64_t& seed,
                std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* ffr = app.add_subcommand("ffr",
                                     "Pressure and flow along a coronary tree, FFR behind each narrowing, "
                                     "computed from its form; for research");
  ffr->footer(
      "Example:\n  ostia ffr heart.ostia -o pressure\n"
      "  ostia ffr lines.vtp -o pressure --systolic 135 --diastolic 85 --lv-mass 140 --pulse");
  ffr->fallthrough();
  ffr->add_option("INPUT", c.input,
                  "Case, or a tree of vessels with radii (.vtp, .vtk, .swc, .csv, .gxl); or a case of "
                  "svZeroDSolver (.json)")
      ->required();
  ffr->add_option("-o,--output", c.output, "Folder that is made")->required();
  ffr->add_option("--systolic", c.systolic_mmhg, "Systolic pressure by cuff, mmHg");
  ffr->add_option("--diastolic", c.diastolic_mmhg, "Diastolic pressure by cuff, mmHg");
  ffr->add_option("--heart-rate", c.heart_rate_bpm, "Beats a minute, for --pulse");
  ffr->add_option("--lv-mass", c.lv_mass_g,
                  "Mass of the left ventricle, g; left out: flow goes by the vessels' calibre");
  ffr->add_option("--rest-flow", c.rest_flow_ml_min,
                  "Flow of the whole tree at rest, ml/min, where it is known");
  ffr->add_option("--conditions", c.conditions,
                  "Any input, as JSON: {\"venous_mmhg\": 7}, or a conditions.json");
  ffr->add_option("--open", c.open,
                  "Also as if a stretch were opened to its reference calibre: VESSEL:FROM-TO in mm from the "
                  "root, :LEFT percent of stenosis that stay; may stand several times")
      ->allow_extra_args(false);
  ffr->add_option("--narrow", c.narrow,
                  "Also as if it were narrowed: VESSEL:FROM-TO:PERCENT at the throat in its middle")
      ->allow_extra_args(false);
  ffr->add_option("--behind", c.behind_mm, "Where a narrowing's FFR is read, mm behind its end")
      ->check(CLI::Range(0.0, 60.0));
  ffr->add_option("--export", c.exports,
                  "Also as a case of svZeroDSolver, svOneDSolver or openBF: svzerod,svoned,openbf")
      ->delimiter(',')
      ->check(CLI::IsMember({"svzerod", "svoned", "openbf"}));
  ffr->add_option("--junctions", c.junctions,
                  "Losses at forks: unified (Mynard and Valen-Sendstad 2015), none")
      ->check(CLI::IsMember({"unified", "none"}));
  ffr->add_flag("--pulse", c.pulse, "Also over the beat at rest: Pd/Pa and iFR");
  CLI::Option* uncertainty = ffr->add_flag(
      "--uncertainty{usual}", c.uncertainty,
      "Also how sure it is: 95 % intervals, the probability of being at or below 0.80 and which "
      "input it comes from, by 1000 trees drawn at random, or --uncertainty=N");
  uncertainty->check([](const std::string& told) {
    return told == usual_trees ? std::string() : CLI::Range(16, 10000)(told);
  });
  CLI::Option* spread = ffr->add_option("--wall-spread", c.wall_spread_mm,
                                        "Of a section's mean radius, mm, one standard deviation")
                            ->check(CLI::Range(0.0, 1.0))
                            ->needs(uncertainty);
  ffr->add_option(
         "--image", c.image,
         "The CT that the case was made with (DICOM folder or image): the walls' spread by its edges")
      ->needs(uncertainty)
      ->excludes(spread);
  ffr->add_flag("--unusual", c.unusual, "Take pressures and flows beyond physiology");
  ffr->add_flag("--json", c.json, "ffr.json on standard output");
  ffr->callback([&app, &c, &seed, &run] {
    if (app.count("--seed") > 0) c.seed = seed;
    run = [&c](const core::TaskContext& task) { return run_ffr(c, task); };
  });
}

}  // namespace ostia::app
