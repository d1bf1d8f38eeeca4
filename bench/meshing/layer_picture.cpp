// A fork filled with layers of prisms and tetrahedra, cut open along its plane.

#include "picture.h"
#include "test_surfaces.h"

#include "ostia/figure/scene.h"
#include "ostia/meshing/boundary_layer.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/sizing.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace {

using namespace ostia;
using geometry::Vec3;
using Face = std::vector<std::int32_t>;

struct Side {
  Face face;  // outward
  bool prism;
};

/// Faces of the elements whose centroid lies behind the plane y = 0 that no other of these shares.
std::vector<Side> laid_open(const geometry::MixedMesh& mesh) {
  std::map<Face, std::pair<Side, int>> sides;
  const auto add = [&](const Side& side) {
    Face key = side.face;
    std::sort(key.begin(), key.end());
    ++sides.try_emplace(key, side, 0).first->second.second;
  };
  const auto behind = [&](const auto& corners) {
    double sum = 0.0;
    for (const std::int32_t v : corners) sum += mesh.points[static_cast<std::size_t>(v)].y();
    return sum >= 0.0;
  };
  for (const geometry::Prism& p : mesh.prisms)
    if (behind(p))
      for (const Face& face : {Face{p[0], p[2], p[1]}, Face{p[3], p[4], p[5]}, Face{p[0], p[1], p[4], p[3]},
                               Face{p[1], p[2], p[5], p[4]}, Face{p[2], p[0], p[3], p[5]}})
        add({face, true});
  for (const geometry::Tetrahedron& t : mesh.tetrahedra)
    if (behind(t))
      for (const Face& face :
           {Face{t[0], t[2], t[1]}, Face{t[0], t[1], t[3]}, Face{t[1], t[2], t[3]}, Face{t[2], t[0], t[3]}})
        add({face, false});
  std::vector<Side> open;
  for (const auto& [key, side] : sides)
    if (side.second == 1) open.push_back(side.first);
  return open;
}

figure::Scene scene_of(const geometry::MixedMesh& mesh) {
  figure::MeshActor layers, inside;
  layers.color = figure::colors::cut;
  layers.label = "layers of prisms";
  inside.color = figure::colors::lumen;
  inside.label = "tetrahedra";
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const Side& side : laid_open(mesh)) {
    const Face& f = side.face;
    auto& triangles = (side.prism ? layers : inside).mesh.triangles;
    triangles.push_back({f[0], f[1], f[2]});
    if (f.size() == 4) triangles.push_back({f[0], f[2], f[3]});
    for (std::size_t i = 0; i < f.size(); ++i) edges.insert(std::minmax({f[i], f[(i + 1) % f.size()]}));
  }
  figure::Scene scene;
  for (figure::MeshActor* actor : {&layers, &inside}) {
    actor->mesh.points = mesh.points;
    actor->shading = figure::Shading::flat;
    scene.meshes.push_back(std::move(*actor));
  }
  for (const auto& [a, b] : edges)
    scene.tubes.push_back(
        {{mesh.points[static_cast<std::size_t>(a)], mesh.points[static_cast<std::size_t>(b)]},
         {0.012},
         {0.06, 0.07, 0.09, 1.0}});
  return scene;
}

void make(const std::string& file) {
  const geometry::AnalyticShape shape = geometry::y_junction(5.0, 9.0, 2.0, 1.4, 50.0);
  const geometry::FacedSurface capped = meshing::capped(shape, 0.25, false);
  meshing::SizingOptions sizing;
  sizing.edge_ratio = 0.3;
  const auto sizes =
      meshing::target_edge_lengths(capped.mesh, meshing::TubeFunction(meshing::tree_of(shape)), sizing);
  meshing::BoundaryLayerOptions options;
  options.layers = 4;
  options.thickness = 0.8;
  const auto filled = meshing::fill_with_layers(meshing::remesh(capped, sizes).surface, options);
  figure::RenderOptions render;
  render.width_px = 900;
  render.height_px = 1100;
  render.look = figure::Look::light;
  figure::scene_figure(scene_of(filled.mesh), figure::cameras::anterior(), render).write(file, 1.0);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::make_picture(argc, argv, "PICTURE.png", 1,
                             [](const std::vector<std::string>& files) { make(files[0]); });
}
