#pragma once
/// \file The coronary tree with the wall of each of its vessels: what a case file stores.

#include "ostia/geometry/vessel_tree.h"
#include "ostia/lumen/vessel_lumen.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::lumen {

/// How branches are joined (tree_field.h).
enum class JointShape {
  sharp,   ///< [Wels] eq. 5: g = min f^w, the exact union
  smooth,  ///< the union with a fillet where two walls are within w of each other
};
struct BlendOptions {
  double width_mm = 0.25;  ///< w of [Wels] eq. 4, (0, 2]
  JointShape joints = JointShape::smooth;
};

/// Immutable once shared; editing makes a new one that shares the untouched vessels.
struct LumenModel {
  geometry::VesselTree tree;  ///< axes, radii and names; ids are never used again
  std::vector<std::shared_ptr<const VesselLumen>> vessels;  ///< in the order of tree.vessels
  BlendOptions blend;
  std::int64_t next_sample_id = 1;
  std::int32_t next_tree_id = 1;  ///< for nodes, segments and vessels
};

const VesselLumen& vessel(const LumenModel& model, std::int32_t id);  ///< throws InvalidInput

/// A segment's wall belongs to the first vessel, in the tree's order, that passes through it; a vessel owns
/// what lies from its first own segment on. Abscissas of both agree on the way they share.
double own_from_mm(const geometry::VesselTree& tree, std::int32_t vessel);
/// The vessel whose wall it is at an abscissa of `vessel`'s axis.
std::int32_t owner_at(const geometry::VesselTree& tree, std::int32_t vessel, double s_mm);

/// What is wrong with a model (tree faults, samples out of order or not unit or not finite, ids repeated or
/// not below next_*, a vessel without samples, an axis that is not its tree's); nothing if sound.
std::optional<std::string> find_fault(const LumenModel& model);

/// SHA-256 over everything stored, in order: equal digests are equal models to the last bit.
std::string digest(const LumenModel& model);

}  // namespace ostia::lumen
