// A fork filled with swept hexahedra, cut open along its plane.

#include "cut_scene.h"
#include "picture.h"
#include "test_graphs.h"

#include "ostia/reconstruction/hexahedra.h"

#include <algorithm>
#include <map>
#include <utility>

namespace {

using namespace ostia;
using geometry::Quad;

struct Side {
  Quad corners;  // outward
  bool layer;
  int seen;
};

/// Sides of the hexahedra behind the plane z = 0 that no other of these shares. Of each ring's hexahedra the
/// first `layers` lie along the wall.
std::vector<Side> laid_open(const geometry::HexMesh& mesh, std::size_t layers, std::size_t in_ring) {
  std::map<Quad, Side> sides;
  for (std::size_t h = 0; h < mesh.hexahedra.size(); ++h) {
    double sum = 0.0;
    for (const std::int32_t v : mesh.hexahedra[h]) sum += mesh.points[static_cast<std::size_t>(v)].z();
    if (sum > 0.0) continue;
    for (const auto& places : geometry::hexahedron_sides) {
      Side side{{}, h % in_ring < layers, 0};
      for (std::size_t k = 0; k < 4; ++k)
        side.corners[k] = mesh.hexahedra[h][static_cast<std::size_t>(places[k])];
      Quad key = side.corners;
      std::sort(key.begin(), key.end());
      ++sides.try_emplace(key, side).first->second.seen;
    }
  }
  std::vector<Side> open;
  for (const auto& [key, side] : sides)
    if (side.seen == 1) open.push_back(side);
  return open;
}

figure::Scene scene_of(const geometry::HexMesh& mesh, std::size_t layers, std::size_t in_ring) {
  bench::CutPart along{"layers along the wall", figure::colors::cut},
      inside{"squares about the axis", figure::colors::lumen};
  for (const Side& side : laid_open(mesh, layers, in_ring))
    (side.layer ? along : inside).faces.emplace_back(side.corners.begin(), side.corners.end());
  return bench::cut_scene(mesh.points, {along, inside});
}

void make(const std::string& file) {
  reconstruction::ReconstructionOptions surface;
  surface.sides = 4;
  surface.level = 2;
  reconstruction::HexahedraOptions options;
  options.layers = 4;
  options.growth = 1.3;
  const auto swept = reconstruction::sweep_hexahedra(
      reconstruction::reconstruct_surface(reconstruction::testing::y_fork(70.0, 0.7), surface), options);
  figure::RenderOptions render;
  render.width_px = 1100;
  render.height_px = 800;
  render.look = figure::Look::light;
  figure::scene_figure(
      scene_of(swept.mesh, 4 * 16, 4 * 16 + 16),
      figure::Camera{.direction = geometry::Vec3(0.15, -0.25, -1.0), .up = geometry::Vec3::UnitY()}, render)
      .write(file, 1.0);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::make_picture(argc, argv, "PICTURE.png", 1,
                             [](const std::vector<std::string>& files) { make(files[0]); });
}
