#include "ostia/view/plaque_layer.h"

#include "scene/tints.h"

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

OverlayTint on_section(SectionView& view, const VesselWalls& walls) {
  const double s = view.s_mm(), pixel = view.pixel_mm(), reach = widest_mm(walls) / pixel + 1.0;
  const std::optional<ViewPlace> middle = view.project(walls.axis->point(s));
  if (!middle || !session::plaque_ray(walls, s, 0.0)) return {};
  std::vector<PlaqueRay> around;
  for (int i = 0; i < rays; ++i)
    around.push_back(*session::plaque_ray(walls, s, (i + 0.5) * 2.0 * pi / rays));
  OverlayTint tint = blank_tint(view, middle->px - Vec2(reach, reach), middle->px + Vec2(reach, reach),
                                roles_of(plaque_colors));
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

OverlayTint on_curved(CurvedView& view, const VesselWalls& walls) {
  const analysis::PlaqueProfile& plaque = walls.plaque;
  return tint_about_vessel(
      view, {*walls.axis, plaque.from_mm, plaque.to_mm, widest_mm(walls), roles_of(plaque_colors)},
      [&](double s, double theta) {
        return [ray = session::plaque_ray(walls, s, theta)](double rho) {
          return ray ? code_of(ray->at(rho)) : std::uint8_t{0};
        };
      });
}

}  // namespace

PlaqueLayer::PlaqueLayer(PictureView& view, session::OuterWallBoard& board) : view_(view), board_(board) {
  view_.set_layer([this](Overlay& overlay) { draw(overlay); }, PictureView::LayerPlace::plaque);
  own_ = redraw_with(view, board.plaque_shown, board.changed);
}
PlaqueLayer::~PlaqueLayer() {
  view_.set_layer({}, PictureView::LayerPlace::plaque);
}

std::shared_ptr<const OverlayTint> PlaqueLayer::made() const {
  const VesselWalls* walls = board_.of_selected();
  if (!walls || walls->maps.empty() || !view_.ready()) return nullptr;
  OverlayTint tint;
  if (auto* section = dynamic_cast<SectionView*>(&view_))
    tint = on_section(*section, *walls);
  else if (auto* curved = dynamic_cast<CurvedView*>(&view_))
    tint = on_curved(*curved, *walls);
  return tint.what.empty() ? nullptr : std::make_shared<const OverlayTint>(std::move(tint));
}

const std::shared_ptr<const OverlayTint>& PlaqueLayer::tint() {
  return tint_.of({board_.revision(), view_.placement_revision(), view_.bench().turning.get()},
                  [this] { return made(); });
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
