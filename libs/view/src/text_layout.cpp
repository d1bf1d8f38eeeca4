#include "ostia/view/text_layout.h"

#include <algorithm>
#include <cmath>

namespace ostia::view {
namespace {

constexpr double least_scale = 0.7;  // of the font, where a text is wider than the view
constexpr double most_lines = 14.0;  // that a text moves to make room
constexpr double label_gap = 6.0;    // units between a label and its anchor
constexpr double rim_units = 2.0;    // units that a long text keeps from both sides together
constexpr const char* ellipsis = "\u2026";

bool in_middle(Anchor anchor) {
  return anchor == Anchor::top || anchor == Anchor::middle || anchor == Anchor::bottom;
}
bool at_right(Anchor anchor) {
  return anchor == Anchor::top_right || anchor == Anchor::right || anchor == Anchor::bottom_right;
}
bool at_bottom(Anchor anchor) {
  return anchor == Anchor::bottom_left || anchor == Anchor::bottom || anchor == Anchor::bottom_right;
}
bool half_way(Anchor anchor) {
  return anchor == Anchor::left || anchor == Anchor::middle || anchor == Anchor::right;
}

/// Without its last letter, which may be of several bytes.
void drop_letter(std::string& text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.pop_back();
  if (!text.empty()) text.pop_back();
}

class TextPlacing {
 public:
  TextPlacing(const TextMeasure& measure, const TextRoom& room) : measure_(measure), room_(room) {}

  PlacedText sized(const OverlayText& text) const {
    PlacedText out;
    out.text = text.text;
    const double most = room_.size.x() - rim_units * room_.density;
    double wide = measure_.width(out.text, 1.0);
    if (wide > most && wide > 0.0) {
      out.scale = std::clamp(most / wide, least_scale, 1.0);
      wide = measure_.width(out.text, out.scale);
    }
    std::string head = text.text;
    while (wide > most && !head.empty()) {
      drop_letter(head);
      out.text = head + ellipsis;
      out.whole = false;
      wide = measure_.width(out.text, out.scale);
    }
    out.rect.size = Vec2(wide, std::ceil(out.scale * measure_.line));
    return out;
  }

  void place(const OverlayText& text, PlacedText& out) {
    Vec2 low = text.px;
    if (in_middle(text.anchor)) low.x() -= 0.5 * out.rect.size.x();
    if (at_right(text.anchor)) low.x() -= out.rect.size.x();
    if (half_way(text.anchor)) low.y() -= 0.5 * out.rect.size.y();
    if (at_bottom(text.anchor)) low.y() -= out.rect.size.y();
    const Vec2 last = room_.size - out.rect.size;
    if (out.text.empty() || !low.allFinite() || last.y() < 0.0) return;
    out.rect.low = low.cwiseMin(last).cwiseMax(Vec2::Zero());
    out.shown = text.stays ? free(out.rect) : make_room(text.anchor, out.rect);
    if (out.shown) taken.push_back(out.rect);
  }

  std::vector<LabelRect> taken;

 private:
  bool free(const LabelRect& rect) const {
    return std::none_of(taken.begin(), taken.end(), [&](const LabelRect& one) { return one.meets(rect); });
  }
  bool make_room(Anchor anchor, LabelRect& rect) const {
    const double step = std::max(1.0, measure_.line / 14.0), last = room_.size.y() - rect.size.y();
    const LabelRect wished = rect;
    for (double away = 0.0; away <= most_lines * measure_.line; away += step)
      for (const double side : {1.0, -1.0}) {
        if (!half_way(anchor) && side != (at_bottom(anchor) ? -1.0 : 1.0)) continue;
        rect.low.y() = wished.low.y() + side * away;
        if (rect.low.y() >= 0.0 && rect.low.y() <= last && free(rect)) return true;
      }
    return false;
  }
  const TextMeasure& measure_;
  const TextRoom& room_;
};

std::vector<LabelLine> pieces_of(std::int32_t id, const std::vector<OverlayLine>& lines) {
  std::vector<LabelLine> pieces;
  for (const OverlayLine& line : lines) {
    if (line.of != id) continue;
    for (std::size_t i = 1; i < line.px.size(); ++i) pieces.push_back({line.px[i - 1], line.px[i]});
  }
  return pieces;
}

void place_all_labels(const std::vector<OverlayText>& texts, const std::vector<OverlayLine>& lines,
                      const TextRoom& room, std::vector<LabelRect> taken, std::vector<PlacedText>& out) {
  std::vector<LabelWish> wishes;
  std::vector<std::size_t> whose;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (!texts[i].label_of) continue;
    const auto before = room.before.find(*texts[i].label_of);
    wishes.push_back({texts[i].px, out[i].rect.size, {}, pieces_of(*texts[i].label_of, lines)});
    if (before != room.before.end()) wishes.back().before = before->second;
    whose.push_back(i);
  }
  const std::vector<PlacedLabel> placed =
      place_labels(wishes, {room.size, label_gap * room.density, std::move(taken)});
  for (std::size_t k = 0; k < placed.size(); ++k) {
    PlacedText& one = out[whose[k]];
    const Vec2& anchor = wishes[k].anchor;
    one.outside = !((anchor.array() >= 0.0).all() && (anchor.array() <= room.size.array()).all());
    one.shown = placed[k].shown;
    if (!one.shown) continue;
    one.rect = placed[k].rect;
    one.leader_to = placed[k].leader_to;
  }
}

}  // namespace

std::vector<PlacedText> lay_out_texts(const std::vector<OverlayText>& texts,
                                      const std::vector<OverlayLine>& lines, const TextMeasure& measure,
                                      const TextRoom& room) {
  TextPlacing placing(measure, room);
  std::vector<PlacedText> out;
  for (const OverlayText& text : texts) out.push_back(placing.sized(text));
  for (const bool staying : {true, false})
    for (std::size_t i = 0; i < texts.size(); ++i)
      if (!texts[i].label_of && texts[i].stays == staying) placing.place(texts[i], out[i]);
  place_all_labels(texts, lines, room, placing.taken, out);
  return out;
}

}  // namespace ostia::view
