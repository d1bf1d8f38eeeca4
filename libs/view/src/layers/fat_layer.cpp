#include "ostia/view/fat_layer.h"

#include "scene/tints.h"

#include "ostia/imaging/sampling.h"

#include <utility>

namespace ostia::view {
namespace {

/// Codes of a tint: what of the places about a vessel is fat.
class FatCode {
 public:
  FatCode(const session::VesselFat& fat, const imaging::ImageVolume& image) : fat_(fat), image_(image) {}
  double reach_mm() const { return fat_.profile.options.reach_diameters * fat_.profile.diameter_mm; }
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

}  // namespace

FatLayer::FatLayer(CurvedView& view, session::FatBoard& board) : view_(view), board_(board) {
  view_.set_layer([this](Overlay& overlay) { draw(overlay); }, PictureView::LayerPlace::fat);
  own_ = redraw_with(view, board.shown, board.changed);
}

FatLayer::~FatLayer() {
  view_.set_layer({}, PictureView::LayerPlace::fat);
}

std::shared_ptr<const OverlayTint> FatLayer::made() const {
  const session::VesselFat* fat = board_.of_selected();
  const session::Workbench& bench = view_.bench();
  if (!fat || !fat->walls || !view_.ready() || !bench.image().volume) return nullptr;
  const FatCode code(*fat, *bench.image().volume);
  const session::VesselWalls& walls = *fat->walls;
  OverlayTint tint =
      tint_about_vessel(view_,
                        {*walls.axis, fat->profile.from_mm, fat->profile.to_mm,
                         widest_mm(walls) + code.reach_mm(), roles_of(fat_colors)},
                        [&](double s, double theta) {
                          return [&code, s, theta](double rho) { return code.of(s, rho, theta); };
                        });
  return tint.what.empty() ? nullptr : std::make_shared<const OverlayTint>(std::move(tint));
}

const std::shared_ptr<const OverlayTint>& FatLayer::tint() {
  return tint_.of({board_.revision(), view_.placement_revision(), view_.bench().turning.get()},
                  [this] { return made(); });
}

void FatLayer::draw(Overlay& overlay) {
  if (!board_.shown.get() || view_.bench().other_image()) return;
  if (tint()) overlay.tints.push_back(tint());
}

}  // namespace ostia::view
