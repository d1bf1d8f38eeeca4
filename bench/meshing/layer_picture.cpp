// A fork filled with layers of prisms and tetrahedra, cut open along its plane.

#include "cut_scene.h"
#include "picture.h"
#include "test_surfaces.h"

#include "ostia/meshing/boundary_layer.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/sizing.h"

#include <algorithm>
#include <map>
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
  bench::CutPart layers{"layers of prisms", figure::colors::cut}, inside{"tetrahedra", figure::colors::lumen};
  for (const Side& side : laid_open(mesh)) (side.prism ? layers : inside).faces.push_back(side.face);
  return bench::cut_scene(mesh.points, {layers, inside});
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
