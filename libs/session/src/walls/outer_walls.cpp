#include "ostia/session/outer_walls.h"

#include "walls/vessel_look.h"

#include "ostia/analysis/stenosis.h"
#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ostia::session {
namespace {

using geometry::Vec3;

constexpr double shortest_mm = 2.0;  // a stretch that is looked at
// The outer wall is known where so much of it is seen, within so far.
constexpr double least_seen_share = 0.5, seen_within_mm = 2.0;
constexpr double closed_radius_mm = 0.06;  // radii of a shut lumen are less
using std::numbers::pi;

/// Of rows those of the longest part in the image; empty where none is.
segmentation::LumenBoundary rows_in(const imaging::ImageVolume& image, const geometry::AxisCurve& axis,
                                    const segmentation::LumenBoundary& rows) {
  int best_first = 0, best_last = -1, first = 0;
  for (int r = 0; r < rows.rows(); ++r) {
    const double s = std::min(rows.from_mm + r * rows.step_mm, axis.length());
    if (!image.geometry.contains(axis.point(s)))
      first = r + 1;
    else if (r - first > best_last - best_first)
      best_first = first, best_last = r;
  }
  return best_last > best_first ? rows_between(rows, best_first, best_last) : segmentation::LumenBoundary();
}

/// One value a row, linear between.
std::function<double(double)> along(const segmentation::LumenBoundary& rows, std::vector<double> values) {
  return [from = rows.from_mm, step = rows.step_mm, values = std::move(values)](double s_mm) {
    const double x = std::clamp((s_mm - from) / step, 0.0, static_cast<double>(values.size() - 1));
    const auto i = static_cast<std::size_t>(x);
    const std::size_t j = std::min(i + 1, values.size() - 1);
    return values[i] + (x - static_cast<double>(i)) * (values[j] - values[i]);
  };
}

/// The lumen's diameter as it would be without disease, from the rows of rays themselves.
std::function<double(double)> calibre_of(const lumen::LumenModel& model, const VesselWalls& walls) {
  const segmentation::LumenBoundary& rows = walls.lumen;
  analysis::LumenProfile profile;
  profile.vessel = walls.vessel;
  profile.length_mm = (rows.rows() - 1) * rows.step_mm;
  for (int r = 0; r < rows.rows(); ++r) {
    double area = 0.0, largest = 0.0;
    for (int a = 0; a < rows.around; ++a) {
      const double radius = rows.radius_mm[static_cast<std::size_t>(r * rows.around + a)];
      area += pi / rows.around * radius * radius;
      largest = std::max(largest, radius);
    }
    analysis::SectionMeasures section;
    section.s_mm = r * rows.step_mm;
    section.found = largest > closed_radius_mm;
    section.area_mm2 = section.found ? area : 0.0;
    section.diameter_mm = section.found ? 2.0 * std::sqrt(area / pi) : 0.0;
    profile.sections.push_back(section);
  }
  std::vector<double> branches = analysis::branch_abscissas(model, walls.vessel);
  for (double& s : branches) s -= rows.from_mm;
  return along(rows, analysis::reference_line(profile, branches).diameter_mm);
}

/// One value a row: 1 where most of the outer wall within `seen_within_mm` ends in fat, else 0.
std::vector<double> seen_rows(const segmentation::LumenBoundary& outer) {
  std::vector<double> clear;
  for (int r = 0; r < outer.rows(); ++r) {
    const auto first = outer.confidence.begin() + r * outer.around;
    clear.push_back(static_cast<double>(
                        std::count_if(first, first + outer.around, [](float one) { return one > 0.0F; })) /
                    outer.around);
  }
  const int reach = static_cast<int>(seen_within_mm / outer.step_mm);
  std::vector<double> seen;
  for (int r = 0; r < outer.rows(); ++r) {
    const int from = std::max(0, r - reach), to = std::min(outer.rows(), r + reach + 1);
    double sum = 0.0;
    for (int k = from; k < to; ++k) sum += clear[static_cast<std::size_t>(k)];
    seen.push_back(sum >= least_seen_share * (to - from) ? 1.0 : 0.0);
  }
  return seen;
}

/// What plaque lies between, and what the image says of it there. Refers to `walls`.
analysis::WallRadii radii_between(const VesselWalls& walls, const lumen::LumenModel& model) {
  analysis::WallRadii radii;
  radii.from_mm = walls.lumen.from_mm;
  radii.to_mm = walls.lumen.from_mm + (walls.lumen.rows() - 1) * walls.lumen.step_mm;
  radii.lumen_mm = [&walls](double s, double theta) { return walls.lumen.at(s, theta); };
  // In muscle no outer wall is seen, and what is drawn there is a bridge: it tells no plaque.
  const auto seen = along(walls.lumen, seen_rows(walls.outer.surface));
  radii.calibre_mm = calibre_of(model, walls);
  radii.outer_mm = [&walls, seen, calibre_mm = radii.calibre_mm](double s, double theta) {
    const double outer = walls.outer.surface.at(s, theta);
    if (seen(s) >= 0.5) return outer;
    return std::min(outer, walls.lumen.at(s, theta) + analysis::healthy_wall_mm(calibre_mm(s)));
  };
  radii.lumen_hu = along(walls.lumen, walls.outer.lumen_hu);
  radii.fat_hu = along(walls.lumen, walls.outer.fat_hu);
  return radii;
}

void add_maps(VesselWalls& walls, const analysis::WallRadii& radii, const imaging::ImageVolume& image,
              const analysis::PlaqueOptions& options, const core::TaskContext& task) {
  const auto hu_at = [&](const Vec3& place) { return imaging::sample(image, place); };
  walls.maps.resize(walls.plaque.slabs.size());
  core::parallel_for(walls.maps.size(), 8, [&](std::size_t i) {
    task.throw_if_cancelled();
    walls.maps[i] = analysis::plaque_map(*walls.axis, radii, walls.plaque.slabs[i].s_mm, hu_at, options);
  });
}

void add_plaque(VesselWalls& walls, const lumen::LumenModel& model, const imaging::ImageVolume& image,
                const OuterWallsOptions& options, const core::TaskContext& task) {
  const analysis::WallRadii radii = radii_between(walls, model);
  const auto hu_at = [&](const Vec3& place) { return imaging::sample(image, place); };
  walls.plaque = analysis::plaque_profile(*walls.axis, radii, hu_at, options.plaque, task);
  if (options.maps) add_maps(walls, radii, image, options.plaque, task);
}

}  // namespace

void validate(const OuterWallsOptions& options) {
  if (!(options.step_mm >= 0.1 && options.step_mm <= 2.0))
    throw InvalidInput("outer walls: step_mm is " + std::to_string(options.step_mm) +
                       "; it has to be in [0.1, 2] mm");
  if (options.around < 8 || options.around > 128)
    throw InvalidInput("outer walls: around is " + std::to_string(options.around) +
                       "; it has to be in [8, 128] rays");
  segmentation::validate(options.wall);
  analysis::validate(options.plaque);
}

std::optional<VesselWalls> walls_in(const OwnLumen& own, const lumen::LumenModel& model,
                                    const imaging::ImageVolume& image, const OuterWallsOptions& options,
                                    const core::TaskContext& task) {
  validate(options);
  VesselWalls out;
  out.vessel = own.vessel;
  out.axis = lumen::vessel(model, own.vessel).axis;
  out.lumen = rows_in(image, *out.axis, own.rows);
  if ((out.lumen.rows() - 1) * out.lumen.step_mm < shortest_mm) return std::nullopt;
  out.outer = segmentation::outer_wall(image, *out.axis, out.lumen, options.wall, task.sub(0.0, 0.9));
  add_plaque(out, model, image, options, task.sub(0.9, 1.0));
  return out;
}

std::optional<VesselWalls> vessel_walls(const lumen::LumenModel& model,
                                        const analysis::SurfaceOfVessel& surface_of, std::int32_t vessel,
                                        const imaging::ImageVolume& image, const OuterWallsOptions& options,
                                        const core::TaskContext& task) {
  validate(options);
  const OwnLumen own =
      own_lumen(model, surface_of, vessel, options.step_mm, options.around, task.sub(0.0, 0.3));
  return walls_in(own, model, image, options, task.sub(0.3, 1.0));
}

void add_plaque_maps(VesselWalls& walls, const lumen::LumenModel& model, const imaging::ImageVolume& image,
                     const analysis::PlaqueOptions& options, const core::TaskContext& task) {
  analysis::validate(options);
  add_maps(walls, radii_between(walls, model), image, options, task);
}

std::vector<Vec3> outer_wall_ring(const VesselWalls& walls, double s_mm, int points) {
  const segmentation::LumenBoundary& surface = walls.outer.surface;
  const double last = surface.from_mm + (surface.rows() - 1) * surface.step_mm;
  std::vector<Vec3> out;
  if (s_mm < surface.from_mm - 1e-6 || s_mm > last + 1e-6) return out;
  for (int i = 0; i < points; ++i) {
    const double theta = 2.0 * pi * i / points;
    out.push_back(walls.axis->place(s_mm, theta, surface.at(s_mm, theta)));
  }
  return out;
}

}  // namespace ostia::session
