#include "ostia/view/plaque_layer.h"

#include "tints.h"

#include "ostia/session/plaque_sampling.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"
#include "ostia/view/plaque_colors.h"
#include "ostia/view/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace ostia::view {
namespace {

using std::numbers::pi;
constexpr int rays = 720;  // of a section: half a degree is less than a pixel of any wall
constexpr double legend_wide = 125.0, legend_high = 230.0;  // a smaller view has no room for one

using session::PlaqueRay;
using session::VesselWalls;

std::uint8_t code_of(const std::optional<analysis::PlaqueClass>& one) {
  return one ? static_cast<std::uint8_t>(1 + static_cast<int>(*one)) : std::uint8_t{0};
}

double widest_mm(const VesselWalls& walls) {
  const std::vector<double>& radii = walls.outer.surface.radius_mm;
  return radii.empty() ? 0.0 : *std::max_element(radii.begin(), radii.end());
}

std::vector<Role> class_roles() {
  std::vector<Role> roles;
  for (const PlaqueColor& one : plaque_colors) roles.push_back(one.role);
  return roles;
}

OverlayTint on_section(SectionView& view, const VesselWalls& walls) {
  const double s = view.s_mm(), pixel = view.pixel_mm(), reach = widest_mm(walls) / pixel + 1.0;
  const std::optional<ViewPlace> middle = view.project(walls.axis->point(s));
  if (!middle || !session::plaque_ray(walls, s, 0.0)) return {};
  std::vector<PlaqueRay> around;
  for (int i = 0; i < rays; ++i)
    around.push_back(*session::plaque_ray(walls, s, (i + 0.5) * 2.0 * pi / rays));
  OverlayTint tint =
      blank_tint(view, middle->px - Vec2(reach, reach), middle->px + Vec2(reach, reach), class_roles());
  fill_tint(tint, [&](double y, std::uint8_t* row) {
    for (int i = 0; i < tint.width; ++i) {
      const Vec2 from = pixel * (Vec2(tint.left + i + 0.5, y) - middle->px);
      const double turns = std::atan2(-from.y(), from.x()) / (2.0 * pi);
      const int ray = static_cast<int>((turns - std::floor(turns)) * rays);
      row[i] = code_of(around[static_cast<std::size_t>(std::min(ray, rays - 1))].at(from.norm()));
    }
  });
  return tint;
}

/// Each row is a line across the axis.
OverlayTint on_straightened(CurvedView& view, const VesselWalls& walls) {
  const double pixel = view.pixel_mm(), reach = widest_mm(walls) / pixel + 1.0;
  const double middle = view.axis_at(walls.plaque.from_mm).x(), theta = view.theta_deg() * pi / 180.0;
  OverlayTint tint = blank_tint(view, {middle - reach, view.row_of(walls.plaque.from_mm)},
                                {middle + reach, view.row_of(walls.plaque.to_mm)}, class_roles());
  fill_tint(tint, [&](double y, std::uint8_t* row) {
    const double s = view.abscissa_at(y);
    const auto right = session::plaque_ray(walls, s, theta), left = session::plaque_ray(walls, s, theta + pi);
    if (!right || !left) return;
    for (int i = 0; i < tint.width; ++i) {
      const double from = pixel * (tint.left + i + 0.5 - middle);
      row[i] = code_of(from >= 0.0 ? right->at(from) : left->at(-from));
    }
  });
  return tint;
}

/// Rows cross the vessel as it comes.
OverlayTint on_stretched(CurvedView& view, const VesselWalls& walls) {
  const double beside = widest_mm(walls) / view.pixel_mm();
  OverlayTint tint = blank_tint(view, {0.0, view.row_of(walls.plaque.from_mm) - beside},
                                {static_cast<double>(view.width()), view.row_of(walls.plaque.to_mm) + beside},
                                class_roles());
  const PlacesAbout places(view, *walls.axis, widest_mm(walls), tint);
  fill_tint(tint, [&](double y, std::uint8_t* row) {
    for (int i = 0; i < tint.width; ++i) {
      const auto at = places.at(i, y);
      if (!at) continue;
      if (const auto ray = session::plaque_ray(walls, at->x(), std::atan2(at->z(), at->y())))
        row[i] = code_of(ray->at(at->tail<2>().norm()));
    }
  });
  return tint;
}

}  // namespace

PlaqueLayer::PlaqueLayer(PictureView& view, session::OuterWallBoard& board) : view_(view), board_(board) {
  view_.set_layer([this](Overlay& overlay) { draw(overlay); }, PictureView::LayerPlace::plaque);
  own_.push_back(board.plaque_shown.observe([this](const bool&) { view_.touch_layer(); }));
  own_.push_back(board.changed.observe([this] { view_.touch_layer(); }));
  own_.push_back(view.bench().turning.observe([this](const bool&) {
    if (board_.plaque_shown.get()) view_.touch_layer();
  }));
}
PlaqueLayer::~PlaqueLayer() {
  view_.set_layer({}, PictureView::LayerPlace::plaque);
}

std::shared_ptr<const OverlayTint> PlaqueLayer::made() const {
  const VesselWalls* walls = board_.of_selected();
  if (!walls || walls->maps.empty() || !view_.ready()) return nullptr;
  OverlayTint tint;
  if (auto* section = dynamic_cast<SectionView*>(&view_)) {
    tint = on_section(*section, *walls);
  } else if (auto* curved = dynamic_cast<CurvedView*>(&view_)) {
    const session::Workbench& bench = view_.bench();
    if (bench.curved_mode.get() == reformat::CurvedMode::straightened)
      tint = on_straightened(*curved, *walls);
    else if (!bench.turning.get())
      tint = on_stretched(*curved, *walls);
  }
  return tint.what.empty() ? nullptr : std::make_shared<const OverlayTint>(std::move(tint));
}

const std::shared_ptr<const OverlayTint>& PlaqueLayer::tint() {
  const std::uint64_t known = board_.revision(), placed = view_.placement_revision();
  const bool turning = view_.bench().turning.get();
  if (made_ && known == known_ && placed == placed_ && turning == turning_) return tint_;
  tint_ = made();
  known_ = known;
  placed_ = placed;
  turning_ = turning;
  made_ = true;
  return tint_;
}

void PlaqueLayer::draw(Overlay& overlay) {
  if (!board_.plaque_shown.get()) return;
  if (tint()) overlay.tints.push_back(tint());
  const bool has_plaque = dynamic_cast<const SectionView*>(&view_) || dynamic_cast<const CurvedView*>(&view_);
  if (has_plaque && board_.of_selected()) add_legend(overlay);
}

void PlaqueLayer::add_legend(Overlay& overlay) const {
  const double unit = view_.density();
  if (view_.width() < legend_wide * unit || view_.height() < legend_high * unit) return;
  const Words& w = words();
  const std::array names{&w.low_attenuation, &w.fibrofatty, &w.fibrous, &w.calcified};
  const double line = 15.0 * unit, side = 9.0 * unit, left = 12.0 * unit;
  double y = view_.height() - 10.0 * unit - 3.0 * line;  // of the first one's middle
  for (std::size_t i = 0; i < plaque_colors.size(); ++i, y += line) {
    overlay.bands.push_back(
        {Vec2(left, y - side / 2), Vec2(left + side, y + side / 2), plaque_colors[i].role, 1.0});
    overlay.texts.push_back(
        {Vec2(left + side + 5.0 * unit, y), *names[i], Role::information, Anchor::left, {}, true});
  }
}

}  // namespace ostia::view
