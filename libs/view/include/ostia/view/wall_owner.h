#pragma once
/// \file Whose wall it is: the vessel and the abscissa of places on the surface of a tree.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/lumen/lumen_model.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace ostia::view {

using geometry::Vec3;

/// A place of the wall in the coordinates of its owner, to the spacing of the nodes (for colours and a look
/// up of what is known along a vessel; geometry::AxisCurve::foot_near makes it exact).
struct WallPlace {
  std::int32_t vessel = 0;
  double s_mm = 0.0;       ///< of the nearest node of the owner's axis
  double radius_mm = 0.0;  ///< of the owner's wall about that node: the mean over its samples there
};

/// Nodes along the stretch of each axis that its vessel owns, every 0.5 mm, with the mean distance of the
/// wall's samples about them (the axis' own radius where there are none). A place belongs to the node with
/// the least |place - node| - radius, as a union of balls has it. Immutable; asked from many threads.
class WallOwner {
 public:
  /// Of `before`, what was made of vessels that `model` shares is kept. Throws InvalidInput for a model
  /// without vessels.
  explicit WallOwner(const lumen::LumenModel& model, const WallOwner* before = nullptr);

  WallPlace at(const Vec3& place) const;
  /// The same for many places; neighbours that follow each other, as in a mesh, are quick.
  std::vector<WallPlace> at(std::span<const Vec3> places) const;
  std::span<const std::int32_t> vessels() const { return vessel_ids_; }  ///< in the model's order

 private:
  struct Node {
    Vec3 point;
    double radius = 0.0, s_mm = 0.0;
  };
  struct OfVessel {
    std::shared_ptr<const lumen::VesselLumen> source;
    std::vector<Node> nodes;
  };
  struct Block {  // a ball about consecutive nodes of one vessel
    Vec3 centre;
    double reach = 0.0;      // of the ball
    double widest = 0.0;     // radius of a node
    std::size_t vessel = 0;  // index
    std::size_t first = 0, last = 0;
  };
  static std::shared_ptr<const OfVessel> nodes_of(const lumen::VesselLumen& vessel);
  void add_blocks(std::size_t vessel);
  void search(std::span<const Vec3> group, std::span<WallPlace> out) const;

  std::vector<std::int32_t> vessel_ids_;
  std::vector<std::shared_ptr<const OfVessel>> of_vessels_;
  std::vector<Block> blocks_;
};

}  // namespace ostia::view
