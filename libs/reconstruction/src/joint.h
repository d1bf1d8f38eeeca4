#pragma once
/// \file Where vessels meet: rings of points that the branches share.

#include "joint_rings.h"

#include "ostia/reconstruction/surface.h"

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace ostia::reconstruction {

struct Joint {
  std::int32_t point = 0;  ///< of the graph
  Vec3 centre = Vec3::Zero();
  JointStyle style;
  std::vector<Slot> slots;
  std::optional<JointField> field;
  std::vector<Vec3> points;
  /// Of each slot, `sides` of the points, counter-clockwise about the slot's direction.
  std::vector<std::vector<std::int32_t>> rings;
  std::vector<double> clearance;  ///< how far along each slot's direction its ring reaches, mm
};

/// By the graph's point; `JointStyle()` for those that are not there.
using JointStyles = std::map<std::int32_t, JointStyle>;

Slot slot_of(const std::vector<Tube>& tubes, std::int32_t tube, bool distal);
/// At these points of the graph (ascending; those where no branches meet are left out), in their order.
std::vector<Joint> joints_of(const std::vector<Tube>& tubes, const TubeEnds& ends,
                             const std::vector<std::int32_t>& points, const geometry::VesselGraph& graph,
                             const ReconstructionOptions& options, const JointStyles& styles);
/// The slots' tubes are indices into `tubes`.
Joint joint_at(const Vec3& centre, std::vector<Slot> slots, const std::vector<Tube>& tubes,
               const ReconstructionOptions& options, const JointStyle& style);

}  // namespace ostia::reconstruction
