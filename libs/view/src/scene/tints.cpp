#include "scene/tints.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::view {
namespace {

constexpr int mesh_px = 4;  // places are looked for so far apart

}  // namespace

OverlayTint blank_tint(const PictureView& view, const Vec2& low, const Vec2& high, std::vector<Role> roles) {
  OverlayTint out;
  out.left = static_cast<int>(std::clamp(std::floor(low.x()), 0.0, static_cast<double>(view.width())));
  out.top = static_cast<int>(std::clamp(std::floor(low.y()), 0.0, static_cast<double>(view.height())));
  out.width =
      static_cast<int>(std::clamp(std::ceil(high.x()), 0.0, static_cast<double>(view.width()))) - out.left;
  out.height =
      static_cast<int>(std::clamp(std::ceil(high.y()), 0.0, static_cast<double>(view.height()))) - out.top;
  out.width = std::max(0, out.width);
  out.height = std::max(0, out.height);
  out.what.assign(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height), 0);
  out.roles = std::move(roles);
  return out;
}

PlacesAbout::PlacesAbout(CurvedView& view, const geometry::AxisCurve& axis, double widest_mm,
                         const OverlayTint& tint)
    : top_(tint.top),
      columns_(tint.width / mesh_px + 2),
      rows_(tint.height / mesh_px + 2),
      torn_mm_(4.0 * mesh_px * view.pixel_mm()),
      mesh_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  const double reach = widest_mm + 2.0 * mesh_px * view.pixel_mm();
  core::parallel_for(static_cast<std::size_t>(rows_), 8, [&](std::size_t row) {
    const double y = tint.top + static_cast<double>(row) * mesh_px;
    const double s = view.abscissa_at(y), middle = (view.axis_at(s).x() - tint.left) / mesh_px;
    const auto look = [&](int column) {  // false where the vessel has ended
      const std::optional<Vec3> place = view.world({tint.left + static_cast<double>(column) * mesh_px, y});
      const auto foot = place ? axis.foot_near(*place, s, 2.0 * reach) : std::nullopt;
      if (!foot || foot->past_end || foot->rho_mm > reach) return false;
      mesh_[row * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)] =
          Vec3(foot->s_mm, foot->rho_mm * std::cos(foot->theta), foot->rho_mm * std::sin(foot->theta));
      return true;
    };
    const int first = static_cast<int>(std::clamp(std::floor(middle), 0.0, static_cast<double>(columns_)));
    for (int x = first; x < columns_ && look(x); ++x) continue;
    for (int x = first - 1; x >= 0 && look(x); --x) continue;
  });
}

std::optional<Vec3> PlacesAbout::at(int column, double y) const {
  const double down = (y - top_) / mesh_px, right = (column + 0.5) / mesh_px;
  const double a = right - std::floor(right), b = down - std::floor(down);
  const std::optional<Vec3>* upper =
      mesh_.data() + static_cast<std::size_t>(down) * static_cast<std::size_t>(columns_) + column / mesh_px;
  const std::optional<Vec3>* lower = upper + columns_;
  if (!upper[0] || !upper[1] || !lower[0] || !lower[1]) return std::nullopt;
  const auto [least, most] = std::minmax({upper[0]->x(), upper[1]->x(), lower[0]->x(), lower[1]->x()});
  // Corners farther apart along the vessel are of two places.
  if (most - least > torn_mm_) return std::nullopt;
  return Vec3((1.0 - b) * ((1.0 - a) * *upper[0] + a * *upper[1]) +
              b * ((1.0 - a) * *lower[0] + a * *lower[1]));
}

double widest_mm(const session::VesselWalls& walls) {
  const std::vector<double>& radii = walls.outer.surface.radius_mm;
  return radii.empty() ? 0.0 : *std::max_element(radii.begin(), radii.end());
}

std::vector<session::Subscription> redraw_with(PictureView& view, session::Property<bool>& shown,
                                               session::Signal<>& changed) {
  std::vector<session::Subscription> own;
  own.push_back(shown.observe([&view](const bool&) { view.touch_layer(); }));
  own.push_back(changed.observe([&view] { view.touch_layer(); }));
  own.push_back(view.bench().turning.observe([&view, &shown](const bool&) {
    if (shown.get()) view.touch_layer();
  }));
  return own;
}

}  // namespace ostia::view
