#include "intake_units.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/flat_caps.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;

constexpr double thinnest_outlet_mm = 0.3, doubtful_outlet_mm = 0.7, trunk_over_outlet = 3.0;
constexpr double least_trunk_cm = 1.0, most_trunk_cm = 5.0;
constexpr double hole_over_widest = 0.02;  // less wide than that is a flaw of the surface

TriMesh outward(const TriMesh& mesh) {
  TriMesh turned = geometry::oriented(geometry::welded(mesh));
  if (geometry::volume(geometry::fill_holes(turned).mesh) < 0.0)
    for (geometry::Triangle& t : turned.triangles) std::swap(t[1], t[2]);
  return turned;
}

}  // namespace

std::optional<EndWidths> end_widths(const geometry::FacedSurface& surface) try {
  std::vector<double> widths;
  const TriMesh mesh = outward(surface.mesh);
  const bool same = mesh.triangles.size() == surface.mesh.triangles.size();
  const meshing::OpenedCaps opened =
      meshing::without_flat_caps(same ? geometry::FacedSurface{mesh, surface.face_ids, surface.faces}
                                      : geometry::FacedSurface{mesh, {}, {}});
  for (const auto& loop : geometry::boundary_loops(opened.wall))
    widths.push_back(2.0 * meshing::end_at_loop(opened.wall, loop).radius_mm);
  if (widths.empty()) return std::nullopt;
  const double widest = *std::ranges::max_element(widths);
  std::erase_if(widths, [&](double width) { return width < hole_over_widest * widest; });
  return EndWidths{*std::ranges::min_element(widths), widest};
} catch (const Error&) {
  return std::nullopt;
}

bool speak_for_cm(const EndWidths& widths) {
  return widths.thinnest < thinnest_outlet_mm && widths.widest >= least_trunk_cm &&
         widths.widest <= most_trunk_cm;
}

bool leave_cm_open(const EndWidths& widths) {
  return widths.thinnest < doubtful_outlet_mm && widths.widest > trunk_over_outlet * widths.thinnest;
}

}  // namespace ostia::pipeline
