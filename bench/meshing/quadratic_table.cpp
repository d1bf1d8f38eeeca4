// The table of docs/methods/quadratic-elements.md: elements of second order on analytic shapes.

#include "mixed_shapes.h"
#include "picture.h"

#include "ostia/meshing/mixed_quality.h"
#include "ostia/meshing/quadratic.h"

#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace ostia;

struct Surface {
  const char* name;
  geometry::AnalyticShape shape;
  double spacing_mm, edge_ratio;
};

void row(const Surface& surface, int layers, double thickness) {
  const geometry::FacedSurface wall =
      meshing::remeshed(surface.shape, surface.spacing_mm, surface.edge_ratio);
  geometry::MixedMesh linear;
  if (layers > 0) {
    meshing::BoundaryLayerOptions options;
    options.layers = layers;
    options.thickness = thickness;
    linear = meshing::fill_with_layers(wall, options).mesh;
  } else {
    linear = geometry::mixed(meshing::tetrahedralize(wall).mesh);
  }
  const geometry::TriMesh reference = geometry::surface_of(surface.shape, surface.spacing_mm, true);
  const meshing::QuadraticMesh bent = meshing::make_quadratic(linear, reference);
  const meshing::QuadraticReport& report = bent.report;
  const meshing::MixedQuality before = meshing::mixed_quality(linear),
                              after = meshing::mixed_quality(bent.mesh);
  std::printf("| %s | %d x %g | %zu + %zu | %zu | %.2f %% | %zu | %zu | %.2f | %.2f -> %.2f |", surface.name,
              layers, thickness, after.tetrahedra.count, after.prisms.count, report.wall_nodes,
              100.0 * static_cast<double>(report.on_reference) / static_cast<double>(report.wall_nodes),
              report.moved_back, after.inverted(), report.min_jacobian_ratio,
              before.tetrahedra.min_scaled_jacobian, after.tetrahedra.min_scaled_jacobian);
  if (layers > 0)
    std::printf(" %.2f -> %.2f |", before.prisms.min_scaled_jacobian, after.prisms.min_scaled_jacobian);
  else
    std::printf(" |");
  std::printf(" %.4f -> %.4f |\n", meshing::wall_deviation(linear, reference).mean_mm,
              meshing::wall_deviation(bent.mesh, reference).mean_mm);
  std::fflush(stdout);
}

void make() {
  using namespace geometry;
  const std::array<Surface, 6> surfaces{
      {{"straight tube", straight_tube(12.0, 1.5), 0.25, 0.4},
       {"fork of 25 degrees", y_junction(8.0, 14.0, 2.0, 1.4, 25.0), 0.25, 0.4},
       {"fork of 120 degrees", y_junction(8.0, 14.0, 2.0, 1.7, 120.0), 0.25, 0.4},
       {"stenosis of 85 %", stenosed_tube(20.0, 1.6, 0.85, 10.0, 5.0), 0.12, 0.4},
       {"coronary-like tree", coronary_like_tree(), 0.2, 0.4},
       {"coronary-like tree, ratio 0.8", coronary_like_tree(), 0.2, 0.8}}};
  for (const Surface& surface : surfaces)
    for (const auto& [layers, thickness] : {std::pair{0, 0.0}, {2, 0.25}, {4, 0.5}, {5, 0.6}})
      row(surface, layers, thickness);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::make_picture(argc, argv, "", 0, [](const std::vector<std::string>&) { make(); });
}
