#pragma once
/// \file The mesh of a whole network, made so that it does not cross itself.

#include "base_mesh.h"
#include "fork_spacing.h"

#include "ostia/core/task_context.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace ostia::reconstruction {

struct Made {
  QuadMesh mesh;
  /// Pairs of triangles (two a quadrilateral) that cross.
  std::vector<std::pair<std::int32_t, std::int32_t>> crossings;
};

/// What crosses is first looked at by itself: only the joints and branches concerned, with their neighbours,
/// are made anew, until they are clear; then the whole again, since they may have met others. Coarse first.
class Assembly {
 public:
  /// Without `sections`: circles.
  Assembly(const geometry::VesselGraph& graph, const EllipticSections* sections,
           const ReconstructionOptions& options, const core::TaskContext& task);

  Made made();
  const std::vector<Tube>& tubes() const { return tubes_; }
  /// By branch: its axis was moved to make room.
  const std::vector<std::uint8_t>& moved() const { return moved_; }

 private:
  /// Branches and joints that are made; ascending.
  struct Part {
    std::vector<std::int32_t> tubes, points;
  };
  Part whole() const;
  Part around(const Made& made) const;
  QuadMesh mesh_at(int level, const Part& part) const;
  static Made checked(QuadMesh mesh);
  Made again(const Made& before, int level) const;
  void clear(const Made& whole, int level);
  std::vector<std::int32_t> crossed_joints(const Made& made) const;
  int coarse() const { return std::min(1, options_.level); }
  void give_room(const Made& made, int level);
  void flatten(std::int32_t point);
  void restyle(const std::vector<std::int32_t>& points, int level);
  void move_apart(const std::vector<std::int32_t>& points);

  const EllipticSections* sections_;
  const ReconstructionOptions& options_;
  const core::TaskContext& task_;
  Network network_;
  std::vector<Tube> tubes_;
  TubeEnds ends_;
  JointStyles styles_;
  JointStyles coarse_styles_;          ///< those with which the coarse mesh was clear
  std::map<std::int32_t, int> tried_;  ///< of a joint: how often it crossed at this level
  std::set<std::int32_t> splayed_;     ///< joints whose branches were bent apart
  std::vector<std::uint8_t> moved_;
  int rounds_ = 0;
};

}  // namespace ostia::reconstruction
