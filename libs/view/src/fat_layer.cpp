#include "ostia/view/fat_layer.h"

#include "tints.h"

#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ostia::view {
namespace {

/// Codes of a tint: what of the places about a vessel is fat.
class FatCode {
 public:
  FatCode(const session::VesselFat& fat, const imaging::ImageVolume& image) : fat_(fat), image_(image) {}
  double reach_mm() const { return fat_.profile.options.reach_diameters * fat_.profile.diameter_mm; }
  double widest_mm() const {
    double widest = 0.0;
    for (const double radius : fat_.walls->outer.surface.radius_mm) widest = std::max(widest, radius);
    return widest + reach_mm();
  }
  /// Of a place, abscissa and distance from the axis at an angle.
  std::uint8_t of(double s, double rho, double theta) const {
    const analysis::FatProfile& profile = fat_.profile;
    if (s < profile.from_mm || s > profile.to_mm) return 0;
    const double beyond = rho - static_cast<double>(fat_.walls->outer.surface.at(s, theta));
    if (!(beyond > 0.0 && beyond <= reach_mm())) return 0;
    const Vec3 place = fat_.walls->axis->place(s, theta, rho);
    if (!image_.geometry.contains(place)) return 0;
    const double hu = imaging::sample(image_, place);
    if (!(hu >= profile.options.from_hu && hu <= profile.options.to_hu)) return 0;
    std::uint8_t code = 1;
    while (code < fat_colors.size() && hu > fat_colors[code - 1U].to_hu) ++code;
    return code;
  }

 private:
  const session::VesselFat& fat_;
  const imaging::ImageVolume& image_;
};

std::vector<Role> fat_roles() {
  std::vector<Role> roles;
  for (const FatColor& one : fat_colors) roles.push_back(one.role);
  return roles;
}

OverlayTint fat_on_straightened(CurvedView& view, const session::VesselFat& fat, const FatCode& code) {
  const double pixel = view.pixel_mm(), reach = code.widest_mm() / pixel + 1.0;
  const double middle = view.axis_at(fat.profile.from_mm).x(),
               theta = view.theta_deg() * std::numbers::pi / 180.0;
  OverlayTint tint = blank_tint(view, {middle - reach, view.row_of(fat.profile.from_mm)},
                                {middle + reach, view.row_of(fat.profile.to_mm)}, fat_roles());
  fill_tint(tint, [&](double y, std::uint8_t* row) {
    const double s = view.abscissa_at(y);
    for (int i = 0; i < tint.width; ++i) {
      const double from = pixel * (tint.left + i + 0.5 - middle);
      row[i] = code.of(s, std::abs(from), from >= 0.0 ? theta : theta + std::numbers::pi);
    }
  });
  return tint;
}

OverlayTint fat_on_stretched(CurvedView& view, const session::VesselFat& fat, const FatCode& code) {
  const double beside = code.widest_mm() / view.pixel_mm();
  OverlayTint tint =
      blank_tint(view, {0.0, view.row_of(fat.profile.from_mm) - beside},
                 {static_cast<double>(view.width()), view.row_of(fat.profile.to_mm) + beside}, fat_roles());
  const PlacesAbout places(view, *fat.walls->axis, code.widest_mm(), tint);
  fill_tint(tint, [&](double y, std::uint8_t* row) {
    for (int i = 0; i < tint.width; ++i)
      if (const auto at = places.at(i, y))
        row[i] = code.of(at->x(), at->tail<2>().norm(), std::atan2(at->z(), at->y()));
  });
  return tint;
}

}  // namespace

FatLayer::FatLayer(CurvedView& view, session::FatBoard& board) : view_(view), board_(board) {
  view_.set_layer([this](Overlay& overlay) { draw(overlay); }, PictureView::LayerPlace::fat);
  own_.push_back(board.shown.observe([this](const bool&) { view_.touch_layer(); }));
  own_.push_back(board.changed.observe([this] { view_.touch_layer(); }));
  own_.push_back(view.bench().turning.observe([this](const bool&) {
    if (board_.shown.get()) view_.touch_layer();
  }));
}

FatLayer::~FatLayer() {
  view_.set_layer({}, PictureView::LayerPlace::fat);
}

std::shared_ptr<const OverlayTint> FatLayer::made() const {
  const session::VesselFat* fat = board_.of_selected();
  const session::Workbench& bench = view_.bench();
  if (!fat || !fat->walls || !view_.ready() || !bench.image().volume) return nullptr;
  const FatCode code(*fat, *bench.image().volume);
  OverlayTint tint;
  if (bench.curved_mode.get() == reformat::CurvedMode::straightened)
    tint = fat_on_straightened(view_, *fat, code);
  else if (!bench.turning.get())
    tint = fat_on_stretched(view_, *fat, code);
  return tint.what.empty() ? nullptr : std::make_shared<const OverlayTint>(std::move(tint));
}

const std::shared_ptr<const OverlayTint>& FatLayer::tint() {
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

void FatLayer::draw(Overlay& overlay) {
  if (!board_.shown.get() || view_.bench().other_image()) return;
  if (tint()) overlay.tints.push_back(tint());
}

}  // namespace ostia::view
