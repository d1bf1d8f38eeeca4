#pragma once
/// \file Faces of a mesh whose file names them by the sides of elements.

#include "mesh_prepared.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace ostia::io {

/// The least id from 1 that no face has.
std::int32_t unused_face_id(const std::vector<geometry::Face>& faces);
/// Facets with the id `rest`, if there are any, are one more face: a wall.
void name_rest(geometry::MixedMesh& mesh, std::int32_t rest);

/// Which face a side of an element belongs to; elements count tetrahedra first, then prisms, sides as in
/// ElementSide.
class TaggedSides {
 public:
  /// Throws InvalidInput that names the file where there is no such element or side.
  void add(const geometry::MixedMesh& mesh, const ElementSide& side, std::int32_t face,
           const std::filesystem::path& path);
  /// Gives the boundary's facets those of the mesh's faces that were said of them; the rest is one more face.
  void apply(geometry::MixedMesh& mesh) const;

 private:
  using Corners = std::array<std::int32_t, 4>;  // sorted, -1 first for a triangle
  std::map<Corners, std::int32_t> faces_;
};

}  // namespace ostia::io
