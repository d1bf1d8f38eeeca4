#include "ostia/session/scan_map.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/polyline.h"

#include <cmath>
#include <memory>

namespace ostia::session {
namespace {

constexpr double guide_step_mm = 2.0;
constexpr double landmark_mm = 5.0;  // beyond it a name is wrong, or the joint was set elsewhere
constexpr std::size_t least_guides = 3;

}  // namespace

registration::Guidance guidance_of(const geometry::VesselTree& before, const imaging::ImageVolume& image,
                                   const analysis::TreeFit* fit) {
  registration::Guidance guidance;
  for (const geometry::TreeSegment& segment : before.segments)
    for (const geometry::Vec3& place : geometry::resample(segment.axis.points, guide_step_mm))
      if (image.geometry.contains(place)) guidance.vessels_mm.push_back(place);
  if (guidance.vessels_mm.empty())
    throw InvalidInput(
        "the former scan shows no place of its own tree: was the case made with another image?");
  if (fit == nullptr) return guidance;
  for (std::size_t i = 0; i < fit->landmarks.size(); ++i) {
    const analysis::TreeLandmark& one = fit->landmarks[i];
    if (fit->landmark_residuals_mm[i] <= landmark_mm)
      guidance.landmarks.push_back({one.name, one.before, one.after});
  }
  if (guidance.landmarks.size() < least_guides) guidance.landmarks.clear();
  return guidance;
}

ScanMap scan_map(const registration::Registration& found) {
  const auto transform = std::make_shared<const registration::Transform>(found.transform);
  return {[transform](const geometry::Vec3& place) { return (*transform)(place); },
          std::string(transform->spline() ? "deformable" : "affine") + ", by the images (correlation " +
              core::fixed_text(found.quality.correlation, 2) + ")"};
}

std::string to_string(MapBy by) {
  if (by == MapBy::trees) return "trees";
  return by == MapBy::images ? "images" : "any";
}

MapBy map_by(const std::string& text) {
  for (const MapBy one : {MapBy::any, MapBy::trees, MapBy::images})
    if (to_string(one) == text) return one;
  throw InvalidInput("a comparison is by \"any\", \"trees\" or \"images\", not by \"" + text + "\"");
}

MapOfImages map_of_images(const geometry::VesselTree& before, const geometry::VesselTree& after,
                          const imaging::ImageVolume* before_image, const imaging::ImageVolume* after_image,
                          MapBy by, const core::TaskContext& task) {
  if (by == MapBy::trees) return {};
  if (before_image == nullptr || after_image == nullptr) {
    if (by == MapBy::images)
      throw InvalidInput("a comparison by the images needs both of them; give both, or compare by the trees");
    return {};
  }
  const auto refused = [&](const std::string& why) -> MapOfImages {
    if (by == MapBy::images)
      throw InvalidInput("the images cannot be laid onto each other: " + why + "; compare by the trees");
    return {std::nullopt, "the trees lay the scans onto each other, not the images: " + why};
  };
  try {
    const analysis::TreeFit fit = analysis::fit_trees(before, after);
    const registration::Registration found = registration::register_scans(
        *before_image, *after_image, guidance_of(before, *before_image, &fit), {}, task);
    const registration::Quality& quality = found.quality;
    if (quality.verdict == registration::Verdict::failed ||
        (by == MapBy::any && quality.verdict != registration::Verdict::good))
      return refused(quality.reason);
    return {scan_map(found), {}};
  } catch (const InvalidInput& error) {
    if (by == MapBy::images) throw;
    return refused(error.what());
  }
}

}  // namespace ostia::session
