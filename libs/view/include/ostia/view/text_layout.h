#pragma once
/// \file Where all texts of a 2D view stand, so that none lies over another and none is cut off.

#include "ostia/view/label_layout.h"
#include "ostia/view/overlay.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace ostia::view {

/// How large texts are, by whoever paints them.
struct TextMeasure {
  std::function<double(const std::string& text, double scale)> width;  ///< px; `scale` of the usual font
  double line = 14.0;                                                  ///< a line's height in it, px
};

/// What texts there are, and what for.
struct TextRoom {
  Vec2 size = Vec2::Zero();  ///< of the view, px
  double density = 1.0;      ///< device pixels per unit of the interface
  /// Where labels stood in the picture before, less their anchors, by their measurements' ids.
  std::map<std::int32_t, Vec2> before = {};
};

struct PlacedText {
  std::string text;  ///< as it is painted
  LabelRect rect = {};
  double scale = 1.0;  ///< of the usual font
  bool shown = false;
  bool outside = false;                ///< a label whose anchor is not in the view: it is not shown
  bool whole = true;                   ///< false: it is too long for the view, and shortened
  std::optional<Vec2> leader_to = {};  ///< from the text's own place
};

/// One for each text, in their order. Texts that stay come first, then those that make room (one at the top
/// goes down, one at the bottom up, others either way), each in the order given, then labels of measurements
/// as place_labels puts them, off the lines of theirs. What would be cut off at the rim moves inwards; what
/// is wider than the view is written smaller, then shortened. A text without room is not shown.
std::vector<PlacedText> lay_out_texts(const std::vector<OverlayText>& texts,
                                      const std::vector<OverlayLine>& lines, const TextMeasure& measure,
                                      const TextRoom& room);

}  // namespace ostia::view
