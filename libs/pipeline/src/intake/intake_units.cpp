#include "intake/intake_units.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/smoothing.h"
#include "ostia/pipeline/source.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;

// Numbers of a vessel's mean calibre and extent below which it can hardly be in millimetres.
constexpr double least_calibre_mm = 0.6, least_extent_mm = 40.0;
constexpr double least_calibre_cm = 0.02, least_extent_cm = 1.5;
constexpr double thinnest_outlet_mm = 0.3, doubtful_outlet_mm = 0.7, trunk_over_outlet = 3.0;
constexpr double least_trunk_cm = 1.0, most_trunk_cm = 5.0;
constexpr double hole_over_widest = 0.02;  // less wide than that is a flaw of the surface

/// An aorta in centimetres has the numbers of a short piece of a coronary in millimetres.
bool may_be_cm(double calibre, double extent) {
  return calibre > 1.0 && calibre < 4.5 && extent > 4.0 && extent < 30.0;
}

/// Noise makes the wall larger and so the calibre smaller: a rough wall in millimetres has the numbers of a
/// smooth one in centimetres. Where the calibre says another unit, the smoothed wall has to say it, too.
double calibre_of(const TriMesh& mesh, double extent) {
  try {
    const TriMesh closed = geometry::fill_holes(geometry::oriented(geometry::welded(mesh))).mesh;
    const double calibre = calibre_of_closed(closed);
    if (unit_by_calibre(calibre, extent) == 1.0) return calibre;
    geometry::VolumeSmoothingOptions how;
    how.filter.pass_band = 0.05;
    const double smooth = calibre_of_closed(geometry::smoothed_in_volume(closed, how));
    return unit_by_calibre(smooth, extent) == 1.0 ? smooth : calibre;
  } catch (const Error&) {  // too broken for that: its extent alone decides
    return geometry::bounds(mesh.points).sizes().maxCoeff();
  }
}

}  // namespace

TriMesh turned_outward(TriMesh mesh) {
  if (geometry::volume(geometry::fill_holes(mesh).mesh) < 0.0)
    for (geometry::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

double calibre_of_closed(const TriMesh& closed) {
  return 4.0 * std::abs(geometry::volume(closed)) / geometry::area(closed);
}

std::optional<EndWidths> end_widths(const geometry::FacedSurface& surface, bool sound,
                                    std::optional<meshing::OpenedCaps>& kept) try {
  std::vector<double> widths;
  const auto mended = [&] {
    TriMesh mesh = turned_outward(geometry::oriented(geometry::welded(surface.mesh)));
    const bool same = mesh.triangles.size() == surface.mesh.triangles.size();
    return same ? geometry::FacedSurface{std::move(mesh), surface.face_ids, surface.faces}
                : geometry::FacedSurface{std::move(mesh), {}, {}};
  };
  meshing::OpenedCaps opened = meshing::without_flat_caps(sound ? surface : mended());
  for (const auto& loop : geometry::boundary_loops(opened.wall))
    widths.push_back(2.0 * meshing::end_at_loop(opened.wall, loop).radius_mm);
  if (sound) kept = std::move(opened);
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

double unit_by_calibre(double calibre, double extent) {
  if (calibre < least_calibre_cm && extent < least_extent_cm) return 1000.0;
  if (calibre < least_calibre_mm && extent < least_extent_mm) return 10.0;
  return 1.0;
}

namespace {

/// Where the calibre leaves it open, the ends say it.
void settle_cm_by_ends(const geometry::FacedSurface& surface, bool sound, TakenSurface& out,
                       const std::string& sizes, std::optional<meshing::OpenedCaps>& kept) {
  const std::optional<EndWidths> ends = end_widths(surface, sound, kept);
  if (!ends) return;
  const std::string thinnest = core::significant_text(ends->thinnest, 2),
                    widest = core::significant_text(ends->widest, 2);
  if (speak_for_cm(*ends)) {
    out.unit_mm = 10.0;
    out.told.push_back("taken to be in centimetres, since its thinnest end is " + thinnest +
                       " wide, which no vessel's is in millimetres, and its widest " + widest +
                       "; --units mm says otherwise");
  } else if (leave_cm_open(*ends)) {
    out.told.push_back("taken to be in millimetres: " + sizes + ", ends " + thinnest + " to " + widest +
                       " mm wide; were it an aorta in centimetres, say --units cm");
  }
}

}  // namespace

std::optional<meshing::OpenedCaps> to_mm(geometry::FacedSurface& surface, std::optional<double> known_calibre,
                                         const IntakeOptions& options, TakenSurface& out,
                                         const std::string& what) {
  std::optional<meshing::OpenedCaps> opened;
  const double extent = geometry::bounds(surface.mesh.points).sizes().norm();
  if (options.unit_mm) {
    out.unit_mm = *options.unit_mm;
  } else {
    const double calibre = known_calibre ? *known_calibre : calibre_of(surface.mesh, extent);
    out.unit_mm = unit_by_calibre(calibre, extent);
    check_vessel_size(out.unit_mm * calibre, what);
    if (out.unit_mm != 1.0)
      out.told.push_back("taken to be in " + std::string(out.unit_mm == 10.0 ? "centimetres" : "metres") +
                         ", since its vessels are " + core::significant_text(calibre, 2) +
                         " wide in the mean; --units mm says otherwise");
    else if (may_be_cm(calibre, extent))
      settle_cm_by_ends(surface, known_calibre.has_value(), out,
                        "vessels " + core::significant_text(calibre, 2) + " mm wide in the mean, " +
                            core::significant_text(extent, 2) + " mm from end to end",
                        opened);
  }
  if (out.unit_mm == 1.0) return opened;
  for (geometry::Vec3& p : surface.mesh.points) p *= out.unit_mm;
  return std::nullopt;
}

}  // namespace ostia::pipeline
