#include "ostia/view/calcium_layer.h"

#include "scene/tints.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::view {
namespace {

constexpr double calcium_opacity = 0.6;  // over what is white
constexpr double ring_units = 12.0;

/// Each lesion's role as a tint's code, by its number.
std::vector<std::uint8_t> codes_of(const analysis::CalciumScore& score) {
  std::vector<std::uint8_t> codes(score.lesions.size() + 1, 0);
  for (const analysis::CalciumLesion& lesion : score.lesions) {
    const auto number = static_cast<std::size_t>(lesion.number);
    if (number >= codes.size()) codes.resize(number + 1, 0);
    const int role = static_cast<int>(calcium_role(lesion.place)) - static_cast<int>(Role::calcium_lm);
    codes[number] = static_cast<std::uint8_t>(1 + role);
  }
  return codes;
}

}  // namespace

Role calcium_role(analysis::CalciumPlace place) {
  switch (place) {
    case analysis::CalciumPlace::left_main:
      return Role::calcium_lm;
    case analysis::CalciumPlace::lad:
      return Role::calcium_lad;
    case analysis::CalciumPlace::lcx:
      return Role::calcium_lcx;
    case analysis::CalciumPlace::rca:
      return Role::calcium_rca;
    default:
      return Role::calcium_elsewhere;
  }
}

CalciumLayer::CalciumLayer(PlaneView& view, session::CalciumBoard& board) : view_(view), board_(board) {
  view_.set_layer([this](Overlay& overlay) { draw(overlay); }, PictureView::LayerPlace::calcium);
  own_.push_back(board.changed.observe([this] { view_.touch_layer(); }));
  own_.push_back(board.chosen.observe([this](const int&) { view_.touch_layer(); }));
  own_.push_back(board.shown.observe([this](const bool&) { view_.touch_layer(); }));
}

CalciumLayer::~CalciumLayer() {
  view_.set_layer({}, PictureView::LayerPlace::calcium);
}

std::shared_ptr<const OverlayTint> CalciumLayer::made() const {
  if (!view_.ready() || !board_.reading()) return nullptr;
  const imaging::Volume<std::int32_t>& numbers = board_.reading()->scored->lesion_numbers;
  const imaging::Geometry& grid = numbers.geometry;
  const std::vector<std::uint8_t> codes = codes_of(board_.score());
  OverlayTint tint = blank_tint(
      view_, {0.0, 0.0}, {static_cast<double>(view_.width()), static_cast<double>(view_.height())},
      {Role::calcium_lm, Role::calcium_lad, Role::calcium_lcx, Role::calcium_rca, Role::calcium_elsewhere});
  tint.opacity = calcium_opacity;
  // Places of the picture are a linear map of its pixels, and so are the grid's indices.
  const Vec3 first = grid.index(*view_.world({0.5, 0.5}));
  const Vec3 right = grid.index(*view_.world({1.5, 0.5})) - first,
             down = grid.index(*view_.world({0.5, 1.5})) - first;
  fill_tint(tint, [&](double y, std::uint8_t* row) {
    Vec3 at = first + (y - 0.5) * down;
    for (int i = 0; i < tint.width; ++i, at += right) {
      const std::int64_t x = std::llround(at.x()), z = std::llround(at.z()), v = std::llround(at.y());
      if (x < 0 || v < 0 || z < 0 || x >= grid.size[0] || v >= grid.size[1] || z >= grid.size[2]) continue;
      row[i] = codes[static_cast<std::size_t>(numbers(x, v, z))];
    }
  });
  return std::make_shared<const OverlayTint>(std::move(tint));
}

const std::shared_ptr<const OverlayTint>& CalciumLayer::tint() {
  return tint_.of({board_.revision(), view_.placement_revision(), 0}, [this] { return made(); });
}

void CalciumLayer::draw(Overlay& overlay) {
  if (!board_.shown.get() || !board_.is_of(view_.bench().shown_image())) return;
  if (tint()) overlay.tints.push_back(tint());
  const analysis::CalciumLesion* chosen = board_.lesion(board_.chosen.get());
  const auto at = chosen ? view_.project(chosen->centre) : std::nullopt;
  if (!at) return;
  const double half_mm = 0.5 * chosen->slices * board_.score().scored_slice_mm;
  if (std::abs(at->out_mm) <= half_mm)
    overlay.marks.push_back({at->px, Role::selected, ring_units, 1.0, false});
}

}  // namespace ostia::view
