#pragma once
/// \file Where labels stand, so that none covers another: one layout for all views, 2D and 3D.

#include "ostia/geometry/vec.h"

#include <optional>
#include <vector>

namespace ostia::view {

using geometry::Vec2;

/// An upright rectangle, px; y runs down.
struct LabelRect {
  Vec2 low = Vec2::Zero(), size = Vec2::Zero();  ///< its corner with the least x and y
  bool meets(const LabelRect& other) const {
    return (low.array() < (other.low + other.size).array()).all() &&
           (other.low.array() < (low + size).array()).all();
  }
};

/// A straight piece of what is drawn, px.
struct LabelLine {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  /// Whether it runs through the rectangle, or by it within `margin`.
  bool crosses(const LabelRect& rect, double margin = 0.0) const;
};

struct LabelWish {
  Vec2 anchor = Vec2::Zero();  ///< what it is of
  Vec2 size = Vec2::Zero();
  /// `low` less `anchor` of the picture before: it stays there where it may, so that labels do not jump while
  /// anchors move.
  std::optional<Vec2> before = {};
  std::vector<LabelLine> lines = {};  ///< that it labels: it never covers them where there is other room
};

struct PlacedLabel {
  bool shown = false;  ///< false: its anchor is outside, or there is no room left
  LabelRect rect = {};
  /// From the anchor to the label's rim, where it stands so far away that one could take it for another's.
  std::optional<Vec2> leader_to = {};
};

struct LabelRoom {
  Vec2 size = Vec2::Zero();           ///< of the view
  double gap = 6.0;                   ///< between anchor and label
  std::vector<LabelRect> taken = {};  ///< texts that stay where they are
};

/// One for each wish, in their order: earlier ones choose first. Right above the anchor, or as near as there
/// is room: within the view, over no other label and nothing taken; over none of its own lines and no other
/// anchor where that can be, over no line of another where that costs no way. The same for the same input.
std::vector<PlacedLabel> place_labels(const std::vector<LabelWish>& wishes, const LabelRoom& room);

}  // namespace ostia::view
