#include "findings/vessel_doubt.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/imaging/image_file.h"
#include "ostia/imaging/sampling.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/pipeline/mask_walls.h"
#include "ostia/pipeline/source.h"
#include "ostia/session/found_model.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace ostia::session {
namespace {

using geometry::Vec3;

constexpr double least_share_inside = 0.99;  // of the mask's voxels in the image
constexpr double least_lumen_hu = 100.0;     // of blood with contrast agent
constexpr double least_above_hu = 30.0;      // what is about it
constexpr double rim_mm = 3.0;               // from the mask's voxels, for what is about it
constexpr std::size_t few = 20000;           // voxels are enough

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A mask of another patient, or in another frame, lies beside the image's vessels.
void require_same_patient(const imaging::MaskVolume& mask, const imaging::ImageVolume& image) {
  std::vector<std::size_t> object;
  for (std::size_t n = 0; n < mask.voxels.size(); ++n)
    if (mask.voxels[n] != 0) object.push_back(n);
  if (object.empty()) return;  // told by whoever looks for vessels in it
  const std::size_t step = std::max<std::size_t>(1, object.size() / few);
  const imaging::Geometry& grid = mask.geometry;
  std::vector<double> inside, about;
  std::size_t looked = 0, covered = 0;
  for (std::size_t i = 0; i < object.size(); i += step) {
    const auto n = static_cast<std::int64_t>(object[i]);
    const Vec3 at = grid.world(Vec3(static_cast<double>(n % grid.size[0]),
                                    static_cast<double>(n / grid.size[0] % grid.size[1]),
                                    static_cast<double>(n / (grid.size[0] * grid.size[1]))));
    ++looked;
    if (!image.geometry.contains(at)) continue;
    ++covered;
    inside.push_back(imaging::sample(image, at));
    for (int d = 0; d < 3; ++d)
      for (const double way : {-rim_mm, rim_mm}) {
        const Vec3 beside = at + way * grid.direction.col(d);
        if (image.geometry.contains(beside)) about.push_back(imaging::sample(image, beside));
      }
  }
  const double share = static_cast<double>(covered) / static_cast<double>(looked);
  if (share < least_share_inside)
    throw InvalidInput(
        "the mask does not lie in the image: " + core::rounded_text(100.0 * (1.0 - share), 0) +
        " % of its voxels are outside; give the CT that it was drawn on, or leave --image out");
  const double lumen_hu = median_of(inside), about_hu = about.empty() ? lumen_hu : median_of(about);
  if (lumen_hu < least_lumen_hu || lumen_hu < about_hu + least_above_hu)
    throw InvalidInput("the mask does not lie on the image's vessels: the image has " +
                       core::rounded_text(lumen_hu, 0) + " HU in it and " + core::rounded_text(about_hu, 0) +
                       " HU about it, where an artery with contrast is above " +
                       core::rounded_text(least_lumen_hu, 0) +
                       " HU and brighter than what is about it; is it another patient's, another phase's, or "
                       "flipped? Give the CT that it was drawn on, or leave --image out");
}

std::vector<coronary::Ostium> ostia_of(const coronary::MaskTree& tree) {
  std::vector<coronary::Ostium> ostia;
  for (const Vec3& place : tree.ostia) {
    coronary::Ostium ostium;
    ostium.place = place;
    for (const geometry::TreeSegment& segment : tree.vessels.tree.segments) {
      if ((segment.axis.points.front() - place).norm() > 1e-6) continue;
      ostium.direction = segment.axis.frames.front().tangent;
      ostium.radius_mm = segment.axis.radius.front();
    }
    ostia.push_back(ostium);
  }
  return ostia;
}

}  // namespace

namespace {

/// An axis that bends more tightly than its wall.
struct KinkedAxis {
  std::string what;
};

/// Tree and walls. Throws KinkedAxis where an axis bends more tightly than a wall can follow.
MaskModel walled(const imaging::MaskVolume& labels, const coronary::MaskTreeOptions& options,
                 const core::TaskContext& task) {
  MaskModel result;
  result.tree = coronary::mask_tree(labels, options, task.sub(0.0, 0.6));
  task.set_stage("walls of the vessels");
  const geometry::VesselTree& tree = result.tree.vessels.tree;
  pipeline::MaskWalls walls = pipeline::walls_from_mask(tree, result.tree.lumen, {}, task.sub(0.6, 0.95));
  result.outside = std::move(walls.outside);
  try {
    result.found.model = lumen::model_of_walls(tree, walls.walls);
  } catch (const InvalidInput& error) {
    throw KinkedAxis{error.what()};
  }
  return result;
}

/// Rough masks need smoother axes than others.
MaskModel walled_smoothly(const imaging::MaskVolume& labels, coronary::MaskTreeOptions options,
                          const core::TaskContext& task) {
  constexpr int tries = 4;
  constexpr double smoother = 1.8;
  for (int i = 1; i < tries; ++i) {
    try {
      return walled(labels, options, task);
    } catch (const KinkedAxis&) {
      options.smooth_radii = std::min(50.0, std::max(1.0, options.smooth_radii) * smoother);
    }
  }
  try {
    return walled(labels, options, task);
  } catch (const KinkedAxis& kink) {
    throw InvalidInput("no wall can be made about the mask's vessels: " + kink.what);
  }
}

/// What of the mask the walls do not hold.
void tell_outside(const std::vector<pipeline::MaskOutside>& parts, std::vector<std::string>& warnings) {
  constexpr double told_mm3 = 2.0;
  constexpr std::size_t most_told = 3;
  double all = 0.0;
  std::string places;
  std::size_t count = 0;
  for (const pipeline::MaskOutside& part : parts) {
    if (part.volume_mm3 < told_mm3) continue;
    all += part.volume_mm3;
    if (++count > most_told) continue;
    places += std::string(count == 1 ? "" : "; ") + core::rounded_text(part.volume_mm3, 1) + " mm3 over " +
              core::rounded_text(part.length_mm, 1) + " mm at " + core::rounded_text(part.place.x(), 1) +
              "," + core::rounded_text(part.place.y(), 1) + "," + core::rounded_text(part.place.z(), 1);
  }
  if (count == 0) return;
  warnings.push_back(std::to_string(count) + (count == 1 ? " place" : " places") + " of the mask, " +
                     core::rounded_text(all, 1) + " mm3 in all, " + (count == 1 ? "lies" : "lie") +
                     " outside the walls" + (count > most_told ? ", the largest " : ": ") + places +
                     " mm (LPS)");
}

}  // namespace

bool holds_labels(const std::filesystem::path& file) {
  std::error_code none;
  if (!std::filesystem::exists(file, none)) return false;  // whoever reads it says so
  const pipeline::SourceKind kind = pipeline::classify(file);
  return kind == pipeline::SourceKind::mask ||
         (kind == pipeline::SourceKind::image &&
          (imaging::looks_like_labels(file) || imaging::looks_like_probabilities(file)));
}

MaskModel model_of_mask(const imaging::MaskVolume& labels, const imaging::ImageVolume* image,
                        const coronary::MaskTreeOptions& options, const core::TaskContext& task) {
  if (image != nullptr) require_same_patient(labels, *image);
  MaskModel result = walled_smoothly(labels, options, task);
  FoundModel& found = result.found;
  found.found.ostia = ostia_of(result.tree);
  found.found.vessels = result.tree.vessels;
  found.found.notes = result.tree.notes;
  found.found.warnings = result.tree.warnings;
  tell_outside(result.outside, found.found.warnings);
  for (std::size_t i = 0; i < result.tree.notes.size(); ++i) {
    coronary::AxisNotes notes = result.tree.notes[i];
    notes.evidence = 1.0;  // how sure a bridge is stands in the notes' words
    found.doubts.push_back(doubt_about(result.tree.vessels.labels[i], notes));
  }
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::session
