// Branches, bifurcations and sections of an analytic tree, or of a surface with its lines; or its patches.

#include "branched_shapes.h"
#include "picture.h"

#include "ostia/analysis/bifurcations.h"
#include "ostia/analysis/branch_mapping.h"
#include "ostia/analysis/branch_sections.h"
#include "ostia/figure/scene.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace ostia;
using geometry::Vec3;

constexpr double wall_opacity = 0.3;
constexpr double patch_mm = 2.0;
constexpr int patch_sectors = 12;

struct Input {
  geometry::TriMesh wall;
  geometry::BranchedLines lines;
};

/// A stenosis.
void narrow(geometry::Centerline& axis, double severity, double centre_mm, double length_mm) {
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const double u = (axis.abscissa[i] - centre_mm) / length_mm;
    if (std::abs(u) < 0.5)
      axis.radius[i] *= 1.0 - 0.5 * severity * (1.0 + std::cos(2.0 * std::numbers::pi * u));
  }
}

/// `fork`, or SURFACE,LINES.
Input made(const std::string& what) {
  if (what == "fork") {
    geometry::AnalyticShape y = geometry::y_junction(16.0, 18.0, 2.0, 2.0, 75.0);
    narrow(y.tubes[1].axis, 0.45, 11.0, 7.0);
    return {geometry::surface_of(y, 0.2, true), geometry::branch_groups(analysis::tree_of_tubes(y))};
  }
  const std::size_t comma = what.find(',');
  const std::string lines = comma == std::string::npos ? "" : what.substr(comma + 1);
  auto split = io::read_branched_lines(lines);
  return {io::read_surface(what.substr(0, comma)).surface.mesh,
          split ? std::move(*split) : geometry::branch_groups(io::read_centerlines(lines))};
}

void add_lines(const Input& input, double thickness, figure::Scene& scene) {
  std::vector<bool> named(2, false);
  for (const geometry::BranchedLine& line : input.lines.lines) {
    for (const geometry::Tract& tract : line.tracts) {
      const figure::Color color = tract.blanked ? figure::palette(3) : figure::colors::centerline;
      figure::TubeActor tube =
          figure::tube_of(geometry::tract_axis(line, tract), (tract.blanked ? 1.6 : 1.0) * thickness, color);
      if (!named[tract.blanked]) tube.label = tract.blanked ? "bifurcation (blanked)" : "branches";
      named[tract.blanked] = true;
      scene.tubes.push_back(std::move(tube));
    }
  }
}

void add_arrow(const Vec3& from, const Vec3& to, double thickness, const figure::Color& color,
               const std::string& label, figure::Scene& scene) {
  const Vec3 tip = from + 0.75 * (to - from);
  scene.tubes.push_back({{from, tip}, {thickness}, color, label});
  scene.tubes.push_back({{tip, to}, {2.4 * thickness, 0.05 * thickness}, color, ""});
}

figure::Scene branches(const Input& input, double thickness) {
  figure::Scene scene;
  add_lines(input, thickness, scene);
  const analysis::SurfaceSections sections = analysis::branch_sections(input.wall, input.lines);
  const figure::Color closed{0.10, 0.12, 0.16}, open{0.55, 0.57, 0.60};
  for (const analysis::BranchSection& one : sections.branches) {
    std::vector<Vec3> outline = one.outline;
    if (one.closed) outline.push_back(outline.front());
    scene.tubes.push_back({outline, {0.4 * thickness}, one.closed ? closed : open, ""});
  }
  const analysis::BifurcationMeasures measures = analysis::measure_bifurcations(input.lines);
  for (const analysis::BifurcationVector& one : measures.vectors)
    add_arrow(one.point, one.point + 2.0 * one.vector, 1.3 * thickness, figure::palette(5), "", scene);
  for (const analysis::BifurcationSystem& one : measures.systems) {
    const double length = 40.0 * thickness;
    const bool first = one.group == measures.systems.front().group;
    add_arrow(one.origin, one.origin + length * one.normal, 1.1 * thickness, figure::palette(2),
              first ? "normal" : "", scene);
    add_arrow(one.origin, one.origin + length * one.up_normal, 1.1 * thickness, figure::palette(4),
              first ? "up-normal" : "", scene);
  }
  const analysis::MappedWall mapped = analysis::map_branches(input.wall, input.lines);
  for (std::size_t i = 0; i < mapped.branches.size(); ++i) {
    figure::MeshActor wall;
    wall.mesh = mapped.branches[i].mesh;
    const std::size_t colors[] = {7, 1, 0};
    wall.color = figure::mixed(figure::palette(colors[i % 3]), {1, 1, 1}, 0.25);
    wall.color.a = wall_opacity;
    scene.meshes.push_back(std::move(wall));
  }
  return scene;
}

figure::Scene patches(const Input& input) {
  const analysis::MappedWall mapped = analysis::map_branches(input.wall, input.lines);
  std::vector<std::vector<std::vector<double>>> values;
  for (const analysis::MappedBranch& branch : mapped.branches) values.push_back({branch.distance_mm});
  const analysis::PatchedWall patched = analysis::patch_branches(mapped, values, {patch_mm, patch_sectors});
  double least = INFINITY, most = 0.0;
  for (const analysis::WallPatch& patch : patched.patches) {
    least = std::min(least, patch.means[0]);
    most = std::max(most, patch.means[0]);
  }
  figure::MeshActor wall;
  for (const analysis::PatchTriangle& triangle : patched.triangles) {
    const analysis::WallPatch& patch = patched.patches[triangle.patch];
    const auto first = static_cast<std::int32_t>(wall.mesh.points.size());
    wall.mesh.points.insert(wall.mesh.points.end(), triangle.corners.begin(), triangle.corners.end());
    wall.mesh.triangles.push_back({first, first + 1, first + 2});
    figure::Color color = figure::mixed({0.80, 0.25, 0.15}, {0.90, 0.93, 0.97},
                                        (patch.means[0] - least) / std::max(most - least, 1e-9));
    if ((patch.along + patch.around) % 2 != 0) color = figure::mixed(color, {0, 0, 0}, 0.12);
    wall.triangle_colors.push_back(color);
  }
  wall.shading = figure::Shading::flat;
  figure::Scene scene;
  scene.meshes.push_back(std::move(wall));
  return scene;
}

void make(const std::string& kind, const std::string& what, const std::string& file) {
  const Input input = made(what);
  geometry::Box3 box;
  for (const Vec3& p : input.wall.points) box.extend(p);
  const figure::Scene scene =
      kind == "patches" ? patches(input) : branches(input, 0.0035 * box.diagonal().norm());
  figure::RenderOptions render;
  render.width_px = 900;
  render.height_px = 900;
  render.look = figure::Look::light;
  figure::Camera camera = figure::cameras::broadside(input.wall.points);
  camera.direction += 0.35 * camera.up.cross(camera.direction) - 0.25 * camera.up;
  figure::scene_figure(scene, camera, render).write(file, 1.0);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::make_picture(argc, argv, "branches|patches fork|SURFACE,LINES PICTURE.png", 3,
                             [](const std::vector<std::string>& a) { make(a[0], a[1], a[2]); });
}
