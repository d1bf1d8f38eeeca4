// The table of docs/boundary-layer.md: layers of prisms on analytic shapes and on synthetic coronary trees.

#include "boundary_layer_shapes.h"
#include "picture.h"

#include "ostia/meshing/boundary_layer.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/phantom/vessel_field.h"

#include <cstdio>
#include <functional>
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

void make(const std::string& what, int seeds) {
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
  return bench::make_picture(argc, argv, "layers|fill PHANTOM_TREES", 2,
                             [](const std::vector<std::string>& a) { make(a[0], std::stoi(a[1])); });
}
