#include "ostia/view/label_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ostia::view {
namespace {

constexpr int ring_directions = 16;
constexpr double leader_gaps = 2.5;  // farther from its anchor, in gaps, a label has a leader

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
    std::optional<Vec2> low = near(i, true);
    if (!low) low = near(i, false);
    if (!low) low = anywhere(wish);
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

  /// Where it was, the eight places beside the anchor, then rings about it.
  std::optional<Vec2> near(std::size_t i, bool off_anchors) const {
    const LabelWish& wish = wishes_[i];
    const Vec2 size = wish.size;
    const auto fits = [&](const Vec2& low) {
      return free(low, size) && !(off_anchors && covers_anchor(low, size));
    };
    const double g = room_.gap, w = size.x(), h = size.y();
    const auto stays = [&] { return wish.before && fits(wish.anchor + *wish.before); };
    const bool was_near = wish.before && distance_to({*wish.before, size}, Vec2::Zero()) <= leader_gaps * g;
    if (was_near && stays()) return wish.anchor + *wish.before;
    const std::array<Vec2, 8> beside{Vec2(g, -g - h),      Vec2(g, g),      Vec2(-g - w, -g - h),
                                     Vec2(-g - w, g),      Vec2(g, -h / 2), Vec2(-g - w, -h / 2),
                                     Vec2(-w / 2, -g - h), Vec2(-w / 2, g)};
    for (const Vec2& offset : beside)
      if (const Vec2 low = wish.anchor + offset; fits(low)) return low;
    if (stays()) return wish.anchor + *wish.before;
    const double step = std::max(1.0, 0.5 * h), farthest = room_.size.norm();
    for (double reach = g + h; reach < farthest; reach += step)
      for (int d = 0; d < ring_directions; ++d) {
        const double angle = 2.0 * std::numbers::pi * d / ring_directions;
        const Vec2 towards(std::cos(angle), -std::sin(angle));
        const Vec2 middle = wish.anchor + reach * towards + 0.5 * size.cwiseProduct(towards);
        if (const Vec2 low = middle - 0.5 * size; fits(low)) return low;
      }
    return std::nullopt;
  }

  /// The nearest free place beside what is taken, or at the view's rim: where any is free, one of these is.
  std::optional<Vec2> anywhere(const LabelWish& wish) const {
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
        if ((best && away >= nearest) || !free({x, y}, wish.size)) continue;
        best = Vec2(x, y), nearest = away;
      }
    return best;
  }

  const std::vector<LabelWish>& wishes_;
  const LabelRoom& room_;
  std::vector<LabelRect> taken_;
};

}  // namespace

std::vector<PlacedLabel> place_labels(const std::vector<LabelWish>& wishes, const LabelRoom& room) {
  Placing placing(wishes, room);
  std::vector<PlacedLabel> out;
  for (std::size_t i = 0; i < wishes.size(); ++i) out.push_back(placing.place(i));
  return out;
}

}  // namespace ostia::view
