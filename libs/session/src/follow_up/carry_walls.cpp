#include "follow_up/carry_walls.h"

#include "walls/lumen_on_rays.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/polyline.h"
#include "ostia/pipeline/image_walls.h"
#include "ostia/segmentation/lumen_boundary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <utility>

namespace ostia::session {
namespace {

using geometry::Vec3;
using AxisPointer = std::shared_ptr<const geometry::AxisCurve>;

constexpr double wall_step_mm = 0.5;
constexpr int wall_rays = 32;
constexpr int beside_rows = 2, beside_rays = 1;  // over which clearness is averaged
constexpr double unclear_edge = 0.1,
                 clear_edge = 0.3;  // about what a boundary's own warning takes for unclear
constexpr double least_tube_mm = 0.1;
constexpr double told_share = 0.1;  // of a wall that is kept, from which on a person is told

/// The former wall of a vessel, asked in the carried vessel's coordinates.
class FormerWall {
 public:
  FormerWall(OwnLumen lumen, const geometry::AxisCurve& before, const geometry::AxisCurve& after,
             std::vector<double> before_mm, std::vector<double> after_mm, const analysis::PointMap& map)
      : lumen_(std::move(lumen)), before_mm_(std::move(before_mm)), after_mm_(std::move(after_mm)) {
    for (std::size_t i = 0; i < after_mm_.size(); ++i) {
      radius_.push_back(std::max(before.radius(before_mm_[i]), least_tube_mm));
      const Vec3 place = before.point(before_mm_[i]);
      const Vec3 normal = geometry::radial_direction(before.frame(before_mm_[i]), 0.0);
      double turn = geometry::angle_of(after.frame(after_mm_[i]), map(place + normal) - map(place));
      if (!turn_.empty())
        turn += 2.0 * std::numbers::pi * std::round((turn_.back() - turn) / (2.0 * std::numbers::pi));
      turn_.push_back(turn);
    }
  }

  double operator()(double s_mm, double theta) const {
    const auto next = std::ranges::lower_bound(after_mm_, s_mm);
    const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
        next - after_mm_.begin(), 1, static_cast<std::ptrdiff_t>(after_mm_.size()) - 1));
    const double span = after_mm_[i] - after_mm_[i - 1];
    const double t = span > 0.0 ? std::clamp((s_mm - after_mm_[i - 1]) / span, 0.0, 1.0) : 0.0;
    const auto between = [&](const std::vector<double>& values) {
      return values[i - 1] + t * (values[i] - values[i - 1]);
    };
    if (lumen_.rows.rows() < 2) return between(radius_);
    return lumen_.rows.at(between(before_mm_), theta - between(turn_));
  }

 private:
  OwnLumen lumen_;
  std::vector<double> before_mm_, after_mm_, radius_, turn_;
};

/// How much of a boundary is the image's, [0, 1] for each ray.
std::vector<double> shares_of_image(const segmentation::LumenBoundary& found,
                                    const std::function<bool(double)>& seen) {
  std::vector<double> shares;
  const int rows = found.rows();
  for (int r = 0; r < rows; ++r) {
    const double shown = seen(found.from_mm + r * found.step_mm) ? 1.0 : 0.0;
    for (int a = 0; a < found.around; ++a) {
      double sum = 0.0;
      int count = 0;
      for (int i = std::max(0, r - beside_rows); i <= std::min(rows - 1, r + beside_rows); ++i)
        for (int k = a - beside_rays; k <= a + beside_rays; ++k, ++count)
          sum +=
              found
                  .confidence[static_cast<std::size_t>(i * found.around + (k + found.around) % found.around)];
      const double t = std::clamp((sum / count - unclear_edge) / (clear_edge - unclear_edge), 0.0, 1.0);
      shares.push_back(shown * t * t * (3.0 - 2.0 * t));
    }
  }
  return shares;
}

/// The image's boundary, and the former wall where it is unclear. Returns the share that is the former.
double constrain(segmentation::LumenBoundary& found, const FormerWall& former,
                 const std::function<bool(double)>& seen) {
  const std::vector<double> shares = shares_of_image(found, seen);
  double kept = 0.0;
  for (std::size_t n = 0; n < shares.size(); ++n) {
    kept += (1.0 - shares[n]) / static_cast<double>(shares.size());
    if (shares[n] >= 1.0) continue;
    const auto row = static_cast<double>(n / static_cast<std::size_t>(found.around));
    const auto ray = static_cast<double>(n % static_cast<std::size_t>(found.around));
    const double was =
        former(found.from_mm + row * found.step_mm, 2.0 * std::numbers::pi * ray / found.around);
    found.radius_mm[n] = shares[n] * found.radius_mm[n] + (1.0 - shares[n]) * was;
  }
  return kept;
}

class Walls {
 public:
  Walls(const lumen::LumenModel& before, const analysis::SurfaceOfVessel& surface_of, CarriedTree& carried,
        const imaging::ImageVolume& image, const analysis::PointMap& map)
      : before_(before), surface_of_(surface_of), carried_(carried), image_(image), map_(map) {
    for (const geometry::Vessel& vessel : carried.tree.vessels)
      axes_.push_back(
          std::make_shared<const geometry::AxisCurve>(geometry::vessel_axis(carried.tree, vessel)));
  }

  lumen::RadialWall of(std::size_t index, const core::TaskContext& task) {
    CarriedLine& line = line_of(carried_.tree.vessels[index].id);
    const auto former = std::make_shared<const FormerWall>(former_wall(index, task));
    const AxisPointer& axis = axes_[index];
    const double free_mm = pipeline::free_from_mm(carried_.tree, axes_, index);
    const auto kept_whole = [&](const std::string& why) -> lumen::RadialWall {
      line.told.wall_kept_share = 1.0;
      line.told.notes.push_back("its wall is the former one: " + why);
      return
          [former, free_mm](double s_mm, double theta) { return (*former)(std::max(s_mm, free_mm), theta); };
    };
    if (line.told.how != CarriedHow::followed) return kept_whole("the image was not followed");
    try {
      segmentation::LumenBoundary found =
          segmentation::lumen_boundary(image_, *axis, free_mm, axis->length(), {}, task);
      line.told.wall_kept_share =
          constrain(found, *former, [&](double s_mm) { return seen_at(line, axis->length(), s_mm); });
      if (line.told.wall_kept_share >= told_share)
        line.told.notes.push_back("no clear edge on " +
                                  core::rounded_text(100.0 * line.told.wall_kept_share, 0) +
                                  " % of its wall, which is the former one there");
      return pipeline::wall_of_boundary(found, free_mm, axis->length());
    } catch (const GeometryError& error) {
      return kept_whole(error.what());
    } catch (const InvalidInput& error) {
      return kept_whole(error.what());
    }
  }

 private:
  CarriedLine& line_of(std::int32_t vessel) {
    return *std::ranges::find(carried_.lines, vessel,
                              [](const CarriedLine& line) { return line.told.vessel; });
  }

  FormerWall former_wall(std::size_t index, const core::TaskContext& task) const {
    const geometry::Vessel& vessel = carried_.tree.vessels[index];
    const geometry::AxisCurve& was = *lumen::vessel(before_, vessel.id).axis;
    const auto former = std::ranges::find(before_.tree.vessels, vessel.id, &geometry::Vessel::id);
    std::vector<double> before_mm = geometry::vessel_axis(before_.tree, *former).abscissa;
    std::vector<double> after_mm = geometry::vessel_axis(carried_.tree, vessel).abscissa;
    before_mm.resize(std::min(before_mm.size(), after_mm.size()));
    after_mm.resize(before_mm.size());
    return {own_lumen(before_, surface_of_, vessel.id, wall_step_mm, wall_rays, task),
            was,
            *axes_[index],
            std::move(before_mm),
            std::move(after_mm),
            map_};
  }

  static bool seen_at(const CarriedLine& line, double length_mm, double s_mm) {
    double left_mm = length_mm - s_mm;  // own points are the last ones of the axis
    for (std::size_t i = line.points.size() - 1; i > 0; --i) {
      left_mm -= (line.points[i] - line.points[i - 1]).norm();
      if (left_mm <= 0.0) return line.seen[i] != 0 && line.seen[i - 1] != 0;
    }
    return true;
  }

  const lumen::LumenModel& before_;
  const analysis::SurfaceOfVessel& surface_of_;
  CarriedTree& carried_;
  const imaging::ImageVolume& image_;
  const analysis::PointMap& map_;
  std::vector<AxisPointer> axes_;
};

}  // namespace

std::vector<lumen::RadialWall> carried_walls(const lumen::LumenModel& before,
                                             const analysis::SurfaceOfVessel& surface_of,
                                             CarriedTree& carried, const imaging::ImageVolume& image,
                                             const analysis::PointMap& map, const core::TaskContext& task) {
  Walls all(before, surface_of, carried, image, map);
  std::vector<lumen::RadialWall> walls;
  const auto count = static_cast<double>(carried.tree.vessels.size());
  for (std::size_t i = 0; i < carried.tree.vessels.size(); ++i) {
    task.throw_if_cancelled();
    walls.push_back(all.of(i, task.sub(static_cast<double>(i) / count, static_cast<double>(i + 1) / count)));
  }
  return walls;
}

}  // namespace ostia::session
