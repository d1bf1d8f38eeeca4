#pragma once
/// \file Faces of a mesh whose file names them by the sides of elements.

#include "mesh/prepared.h"

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

/// Keeps ids from 1, each of the first face that has it; the others get the least that no face has.
void make_ids_unique(std::vector<geometry::Face>& faces);

/// An element by its place among those of its kind.
struct CountedElement {
  std::int32_t number = 0;
  bool prism = false;
};
/// Counts the elements of a file in which kinds may follow each other in any order.
class ElementCounts {
 public:
  CountedElement next(bool prism) { return {counts_[prism ? 1 : 0]++, prism}; }

 private:
  std::array<std::int32_t, 2> counts_{};
};
/// In the whole mesh: tetrahedra first, then prisms.
std::int32_t index_of(const CountedElement& element, const geometry::MixedMesh& mesh);

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
