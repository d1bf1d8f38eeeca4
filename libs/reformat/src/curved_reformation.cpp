#include "ostia/reformat/curved_reformation.h"

#include "curved_guide.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <cmath>
#include <numbers>
#include <string>

namespace ostia::reformat {
namespace {

constexpr int most_pixels = 32767;
constexpr double thickest_mm = 100.0;
constexpr double on_view_mm = 1e-6;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

}  // namespace

void validate(const CurvedOptions& o) {
  if (!std::isfinite(o.theta_deg)) throw InvalidInput("the angle of the curved reformation is not finite");
  if (!(o.pixel_mm > 0.0) || !std::isfinite(o.pixel_mm))
    throw InvalidInput("the pixels of the curved reformation are " + core::mm_text(o.pixel_mm, 6) +
                       " wide; they must be wider than 0");
  if (o.width < 1 || o.height < 1 || o.width > most_pixels || o.height > most_pixels)
    throw InvalidInput("a curved reformation of " + std::to_string(o.width) + " x " +
                       std::to_string(o.height) + " pixels cannot be pictured; both must lie between 1 and " +
                       std::to_string(most_pixels));
  if (!std::isfinite(o.s_start_mm))
    throw InvalidInput("the abscissa of the curved reformation's first row is not finite");
  if (o.slab != Slab::none && !(o.slab_mm > 0.0 && o.slab_mm <= thickest_mm))
    throw InvalidInput("the slab of the curved reformation is " + core::mm_text(o.slab_mm, 6) +
                       " thick; give more than 0 and at most " + core::mm_text(thickest_mm, 6) +
                       ", or no slab");
}

CurvedReformation::CurvedReformation(std::shared_ptr<const geometry::AxisCurve> axis,
                                     std::shared_ptr<const Guide> guide, const CurvedOptions& options)
    : axis_(std::move(axis)), options_(options), guide_(std::move(guide)) {
  validate(options_);
  if (!axis_) throw InvalidInput("a curved reformation needs an axis");
  if (!guide_) {
    guide_ = options_.mode == CurvedMode::straightened
                 ? Guide::of_axis(*axis_)
                 : Guide::of_projection(*axis_, radians(options_.theta_deg));
  }
  start_ = guide_->coordinate(options_.s_start_mm);
}

CurvedReformation::CurvedReformation(std::shared_ptr<const geometry::AxisCurve> axis,
                                     const CurvedOptions& options)
    : CurvedReformation(std::move(axis), nullptr, options) {}

CurvedReformation CurvedReformation::twin() const {
  return rotated(options_.theta_deg + 90.0);
}

CurvedReformation CurvedReformation::rotated(double theta_deg) const {
  CurvedOptions options = options_;
  options.theta_deg = theta_deg;
  const bool same_guide = options.mode == CurvedMode::straightened;
  return {axis_, same_guide ? guide_ : nullptr, options};
}

CurvedReformation::Row CurvedReformation::row(double row_px) const {
  const double w = start_ + row_px * options_.pixel_mm;
  const geometry::Frame frame = guide_->frame(*axis_, w);
  Row row;
  const double half = 0.5 * options_.width * options_.pixel_mm;
  row.start = guide_->point(*axis_, w);
  if (guide_->stretched) {
    row.along = guide_->v;
    row.start += (guide_->middle - half) * row.along;
  } else {
    row.along = geometry::radial_direction(frame, radians(options_.theta_deg));
    row.start -= half * row.along;
  }
  row.across = row.along.cross(frame.tangent);
  return row;
}

Vec3 CurvedReformation::world(const Vec2& picture_px) const {
  const Row line = row(picture_px.y());
  return line.start + picture_px.x() * options_.pixel_mm * line.along;
}

std::optional<CurvedReformation::ViewPoint> CurvedReformation::project(
    const Vec3& place, std::optional<double> near_s_mm) const {
  if (!place.allFinite()) return std::nullopt;
  std::optional<ViewPoint> best;
  double best_rank = 0.0, best_cost = 0.0;
  for (const Guide::Foot& foot : guide_->feet(*axis_, place)) {
    const double row_px = (foot.w - start_) / options_.pixel_mm;
    const Row line = row(row_px);
    const Vec3 offset = place - line.start;
    ViewPoint seen;
    seen.picture_px = {offset.dot(line.along) / options_.pixel_mm, row_px};
    seen.s_mm = guide_->abscissa(foot.w);
    seen.out_mm = offset.dot(line.across);
    // At a cusp of a stretched view the place need not lie straight across the row.
    const double beside = std::abs(offset.dot(line.across.cross(line.along)));
    double rank = 0.0, cost = 0.0;
    if (beside > on_view_mm) {
      rank = 3.0;
      cost = std::hypot(beside, seen.out_mm);
    } else if (near_s_mm) {
      cost = std::abs(seen.s_mm - *near_s_mm);
    } else if (std::abs(seen.out_mm) <= on_view_mm) {
      cost = (place - axis_->point(seen.s_mm)).norm();
    } else {
      rank = foot.nearest ? 1.0 : 2.0;  // a maximum is the far side of a bend
      cost = std::abs(seen.out_mm);
    }
    if (best && (rank > best_rank || (rank == best_rank && cost >= best_cost))) continue;
    best = seen;
    best_rank = rank;
    best_cost = cost;
  }
  return best;
}

std::vector<Vec2> CurvedReformation::axis_px() const {
  std::vector<Vec2> places;
  for (int j = 0; j < options_.height; ++j) {
    const double row_px = j + 0.5;
    const double s = abscissa_at_row(row_px);
    if (s < 0.0 || s > axis_->length()) continue;
    double column = 0.5 * options_.width;
    if (guide_->stretched) column += (axis_->point(s).dot(guide_->v) - guide_->middle) / options_.pixel_mm;
    places.emplace_back(column, row_px);
  }
  return places;
}

double CurvedReformation::abscissa_at_row(double row_px) const {
  return guide_->abscissa(start_ + row_px * options_.pixel_mm);
}

double CurvedReformation::row_at_abscissa(double s_mm) const {
  return (guide_->coordinate(s_mm) - start_) / options_.pixel_mm;
}

}  // namespace ostia::reformat
