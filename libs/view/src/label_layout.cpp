#include "ostia/view/label_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ostia::view {
namespace {

constexpr int ring_directions = 16;
constexpr double leader_gaps = 2.5;  // farther from its anchor, in gaps, a label has a leader
constexpr double line_gaps = 0.25;   // that a label keeps from lines

/// What a label keeps off, beside what it may never cover.
enum class Care { all_lines, own_lines_and_anchors, own_lines, none };

double distance_to(const LabelRect& rect, const Vec2& place) {
  return (place - place.cwiseMax(rect.low).cwiseMin(rect.low + rect.size)).norm();
}

class Placing {
 public:
  Placing(const std::vector<LabelWish>& wishes, const LabelRoom& room)
      : wishes_(wishes), room_(room), taken_(room.taken) {}

  PlacedLabel place(std::size_t i) {
    const LabelWish& wish = wishes_[i];
    PlacedLabel out;
    const bool inside =
        (wish.anchor.array() >= 0.0).all() && (wish.anchor.array() <= room_.size.array()).all();
    if (!inside || !wish.size.allFinite()) return out;
    std::optional<Vec2> low = beside(i, Care::all_lines);
    for (const Care care : {Care::own_lines_and_anchors, Care::own_lines})
      if (!low) low = near(i, care);
    if (!low) low = anywhere(i, Care::own_lines);
    if (!low && !wish.lines.empty()) low = near(i, Care::none);
    if (!low && !wish.lines.empty()) low = anywhere(i, Care::none);
    if (!low) return out;
    out.shown = true;
    out.rect = {*low, wish.size};
    taken_.push_back(out.rect);
    if (distance_to(out.rect, wish.anchor) > leader_gaps * room_.gap)
      out.leader_to = wish.anchor.cwiseMax(out.rect.low).cwiseMin(out.rect.low + out.rect.size);
    return out;
  }

 private:
  bool free(const Vec2& low, const Vec2& size) const {
    const LabelRect rect{low, size};
    if ((low.array() < 0.0).any() || ((low + size).array() > room_.size.array()).any()) return false;
    return std::none_of(taken_.begin(), taken_.end(), [&](const LabelRect& one) { return one.meets(rect); });
  }
  bool covers_anchor(const Vec2& low, const Vec2& size) const {
    return std::any_of(wishes_.begin(), wishes_.end(), [&](const LabelWish& one) {
      return (one.anchor.array() > low.array()).all() && (one.anchor.array() < (low + size).array()).all();
    });
  }

  bool covers_line(const LabelRect& rect, const LabelWish& of) const {
    return std::any_of(of.lines.begin(), of.lines.end(),
                       [&](const LabelLine& line) { return line.crosses(rect, line_gaps * room_.gap); });
  }
  bool fits(std::size_t i, const Vec2& low, Care care) const {
    const LabelWish& wish = wishes_[i];
    const LabelRect rect{low, wish.size};
    if (!free(low, wish.size)) return false;
    if (care == Care::none) return true;
    if (covers_line(rect, wish)) return false;
    if (care == Care::own_lines) return true;
    if (covers_anchor(low, wish.size)) return false;
    return care == Care::own_lines_and_anchors ||
           std::none_of(wishes_.begin(), wishes_.end(),
                        [&](const LabelWish& other) { return covers_line(rect, other); });
  }
  bool was_near(const LabelWish& wish) const {
    return wish.before && distance_to({*wish.before, wish.size}, Vec2::Zero()) <= leader_gaps * room_.gap;
  }

  /// Where it was, if that is near, and the eight places beside the anchor.
  std::optional<Vec2> beside(std::size_t i, Care care) const {
    const LabelWish& wish = wishes_[i];
    // A line of another that comes by does not make it jump.
    const Care least = std::max(care, Care::own_lines_and_anchors);
    if (was_near(wish) && fits(i, wish.anchor + *wish.before, least)) return wish.anchor + *wish.before;
    const double g = room_.gap, w = wish.size.x(), h = wish.size.y();
    const std::array<Vec2, 8> places{Vec2(g, -g - h),      Vec2(g, g),      Vec2(-g - w, -g - h),
                                     Vec2(-g - w, g),      Vec2(g, -h / 2), Vec2(-g - w, -h / 2),
                                     Vec2(-w / 2, -g - h), Vec2(-w / 2, g)};
    for (const Vec2& offset : places)
      if (const Vec2 low = wish.anchor + offset; fits(i, low, care)) return low;
    return std::nullopt;
  }

  /// Beside the anchor, where it was far from it, then rings about it.
  std::optional<Vec2> near(std::size_t i, Care care) const {
    const LabelWish& wish = wishes_[i];
    if (const std::optional<Vec2> low = beside(i, care)) return low;
    if (wish.before && fits(i, wish.anchor + *wish.before, care)) return wish.anchor + *wish.before;
    const double g = room_.gap, h = wish.size.y();
    const double step = std::max(1.0, 0.5 * h), farthest = room_.size.norm();
    for (double reach = g + h; reach < farthest; reach += step)
      for (int d = 0; d < ring_directions; ++d) {
        const double angle = 2.0 * std::numbers::pi * d / ring_directions;
        const Vec2 towards(std::cos(angle), -std::sin(angle));
        const Vec2 middle = wish.anchor + reach * towards + 0.5 * wish.size.cwiseProduct(towards);
        if (const Vec2 low = middle - 0.5 * wish.size; fits(i, low, care)) return low;
      }
    return std::nullopt;
  }

  /// The nearest free place beside what is taken, or at the view's rim: where any is free, one of these is.
  std::optional<Vec2> anywhere(std::size_t i, Care care) const {
    const LabelWish& wish = wishes_[i];
    std::vector<double> xs{0.0, room_.size.x() - wish.size.x()}, ys{0.0, room_.size.y() - wish.size.y()};
    for (const LabelRect& one : taken_) {
      xs.insert(xs.end(), {one.low.x() + one.size.x(), one.low.x() - wish.size.x()});
      ys.insert(ys.end(), {one.low.y() + one.size.y(), one.low.y() - wish.size.y()});
    }
    std::optional<Vec2> best;
    double nearest = 0.0;
    for (const double y : ys)
      for (const double x : xs) {
        const double away = distance_to({Vec2(x, y), wish.size}, wish.anchor);
        if ((best && away >= nearest) || !fits(i, {x, y}, care)) continue;
        best = Vec2(x, y), nearest = away;
      }
    return best;
  }

  const std::vector<LabelWish>& wishes_;
  const LabelRoom& room_;
  std::vector<LabelRect> taken_;
};

}  // namespace

/// By the stretch of the line that lies between each pair of sides.
bool LabelLine::crosses(const LabelRect& rect, double margin) const {
  const Vec2 low = rect.low - Vec2::Constant(margin), high = rect.low + rect.size + Vec2::Constant(margin);
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double along = to[axis] - from[axis], before = low[axis] - from[axis],
                 past = high[axis] - from[axis];
    if (along == 0.0) {
      if (before >= 0.0 || past <= 0.0) return false;
      continue;
    }
    enter = std::max(enter, std::min(before / along, past / along));
    leave = std::min(leave, std::max(before / along, past / along));
  }
  return enter < leave;
}

std::vector<PlacedLabel> place_labels(const std::vector<LabelWish>& wishes, const LabelRoom& room) {
  Placing placing(wishes, room);
  std::vector<PlacedLabel> out;
  for (std::size_t i = 0; i < wishes.size(); ++i) out.push_back(placing.place(i));
  return out;
}

}  // namespace ostia::view
