// The tables of docs/methods/boundary-layer.md and docs/methods/tetrahedra.md: layers of prisms on analytic
// shapes and on synthetic coronary trees (`layers`, with `fill` the tetrahedra inside too), and what the gate
// says of these trees (`gate`).

#include "boundary_layer_shapes.h"
#include "picture.h"

#include "ostia/geometry/mixed_mesh_split.h"
#include "ostia/meshing/boundary_layer.h"
#include "ostia/meshing/mixed_quality.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/phantom/vessel_field.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace ostia;
using Surface = geometry::FacedSurface;

struct Setting {
  int layers;
  double thickness;
};
constexpr Setting settings[] = {{2, 0.25}, {4, 0.5}, {3, 1.0}, {5, 0.6}};

Surface even_stenosis() {
  const Surface input = meshing::capped(geometry::stenosed_tube(20.0, 1.6, 0.85, 10.0, 5.0), 0.15, false);
  return meshing::remesh(input, std::vector<double>(input.mesh.points.size(), 0.4)).surface;
}

Surface phantom_tree(std::uint64_t seed) {
  phantom::CaseOptions options;
  options.seed = seed;
  const phantom::CasePlan plan = phantom::plan_case(options);
  const geometry::VesselTree tree = phantom::vessel_tree(plan.tree);
  const auto lumen = phantom::tree_surface(phantom::VesselField(plan.tree), phantom::Boundary::lumen, 0.2);
  const Surface closed = meshing::cap_ends(meshing::clip_ends(lumen, tree));
  return meshing::remesh(closed, meshing::target_edge_lengths(closed.mesh, meshing::TubeFunction(tree)))
      .surface;
}

std::string cell(const Surface& surface, const Setting& setting, bool fill) {
  meshing::BoundaryLayerOptions options;
  options.layers = setting.layers;
  options.thickness = setting.thickness;
  meshing::BoundaryLayerReport report;
  char text[160], dihedral[48] = "";
  try {
    if (fill) {
      auto filled = meshing::fill_with_layers(surface, options);
      std::snprintf(dihedral, sizeof dihedral, " / %.1f degrees", filled.tetrahedra.quality.min_dihedral_deg);
      report = std::move(filled.layers);
    } else {
      report = meshing::boundary_layer(surface, options).report;
    }
  } catch (const Error& error) {
    return error.what();
  }
  std::snprintf(text, sizeof text, "%s%.2f / %.1f %%%s", report.inverted > 0 ? "INVERTED " : "",
                report.min_scaled_jacobian, 100.0 * report.full_share, dihedral);
  return text;
}

void row(const std::string& name, const std::function<Surface()>& make, bool fill) {
  const Surface surface = make();
  std::printf("| %s | %zu |", name.c_str(), surface.mesh.triangles.size());
  for (const Setting& setting : settings) std::printf(" %s |", cell(surface, setting, fill).c_str());
  std::printf("\n");
  std::fflush(stdout);
}

/// Angles of a surface, degrees.
struct SurfaceAngles {
  double wall = 180.0, caps = 180.0;  // the smallest of a triangle
  double wall_wedge = 360.0,
         rim_wedge = 360.0;  // the smallest inside between two triangles of the wall, and at caps
};

SurfaceAngles angles_of(const Surface& surface) {
  using geometry::Vec3;
  const auto at = [&](std::int32_t v) -> const Vec3& {
    return surface.mesh.points[static_cast<std::size_t>(v)];
  };
  const auto corner = [&](std::size_t t, std::size_t i) -> const Vec3& {
    return at(surface.mesh.triangles[t][i]);
  };
  const auto normal = [&](std::size_t t) {
    return Vec3((corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).normalized());
  };
  const auto centre = [&](std::size_t t) { return Vec3((corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0); };
  SurfaceAngles angles;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> seen;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    double& of_kind = surface.face_ids[t] == 1 ? angles.wall : angles.caps;
    of_kind = std::min(of_kind, meshing::min_angle_deg(corner(t, 0), corner(t, 1), corner(t, 2)));
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(surface.mesh.triangles[t][i], surface.mesh.triangles[t][(i + 1) % 3]);
      const auto [other, fresh] = seen.try_emplace({a, b}, t);
      if (fresh) continue;
      const Vec3 m = normal(other->second), n = normal(t);
      const double bend = std::atan2(m.cross(n).norm(), m.dot(n)) * 180.0 / std::numbers::pi;
      const bool convex = m.dot(centre(t) - centre(other->second)) < 0.0;
      double& wedge =
          surface.face_ids[t] == surface.face_ids[other->second] ? angles.wall_wedge : angles.rim_wedge;
      wedge = std::min(wedge, convex ? 180.0 - bend : 180.0 + bend);
    }
  }
  return angles;
}

/// What checkMesh and the gate look at.
std::string judged(const geometry::MixedMesh& mesh) {
  const meshing::MixedQuality q = meshing::mixed_quality(mesh);
  char text[160];
  std::snprintf(text, sizeof text, "%.1f / %.1f / %.2f", q.tetrahedra.min_dihedral_deg,
                q.openfoam.max_non_orthogonality_deg, q.openfoam.max_skewness);
  const meshing::QualityVerdict verdict = meshing::check(q);
  return text + (verdict.ok() ? std::string() : " FAILED: " + verdict.summary());
}

void gate_row(int seed) {
  const Surface surface = phantom_tree(static_cast<std::uint64_t>(seed));
  const SurfaceAngles angles = angles_of(surface);
  std::printf("| %d | %zu | %.1f / %.1f | %.1f / %.1f |", seed, surface.mesh.triangles.size(), angles.wall,
              angles.caps, angles.wall_wedge, angles.rim_wedge);
  std::printf(" %s |", judged(geometry::mixed(meshing::tetrahedralize(surface).mesh)).c_str());
  for (const Setting& setting : settings) {
    meshing::BoundaryLayerOptions options;
    options.layers = setting.layers;
    options.thickness = setting.thickness;
    std::printf(" %s |", judged(meshing::fill_with_layers(surface, options).mesh).c_str());
    std::fflush(stdout);
  }
  std::printf("\n");
}

void make(const std::string& what, int seeds) {
  if (what == "gate") {
    std::printf("| seed | triangles | least angle of wall / caps | least wedge within the wall / at caps |");
    std::printf(" no layers: dihedral angle / non-orthogonality / skewness |");
    for (const Setting& setting : settings) std::printf(" %d x %g |", setting.layers, setting.thickness);
    std::printf("\n");
    for (int seed = 1; seed <= seeds; ++seed) gate_row(seed);
    return;
  }
  using namespace geometry;
  const bool fill = what == "fill";
  const std::vector<std::pair<std::string, std::function<AnalyticShape()>>> shapes{
      {"straight tube", [] { return straight_tube(12.0, 1.5); }},
      {"fork of 25 degrees", [] { return y_junction(8.0, 14.0, 2.0, 1.4, 25.0); }},
      {"fork of 15 degrees", [] { return y_junction(8.0, 24.0, 2.0, 1.4, 15.0); }},
      {"fork of 120 degrees", [] { return y_junction(8.0, 14.0, 2.0, 1.7, 120.0); }}};
  for (const auto& [name, shape] : shapes)
    row(
        name, [&make_shape = shape] { return meshing::remeshed(make_shape(), 0.3); }, fill);
  row(
      "aorta-like fork", [] { return meshing::remeshed(y_junction(40.0, 40.0, 10.0, 7.0, 50.0), 1.0); },
      fill);
  row(
      "stenosis of 85 %, 5 mm",
      [] { return meshing::remeshed(stenosed_tube(20.0, 1.6, 0.85, 10.0, 5.0), 0.15); }, fill);
  row(
      "stenosis of 90 %, 3 mm",
      [] { return meshing::remeshed(stenosed_tube(20.0, 1.6, 0.9, 10.0, 3.0), 0.1); }, fill);
  row("stenosis of 85 %, edges of 0.4 mm", even_stenosis, fill);
  for (const double ratio : {0.4, 0.23, 0.8})
    row(
        "coronary-like tree, ratio " + std::to_string(ratio).substr(0, 4),
        [&] { return meshing::remeshed(coronary_like_tree(), 0.25, ratio); }, fill);
  for (int seed = 1; seed <= seeds; ++seed)
    row(
        "phantom tree " + std::to_string(seed),
        [&] { return phantom_tree(static_cast<std::uint64_t>(seed)); }, fill);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::make_picture(argc, argv, "layers|fill|gate PHANTOM_TREES", 2,
                             [](const std::vector<std::string>& a) { make(a[0], std::stoi(a[1])); });
}
