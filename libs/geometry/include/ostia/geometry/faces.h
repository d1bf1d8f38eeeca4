#pragma once
/// \file Faces of surfaces and meshes by their ids: which are wall.

#include "ostia/core/error.h"
#include "ostia/geometry/tri_mesh.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::geometry {

/// "wall", "inlet", "outlet".
constexpr std::string_view name_of(FaceKind kind) {
  return kind == FaceKind::inlet ? "inlet" : kind == FaceKind::outlet ? "outlet" : "wall";
}

constexpr bool is_wall(const Face& face) {
  return face.kind == FaceKind::wall;
}

/// Throws InvalidInput that begins with `what` where no face of the surface has the id.
inline const Face& face_of(const FacedSurface& surface, std::int32_t id, const char* what) {
  const auto found = std::ranges::find(surface.faces, id, &Face::id);
  if (found != surface.faces.end()) return *found;
  throw InvalidInput(std::string(what) + ": triangles carry face id " + std::to_string(id) +
                     ", which no face of the surface has");
}

/// Wall and caps by their ids, for asking about many facets. An id that no face has is neither.
class FacesByKind {
 public:
  explicit FacesByKind(const std::vector<Face>& faces) {
    for (const Face& face : faces) (is_wall(face) ? walls_ : caps_).push_back(face.id);
    std::ranges::sort(walls_);
    std::ranges::sort(caps_);
  }
  bool wall(std::int32_t id) const { return std::ranges::binary_search(walls_, id); }
  bool cap(std::int32_t id) const { return std::ranges::binary_search(caps_, id); }

 private:
  std::vector<std::int32_t> walls_, caps_;
};

/// One a point: whether all its triangles are wall. Points of the rings about caps are not.
inline std::vector<bool> points_of_wall_alone(const FacedSurface& surface) {
  std::vector<bool> alone(surface.mesh.points.size(), true);
  const FacesByKind faces(surface.faces);
  for (std::size_t i = 0; i < surface.mesh.triangles.size(); ++i)
    if (!faces.wall(surface.face_ids[i]))
      for (const std::int32_t p : surface.mesh.triangles[i]) alone[static_cast<std::size_t>(p)] = false;
  return alone;
}

}  // namespace ostia::geometry
