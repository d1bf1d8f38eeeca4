#include "meshes.h"

#include "ostia/core/error.h"

#include <algorithm>

namespace ostia::python {

void require_indices(const py::array& indices, std::size_t count, const std::string& name) {
  const auto* first = static_cast<const std::int32_t*>(indices.data());
  const auto* last = first + indices.size();
  const auto* wrong = std::find_if(
      first, last, [&](std::int32_t i) { return i < 0 || static_cast<std::size_t>(i) >= count; });
  if (wrong == last) return;
  throw InvalidInput(name + ": " + std::to_string(*wrong) + " in row " +
                     std::to_string((wrong - first) / indices.shape(1)) +
                     " is the index of no point; there are " + std::to_string(count) + ", counted from 0");
}

void require_indices(const geometry::TriMesh& surface) {
  const auto count = static_cast<std::int32_t>(surface.points.size());
  for (const geometry::Triangle& triangle : surface.triangles)
    for (const std::int32_t i : triangle)
      if (i < 0 || i >= count)
        throw InvalidInput("surface: " + std::to_string(i) + " is the index of no point; there are " +
                           std::to_string(count) + "; its array was written to after it was made of it");
}

std::shared_ptr<geometry::TriMesh> mesh_of(const py::object& points, const py::object& triangles,
                                           const py::object& copy) {
  const Copying copying = copying_of(copy);
  const py::array places = taken(points, {"points", 'f', 8, {-1, 3}}, copying);
  require_finite(places, "points");
  const py::array rows = taken(triangles, {"triangles", 'i', 4, {-1, 3}}, copying);
  require_indices(rows, static_cast<std::size_t>(places.shape(0)), "triangles");
  auto* mesh = new geometry::TriMesh;
  lend(mesh->points, places.data(), static_cast<std::size_t>(places.shape(0)));
  lend(mesh->triangles, rows.data(), static_cast<std::size_t>(rows.shape(0)));
  auto owners = std::make_shared<Held>(py::make_tuple(places, rows));
  return {mesh, [owners](geometry::TriMesh* gone) {
            take_back(gone->points);
            take_back(gone->triangles);
            delete gone;
          }};
}

}  // namespace ostia::python
