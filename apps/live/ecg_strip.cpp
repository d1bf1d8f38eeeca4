#include "ecg_strip.h"

#include "look_of_windows.h"
#include "panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace ostia::live {
namespace {

constexpr double shown_s = 6.0;
constexpr float left = 18.0F, right_room = 26.0F, top_room = 18.0F, bottom_room = 40.0F;

struct Frame {
  ImVec2 low, high;  // px
  double from_s, to_s;
  double least, most;
  float x(double time_s) const {
    return low.x + (high.x - low.x) * static_cast<float>((time_s - from_s) / (to_s - from_s));
  }
  float y(double value) const {
    return high.y - (high.y - low.y) * static_cast<float>((value - least) / (most - least));
  }
};

/// The span of what is seen, with some room; a flat line is in the middle.
void fit_values(const EcgFeed& feed, std::size_t first, Frame& frame) {
  double least = 1e300, most = -1e300;
  for (std::size_t i = first; i < feed.samples(); ++i) {
    const double v = feed.value(i);
    if (std::isnan(v)) continue;
    least = std::min(least, v);
    most = std::max(most, v);
  }
  if (least > most) least = most = 0.0;
  const double room = std::max(0.08 * (most - least), 0.05);
  frame.least = least - room;
  frame.most = most + room;
}

void draw_line(ImDrawList& draw, const EcgFeed& feed, std::size_t first, const Frame& frame) {
  const double column_s =
      (frame.to_s - frame.from_s) / std::max(1.0, static_cast<double>(frame.high.x - frame.low.x));
  std::vector<ImVec2> points;
  for (const std::vector<LinePoint>& line : lines_of(feed, first, column_s)) {
    points.clear();
    for (const LinePoint& point : line) points.push_back({frame.x(point.time_s), frame.y(point.value)});
    if (points.size() > 1)
      draw.AddPolyline(points.data(), static_cast<int>(points.size()), ecg_color, ImDrawFlags_None, 1.6F);
  }
}

void draw_phase(ImDrawList& draw, const Playback& playback, const Frame& frame) {
  const float y = frame.high.y + 16.0F, wide = frame.high.x - frame.low.x;
  const auto shown = static_cast<float>(playback.phase());
  draw.AddRectFilled({frame.low.x, y}, {frame.high.x, y + 6.0F}, grid_color, 3.0F);
  draw.AddRectFilled({frame.low.x, y}, {frame.low.x + wide * shown, y + 6.0F}, accent_mark, 3.0F);
  draw.AddCircleFilled({frame.low.x + wide * shown, y + 3.0F}, 6.0F, accent_mark);
  draw.AddText({frame.low.x, y + 8.0F}, muted_mark, "R");
  draw.AddText({frame.high.x - 8.0F, y + 8.0F}, muted_mark, "R");
  draw.AddText({frame.low.x + 0.5F * wide - 12.0F, y + 8.0F}, muted_mark, "50 %");
}

}  // namespace

void draw_ecg_strip(const Playback& playback, int width, int height) {
  const EcgFeed* feed = playback.feed();
  if (feed == nullptr) return;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const float top = static_cast<float>(height - strip_height), wide = static_cast<float>(width);
  Frame frame{{left, top + top_room},
              {wide - right_room, static_cast<float>(height) - bottom_room},
              feed->time_s() - shown_s,
              feed->time_s(),
              0.0,
              1.0};
  const auto first =
      static_cast<std::size_t>(std::ceil(std::max(0.0, frame.from_s) * feed->samples_per_second()));
  fit_values(*feed, first, frame);
  for (double t = std::ceil(frame.from_s); t <= frame.to_s; t += 1.0) {
    if (t < 0.0) continue;
    draw.AddLine({frame.x(t), frame.low.y}, {frame.x(t), frame.high.y}, grid_color);
    char text[32];
    std::snprintf(text, sizeof(text), "%.0f s", t);
    draw.AddText({frame.x(t) + 3.0F, top + 2.0F}, muted_mark, text);
  }
  for (const double peak : feed->peaks()) {
    if (peak < frame.from_s) continue;
    const float x = frame.x(peak);
    draw.AddLine({x, frame.low.y}, {x, frame.high.y}, peak_line);
    draw.AddTriangleFilled({x - 5.0F, frame.high.y + 8.0F}, {x + 5.0F, frame.high.y + 8.0F},
                           {x, frame.high.y}, peak_mark);
  }
  draw_line(draw, *feed, first, frame);
  if (feed->samples() > 0 && !std::isnan(feed->value(feed->samples() - 1)))
    draw.AddCircleFilled({frame.high.x, frame.y(feed->value(feed->samples() - 1))}, 3.5F, text_color);
  draw_phase(draw, playback, frame);
}

}  // namespace ostia::live
