// Results before and after refinement by flow, cut open along the vessel and coloured by speed.

#include "picture.h"

#include "ostia/core/error.h"
#include "ostia/figure/cut_open.h"
#include "ostia/figure/scene.h"
#include "ostia/figure/value_colors.h"
#include "ostia/geometry/kd_tree.h"
#include "ostia/io/volume_fields.h"
#include "ostia/io/volume_mesh_file.h"

#include <algorithm>
#include <cmath>

namespace {

using namespace ostia;
using geometry::Vec3;

constexpr int width_px = 1500, height_px = 300;
constexpr double shown_mm = 4.2, middle_mm = 14.0;

struct Result {
  geometry::MixedMesh mesh;
  std::vector<double> speed;  // at its points
};

Result read(const std::string& file) {
  Result result{io::read_volume_mesh(file), {}};
  const io::VolumeFields fields = io::read_vtu_fields(file);
  const auto velocity = fields.points.find("velocity_m_s");
  if (velocity == fields.points.end()) throw InvalidInput(file + " has no point field velocity_m_s");
  const std::vector<double>& v = velocity->second.values;
  for (std::size_t i = 0; i + 2 < v.size(); i += 3)
    result.speed.push_back(Vec3(v[i], v[i + 1], v[i + 2]).norm());
  return result;
}

figure::Picture picture_of(const Result& result, double top, const std::string& title) {
  const geometry::KdTree points(result.mesh.points);
  figure::Scene scene;
  const figure::CutPlane plane{Vec3::Zero(), -Vec3::UnitY()};
  for (figure::MeshActor& actor : figure::cut_actors(result.mesh, plane)) {
    for (const geometry::Triangle& t : actor.mesh.triangles) {
      double sum = 0.0;
      for (const std::int32_t v : t)
        sum += result.speed[static_cast<std::size_t>(
            points.nearest(actor.mesh.points[static_cast<std::size_t>(v)]))];
      actor.triangle_colors.push_back(figure::viridis(sum / 3.0 / top));
    }
    actor.shading = figure::Shading::flat;
    actor.edge_width_px = 0.5;
    actor.label.clear();
    scene.meshes.push_back(std::move(actor));
  }
  figure::Camera camera;
  camera.up = -Vec3::UnitX();  // the flow runs to the right
  camera.focus = Vec3(0.0, 0.0, middle_mm);
  camera.height_mm = shown_mm;
  figure::RenderOptions render;
  render.width_px = width_px;
  render.height_px = height_px;
  render.look = figure::Look::light;
  render.occlusion_rays = 0;  // darker places would be read as other values
  render.title = title;
  render.orientation_axes = false;
  render.legend = false;
  return figure::scene_figure(scene, camera, render);
}

void make(const std::vector<std::string>& files) {
  std::vector<figure::Picture> rows;
  const std::vector<Result> results{read(files[0]), read(files[1])};
  const double fastest =
      std::max(*std::ranges::max_element(results[0].speed), *std::ranges::max_element(results[1].speed));
  const double top = std::ceil(10.0 * fastest) / 10.0;
  for (const Result& result : results)
    rows.push_back(
        picture_of(result, top,
                   std::to_string(result.mesh.tetrahedra.size() + result.mesh.prisms.size()) + " elements"));
  figure::GridOptions grid;
  grid.columns = 1;
  grid.look = figure::Look::light;
  figure::ValueBar bar;
  bar.title = "speed, m/s";
  bar.high = top;
  bar.height_px = 2 * height_px;
  figure::GridOptions beside = grid;
  beside.columns = 2;
  figure::grid({figure::grid(rows, grid), figure::value_bar(bar)}, beside).write(files[2], 1.0);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::make_picture(argc, argv, "BEFORE.vtu AFTER.vtu PICTURE.png", 3, make);
}
