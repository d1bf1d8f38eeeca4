#include "ostia/solver/wall_surface.h"

#include "facets.h"

#include "ostia/core/error.h"
#include "ostia/geometry/faces.h"
#include "ostia/io/mesh_export.h"
#include "ostia/meshing/boundary_layer.h"

namespace ostia::solver {
namespace {

using geometry::MixedMesh;

/// Sums of weighted values at points.
class Carrier {
 public:
  Carrier(std::size_t points, std::size_t components)
      : components_(components), sums_(points * components), weights_(points) {}
  void add(std::int32_t point, const double* values, double weight) {
    const auto p = static_cast<std::size_t>(point);
    for (std::size_t c = 0; c < components_; ++c) sums_[p * components_ + c] += weight * values[c];
    weights_[p] += weight;
  }
  std::vector<double> means() {
    for (std::size_t i = 0; i < sums_.size(); ++i)
      if (weights_[i / components_] > 0.0) sums_[i] /= weights_[i / components_];
    return std::move(sums_);
  }

 private:
  std::size_t components_;
  std::vector<double> sums_, weights_;
};

/// Takes the facets of walls over.
class WallCollector {
 public:
  WallCollector(const MixedMesh& mesh, WallSurface& wall)
      : wall_(wall), local_(mesh, wall.surface.mesh.points) {}

  template <std::size_t N>
  void add(const std::array<std::int32_t, N>& corners, std::int32_t face) {
    const auto facet = static_cast<std::int32_t>(wall_.areas_mm2.size());
    double area = 0.0;
    for (std::size_t i = 2; i < N; ++i) {
      const geometry::Triangle t{local_(corners[0]), local_(corners[i - 1]), local_(corners[i])};
      const auto p = [&](std::size_t k) { return wall_.surface.mesh.points[static_cast<std::size_t>(t[k])]; };
      area += (p(1) - p(0)).cross(p(2) - p(0)).norm() / 2.0;
      wall_.surface.mesh.triangles.push_back(t);
      wall_.surface.face_ids.push_back(face);
      wall_.facet_of.push_back(facet);
    }
    wall_.areas_mm2.push_back(area);
  }
  const std::vector<std::int32_t>& taken() const { return local_.taken(); }

 private:
  WallSurface& wall_;
  OwnPoints local_;
};

}  // namespace

WallSurface wall_surface(const MixedMesh& mesh) {
  WallSurface wall;
  WallCollector collector(mesh, wall);
  const std::vector<std::string> names = io::safe_face_names(mesh.faces);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const geometry::Face& face = mesh.faces[f];
    if (!geometry::is_wall(face)) continue;
    WallSurface::Part part{names[f], wall.areas_mm2.size(), 0};
    for_facets_of(mesh, face.id, [&](const auto& corners) { collector.add(corners, face.id); });
    part.count = wall.areas_mm2.size() - part.first;
    if (part.count == 0) continue;
    wall.parts.push_back(part);
    wall.surface.faces.push_back({face.id, names[f], face.kind});
  }
  if (wall.parts.empty()) throw InvalidInput("the mesh has no wall");
  wall.mesh_points = collector.taken();
  return wall;
}

std::vector<double> at_wall_points(const WallSurface& wall, const std::vector<double>& facets,
                                   std::size_t components) {
  const geometry::TriMesh& mesh = wall.surface.mesh;
  Carrier carrier(mesh.points.size(), components);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto p = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(mesh.triangles[t][k])]; };
    const double area = (p(1) - p(0)).cross(p(2) - p(0)).norm();
    const double* values = facets.data() + static_cast<std::size_t>(wall.facet_of[t]) * components;
    for (const std::int32_t corner : mesh.triangles[t]) carrier.add(corner, values, area);
  }
  return carrier.means();
}

std::vector<double> element_volumes(const MixedMesh& mesh) {
  std::vector<double> volumes;
  volumes.reserve(mesh.tetrahedra.size() + mesh.prisms.size());
  for (const geometry::Tetrahedron& t : mesh.tetrahedra) {
    const auto p = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(t[k])]; };
    volumes.push_back((p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0)) / 6.0);
  }
  for (const geometry::Prism& prism : mesh.prisms) {
    meshing::PrismCorners corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
      corners[i] = mesh.points[static_cast<std::size_t>(prism[i])];
    volumes.push_back(meshing::prism_volume(corners));
  }
  return volumes;
}

std::vector<double> at_mesh_points(const MixedMesh& mesh, const std::vector<double>& elements,
                                   std::size_t components) {
  const std::vector<double> volumes = element_volumes(mesh);
  Carrier carrier(mesh.points.size(), components);
  std::size_t element = 0;
  const auto add = [&](const auto& corners) {
    for (const std::int32_t corner : corners)
      carrier.add(corner, elements.data() + element * components, volumes[element]);
    ++element;
  };
  for (const geometry::Tetrahedron& t : mesh.tetrahedra) add(t);
  for (const geometry::Prism& prism : mesh.prisms) add(prism);
  return carrier.means();
}

}  // namespace ostia::solver
