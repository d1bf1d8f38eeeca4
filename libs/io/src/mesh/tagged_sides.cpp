#include "mesh/tagged_sides.h"

#include "surface_formats.h"

#include "ostia/geometry/mixed_mesh_sides.h"

#include <algorithm>
#include <set>

namespace ostia::io {
namespace {

template <class Element>
std::array<std::int32_t, 4> corners_of(const Element& element, const std::array<int, 4>& side) {
  std::array<std::int32_t, 4> corners{-1, -1, -1, -1};
  for (std::size_t i = 0; i < 4; ++i)
    if (side[i] >= 0) corners[i] = element[static_cast<std::size_t>(side[i])];
  std::ranges::sort(corners);
  return corners;
}

}  // namespace

std::int32_t unused_face_id(const std::vector<geometry::Face>& faces) {
  std::set<std::int32_t> used;
  for (const geometry::Face& face : faces) used.insert(face.id);
  std::int32_t id = 1;
  while (used.contains(id)) ++id;
  return id;
}

void make_ids_unique(std::vector<geometry::Face>& faces) {
  std::set<std::int32_t> used;
  std::vector<geometry::Face*> without;
  for (geometry::Face& face : faces)
    if (face.id < 1 || !used.insert(face.id).second) without.push_back(&face);
  std::int32_t id = 1;
  for (geometry::Face* face : without) {
    while (!used.insert(id).second) ++id;
    face->id = id;
  }
}

std::int32_t index_of(const CountedElement& element, const geometry::MixedMesh& mesh) {
  return element.number + (element.prism ? static_cast<std::int32_t>(mesh.tetrahedra.size()) : 0);
}

void name_rest(geometry::MixedMesh& mesh, std::int32_t rest) {
  for (const auto* ids : {&mesh.triangle_face_ids, &mesh.quad_face_ids}) {
    if (std::ranges::find(*ids, rest) == ids->end()) continue;
    mesh.faces.push_back({rest, "wall", geometry::FaceKind::wall});
    return;
  }
}

void TaggedSides::add(const geometry::MixedMesh& mesh, const ElementSide& side, std::int32_t face,
                      const std::filesystem::path& path) {
  const std::size_t tetrahedra = mesh.tetrahedra.size(), elements = tetrahedra + mesh.prisms.size();
  const auto e = static_cast<std::size_t>(side.element), s = static_cast<std::size_t>(side.side);
  if (side.element < 0 || e >= elements || side.side < 0 || s >= (e < tetrahedra ? 4U : 5U))
    refuse(path, "a set names side " + std::to_string(side.side + 1) + " of element " +
                     std::to_string(side.element + 1) + ", which is not there");
  faces_[e < tetrahedra ? corners_of(mesh.tetrahedra[e], geometry::tetrahedron_sides[s])
                        : corners_of(mesh.prisms[e - tetrahedra], geometry::prism_sides[s])] = face;
}

void TaggedSides::apply(geometry::MixedMesh& mesh) const {
  const std::int32_t rest = unused_face_id(mesh.faces);
  std::ranges::fill(mesh.triangle_face_ids, rest);
  std::ranges::fill(mesh.quad_face_ids, rest);
  const auto tag = [&](Corners corners, std::int32_t& id) {
    std::ranges::sort(corners);
    if (const auto found = faces_.find(corners); found != faces_.end()) id = found->second;
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const geometry::Triangle& t = mesh.triangles[i];
    tag({-1, t[0], t[1], t[2]}, mesh.triangle_face_ids[i]);
  }
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) tag(mesh.quads[i], mesh.quad_face_ids[i]);
  name_rest(mesh, rest);
}

}  // namespace ostia::io
