#pragma once
/// \file A volume mesh put together of the cells of a file.

#include "mesh/prepared.h"

#include "ostia/geometry/hex_mesh.h"
#include "ostia/io/volume_mesh_file.h"

#include <filesystem>
#include <span>

namespace ostia::io {

class MeshBuilder {
 public:
  explicit MeshBuilder(std::filesystem::path path) : path_(std::move(path)) {}
  std::vector<geometry::Vec3>& points() { return mesh_.points; }
  /// A cell with the nodes that its file names, from 0, in the order of `order`; `face` of a facet. False
  /// where no such shape has this number of nodes.
  bool add(Shape shape, std::span<const std::int32_t> nodes, std::int32_t face, const NodeOrder& order);
  /// A hexahedron with eight nodes in VTK's order, from 0; false where they are not eight. It ends as two
  /// prisms.
  bool add_hexahedron(std::span<const std::int32_t> nodes);
  /// Whether the tetrahedra that are added from now on are layers' prisms that were split.
  void set_in_layers(bool in_layers) { now_in_layers_ = in_layers; }
  /// Of all facets.
  std::vector<std::int32_t> face_ids() const;
  bool has_boundary() const { return !mesh_.triangles.empty() || !mesh_.quads.empty(); }
  /// With its faces; without facets the boundary is the elements' free sides, and all wall. Throws
  /// InvalidInput naming the file: no elements, linear and quadratic cells together, nodes that are no point,
  /// hexahedra that cannot be cut into prisms.
  LayeredMesh finish(std::vector<geometry::Face> faces);

 private:
  void check_nodes(std::span<const std::int32_t> nodes) const;
  void cut_hexahedra();

  std::filesystem::path path_;
  geometry::MixedMesh mesh_;
  std::vector<bool> in_layers_;
  std::vector<geometry::Hexahedron> hexahedra_;
  bool now_in_layers_ = false;
};

}  // namespace ostia::io
