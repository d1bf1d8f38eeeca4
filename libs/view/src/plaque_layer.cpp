#include "ostia/view/plaque_layer.h"

#include "ostia/core/parallel.h"
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

/// Nothing coloured yet, from one corner to the other as far as the view reaches.
OverlayTint blank(const PictureView& view, const Vec2& low, const Vec2& high) {
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
  for (const PlaqueColor& one : plaque_colors) out.roles.push_back(one.role);
  return out;
}

/// Asks `of(x, y)` for the middle of every pixel, rows side by side.
template <class Of>
void fill(OverlayTint& tint, const Of& of_row) {
  core::parallel_for(static_cast<std::size_t>(tint.height), 16, [&](std::size_t row) {
    of_row(tint.top + static_cast<double>(row) + 0.5,
           tint.what.data() + row * static_cast<std::size_t>(tint.width));
  });
}

OverlayTint on_section(SectionView& view, const VesselWalls& walls) {
  const double s = view.s_mm(), pixel = view.pixel_mm(), reach = widest_mm(walls) / pixel + 1.0;
  const std::optional<ViewPlace> middle = view.project(walls.axis->point(s));
  if (!middle || !session::plaque_ray(walls, s, 0.0)) return {};
  std::vector<PlaqueRay> around;
  for (int i = 0; i < rays; ++i)
    around.push_back(*session::plaque_ray(walls, s, (i + 0.5) * 2.0 * pi / rays));
  OverlayTint tint = blank(view, middle->px - Vec2(reach, reach), middle->px + Vec2(reach, reach));
  fill(tint, [&](double y, std::uint8_t* row) {
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
  OverlayTint tint = blank(view, {middle - reach, view.row_of(walls.plaque.from_mm)},
                           {middle + reach, view.row_of(walls.plaque.to_mm)});
  fill(tint, [&](double y, std::uint8_t* row) {
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

/// Where a place is about the axis: abscissa, and across it along theta = 0 and 90 degrees.
using About = std::optional<Vec3>;
constexpr int mesh_px = 4;  // places are looked for so far apart; between them they change evenly

/// Looked for at the corners of a mesh over the tint, row by row from the axis outwards, near the row's own
/// abscissa, as far as the vessel reaches.
std::vector<About> places_about(CurvedView& view, const VesselWalls& walls, const OverlayTint& tint,
                                int columns, int rows) {
  std::vector<About> all(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const double widest = widest_mm(walls), reach = widest + 2.0 * mesh_px * view.pixel_mm();
  core::parallel_for(static_cast<std::size_t>(rows), 8, [&](std::size_t row) {
    const double y = tint.top + static_cast<double>(row) * mesh_px;
    const double s = view.abscissa_at(y), middle = (view.axis_at(s).x() - tint.left) / mesh_px;
    const auto look = [&](int column) {  // false where the vessel has ended
      const std::optional<Vec3> place = view.world({tint.left + static_cast<double>(column) * mesh_px, y});
      const auto foot = place ? walls.axis->foot_near(*place, s, 2.0 * reach) : std::nullopt;
      if (!foot || foot->past_end || foot->rho_mm > reach) return false;
      all[row * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)] =
          Vec3(foot->s_mm, foot->rho_mm * std::cos(foot->theta), foot->rho_mm * std::sin(foot->theta));
      return true;
    };
    const int first = static_cast<int>(std::clamp(std::floor(middle), 0.0, static_cast<double>(columns)));
    for (int x = first; x < columns && look(x); ++x) continue;
    for (int x = first - 1; x >= 0 && look(x); --x) continue;
  });
  return all;
}

/// Rows cross the vessel as it comes.
OverlayTint on_stretched(CurvedView& view, const VesselWalls& walls) {
  const double pixel = view.pixel_mm(), beside = widest_mm(walls) / pixel;
  OverlayTint tint = blank(view, {0.0, view.row_of(walls.plaque.from_mm) - beside},
                           {static_cast<double>(view.width()), view.row_of(walls.plaque.to_mm) + beside});
  const int columns = tint.width / mesh_px + 2, rows = tint.height / mesh_px + 2;
  const std::vector<About> mesh = places_about(view, walls, tint, columns, rows);
  const double torn_mm = 4.0 * mesh_px * pixel;  // corners farther apart along the vessel are of two places
  fill(tint, [&](double y, std::uint8_t* row) {
    const double down = (y - tint.top) / mesh_px;
    const auto j = static_cast<std::size_t>(down);
    for (int i = 0; i < tint.width; ++i) {
      const double right = (i + 0.5) / mesh_px, a = right - std::floor(right), b = down - std::floor(down);
      const About* upper = mesh.data() + j * static_cast<std::size_t>(columns) + i / mesh_px;
      const About* lower = upper + columns;
      if (!upper[0] || !upper[1] || !lower[0] || !lower[1]) continue;
      const auto [least, most] = std::minmax({upper[0]->x(), upper[1]->x(), lower[0]->x(), lower[1]->x()});
      if (most - least > torn_mm) continue;
      const Vec3 at =
          (1.0 - b) * ((1.0 - a) * *upper[0] + a * *upper[1]) + b * ((1.0 - a) * *lower[0] + a * *lower[1]);
      if (const auto ray = session::plaque_ray(walls, at.x(), std::atan2(at.z(), at.y())))
        row[i] = code_of(ray->at(at.tail<2>().norm()));
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
