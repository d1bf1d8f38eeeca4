#include "hard/baseline_growing.h"

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/core/error.h"
#include "ostia/imaging/morphology.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::experiments {
namespace {

using geometry::Vec3;
using imaging::MaskVolume;

/// Calls visit(offset) for each voxel within a ball.
template <class Visit>
void for_ball(const imaging::Geometry& grid, const Vec3& centre, double radius_mm, const Visit& visit) {
  const Vec3 middle = grid.index(centre);
  std::array<std::int64_t, 3> from{}, to{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double reach = radius_mm / grid.spacing[static_cast<int>(a)];
    from[a] = std::max<std::int64_t>(0, std::llround(std::ceil(middle[static_cast<int>(a)] - reach)));
    to[a] = std::min(grid.size[a] - 1,
                     std::int64_t{std::llround(std::floor(middle[static_cast<int>(a)] + reach))});
  }
  for (std::int64_t k = from[2]; k <= to[2]; ++k)
    for (std::int64_t j = from[1]; j <= to[1]; ++j)
      for (std::int64_t i = from[0]; i <= to[0]; ++i)
        if ((grid.world(Vec3(double(i), double(j), double(k))) - centre).norm() <= radius_mm)
          visit(grid.offset(i, j, k));
}

double blood_of(const imaging::ImageVolume& image, const std::vector<Vec3>& ostia, double radius_mm) {
  std::vector<double> values;
  for (const Vec3& ostium : ostia)
    for_ball(image.geometry, ostium, radius_mm,
             [&](std::int64_t at) { values.push_back(image.voxels[static_cast<std::size_t>(at)]); });
  if (values.empty()) throw InvalidInput("region growing: the ostia lie outside of the image");
  const auto quartile = values.begin() + static_cast<std::ptrdiff_t>(3 * values.size() / 4);
  std::nth_element(values.begin(), quartile, values.end());
  return *quartile;
}

MaskVolume bright_voxels(const imaging::ImageVolume& image, double threshold_hu) {
  MaskVolume mask{image.geometry, std::vector<std::uint8_t>(image.voxels.size())};
  for (std::size_t i = 0; i < mask.voxels.size(); ++i)
    mask.voxels[i] = image.voxels[i] >= threshold_hu ? 1 : 0;
  return mask;
}

/// Aorta, chambers and all else that holds a ball, with the voxels at its surface.
MaskVolume chambers_of(const MaskVolume& bright, double radius_mm) {
  return imaging::dilated(imaging::eroded(bright, radius_mm), radius_mm + bright.geometry.spacing.maxCoeff());
}

/// The part of `bright` that is connected (26 neighbours) to what lies about the ostium; stops beyond `most`
/// voxels.
std::vector<std::int64_t> connected(const MaskVolume& bright, const Vec3& ostium, double begin_mm,
                                    std::size_t most) {
  const imaging::Geometry& grid = bright.geometry;
  std::vector<std::uint8_t> left = bright.voxels;
  std::vector<std::int64_t> found;
  const auto take = [&](std::int64_t at) {
    if (left[static_cast<std::size_t>(at)] == 0) return;
    left[static_cast<std::size_t>(at)] = 0;
    found.push_back(at);
  };
  for_ball(grid, ostium, begin_mm, take);
  for (std::size_t n = 0; n < found.size() && found.size() <= most; ++n) {
    const std::int64_t i = found[n] % grid.size[0], row = found[n] / grid.size[0];
    const std::int64_t j = row % grid.size[1], k = row / grid.size[1];
    for (std::int64_t c = std::max<std::int64_t>(k - 1, 0); c <= std::min(k + 1, grid.size[2] - 1); ++c)
      for (std::int64_t b = std::max<std::int64_t>(j - 1, 0); b <= std::min(j + 1, grid.size[1] - 1); ++b)
        for (std::int64_t a = std::max<std::int64_t>(i - 1, 0); a <= std::min(i + 1, grid.size[0] - 1); ++a)
          take(grid.offset(a, b, c));
  }
  return found;
}

/// The skeleton begins behind what was taken off with the aorta; its lines go back to the ostium.
void begin_at_ostia(geometry::VesselTree& tree, const std::vector<Vec3>& ostia, double within_mm) {
  for (geometry::TreeNode& node : tree.nodes) {
    if (std::ranges::any_of(tree.segments, [&](const auto& segment) { return segment.to == node.id; }))
      continue;
    const auto nearest =
        std::ranges::min_element(ostia, {}, [&](const Vec3& o) { return (o - node.position).norm(); });
    const double away = nearest == ostia.end() ? 0.0 : (*nearest - node.position).norm();
    if (!(away > 0.0 && away <= within_mm)) continue;
    node.position = *nearest;
    for (geometry::TreeSegment& segment : tree.segments) {
      if (segment.from != node.id) continue;
      segment.axis.points.insert(segment.axis.points.begin(), *nearest);
      segment.axis.radius.insert(segment.axis.radius.begin(), segment.axis.radius.front());
      geometry::complete(segment.axis);
    }
  }
}

geometry::VesselTree skeleton_tree(const MaskVolume& region, const std::vector<Vec3>& ostia,
                                   const RegionGrowingOptions& options, const core::TaskContext& task) {
  constexpr double inlet_mm = 12.0;
  const centerline::Thinned skeleton = centerline::thinned(region, {.fill_cavities = true}, task);
  centerline::SkeletonGraph graph = centerline::loops_opened(centerline::skeleton_graph(skeleton, task));
  graph = centerline::pruned(graph, {.length_mm = options.prune_mm});
  if (graph.edges.empty()) return {};
  std::vector<Vec3> inlets;
  for (const Vec3& ostium : ostia)
    if (std::ranges::any_of(graph.nodes, [&](const centerline::SkeletonNode& node) {
          return (node.position - ostium).norm() <= inlet_mm;
        }))
      inlets.push_back(ostium);
  graph = centerline::oriented(graph, inlets, {.snap_mm = inlet_mm}).graph;
  geometry::VesselTree tree = centerline::vessel_tree(graph).tree;
  begin_at_ostia(tree, inlets, inlet_mm);
  return tree;
}

/// Adds what grows from one ostium to the region, at the first threshold at which it does not leak.
GrownPart add_part(const imaging::ImageVolume& image, const MaskVolume& chambers, const Vec3& ostium,
                   GrownPart part, double blood_hu, const RegionGrowingOptions& options, MaskVolume& region,
                   const core::TaskContext& task) {
  const double voxel_ml = image.geometry.spacing.prod() / 1000.0;
  const auto most = static_cast<std::size_t>(options.most_ml / voxel_ml);
  std::vector<std::int64_t> found;
  for (;; part.threshold_hu += options.step_hu) {
    task.throw_if_cancelled();
    MaskVolume bright = bright_voxels(image, part.threshold_hu);
    for (std::size_t i = 0; i < bright.voxels.size(); ++i)
      if (chambers.voxels[i] != 0) bright.voxels[i] = 0;
    found = connected(bright, ostium, options.begin_mm, most);
    part.leaked = found.size() > most;
    if (!part.leaked || part.threshold_hu + options.step_hu >= blood_hu) break;
  }
  if (part.leaked) return part;
  part.volume_ml = voxel_ml * static_cast<double>(found.size());
  for (const std::int64_t at : found) region.voxels[static_cast<std::size_t>(at)] = 1;
  return part;
}

}  // namespace

GrownRegion grow_region(const imaging::ImageVolume& image, const std::vector<Vec3>& ostia,
                        const RegionGrowingOptions& options, const core::TaskContext& task) {
  if (ostia.empty()) throw InvalidInput("region growing: no ostium was given");
  GrownRegion out;
  out.blood_hu = blood_of(image, ostia, options.blood_mm);
  GrownPart first;
  first.threshold_hu = options.tissue_hu + options.level * (out.blood_hu - options.tissue_hu);
  const MaskVolume chambers = chambers_of(bright_voxels(image, first.threshold_hu), options.chamber_mm);
  MaskVolume region{image.geometry, std::vector<std::uint8_t>(image.voxels.size(), 0)};
  for (const Vec3& ostium : ostia)
    out.parts.push_back(add_part(image, chambers, ostium, first, out.blood_hu, options, region, task));
  if (std::ranges::any_of(region.voxels, [](std::uint8_t value) { return value != 0; }))
    out.tree = skeleton_tree(region, ostia, options, task);
  return out;
}

}  // namespace ostia::experiments
