#pragma once
/// \file What is near on a surface.

#include "ostia/geometry/mesh_topology.h"

#include <cstdint>
#include <vector>

namespace ostia::glview {

/// The vertices that the surface joins to one within a distance, itself first.
class Neighbourhood {
 public:
  explicit Neighbourhood(const geometry::TriMesh& mesh)
      : mesh_(mesh), neighbours_(geometry::vertex_neighbours(mesh)), seen_(mesh.points.size(), -1) {}
  const std::vector<std::int32_t>& of(std::int32_t start, double reach_mm) {
    found_.assign(1, start);
    seen_[static_cast<std::size_t>(start)] = start;
    const geometry::Vec3& middle = mesh_.points[static_cast<std::size_t>(start)];
    for (std::size_t k = 0; k < found_.size(); ++k)
      for (const std::int32_t next : neighbours_[static_cast<std::size_t>(found_[k])]) {
        const auto i = static_cast<std::size_t>(next);
        if (seen_[i] == start || (mesh_.points[i] - middle).norm() > reach_mm) continue;
        seen_[i] = start;
        found_.push_back(next);
      }
    return found_;
  }

 private:
  const geometry::TriMesh& mesh_;
  std::vector<std::vector<std::int32_t>> neighbours_;
  std::vector<std::int32_t> seen_, found_;
};

}  // namespace ostia::glview
