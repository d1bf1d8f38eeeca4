#include "mesh/builder.h"

#include "surface_formats.h"

#include "ostia/geometry/hex_prisms.h"
#include "ostia/geometry/mixed_mesh_sides.h"

#include <algorithm>

namespace ostia::io {
namespace {

using geometry::MixedMesh;

template <std::size_t N>
constexpr std::array<int, N> as_it_is() {
  std::array<int, N> order{};
  for (std::size_t i = 0; i < N; ++i) order[i] = static_cast<int>(i);
  return order;
}

/// `order` says which of our nodes stands at each place of the file's.
template <std::size_t N, std::size_t M>
bool add_cell(std::span<const std::int32_t> nodes, const std::array<int, N + M>& order,
              std::vector<std::array<std::int32_t, N>>& corners,
              std::vector<std::array<std::int32_t, M>>& second) {
  if (nodes.size() != N && nodes.size() != N + M) return false;
  std::array<std::int32_t, N> corner{};
  std::array<std::int32_t, M> node{};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto ours = static_cast<std::size_t>(order[i]);
    (ours < N ? corner[ours] : node[ours - N]) = nodes[i];
  }
  corners.push_back(corner);
  if (nodes.size() == N + M) second.push_back(node);
  return true;
}

}  // namespace

void MeshBuilder::check_nodes(std::span<const std::int32_t> nodes) const {
  for (const std::int32_t node : nodes) {
    if (node < 0 || static_cast<std::size_t>(node) >= mesh_.points.size())
      refuse(path_,
             "a cell names point " + std::to_string(node) + " of " + std::to_string(mesh_.points.size()));
  }
}

bool MeshBuilder::add_hexahedron(std::span<const std::int32_t> nodes) {
  check_nodes(nodes);
  geometry::Hexahedron hexahedron{};
  if (nodes.size() != hexahedron.size()) return false;
  std::ranges::copy(nodes, hexahedron.begin());
  hexahedra_.push_back(hexahedron);
  return true;
}

void MeshBuilder::cut_hexahedra() {
  try {
    geometry::add_as_prisms(hexahedra_, mesh_);
  } catch (const GeometryError& error) {
    refuse(path_, error.what());
  }
}

bool MeshBuilder::add(Shape shape, std::span<const std::int32_t> nodes, std::int32_t face,
                      const NodeOrder& order) {
  check_nodes(nodes);
  switch (shape) {
    case Shape::tetrahedron:
      if (!add_cell(nodes, order.tetrahedron, mesh_.tetrahedra, mesh_.tetrahedron_nodes)) return false;
      in_layers_.push_back(now_in_layers_);
      return true;
    case Shape::prism:
      return add_cell(nodes, order.prism, mesh_.prisms, mesh_.prism_nodes);
    case Shape::triangle:
      if (!add_cell(nodes, as_it_is<6>(), mesh_.triangles, mesh_.triangle_nodes)) return false;
      mesh_.triangle_face_ids.push_back(face);
      return true;
    case Shape::quad:
      if (!add_cell(nodes, as_it_is<9>(), mesh_.quads, mesh_.quad_nodes)) return false;
      mesh_.quad_face_ids.push_back(face);
      return true;
  }
  return false;
}

std::vector<std::int32_t> MeshBuilder::face_ids() const {
  std::vector<std::int32_t> ids = mesh_.triangle_face_ids;
  ids.insert(ids.end(), mesh_.quad_face_ids.begin(), mesh_.quad_face_ids.end());
  return ids;
}

LayeredMesh MeshBuilder::finish(std::vector<geometry::Face> faces) {
  if (mesh_.tetrahedra.empty() && mesh_.prisms.empty() && hexahedra_.empty())
    refuse(path_, "it has no tetrahedra, no prisms and no hexahedra");
  const bool second = mesh_.quadratic();
  const auto of_one_order = [second](std::size_t cells, std::size_t with_nodes) {
    return with_nodes == (second ? cells : 0);
  };
  if (!of_one_order(mesh_.tetrahedra.size(), mesh_.tetrahedron_nodes.size()) ||
      !of_one_order(mesh_.prisms.size(), mesh_.prism_nodes.size()) ||
      !of_one_order(mesh_.triangles.size(), mesh_.triangle_nodes.size()) ||
      !of_one_order(mesh_.quads.size(), mesh_.quad_nodes.size()) || (second && !hexahedra_.empty()))
    refuse(path_, "it has linear and quadratic cells together; a mesh is of one order");
  mesh_.faces = std::move(faces);
  if (!hexahedra_.empty()) cut_hexahedra();
  if (!has_boundary()) take_free_sides_as_boundary(mesh_);
  if (std::ranges::find(in_layers_, true) == in_layers_.end()) in_layers_.clear();
  return {std::move(mesh_), std::move(in_layers_), hexahedra_.size()};
}

}  // namespace ostia::io
