#include "ostia/experiments/robustness.h"

#include "motion/heart_field.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/coronary/extract.h"
#include "ostia/phantom/body.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

namespace ostia::experiments {
namespace {

using core::rounded_text;
using geometry::Vec3;
using phantom::Anatomy;

/// Nothing but water: what is left of its scan is the noise.
class Water : public phantom::Scene {
  class Part : public phantom::ScenePart {
   public:
    phantom::Material at(const Vec3&) const override { return {phantom::Label::muscle, 0.0f}; }
    std::optional<phantom::Material> uniform() const override { return at({}); }
    bool fine_near(const Vec3&, double) const override { return false; }
  };

 public:
  std::unique_ptr<const phantom::ScenePart> part(const geometry::Box3&) const override {
    return std::make_unique<Part>();
  }
};

phantom::CasePlan plan_of(const Variation& variation, std::uint64_t seed, const RobustnessOptions& options) {
  phantom::CaseOptions patient;
  patient.seed = seed;
  patient.preset = phantom::Preset::small;
  patient.variant = variation.patient;
  patient.scan.motion_mm = variation.motion_mm;
  phantom::CasePlan plan = phantom::plan_case(patient);
  scan_heart_field(plan, options.voxel_mm, variation.slice_mm);
  phantom::ScanOptions& scan = plan.options.scan;
  scan.psf_fwhm_z_mm = std::max(scan.psf_fwhm_z_mm, 0.9 * variation.slice_mm);
  return plan;
}

/// The patient without noise.
imaging::ImageVolume clean_image(phantom::CasePlan plan, const core::TaskContext& task) {
  plan.options.scan.noise_hu = 0.0;
  return phantom::scan_case(plan, task).image;
}

void add_noise(imaging::ImageVolume& image, const phantom::CasePlan& plan, double noise_hu,
               const core::TaskContext& task) {
  phantom::ScanOptions scan = plan.options.scan;
  scan.noise_hu = noise_hu;
  const imaging::ImageVolume noise = phantom::acquire(Water(), scan, task).image;
  for (std::size_t i = 0; i < image.voxels.size(); ++i)
    image.voxels[i] = static_cast<std::int16_t>(std::clamp(image.voxels[i] + noise.voxels[i], -1024, 3071));
}

imaging::ImageVolume upper_part(const imaging::ImageVolume& image, double kept) {
  imaging::Region region{{0, 0, 0}, image.geometry.size};
  region.lower[2] = static_cast<std::int64_t>((1.0 - kept) * static_cast<double>(image.geometry.size[2]));
  return imaging::cropped(image, region);
}

/// What is known of the vessels that the image shows: each up to where it leaves the image.
ExtractionTruth truth_of(const phantom::CasePlan& plan, const imaging::Geometry& grid) {
  constexpr double observers_mm = 0.2, least_mm = 5.0;
  ExtractionTruth truth;
  truth.tree = phantom::vessel_tree(plan.tree);
  for (const phantom::CoronaryVessel& vessel : plan.tree.vessels) {
    const geometry::Centerline path = phantom::path_from_ostium(plan.tree, vessel.id);
    std::size_t inside = 0;
    while (inside < path.size() && grid.contains(path.points[inside])) ++inside;
    const double own = path.abscissa[std::max<std::size_t>(inside, 1) - 1] -
                       (path.abscissa.back() - vessel.axis.abscissa.back());
    if (own < least_mm) continue;
    const auto end = static_cast<std::ptrdiff_t>(inside);
    TrueVessel one{vessel.name, false, {}};
    one.reference.points.assign(path.points.begin(), path.points.begin() + end);
    one.reference.radius.assign(path.radius.begin(), path.radius.begin() + end);
    one.reference.observer_spread.assign(inside, observers_mm);
    truth.vessels.push_back(std::move(one));
  }
  return truth;
}

RobustnessRun run_one(const VariedScan& scan, const RobustnessOptions& options,
                      const core::TaskContext& task) {
  RobustnessRun run;
  run.variation = scan.variation;
  run.seed = scan.seed;
  const auto start = std::chrono::steady_clock::now();
  const auto refused = [&](const std::string& why) { run.score = score_of_no_extraction(scan.truth, why); };
  double seconds = 0.0;
  const auto passed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  try {
    const coronary::Extraction found = coronary::extract(scan.image, {}, task);
    seconds = passed();
    run.warnings = found.warnings;
    run.score = score_axes(scan.truth, found.vessels, options.scores, task);
  } catch (const GeometryError& error) {
    seconds = passed();
    refused(error.what());
  } catch (const InvalidInput& error) {
    seconds = passed();
    refused(error.what());
  }
  run.score.seconds = seconds;
  return run;
}

Variation step(const std::string& what, const std::string& value) {
  Variation variation;
  variation.what = what;
  variation.step = value;
  return variation;
}

}  // namespace

std::vector<Variation> usual_variations() {
  std::vector<Variation> all{step("as drawn", "25 HU of noise, 400 HU of contrast")};
  const auto add = [&](const std::string& what, const std::string& value) -> Variation& {
    all.push_back(step(what, value));
    return all.back();
  };
  // Those that show the same patient come first: the patient is scanned once for them.
  for (const double noise : {15.0, 40.0, 60.0, 90.0, 120.0})
    add("noise", rounded_text(noise, 0) + " HU").noise_hu = noise;
  for (const double kept : {0.8, 0.6, 0.4})
    add("upper part of the image", rounded_text(100.0 * kept, 0) + " %").kept = kept;
  for (const double contrast : {200.0, 250.0, 300.0, 600.0})
    add("contrast", rounded_text(contrast, 0) + " HU").patient.contrast_hu = contrast;
  for (const double calcium : {0.0, 4.0, 10.0})
    add("calcium",
        calcium == 0.0 ? "none" : "a nodule every " + rounded_text(12.0 / (calcium - 1.0), 1) + " mm")
        .patient.calcium = calcium;
  for (const double motion : {1.0, 2.0, 3.0})
    add("motion", rounded_text(motion, 1) + " mm").motion_mm = motion;
  for (const double slice : {1.5, 2.0, 3.0}) add("slices", rounded_text(slice, 1) + " mm").slice_mm = slice;
  for (const double venous : {0.5, 1.0})
    add("venous contrast", rounded_text(100.0 * venous, 0) + " % of the arterial").patient.venous = venous;
  for (const Anatomy anatomy : {Anatomy::left_ostium_closed, Anatomy::right_ostium_closed,
                                Anatomy::rca_from_left, Anatomy::lcx_from_right, Anatomy::bypass})
    add("anatomy", phantom::word(anatomy)).patient.anatomy = anatomy;
  add("stent", "18 mm in the proximal LAD").patient.stent_mm = 18.0;
  return all;
}

void validate(const RobustnessOptions& options) {
  if (options.seeds < 1 || options.seeds > 20)
    throw InvalidInput("robustness experiment: 1 to 20 patients, not " + std::to_string(options.seeds));
  if (!(options.voxel_mm >= 0.5 && options.voxel_mm <= 2.0))
    throw InvalidInput("robustness experiment: voxels of 0.5 to 2 mm, not " +
                       std::to_string(options.voxel_mm));
  validate(options.scores);
}

void scan_patients(const std::vector<Variation>& variations, const RobustnessOptions& options,
                   const std::function<void(const VariedScan&, const core::TaskContext&)>& look,
                   const core::TaskContext& task) {
  validate(options);
  double done = 0.0;
  const double count = static_cast<double>(options.seeds) * static_cast<double>(variations.size());
  for (int patient = 0; patient < options.seeds; ++patient) {
    const std::uint64_t seed = options.first_seed + static_cast<std::uint64_t>(patient);
    std::string scanned;  // what the clean image shows
    imaging::ImageVolume clean;
    for (const Variation& variation : variations) {
      const core::TaskContext part = task.sub(done / count, (done + 1.0) / count);
      part.throw_if_cancelled();
      const phantom::CasePlan plan = plan_of(variation, seed, options);
      const std::string shown = phantom::parameters_json(plan.options) + std::to_string(variation.slice_mm);
      if (shown != scanned) clean = clean_image(plan, part.sub(0.0, 0.7));
      scanned = shown;
      imaging::ImageVolume image = clean;
      add_noise(image, plan, variation.noise_hu, part.sub(0.7, 0.75));
      if (variation.kept < 1.0) image = upper_part(image, variation.kept);
      ExtractionTruth truth = truth_of(plan, image.geometry);
      truth.case_name = variation.what + " " + variation.step;
      task.set_stage(truth.case_name);
      look({variation, seed, image, truth}, part.sub(0.75, 1.0));
      done += 1.0;
    }
  }
}

std::vector<RobustnessRun> vary_patients(const std::vector<Variation>& variations,
                                         const RobustnessOptions& options, const core::TaskContext& task) {
  std::vector<RobustnessRun> runs;
  scan_patients(
      variations, options,
      [&](const VariedScan& scan, const core::TaskContext& part) {
        runs.push_back(run_one(scan, options, part));
      },
      task);
  return runs;
}

}  // namespace ostia::experiments
