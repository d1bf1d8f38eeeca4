#pragma once
/// \file The cells of a view that contour lines are followed through.

#include "ostia/lumen/contour_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::lumen {

/// Square cells from the picture's first corner on; the last column and row end at its border.
class ViewGrid {
 public:
  ViewGrid(ViewSurface view, const ContourLineOptions& options) : view_(std::move(view)) {
    step_ = std::clamp(options.largest_mm / view_.pixel_mm, 0.25, options.step_px);
    columns_ = static_cast<int>(std::ceil(view_.width / step_));
    rows_ = static_cast<int>(std::ceil(view_.height / step_));
    if (view_.row) row_.resize(static_cast<std::size_t>(rows_) + 1);
  }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double pixel_mm() const { return view_.pixel_mm; }
  double cell_mm() const { return step_ * view_.pixel_mm; }

  bool holds(const Vec2& px) const {
    return px.x() >= 0.0 && px.y() >= 0.0 && px.x() <= view_.width && px.y() <= view_.height;
  }
  Vec2 corner(int column, int row) const {
    return {std::min(column * step_, static_cast<double>(view_.width)),
            std::min(row * step_, static_cast<double>(view_.height))};
  }
  std::array<int, 2> cell_at(const Vec2& px) const {
    return {std::clamp(static_cast<int>(px.x() / step_), 0, columns_ - 1),
            std::clamp(static_cast<int>(px.y() / step_), 0, rows_ - 1)};
  }
  std::array<int, 2> corner_near(const Vec2& px) const {
    return {std::clamp(static_cast<int>(std::lround(px.x() / step_)), 0, columns_),
            std::clamp(static_cast<int>(std::lround(px.y() / step_)), 0, rows_)};
  }

  /// From many threads.
  Vec3 place(const Vec2& px) const {
    if (!view_.row) return view_.world(px);
    const ViewRow row = view_.row(px.y());
    return row.start + px.x() * row.along;
  }
  /// A place between two corners of one row of cells; from one thread.
  Vec3 place_on_row(double x, int row) {
    const double y = std::min(row * step_, static_cast<double>(view_.height));
    if (!view_.row) return view_.world({x, y});
    std::optional<ViewRow>& kept = row_[static_cast<std::size_t>(row)];
    if (!kept) kept = view_.row(y);
    return kept->start + x * kept->along;
  }

 private:
  ViewSurface view_;
  double step_ = 1.0;
  int columns_ = 0, rows_ = 0;
  std::vector<std::optional<ViewRow>> row_;
};

/// A number for each place of a large grid of which only a small part is used; -1 where none was set.
class TiledIndex {
 public:
  TiledIndex(int columns, int rows)
      : across_((columns >> shift) + 1),
        tiles_(static_cast<std::size_t>(across_) * static_cast<std::size_t>((rows >> shift) + 1)) {}
  std::int32_t& at(int column, int row) {
    std::unique_ptr<Tile>& tile =
        tiles_[static_cast<std::size_t>(row >> shift) * across_ + static_cast<std::size_t>(column >> shift)];
    if (!tile) {
      tile = std::make_unique<Tile>();
      tile->fill(-1);
    }
    return (*tile)[static_cast<std::size_t>((row & mask) << shift | (column & mask))];
  }

 private:
  static constexpr int shift = 5, mask = (1 << shift) - 1;
  using Tile = std::array<std::int32_t, (1 << shift) * (1 << shift)>;
  std::size_t across_;
  std::vector<std::unique_ptr<Tile>> tiles_;
};

}  // namespace ostia::lumen
