// How a person has set a view, as numbers.

#include "ostia/core/error.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"

#include <algorithm>
#include <cmath>

namespace ostia::view {
namespace {

void check(const std::vector<double>& framing, std::size_t count, const char* view) {
  const bool finite =
      std::all_of(framing.begin(), framing.end(), [](double value) { return std::isfinite(value); });
  if (framing.size() != count || !finite)
    throw InvalidInput(std::string("the framing of a ") + view + " is " + std::to_string(count) +
                       " finite numbers");
}

constexpr std::size_t of_plane = 3;

}  // namespace

std::optional<ViewPlace> CurvedView::project_near(const Vec3& place, double s_mm) {
  const reformat::CurvedReformation* shown = reformation();
  if (!shown) return std::nullopt;
  const auto at = shown->project(place, s_mm);
  if (!at) return std::nullopt;
  return ViewPlace{at->picture_px - contour_offset(), at->out_mm};
}

std::vector<double> CurvedView::framing() const {
  return {frame_->pixel_mm.value_or(0.0), frame_->pixel_mm ? frame_->top_mm : 0.0, frame_->whole ? 1.0 : 0.0,
          static_cast<double>(shift_px_)};
}

void CurvedView::set_framing(const std::vector<double>& framing) {
  check(framing, 4, "curved view");
  if (framing == this->framing()) return;
  const bool zoomed = framing[0] > 0.0;
  frame_->pixel_mm = zoomed ? std::optional(framing[0]) : std::nullopt;
  frame_->top_mm = framing[1];
  frame_->whole = framing[2] != 0.0;
  shift_px_ = static_cast<int>(std::lround(std::clamp(framing[3], -1e6, 1e6)));
  frame_->changed.tell();
}

std::vector<double> PlaneView::framing() const {
  return {zoom_, pan_px_.x(), pan_px_.y()};
}

void PlaneView::set_framing(const std::vector<double>& framing) {
  check(framing, of_plane, "flat view");
  if (!(framing[0] > 0.0)) throw InvalidInput("the framing of a flat view begins with a zoom above 0");
  if (framing == PlaneView::framing()) return;
  zoom_ = framing[0];
  pan_px_ = {framing[1], framing[2]};
  moved();
}

std::vector<double> SliceView::framing() const {
  std::vector<double> all = PlaneView::framing();
  all.push_back(static_cast<double>(kind_));
  for (const Vec3& axis : {u_, v_}) all.insert(all.end(), {axis.x(), axis.y(), axis.z()});
  return all;
}

void SliceView::set_framing(const std::vector<double>& framing) {
  check(framing, of_plane + 7, "slice");
  const double kind = framing[of_plane];
  const Vec3 u(framing[4], framing[5], framing[6]), v(framing[7], framing[8], framing[9]);
  const bool known = kind == 0.0 || kind == 1.0 || kind == 2.0 || kind == 3.0;
  const bool upright =
      std::abs(u.norm() - 1.0) < 1e-6 && std::abs(v.norm() - 1.0) < 1e-6 && std::abs(u.dot(v)) < 1e-6;
  if (!known || !upright)
    throw InvalidInput(
        "the framing of a slice names a kind of slice and two directions normal to each other");
  if (framing == this->framing()) return;
  kind_ = static_cast<SliceKind>(static_cast<int>(kind));
  u_ = u;
  v_ = v;
  PlaneView::set_framing({framing.begin(), framing.begin() + of_plane});
  moved();
}

}  // namespace ostia::view
