#include "ostia/session/outer_walls.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/sampling.h"
#include "ostia/pipeline/image_walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ostia::session {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr double shortest_mm = 2.0;   // a stretch that is looked at
constexpr double shut_mm = 0.05;      // of a lumen that is not there
constexpr double usual_end_mm = 1.0;  // left out at an end whose radius is not known
using std::numbers::pi;

struct Stretch {
  double from_mm = 0.0, to_mm = 0.0;
};

std::size_t index_of(const lumen::LumenModel& model, std::int32_t vessel) {
  for (std::size_t i = 0; i < model.tree.vessels.size(); ++i)
    if (model.tree.vessels[i].id == vessel) return i;
  throw InvalidInput("there is no vessel " + std::to_string(vessel) + " in the model");
}

/// The vessel by itself, and of that the longest part in the image.
Stretch stretch_of(const lumen::LumenModel& model, std::int32_t vessel, const imaging::ImageVolume& image,
                   double step_mm) {
  std::vector<std::shared_ptr<const geometry::AxisCurve>> axes;
  for (const geometry::Vessel& one : model.tree.vessels) axes.push_back(lumen::vessel(model, one.id).axis);
  const std::size_t index = index_of(model, vessel);
  const geometry::AxisCurve& axis = *axes[index];
  const auto end_mm = [&](double s) { return axis.radius(s) > 0.0 ? axis.radius(s) : usual_end_mm; };
  const double branch = pipeline::free_from_mm(model.tree, axes, index);
  const double from = branch > 0.0 ? branch : end_mm(0.0), to = axis.length() - end_mm(axis.length());
  Stretch best, here;
  bool inside = false;
  for (double s = from; s <= to; s += step_mm) {
    const bool now = image.geometry.contains(axis.point(s));
    if (now && !inside) here.from_mm = s;
    if (now) here.to_mm = s;
    if (now && here.to_mm - here.from_mm > best.to_mm - best.from_mm) best = here;
    inside = now;
  }
  return best;
}

/// How far a closed line lies from the axis along each ray; its outermost crossing. Negative where none.
std::vector<double> radii_of(const std::vector<Vec3>& contour, const geometry::AxisCurve& axis, double s_mm,
                             int around) {
  const geometry::Frame frame = axis.frame(s_mm);
  const Vec3 centre = axis.point(s_mm), x = geometry::radial_direction(frame, 0.0),
             y = geometry::radial_direction(frame, 0.5 * pi);
  std::vector<Vec2> line;
  for (const Vec3& p : contour) line.emplace_back((p - centre).dot(x), (p - centre).dot(y));
  std::vector<double> out(static_cast<std::size_t>(around), -1.0);
  for (int a = 0; a < around; ++a) {
    const Vec2 ray(std::cos(2.0 * pi * a / around), std::sin(2.0 * pi * a / around));
    const auto side = [&](const Vec2& p) { return ray.x() * p.y() - ray.y() * p.x(); };
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Vec2 &p = line[i], &q = line[(i + 1) % line.size()];
      if ((side(p) <= 0.0) == (side(q) <= 0.0)) continue;
      const double t = side(p) / (side(p) - side(q));
      out[a] = std::max(out[a], ray.dot(p + t * (q - p)));
    }
  }
  return out;
}

/// The model's lumen on rays. Where a section's wall is open its neighbours' is taken.
segmentation::LumenBoundary lumen_on_rays(const lumen::LumenModel& model,
                                          const analysis::SurfaceOfVessel& surface_of, std::int32_t vessel,
                                          const Stretch& stretch, const OuterWallsOptions& options,
                                          const core::TaskContext& task) {
  const geometry::AxisCurve& axis = *lumen::vessel(model, vessel).axis;
  const int rows =
      std::max(2, 1 + static_cast<int>(std::lround((stretch.to_mm - stretch.from_mm) / options.step_mm)));
  segmentation::LumenBoundary out;
  out.from_mm = stretch.from_mm;
  out.step_mm = (stretch.to_mm - stretch.from_mm) / (rows - 1);
  out.around = options.around;
  std::vector<char> known;
  for (int r = 0; r < rows; ++r) {
    task.throw_if_cancelled();
    const double s = std::min(stretch.from_mm + r * out.step_mm, axis.length());
    const analysis::MeasuredSection section = analysis::measured_section(model, surface_of, vessel, s);
    known.push_back(section.measures.open ? 0 : 1);
    std::vector<double> ring = radii_of(section.contour, axis, s, options.around);
    for (double& radius : ring) out.radius_mm.push_back(std::max(radius, shut_mm));
  }
  const auto ring = [&](int r) {
    return out.radius_mm.begin() + static_cast<std::ptrdiff_t>(r) * out.around;
  };
  for (int r = 1; r < rows; ++r)
    if (!known[r] && known[r - 1]) std::copy_n(ring(r - 1), out.around, ring(r)), known[r] = 1;
  for (int r = rows - 2; r >= 0; --r)
    if (!known[r] && known[r + 1]) std::copy_n(ring(r + 1), out.around, ring(r)), known[r] = 1;
  out.confidence.assign(out.radius_mm.size(), 1.0F);
  return out;
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

void add_plaque(VesselWalls& walls, const imaging::ImageVolume& image, const OuterWallsOptions& options,
                const core::TaskContext& task) {
  analysis::WallRadii radii;
  radii.from_mm = walls.lumen.from_mm;
  radii.to_mm = walls.lumen.from_mm + (walls.lumen.rows() - 1) * walls.lumen.step_mm;
  radii.lumen_mm = [&](double s, double theta) { return walls.lumen.at(s, theta); };
  radii.outer_mm = [&](double s, double theta) { return walls.outer.surface.at(s, theta); };
  radii.lumen_hu = along(walls.lumen, walls.outer.lumen_hu);
  radii.fat_hu = along(walls.lumen, walls.outer.fat_hu);
  const auto hu_at = [&](const Vec3& place) { return imaging::sample(image, place); };
  walls.plaque = analysis::plaque_profile(*walls.axis, radii, hu_at, options.plaque, task);
  if (!options.maps) return;
  walls.maps.resize(walls.plaque.slabs.size());
  core::parallel_for(walls.maps.size(), 8, [&](std::size_t i) {
    task.throw_if_cancelled();
    walls.maps[i] =
        analysis::plaque_map(*walls.axis, radii, walls.plaque.slabs[i].s_mm, hu_at, options.plaque);
  });
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

std::optional<VesselWalls> vessel_walls(const lumen::LumenModel& model,
                                        const analysis::SurfaceOfVessel& surface_of, std::int32_t vessel,
                                        const imaging::ImageVolume& image, const OuterWallsOptions& options,
                                        const core::TaskContext& task) {
  validate(options);
  const Stretch stretch = stretch_of(model, vessel, image, options.step_mm);
  if (stretch.to_mm - stretch.from_mm < shortest_mm) return std::nullopt;
  VesselWalls out;
  out.vessel = vessel;
  out.axis = lumen::vessel(model, vessel).axis;
  out.lumen = lumen_on_rays(model, surface_of, vessel, stretch, options, task);
  task.set_progress(0.3);
  out.outer = segmentation::outer_wall(image, *out.axis, out.lumen, options.wall, task.sub(0.3, 0.9));
  add_plaque(out, image, options, task.sub(0.9, 1.0));
  return out;
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
