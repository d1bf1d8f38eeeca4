#include "ostia/core/text.h"
#include "ostia/experiments/sensitivity.h"

#include <cmath>

namespace ostia::experiments {
namespace {

using segmentation::LumenBoundaryOptions;
using segmentation::SegmentOptions;
using segmentation::WallFeature;
using Segment = Parameter<SegmentOptions>;
using Boundary = Parameter<LumenBoundaryOptions>;

/// Numbers about a default; near are those within 25 % of it, or of the first step where it is 0.
template <class Options, class Apply>
Parameter<Options> number(const char* name, const char* meaning, double standard, std::vector<double> values,
                          const Apply& apply) {
  Parameter<Options> out;
  out.name = name;
  out.meaning = meaning;
  out.apply = [apply](Options& o, double v, const KnownLumen& lumen) { apply(o, v, lumen); };
  double first_step = 1e300;
  for (const double v : values)
    if (v != standard) first_step = std::min(first_step, std::abs(v - standard));
  const double reach = standard != 0.0 ? 0.25 * std::abs(standard) : first_step;
  for (const double v : values) {
    if (v == standard) out.standard = out.settings.size();
    out.settings.push_back({core::significant_text(v, 4), v, std::abs(v - standard) <= reach * (1.0 + 1e-9)});
  }
  return out;
}

template <class Options, class Apply>
Parameter<Options> kinds(const char* name, const char* meaning, const std::vector<std::string>& names,
                         const Apply& apply) {
  Parameter<Options> out;
  out.name = name;
  out.meaning = meaning;
  out.choice = true;
  for (std::size_t i = 0; i < names.size(); ++i)
    out.settings.push_back({names[i], static_cast<double>(i), false});
  out.apply = [apply](Options& o, double v, const KnownLumen&) { apply(o, static_cast<int>(v)); };
  return out;
}

void add_weights(std::vector<Segment>& out) {
  out.push_back(number<SegmentOptions>(
      "curvature w2", "--curvature", 0.1, {0.0, 0.05, 0.075, 0.1, 0.125, 0.2, 0.5, 1.0},
      [](SegmentOptions& o, double v, const KnownLumen&) { o.level_set.curvature = v; }));
  out.push_back(number<SegmentOptions>(
      "advection w3", "level_set.advection", 1.0, {0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0},
      [](SegmentOptions& o, double v, const KnownLumen&) { o.level_set.advection = v; }));
  out.push_back(number<SegmentOptions>(
      "inflation w1", "--inflation", 0.0, {-0.2, -0.1, -0.05, 0.0, 0.05, 0.1, 0.2},
      [](SegmentOptions& o, double v, const KnownLumen&) { o.level_set.inflation = v; }));
  out.push_back(number<SegmentOptions>("iterations", "--iterations", 200.0, {20, 50, 100, 150, 200, 250, 400},
                                       [](SegmentOptions& o, double v, const KnownLumen&) {
                                         o.level_set.iterations_max = static_cast<int>(v);
                                       }));
  out.push_back(number<SegmentOptions>(
      "convergence", "level_set.rms_tolerance_voxels", 0.01,
      {0.0025, 0.005, 0.0075, 0.01, 0.0125, 0.02, 0.05},
      [](SegmentOptions& o, double v, const KnownLumen&) { o.level_set.rms_tolerance_voxels = v; }));
  out.push_back(kinds<SegmentOptions>(
      "curvature term", "--curvature-term", {"mean", "minimal"}, [](SegmentOptions& o, int v) {
        o.level_set.curvature_term =
            v == 0 ? segmentation::CurvatureTerm::mean : segmentation::CurvatureTerm::minimal;
      }));
}

void add_fronts(std::vector<Segment>& out) {
  out.push_back(number<SegmentOptions>(
      "fronts' threshold", "--lower, between surroundings (0) and lumen (1); the default is chosen near 0.6",
      0.6, {0.3, 0.45, 0.6, 0.75, 0.85}, [](SegmentOptions& o, double v, const KnownLumen& lumen) {
        o.fronts.lower_hu = lumen.around_hu + v * (lumen.lumen_hu - lumen.around_hu);
      }));
  out.push_back(number<SegmentOptions>(
      "fronts' upper bound", "--upper, the same scale", 2.0, {1.25, 1.5, 2.0, 2.5, 4.0},
      [](SegmentOptions& o, double v, const KnownLumen& lumen) {
        o.fronts.upper_hu = lumen.around_hu + v * (lumen.lumen_hu - lumen.around_hu);
      }));
  out.push_back(number<SegmentOptions>(
      "fronts' slowest speed", "fronts.slowest", 0.7, {0.4, 0.525, 0.6, 0.7, 0.8, 0.875, 1.0},
      [](SegmentOptions& o, double v, const KnownLumen&) { o.fronts.slowest = v; }));
  out.push_back(
      number<SegmentOptions>("fronts' overrun", "fronts.overrun", 0.15, {0.05, 0.1125, 0.15, 0.1875, 0.3},
                             [](SegmentOptions& o, double v, const KnownLumen&) { o.fronts.overrun = v; }));
  out.push_back(number<SegmentOptions>(
      "margin, voxels", "fronts.margin_voxels", 6.0, {3, 5, 6, 7, 10},
      [](SegmentOptions& o, double v, const KnownLumen&) { o.fronts.margin_voxels = static_cast<int>(v); }));
}

void add_feature(std::vector<Segment>& out) {
  out.push_back(
      kinds<SegmentOptions>("feature", "--feature", {"edges", "upwind", "centred", "gaussian"},
                            [](SegmentOptions& o, int v) { o.feature = static_cast<WallFeature>(v); }));
  out.push_back(number<SegmentOptions>("sigma, mm (gaussian)", "--sigma", 0.4, {0.2, 0.3, 0.4, 0.5, 0.8},
                                       [](SegmentOptions& o, double v, const KnownLumen&) {
                                         o.feature = WallFeature::gaussian;
                                         o.gaussian_sigma_mm = v;
                                       }));
  out.push_back(kinds<SegmentOptions>("bright is lumen", "bright_is_lumen", {"off", "on"},
                                      [](SegmentOptions& o, int v) { o.bright_is_lumen = v == 1; }));
  out.push_back(kinds<SegmentOptions>("diffusion", "--denoise", {"none", "flux", "gradient", "curvature"},
                                      [](SegmentOptions& o, int v) {
                                        if (v == 0) return;
                                        o.denoise.emplace();
                                        o.denoise->method = static_cast<imaging::Diffusion>(v - 1);
                                      }));
  out.push_back(number<SegmentOptions>("steps of flux diffusion", "--denoise-iterations", 5.0,
                                       {2, 4, 5, 6, 10, 20},
                                       [](SegmentOptions& o, double v, const KnownLumen&) {
                                         o.denoise.emplace();
                                         o.denoise->iterations = static_cast<int>(v);
                                       }));
  out.push_back(number<SegmentOptions>(
      "contrast of flux diffusion, HU/mm", "--denoise-contrast; the default is chosen from the noise", 80.0,
      {20, 40, 60, 80, 100, 160}, [](SegmentOptions& o, double v, const KnownLumen&) {
        o.denoise.emplace();
        o.denoise->contrast_hu_per_mm = v;
      }));
}

void balloon(SegmentOptions& o) {
  o.balloon.emplace();
  o.level_set.inflation = 0.5;
}

void add_balloon(std::vector<Segment>& out) {
  out.push_back(kinds<SegmentOptions>("balloon", "--balloon", {"off", "on"}, [](SegmentOptions& o, int v) {
    if (v == 1) balloon(o);
  }));
  out.push_back(number<SegmentOptions>("balloon's tau", "--balloon-tau", 0.2, {0.1, 0.15, 0.2, 0.25, 0.4},
                                       [](SegmentOptions& o, double v, const KnownLumen&) {
                                         balloon(o);
                                         o.balloon->tau = v;
                                       }));
  out.push_back(number<SegmentOptions>("balloon's weight", "--inflation with --balloon", 0.5,
                                       {0.1, 0.25, 0.375, 0.5, 0.625, 1.0},
                                       [](SegmentOptions& o, double v, const KnownLumen&) {
                                         balloon(o);
                                         o.level_set.inflation = v;
                                       }));
  out.push_back(number<SegmentOptions>(
      "balloon's mean", "--balloon-mean, between surroundings (0) and lumen (1); the default is measured",
      1.0, {0.75, 0.9, 1.0, 1.1, 1.25}, [](SegmentOptions& o, double v, const KnownLumen& lumen) {
        balloon(o);
        o.balloon->mean_hu = lumen.around_hu + v * (lumen.lumen_hu - lumen.around_hu);
      }));
  out.push_back(number<SegmentOptions>("balloon's sigma, HU", "--balloon-sigma; the default is measured",
                                       20.0, {10, 15, 20, 25, 40},
                                       [](SegmentOptions& o, double v, const KnownLumen&) {
                                         balloon(o);
                                         o.balloon->sigma_hu = v;
                                       }));
}

template <class Member>
Boundary of_boundary(const char* name, const char* meaning, double standard, std::vector<double> values,
                     Member member) {
  return number<LumenBoundaryOptions>(name, meaning, standard, std::move(values),
                                      [member](LumenBoundaryOptions& o, double v, const KnownLumen&) {
                                        o.*member =
                                            static_cast<std::remove_reference_t<decltype(o.*member)>>(v);
                                      });
}

}  // namespace

std::vector<Segment> segment_parameters() {
  std::vector<Segment> out;
  add_weights(out);
  add_fronts(out);
  add_feature(out);
  add_balloon(out);
  return out;
}

std::vector<Boundary> boundary_parameters() {
  using O = LumenBoundaryOptions;
  const O standard;
  return {of_boundary("step along, mm", "step_mm", standard.step_mm, {0.25, 0.4, 0.5, 0.6, 1.0}, &O::step_mm),
          of_boundary("rays around", "around", standard.around, {16, 24, 32, 40, 64}, &O::around),
          of_boundary("radial step, mm", "radial_step_mm", standard.radial_step_mm,
                      {0.05, 0.075, 0.1, 0.125, 0.2}, &O::radial_step_mm),
          of_boundary("largest radius, mm", "largest_radius_mm", standard.largest_radius_mm,
                      {2.5, 3.0, 4.0, 5.0, 8.0}, &O::largest_radius_mm),
          of_boundary("blur sigma, mm", "blur_sigma_mm", standard.blur_sigma_mm,
                      {0.15, 0.225, 0.3, 0.375, 0.5}, &O::blur_sigma_mm),
          of_boundary("wall, HU", "wall_hu", standard.wall_hu, {0, 25, 37.5, 50, 62.5, 75, 100}, &O::wall_hu),
          of_boundary("calcium, HU", "calcium_hu (0: from the lumen's statistics)", standard.calcium_hu,
                      {0, 500, 600, 800, 1200}, &O::calcium_hu),
          of_boundary("largest slope along", "largest_slope_along", standard.largest_slope_along,
                      {0.5, 0.75, 1.0, 1.25, 2.0}, &O::largest_slope_along),
          of_boundary("largest slope around", "largest_slope_around", standard.largest_slope_around,
                      {0.5, 0.75, 1.0, 1.25, 2.0}, &O::largest_slope_around)};
}

}  // namespace ostia::experiments
