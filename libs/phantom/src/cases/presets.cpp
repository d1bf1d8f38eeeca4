#include "ostia/phantom/presets.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::phantom {
namespace {

using geometry::Box3;

constexpr double border_mm = 5.0;     // between the tree and the border
constexpr double proximal_mm = 25.0;  // of vessel from an ostium that the tiny grid would hold

imaging::Geometry grid_about(const Vec3& centre, std::array<std::int64_t, 3> size, const Vec3& spacing) {
  imaging::Geometry grid;
  grid.size = size;
  grid.spacing = spacing;
  for (int axis = 0; axis < 3; ++axis) {
    const auto steps = static_cast<double>(size[static_cast<std::size_t>(axis)] - 1);
    // To a hundredth of a millimetre, so that files say exactly where the grid is.
    grid.origin[axis] = std::round(100.0 * (centre[axis] - 0.5 * spacing[axis] * steps)) / 100.0;
  }
  return grid;
}

Box3 root_box(const AorticRoot& root) {
  Box3 box;
  for (const double along : {0.0, root.sinus_height_mm}) {
    const Vec3 middle = root.annulus + along * root.axis;
    box.extend(middle - Vec3::Constant(root.sinus_radius_mm));
    box.extend(middle + Vec3::Constant(root.sinus_radius_mm));
  }
  return box;
}

Box3 heart_box(const HeartShape& heart) {
  Box3 box = root_box(heart.root);
  for (int a = 0; a < 24; ++a) {
    for (int d = -2; d <= 10; ++d) box.extend(heart.epicardium(a * std::numbers::pi / 12.0, 0.1 * d));
  }
  return box;
}

/// What must not be cut: the tree and the root.
Box3 needed_box(const HeartShape& heart, const CoronaryTree* tree) {
  Box3 box = root_box(heart.root);
  if (tree == nullptr) return box;
  for (const CoronaryVessel& vessel : tree->vessels) {
    for (const Vec3& p : vessel.axis.points) {
      box.extend(p - Vec3::Constant(border_mm));
      box.extend(p + Vec3::Constant(border_mm));
    }
  }
  return box;
}

/// Where the left main ends on a vessel that begins at an ostium; 0 where it has none.
double left_main_end(const CoronaryVessel& vessel) {
  constexpr int left_main = 5;  // the AHA's number
  double end = 0.0;
  for (const SegmentSpan& span : vessel.segments)
    if (span.aha == left_main) end = std::max(end, span.s_to_mm);
  return end;
}

/// Around what lies within a length of vessel from an ostium, on the vessels from the ostia and those that
/// leave at the left main's end.
Box3 box_of_ostia(const CoronaryTree& tree, double length_mm) {
  Box3 box;
  const auto add = [&](const CoronaryVessel& vessel, double until_mm) {
    for (std::size_t i = 0; i < vessel.axis.size() && vessel.axis.abscissa[i] <= until_mm; ++i)
      box.extend(vessel.axis.points[i]);
  };
  for (const CoronaryVessel& vessel : tree.vessels) {
    if (vessel.parent < 0) {
      add(vessel, length_mm);
      continue;
    }
    const auto parent = static_cast<std::size_t>(vessel.parent);
    if (parent >= tree.vessels.size() || tree.vessels[parent].parent >= 0) continue;
    const double end = left_main_end(tree.vessels[parent]);
    if (end > 0.0 && vessel.parent_s_mm <= end + 1.0) add(vessel, length_mm - vessel.parent_s_mm);
  }
  return box;
}

/// As much of it as the field holds.
Vec3 middle_of_ostia(const HeartShape& heart, const CoronaryTree* tree, const Vec3& field_mm) {
  if (tree != nullptr) {
    for (double length_mm = proximal_mm; length_mm >= 0.0; length_mm -= 1.0) {
      const Box3 box = box_of_ostia(*tree, length_mm);
      if (box.isEmpty()) break;
      if ((box.sizes().array() <= field_mm.array() - 2.0 * border_mm).all() || length_mm < 1.0)
        return box.center();
    }
  }
  return root_box(heart.root).center();
}

/// A field of view: the heart in its middle, moved as far as what is needed asks for.
imaging::Geometry whole_grid(const HeartShape& heart, const CoronaryTree* tree,
                             std::array<std::int64_t, 3> size, const Vec3& spacing) {
  const Box3 needed = needed_box(heart, tree);
  Vec3 centre = heart_box(heart).center();
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * spacing[axis] * static_cast<double>(size[static_cast<std::size_t>(axis)] - 1);
    const double least = needed.max()[axis] - half, most = needed.min()[axis] + half;
    if (least > most)
      throw InvalidInput("grid: the coronary tree and the root are " + std::to_string(needed.sizes()[axis]) +
                         " mm long along axis " + std::to_string(axis) + ", more than the field of view of " +
                         std::to_string(2.0 * half) + " mm; another seed draws a smaller heart");
    centre[axis] = std::clamp(centre[axis], least, most);
  }
  return grid_about(centre, size, spacing);
}

}  // namespace

imaging::Geometry grid_of(Preset preset, const HeartShape& heart, const CoronaryTree* tree) {
  switch (preset) {
    case Preset::tiny:
      return grid_about(middle_of_ostia(heart, tree, {48.0, 48.0, 48.0}), {96, 96, 80}, {0.5, 0.5, 0.6});
    case Preset::small:
      return whole_grid(heart, tree, {256, 256, 150}, {0.7, 0.7, 0.9});
    case Preset::full:
      return whole_grid(heart, tree, {512, 512, 300}, {0.35, 0.35, 0.45});
  }
  throw InvalidInput("grid: unknown preset");
}

}  // namespace ostia::phantom
