// The options that say how a lumen is found in an image.

#include "vessel/cli_segment.h"

#include "options/shown_defaults.h"
#include "options/validators.h"

#include "ostia/segmentation/level_set.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <string>

namespace ostia::app {
namespace {

/// What is done to the image before, and the inflation by intensities.
void add_filters(CLI::App& app, LumenOptions& o) {
  app.add_flag("--balloon", o.balloon,
               "Inflate by exp(-(I-m)^2/sigma^2) - tau: outwards where the image is like the vessel, inwards "
               "elsewhere; its weight is --inflation (0.5 unless given)");
  app.add_option("--balloon-tau", o.balloon_tau, "tau; left out: 0.2")->check(CLI::Range(0.001, 0.999));
  app.add_option("--balloon-mean", o.balloon_mean_hu, "m, HU; left out: the vessel's own median");
  app.add_option("--balloon-sigma", o.balloon_sigma_hu, "sigma, HU; left out: the vessel's own deviation")
      ->check(above_zero());
  app.add_option(
         "--denoise", o.denoise,
         "Diffusion of the image that stops at edges: flux (Krissian), gradient (Perona and Malik) or "
         "curvature (Whitaker and Xue); left out: none")
      ->check(CLI::IsMember({"flux", "gradient", "curvature"}));
  app.add_option("--denoise-iterations", o.denoise_iterations, "Steps of it; left out: 5")
      ->check(CLI::Range(1, 1000));
  app.add_option("--denoise-contrast", o.denoise_contrast,
                 "Gradient above which an edge stays, HU/mm; left out: chosen from the noise")
      ->check(above_zero());
  app.add_option("--remove", o.remove,
                 "Taken out of the image before: bone, calcium, skin, separated by commas; left out: nothing")
      ->delimiter(',')
      ->check(CLI::IsMember({"bone", "calcium", "skin"}));
}

}  // namespace

void add_lumen(CLI::App& app, LumenOptions& o) {
  const segmentation::LevelSetOptions usual;
  app.add_option(
         "--branch", o.branches,
         "A vessel: from:to or from:through:to, each point x,y,z, or a file whose lists of points are "
         "vessels (.mrk.json, .fcsv, .csv); repeat for more vessels")
      ->allow_extra_args(false);
  app.add_option("--lower", o.lower_hu, "Least HU of the lumen; left out: chosen about the seeds");
  app.add_option("--upper", o.upper_hu, "Largest HU of the lumen; left out: chosen about the seeds");
  app.add_option(
         "--feature", o.feature,
         "What the surface is pulled to: edges (sub-voxel ridges of the gradient; default), upwind or "
         "centred (gradient on the voxels), gaussian (derivatives of a Gaussian)")
      ->check(CLI::IsMember({"edges", "upwind", "centred", "gaussian"}));
  app.add_option("--sigma", o.gaussian_sigma_mm,
                 "Of the feature gaussian, mm; left out: the least spacing of the image")
      ->check(CLI::Range(0.01, 10.0));
  app.add_option("--inflation", o.inflation,
                 "Weight w1 of the level set's inflation" + default_text(usual.inflation))
      ->check(zero_or_above());
  app.add_option("--curvature", o.curvature,
                 "Weight w2 of the level set's curvature" + default_text(usual.curvature))
      ->check(zero_or_above());
  app.add_option("--curvature-term", o.curvature_term,
                 "Which curvature that is: mean (default), or minimal (of both principal curvatures the "
                 "smaller: smooths along a vessel and leaves its radius alone)")
      ->check(CLI::IsMember({"mean", "minimal"}));
  app.add_option("--advection", o.advection,
                 "Weight w3 of the pull to the image's edges" + default_text(usual.advection))
      ->check(zero_or_above());
  app.add_option("--iterations", o.iterations,
                 "Most iterations of the level set" + default_text(usual.iterations_max))
      ->check(zero_or_above());
  app.add_flag("--whole-volume", o.whole_volume, "Let the fronts run through the whole image");
  app.add_flag("--bright-is-lumen", o.bright_is_lumen,
               "What is brighter than the lumen (a stent, a catheter) belongs to it; not for calcium");
  add_filters(app, o);
  app.add_option("--smooth", o.smooth, "Iterations of Taubin's smoothing of the surface; 0: none")
      ->check(CLI::Range(0, 1000));
}

void add_aorta(CLI::App& app, SegmentCommand& o) {
  app.add_flag("--aorta", o.aorta,
               "The aorta instead, found without a seed, from its root along the arch: a mask (.nrrd, .mhd, "
               ".mha) or a surface; goes with no option that says how a lumen is found between seeds");
}

void require_aorta_alone(const CLI::App& segment) {
  if (segment.count("--aorta") == 0) return;
  CLI::App lumen;
  LumenOptions unused;
  add_lumen(lumen, unused);
  for (const CLI::Option* option : lumen.get_options())
    if (const std::string name = option->get_name();
        name != "--help" && name != "--smooth" && segment.count(name) > 0)
      throw CLI::ExcludesError("--aorta", name);
  if (segment.count("--levelset") > 0) throw CLI::ExcludesError("--aorta", "--levelset");
}

}  // namespace ostia::app
