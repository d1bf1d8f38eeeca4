#include "ostia/segmentation/lumen_boundary.h"

#include "boundary/boundary_fit.h"
#include "boundary/boundary_rows.h"
#include "boundary/edge_profile.h"
#include "boundary/lumen_level.h"
#include "boundary/ray_fan.h"
#include "boundary/star_surface.h"
#include "option_range.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace ostia::segmentation {
namespace {

using geometry::Vec3;

constexpr double least_radius_mm = 0.2;   // of the grid; a lumen that a scan can show is no thinner
constexpr double least_result_mm = 0.05;  // where the axis lies outside the lumen
constexpr double core_mm = 0.4;           // the first look at the lumen's brightness
constexpr double most_nodes = 1e7;        // of the graph, some 200 bytes each
constexpr double variation = 0.12;        // total variation against the region's cost, both in mm

/// Rows across the axis, the rays' centre moved off it by an offset each.
struct Rows {
  std::vector<RayRow> on_axis;
  std::vector<Vec2> offset;
  double step_mm = 0.0;
  int count() const { return static_cast<int>(on_axis.size()); }
  Vec3 place(std::size_t n, const Vec2& off_axis) const;
  std::vector<RayRow> moved() const;
};

Vec3 Rows::place(std::size_t n, const Vec2& off_axis) const {
  const RayRow& row = on_axis[n];
  return row.centre + off_axis.x() * geometry::radial_direction(row.frame, 0.0) +
         off_axis.y() * geometry::radial_direction(row.frame, 0.5 * std::numbers::pi);
}

std::vector<RayRow> Rows::moved() const {
  std::vector<RayRow> out = on_axis;
  for (std::size_t n = 0; n < out.size(); ++n) out[n].centre = place(n, offset[n]);
  return out;
}

Rows rows_of(const imaging::ImageVolume& image, const geometry::AxisCurve& axis, double from_mm, double to_mm,
             double step_mm) {
  if (!std::isfinite(from_mm) || !std::isfinite(to_mm) || !(from_mm < to_mm) || from_mm < -1e-6 ||
      to_mm > axis.length() + 1e-6) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "lumen boundary: from %g to %g mm is no stretch of an axis of %.6g mm; give "
                  "0 <= from < to <= its length",
                  from_mm, to_mm, axis.length());
    throw InvalidInput(text);
  }
  const int count = std::max(2, 1 + static_cast<int>(std::lround((to_mm - from_mm) / step_mm)));
  Rows rows;
  rows.step_mm = (to_mm - from_mm) / (count - 1);
  for (int n = 0; n < count; ++n) {
    const double s = from_mm + n * rows.step_mm;
    rows.on_axis.push_back({s, axis.point(s), axis.frame(s)});
    if (image.geometry.contains(rows.on_axis.back().centre)) continue;
    char text[200];
    std::snprintf(text, sizeof text,
                  "lumen boundary: the axis leaves the image at %.4g mm; choose the stretch that lies inside",
                  s);
    throw InvalidInput(text);
  }
  rows.offset.assign(rows.on_axis.size(), Vec2::Zero());
  return rows;
}

/// Moves the rays' centres to the lumen's, smoothed over a millimetre to either side; the radii are then
/// those seen from there.
void recentre(Rows& rows, std::vector<double>& radius_mm, int around) {
  const int n = rows.count();
  std::vector<Vec2> wanted(rows.offset.size());
  for (int r = 0; r < n; ++r) {
    wanted[r] = rows.offset[r] + centroid_of(radius_mm.data() + static_cast<std::size_t>(r) * around, around);
  }
  const int reach = std::max(1, static_cast<int>(std::lround(1.0 / rows.step_mm)));
  for (int r = 0; r < n; ++r) {
    const int half = std::min({reach, r, n - 1 - r});
    Vec2 sum = Vec2::Zero();
    for (int i = r - half; i <= r + half; ++i) sum += wanted[i];
    const Vec2 target = sum / (2 * half + 1);
    double* ring = radius_mm.data() + static_cast<std::size_t>(r) * around;
    const SeenLine seen = seen_from(ring, around, target - rows.offset[r], least_radius_mm);
    std::copy(seen.radius_mm.begin(), seen.radius_mm.end(), ring);
    rows.offset[r] = target;
  }
}

/// Where calcium was seen, and a millimetre around, it is likelier than elsewhere.
std::vector<float> calcium_odds(const std::vector<char>& seen, const Rows& rows, int around) {
  const int along = std::max(1, static_cast<int>(std::lround(1.0 / rows.step_mm)));
  const int across = std::max(1, around / 12);
  std::vector<float> out(seen.size(), 1.0F);
  for (int r = 0; r < rows.count(); ++r) {
    for (int a = 0; a < around; ++a) {
      if (!seen[static_cast<std::size_t>(r) * around + a]) continue;
      for (int i = std::max(0, r - along); i <= std::min(rows.count() - 1, r + along); ++i)
        for (int j = a - across; j <= a + across; ++j)
          out[static_cast<std::size_t>(i) * around + (j + around) % around] = 20.0F;
    }
  }
  return out;
}

/// The fitted boundary seen from the given axis again.
std::size_t put_on_axis(const Rows& rows, const BoundaryFit& fit, LumenBoundary& out) {
  std::size_t outside = 0;
  const int around = out.around;
  for (int r = 0; r < rows.count(); ++r) {
    const auto ring = static_cast<std::size_t>(r) * around;
    const SeenLine seen = seen_from(fit.radius_mm.data() + ring, around, -rows.offset[r], least_result_mm);
    outside += seen.inside ? 0 : 1;
    const auto row = static_cast<std::size_t>(r);
    out.middle.push_back(
        rows.place(row, rows.offset[row] + centroid_of(fit.radius_mm.data() + ring, around)));
    for (int a = 0; a < around; ++a) {
      const int nearest = static_cast<int>(std::lround(seen.index[a])) % around;
      out.radius_mm.push_back(seen.radius_mm[a]);
      out.confidence.push_back(seen.inside ? fit.confidence[ring + nearest] : 0.0F);
    }
  }
  return outside;
}

void add_warnings(LumenBoundary& out, std::size_t outside_rows, double wall_hu) {
  char text[200];
  if (out.lumen_hu < wall_hu + 80.0) {
    std::snprintf(text, sizeof text,
                  "the lumen is hardly brighter than its surroundings (%.0f HU): is this a contrast-enhanced "
                  "vessel?",
                  out.lumen_hu);
    out.warnings.emplace_back(text);
  }
  if (outside_rows > 0) {
    std::snprintf(text, sizeof text, "the axis lies outside the lumen over %.1f mm",
                  static_cast<double>(outside_rows) * out.step_mm);
    out.warnings.emplace_back(text);
  }
  const auto unclear = std::count_if(out.confidence.begin(), out.confidence.end(),
                                     [](float confidence) { return confidence < 0.2F; });
  const double share = static_cast<double>(unclear) / static_cast<double>(out.confidence.size());
  if (share > 0.25) {
    std::snprintf(text, sizeof text, "no clear edge on %.0f %% of the rays", 100.0 * share);
    out.warnings.emplace_back(text);
  }
}

/// The candidates of the first pass. Throws InvalidInput where the graph would take some gigabytes.
RadiusGrid grid_for(const LumenBoundaryOptions& options, int rows) {
  RadiusGrid grid{least_radius_mm, options.radial_step_mm, 0};
  grid.count = 1 + static_cast<int>((options.largest_radius_mm - grid.first_mm) / grid.step_mm + 1e-9);
  const double nodes = static_cast<double>(rows) * options.around * grid.count;
  if (nodes <= most_nodes) return grid;
  char text[200];
  std::snprintf(text, sizeof text,
                "lumen boundary: %.3g candidates are more than %.3g; make step_mm or radial_step_mm larger, "
                "around or largest_radius_mm smaller, or go by shorter stretches",
                nodes, most_nodes);
  throw InvalidInput(text);
}

/// What is known of the lumen after a pass.
struct Estimate {
  std::vector<double> radius_mm;
  std::vector<float> calcium_odds;
  LumenLevel level;
};

/// First pass: the globally best surface on the grid of radii, about the given axis.
Estimate first_estimate(const imaging::ImageVolume& image, const Rows& rows,
                        const LumenBoundaryOptions& options, const core::TaskContext& task) {
  const RadiusGrid grid = grid_for(options, rows.count());
  const int around = options.around;
  const double fine = std::min(0.1, options.radial_step_mm);
  const int count = static_cast<int>(std::ceil(options.largest_radius_mm / fine)) + 2;
  const RayFan fan = sample_rays(image, rows.on_axis, around, count, fine, task);
  Estimate out;
  out.level = lumen_level(fan, core_mm, rows.step_mm);
  task.set_progress(0.15);
  const TissueLevels tissue{options.wall_hu, options.calcium_hu};
  const std::vector<int> onset = calcium_onsets(fan, out.level, tissue);
  const std::vector<float> cost = region_cost(fan, out.level, tissue, onset, grid, rows.step_mm);
  const std::vector<int> surface =
      least_cost_surface(cost, rows.count(), around, grid, rows.step_mm,
                         {options.largest_slope_along, options.largest_slope_around}, variation, task);
  std::vector<char> calcium;  // there is some just behind the boundary
  for (std::size_t n = 0; n < surface.size(); ++n) {
    out.radius_mm.push_back(grid.at(surface[n]));
    calcium.push_back(onset[n] * fine < out.radius_mm[n] + 0.8 ? 1 : 0);
  }
  out.calcium_odds = calcium_odds(calcium, rows, around);
  return out;
}

EdgeProfileOptions edge_options(const LumenBoundaryOptions& options) {
  EdgeProfileOptions out;
  out.blur_sigma_mm = std::max(0.05, options.blur_sigma_mm);
  out.wall_hu = options.wall_hu;
  const double coarser = std::max(1.0, out.blur_sigma_mm / 0.3);
  out.sample_step_mm *= coarser;
  out.noise_length_mm *= coarser;
  out.radius_step_mm *= coarser;
  const double largest = options.largest_radius_mm + 0.5 * coarser;
  out.radii = 1 + static_cast<int>((largest - out.first_mm) / out.radius_step_mm);
  return out;
}

/// Second pass, twice: rays from the lumen's own middle, the blurred edge's model on each.
BoundaryFit fitted(const imaging::ImageVolume& image, Rows& rows, Estimate& estimate,
                   const LumenBoundaryOptions& options, const core::TaskContext& task) {
  EdgeProfileOptions edge = edge_options(options);
  std::optional<EdgeProfile> profile;
  const int samples =
      static_cast<int>((options.largest_radius_mm + 2.0) / edge.sample_step_mm) + EdgeProfile::samples + 2;
  BoundaryFitOptions how;
  how.row_step_mm = rows.step_mm;
  BoundaryFit fit;
  for (int round = 0; round < 2; ++round) {
    recentre(rows, estimate.radius_mm, options.around);
    const RayFan fan = sample_rays(image, rows.moved(), options.around, samples, edge.sample_step_mm, task);
    estimate.level = lumen_level(fan, estimate.radius_mm, {edge.blur_sigma_mm, options.wall_hu}, rows.step_mm,
                                 estimate.level);
    if (!profile) {
      edge.noise_hu = estimate.level.sigma_hu;
      profile.emplace(edge);
    }
    fit =
        fit_boundary(fan, estimate.level.hu, estimate.radius_mm, estimate.calcium_odds, *profile, how, task);
    estimate.radius_mm = fit.radius_mm;
    task.set_progress(0.75 + 0.25 * round);
  }
  return fit;
}

double cubic(double a, double b, double c, double d, double t) {
  return b + 0.5 * t * ((c - a) + t * ((2.0 * a - 5.0 * b + 4.0 * c - d) + t * (3.0 * (b - c) + d - a)));
}

}  // namespace

void validate(const LumenBoundaryOptions& o) {
  const auto require = [](const char* name, double value, double low, double high, const char* range) {
    detail::require_range("lumen boundary", name, value, low, high, range);
  };
  require("step_mm", o.step_mm, 0.1, 2.0, "[0.1, 2] mm");
  require("around", o.around, 8, 128, "[8, 128] rays");
  require("radial_step_mm", o.radial_step_mm, 0.02, 0.5, "[0.02, 0.5] mm");
  require("largest_radius_mm", o.largest_radius_mm, 0.5, 20.0, "[0.5, 20] mm");
  require("blur_sigma_mm", o.blur_sigma_mm, 0.0, 1.5, "[0, 1.5] mm");
  require("wall_hu", o.wall_hu, -100.0, 200.0, "[-100, 200] HU");
  require("calcium_hu", o.calcium_hu, 0.0, 4000.0, "[0, 4000] HU");
  require("largest_slope_along", o.largest_slope_along, 0.05, 10.0, "[0.05, 10]");
  require("largest_slope_around", o.largest_slope_around, 0.05, 10.0, "[0.05, 10]");
}

double LumenBoundary::at(double s_mm, double theta) const {
  const int n = rows();
  if (n == 0) return 0.0;
  const double turns = theta / (2.0 * std::numbers::pi);
  const double x = (turns - std::floor(turns)) * around;
  const int a = static_cast<int>(x);
  const auto ring = [&](int row) {
    const double* r = radius_mm.data() + static_cast<std::size_t>(std::clamp(row, 0, n - 1)) * around;
    return cubic(r[(a + around - 1) % around], r[a % around], r[(a + 1) % around], r[(a + 2) % around],
                 x - a);
  };
  const double y = step_mm > 0.0 ? std::clamp((s_mm - from_mm) / step_mm, 0.0, n - 1.0) : 0.0;
  const int row = std::min(static_cast<int>(y), std::max(0, n - 2));
  // Beyond the ends the mirrored row keeps the slope there zero, as the constant continuation's is.
  const double before = row == 0 ? ring(1) : ring(row - 1);
  const double after = row + 2 > n - 1 ? ring(n - 2) : ring(row + 2);
  return std::max(0.0, cubic(before, ring(row), ring(row + 1), after, y - row));
}

LumenBoundary lumen_boundary(const imaging::ImageVolume& image, const geometry::AxisCurve& axis,
                             double from_mm, double to_mm, const LumenBoundaryOptions& options,
                             const core::TaskContext& task) {
  validate(options);
  if (image.voxels.empty()) throw InvalidInput("lumen boundary: the image is empty");
  task.set_stage("lumen boundary");
  task.throw_if_cancelled();
  Rows rows = rows_of(image, axis, from_mm, to_mm, options.step_mm);
  Estimate estimate = first_estimate(image, rows, options, task);
  task.set_progress(0.5);
  const BoundaryFit fit = fitted(image, rows, estimate, options, task);

  LumenBoundary out;
  out.from_mm = from_mm;
  out.step_mm = rows.step_mm;
  out.around = options.around;
  out.lumen_hu = estimate.level.typical_hu;
  out.lumen_sigma_hu = estimate.level.sigma_hu;
  const std::size_t outside = put_on_axis(rows, fit, out);
  hold_limits(out.radius_mm, rows.count(), out.around, options.largest_slope_along * rows.step_mm,
              options.largest_slope_around * 2.0 * std::numbers::pi / out.around);
  add_warnings(out, outside, options.wall_hu);
  return out;
}

}  // namespace ostia::segmentation
