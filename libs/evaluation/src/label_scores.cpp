#include "ostia/evaluation/label_scores.h"

#include "ostia/core/error.h"
#include "ostia/geometry/isosurface.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>

namespace ostia::evaluation {
namespace {

using imaging::ImageVolume;
using imaging::Vec3;

constexpr std::size_t most_labels = 64;

/// The box of voxels with a label, one voxel to spare; empty where there is none.
imaging::Region box_of(const ImageVolume& labels, std::int16_t label) {
  const auto& size = labels.geometry.size;
  imaging::Region box{size, {0, 0, 0}};
  std::size_t at = 0;
  for (std::int64_t k = 0; k < size[2]; ++k) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t i = 0; i < size[0]; ++i, ++at) {
        if (labels.voxels[at] != label) continue;
        const std::array<std::int64_t, 3> here{i, j, k};
        for (std::size_t a = 0; a < 3; ++a) {
          box.lower[a] = std::min(box.lower[a], here[a]);
          box.upper[a] = std::max(box.upper[a], here[a] + 1);
        }
      }
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    box.lower[a] = std::max<std::int64_t>(0, box.lower[a] - 1);
    box.upper[a] = std::min(size[a], box.upper[a] + 1);
  }
  return box;
}

struct VoxelCounts {
  std::int64_t reference = 0, result = 0, both = 0;
};

std::map<std::int16_t, VoxelCounts> count(const ImageVolume& reference, const ImageVolume& result) {
  std::map<std::int16_t, VoxelCounts> counts;
  for (std::size_t i = 0; i < reference.voxels.size(); ++i) {
    const std::int16_t a = reference.voxels[i], b = result.voxels[i];
    if (a == 0 && b == 0) continue;
    if (a != 0) ++counts[a].reference;
    if (b != 0) ++counts[b].result;
    if (a == b) ++counts[a].both;
    if (counts.size() > most_labels)
      throw InvalidInput("more than " + std::to_string(most_labels) +
                         " different values: these are grey values, not labels; give masks or label volumes");
  }
  return counts;
}

SurfaceDistances no_distances() {
  const double none = std::numeric_limits<double>::quiet_NaN();
  return {none, none, none, none, none, none};
}

LabelScore score_of(std::int16_t label, const VoxelCounts& counts, double voxel_mm3) {
  LabelScore score;
  score.label = label;
  score.in_reference = counts.reference > 0;
  score.in_result = counts.result > 0;
  VolumeOverlap& o = score.overlap;
  o.reference_mm3 = voxel_mm3 * static_cast<double>(counts.reference);
  o.result_mm3 = voxel_mm3 * static_cast<double>(counts.result);
  o.both_mm3 = voxel_mm3 * static_cast<double>(counts.both);
  o.dice = 2.0 * o.both_mm3 / (o.reference_mm3 + o.result_mm3);
  o.jaccard = o.both_mm3 / (o.reference_mm3 + o.result_mm3 - o.both_mm3);
  score.difference_mm3 = o.result_mm3 - o.reference_mm3;
  o.relative_difference =
      score.in_reference ? score.difference_mm3 / o.reference_mm3 : std::numeric_limits<double>::quiet_NaN();
  score.boundary = no_distances();
  return score;
}

}  // namespace

geometry::TriMesh boundary_of(const ImageVolume& labels, std::int16_t label, const core::TaskContext& task) {
  const imaging::Region box = box_of(labels, label);
  std::array<std::int64_t, 3> size{};
  for (std::size_t a = 0; a < 3; ++a) size[a] = box.upper[a] - box.lower[a];
  if (size[0] <= 0 || size[1] <= 0 || size[2] <= 0) return {};
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(size[0] * size[1] * size[2]));
  for (std::int64_t k = box.lower[2]; k < box.upper[2]; ++k)
    for (std::int64_t j = box.lower[1]; j < box.upper[1]; ++j)
      for (std::int64_t i = box.lower[0]; i < box.upper[0]; ++i)
        values.push_back(labels(i, j, k) == label ? -1.0f : 1.0f);
  const imaging::Geometry& g = labels.geometry;
  const geometry::ScalarGrid grid{
      size, values.data(),
      g.world(Vec3(static_cast<double>(box.lower[0]), static_cast<double>(box.lower[1]),
                   static_cast<double>(box.lower[2]))),
      g.direction * g.spacing.asDiagonal()};
  return geometry::isosurface(grid, 0.0f, true, task);
}

std::vector<LabelScore> compare_labels(const ImageVolume& reference, const ImageVolume& result,
                                       const SurfaceDistanceOptions& options, const core::TaskContext& task) {
  if (!imaging::same_grid(reference.geometry, result.geometry))
    throw InvalidInput(
        "the two volumes lie on different grids: other sizes, spacings, origins or axes; "
        "resample one onto the other's grid");
  const std::map<std::int16_t, VoxelCounts> counts = count(reference, result);
  const bool any_reference =
      std::any_of(counts.begin(), counts.end(), [](const auto& one) { return one.second.reference > 0; });
  const bool any_result =
      std::any_of(counts.begin(), counts.end(), [](const auto& one) { return one.second.result > 0; });
  if (!any_reference)
    throw InvalidInput(any_result ? "the reference is empty, the result is not: are the two swapped?"
                                  : "both volumes are empty: there is no overlap to speak of");
  std::vector<LabelScore> scores;
  for (const auto& [label, own] : counts) {
    task.throw_if_cancelled();
    scores.push_back(score_of(label, own, reference.geometry.spacing.prod()));
    if (own.reference == 0 || own.result == 0) continue;
    scores.back().boundary =
        compare_surfaces(boundary_of(reference, label), boundary_of(result, label), options);
    task.set_progress(static_cast<double>(scores.size()) / static_cast<double>(counts.size()));
  }
  return scores;
}

}  // namespace ostia::evaluation
