// The options that say what synthetic scans are made.

#include "phantom/cli_phantom.h"

#include "options/shown_defaults.h"
#include "options/validators.h"

#include "ostia/phantom/anatomy.h"
#include "ostia/phantom/scan.h"
#include "ostia/phantom/truth.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <string>
#include <vector>

namespace ostia::app {
namespace {

std::string names_of_realism() {
  std::vector<std::string> names;
  for (const phantom::RealismMember& member : phantom::realism_members()) names.push_back(member.name);
  return CLI::detail::join(names, ", ");
}

}  // namespace

void add_phantom(CLI::App& app, PhantomCommand& o) {
  const phantom::ScanOptions usual{};
  const phantom::ContourOptions contours{};
  app.add_option("-o,--output", o.output, "Folder that is made: dataset00, dataset01, ... and suite.json")
      ->required();
  app.add_option("--preset", o.preset,
                 "full: 512x512x300 voxels; small: voxels twice as large; tiny: about the ostia alone")
      ->check(CLI::IsMember({"tiny", "small", "full"}));
  app.add_option("--cases", o.cases, "How many cases, with the seeds from --seed on")
      ->check(CLI::Range(1, 100));
  CLI::Option* suite =
      app.add_option(
             "--suite", o.suite,
             "usual: alike but for the heart; hard: noise, contrast, blur, motion, disease and anatomy as "
             "mixed as a clinic's")
          ->check(CLI::IsMember({"usual", "hard"}));
  app.add_option("--phases", o.phases,
                 "Phases of a heartbeat, 1 to 100; 1: the heart stands still in mid-diastole");
  app.add_flag("--truth-only", o.truth_only, "No images and label volumes");
  app.add_option("--formats", o.formats, "Of the image: mhd, nrrd, dicom, separated by commas; all")
      ->delimiter(',')
      ->check(CLI::IsMember({"mhd", "nrrd", "dicom"}));
  app.add_option("--disease", o.disease, "Number of lesions, as a multiple of the usual; 0: a healthy tree")
      ->check(CLI::Range(0.0, 5.0));
  app.add_option("--anatomy", o.anatomy, CLI::detail::join(phantom::anatomy_words(), ", "))
      ->check(CLI::IsMember(phantom::anatomy_words()));
  CLI::Option* tree = app.add_option(
      "--tree", o.tree,
      "The heart is built around these arteries: a patient's mask (.nrrd, .nii.gz, ...) or case (.ostia)");
  tree->excludes(app.get_option("--anatomy"));
  app.add_option("--tree-rim", o.tree_rim_mm,
                 "What of each of their radii is no lumen, mm; default 0.5 of a mask, 0 of a case")
      ->check(CLI::Range(0.0, 1.0))
      ->needs(tree);
  app.add_option("--calcium", o.calcium, "0: none; 1: that of the lesions; more: nodules along the arteries")
      ->check(CLI::Range(0.0, 20.0));
  app.add_option("--stent", o.stent_mm, "Length of a stent in the proximal LAD, mm")
      ->check(CLI::Range(0.0, 40.0));
  app.add_option("--contrast", o.contrast_hu,
                 "Of aorta, left heart and arteries, HU; left out: drawn by the seed")
      ->check(CLI::Range(80.0, 1000.0));
  app.add_option("--venous", o.venous, "Contrast in veins and right heart, as a share of the arteries'")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--scanner", o.scanner,
                 "ideal: even noise, Gaussian blur; measured: as a gated coronary CTA was measured")
      ->check(CLI::IsMember({"ideal", "measured"}));
  app.add_option("--realism", o.realism,
                 "What real scans show, as NAME=VALUE,...: " + names_of_realism() +
                     " (docs/methods/phantom-realism.md)")
      ->delimiter(',');
  app.add_option("--noise", o.noise_hu, "Standard deviation of the noise, HU" + default_text(usual.noise_hu))
      ->check(CLI::Range(0.0, 500.0));
  app.add_option(
         "--blur", o.blur_mm,
         "Point spread in the slice, full width at half maximum, mm" + default_text(usual.psf_fwhm_mm))
      ->check(CLI::Range(0.0, 5.0));
  app.add_option("--blur-z", o.blur_z_mm, "The same along z, mm" + default_text(usual.psf_fwhm_z_mm))
      ->check(CLI::Range(0.0, 5.0));
  app.add_option("--motion", o.motion_mm,
                 "Blur by the heart's motion: length of the path, mm" + default_text(usual.motion_mm))
      ->check(CLI::Range(0.0, 10.0));
  app.add_option("--stair-step", o.stair_step_mm,
                 "Jump of the heart between blocks of slices, mm" + default_text(usual.stair_step_mm))
      ->check(CLI::Range(0.0, 10.0));
  app.add_option("--beam-hardening", o.beam_hardening,
                 "Dark streaks beside dense things; 1 is usual" + default_text(usual.beam_hardening))
      ->check(CLI::Range(0.0, 5.0));
  app.add_option("--contour-spacing", o.contour_spacing_mm,
                 "Distance between the true contours, mm" + default_text(contours.spacing_mm))
      ->check(above_zero());
  app.add_option("--contour-points", o.contour_points, "Points of a contour" + default_text(contours.points))
      ->check(CLI::Range(8, 1024));
  app.add_option("--surface-spacing", o.surface_spacing_mm,
                 "Edges of the true surfaces, mm; default 0.15, with phases 0.4")
      ->check(CLI::Range(0.05, 1.0));
  for (const char* drawn : {"--disease", "--anatomy", "--calcium", "--stent", "--contrast", "--venous",
                            "--noise", "--blur", "--blur-z", "--motion", "--stair-step", "--beam-hardening"})
    app.get_option(drawn)->excludes(suite);
  app.add_flag("--no-report", o.no_report, "No report.html and no pictures");
  app.add_flag("--json", o.json, "suite.json on standard output");
}

}  // namespace ostia::app
