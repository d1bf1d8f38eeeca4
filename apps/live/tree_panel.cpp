// What the tree's viewer writes: facts of what was picked, measures, marks over the picture.
#include "look_of_windows.h"
#include "panel.h"
#include "tree_viewer.h"

#include <imgui.h>

#include <array>
#include <cstdio>
#include <numbers>
#include <string>

namespace ostia::live {
namespace {

using geometry::Vec3;

constexpr std::array<std::array<const char*, 2>, 14> tree_keys{
    {{"drag", "turn"},
     {"Shift + drag", "move"},
     {"wheel", "nearer, to what is under the mouse"},
     {"click", "choose a segment"},
     {"F, double click", "the segment and all behind it"},
     {"T", "only that, or all"},
     {"R", "what lies in a ball about the place"},
     {"G", "grid of coordinates"},
     {"Backspace", "forget what was chosen"},
     {"Home", "all in the picture"},
     {"S", "screenshot"},
     {"Tab", "panel away"},
     {"H", "this help"},
     {"Q", "quit"}}};

void tree_heading(const char* text) {
  ImGui::Dummy({0.0F, 5.0F});
  ImGui::TextColored(muted_color, "%s", text);
  ImGui::Separator();
}

void totals(const analysis::SubtreeTotals& all) {
  ImGui::Text("%d segment%s", all.segments, all.segments == 1 ? "" : "s");
  ImGui::Text("%.6g mm, %.6g mm2", all.length_mm, all.area_mm2);
  ImGui::Text("%.6g mm3", all.volume_mm3);
}

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

ImVec2 at(const geometry::Vec2& place) {
  return {static_cast<float>(place.x()), static_cast<float>(place.y())};
}

}  // namespace

void TreeViewer::facts() {
  tree_heading("CHOSEN");
  if (picked_.empty()) {
    ImGui::TextWrapped("Click a segment to see its facts.");
    return;
  }
  const analysis::SegmentFacts one = input_.ruler->facts(picked_.back().edge);
  ImGui::TextColored(accent_color, "%s %lld", input_.reference_name.c_str(),
                     static_cast<long long>(one.reference));
  ImGui::Text("length %.6g mm", one.cone.length_mm);
  ImGui::Text("radius %.6g to %.6g mm", one.radius_from_mm, one.radius_to_mm);
  ImGui::Text("lateral area %.6g mm2", one.cone.area_mm2);
  ImGui::Text("volume %.6g mm3", one.cone.volume_mm3);
  if (!one.of_tree) {
    ImGui::TextWrapped("Orders and what lies behind it are known of trees alone.");
    return;
  }
  ImGui::Text("Strahler order %d, by diameter %d", one.strahler, one.diameter_order);
  ImGui::Text("from the root %.6g mm", one.from_root_mm);
  if (const analysis::ForkAngles* fork = input_.ruler->fork_behind(picked_.back().edge))
    ImGui::TextWrapped("At its fork %.1f degrees between the two, %.1f and %.1f from the parent",
                       degrees(fork->between_rad), degrees(fork->wide_rad), degrees(fork->narrow_rad));
  tree_heading("WITH ALL BEHIND IT");
  totals(one.behind);
  if (ImGui::Button("Go there", {110.0F, 0.0F})) go_to_subtree();
  ImGui::SameLine();
  if (ImGui::Button(shown_.empty() ? "Only this" : "All", {-1.0F, 0.0F})) show_subtree(shown_.empty());
}

void TreeViewer::measures() {
  if (picked_.size() == 2) {
    tree_heading("FROM THE PLACE BEFORE");
    ImGui::Text("straight %.6g mm", input_.ruler->straight_mm(picked_[0], picked_[1]));
    if (const auto along = input_.ruler->along_mm(picked_[0], picked_[1]))
      ImGui::Text("along the tree %.6g mm", *along);
    if (const auto angle = input_.ruler->angle_rad(picked_[0].edge, picked_[1].edge))
      ImGui::Text("between the two %.2f degrees", degrees(*angle));
  }
  if (!region_ || picked_.empty()) return;
  tree_heading("IN A BALL ABOUT THE PLACE");
  ImGui::SetNextItemWidth(-70.0F);
  const bool other = ImGui::InputFloat("mm", &region_mm_, 0.0F, 0.0F, "%.4g");
  if (!(region_mm_ >= 0.0F)) region_mm_ = 0.0F;
  if (other || !within_)
    within_ = input_.ruler->within(input_.ruler->point(picked_.back()), static_cast<double>(region_mm_));
  totals(*within_);
}

void TreeViewer::panel(int width, int height, double frames_per_second) {
  ImGui::SetNextWindowPos({static_cast<float>(width - panel_width), 0.0F});
  ImGui::SetNextWindowSize({static_cast<float>(panel_width), static_cast<float>(height)});
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus);
  tree_heading("TREE");
  ImGui::TextWrapped("%s", input_.name.c_str());
  ImGui::Text("%zu segment%s", shown_segments_, shown_segments_ == 1 ? "" : "s");
  facts();
  measures();
  tree_heading("PICTURE");
  ImGui::Text("%zu drawn, %zu too small", choice().chosen, choice().left_out);
  if (choice().hidden > 0) ImGui::Text("%zu behind others", choice().hidden);
  if (frames_per_second > 0.0) ImGui::TextColored(muted_color, "%.0f pictures/s", frames_per_second);
  ImGui::Checkbox("grid", &grid_);
  ImGui::SameLine();
  if (ImGui::Checkbox("ball", &region_)) within_.reset();
  if (ImGui::Button("Screenshot", {110.0F, 0.0F})) screenshot_ = true;
  ImGui::SameLine();
  if (ImGui::Button("Help", {-1.0F, 0.0F})) help_ = !help_;
  const std::size_t first = notices_.size() > 3 ? notices_.size() - 3 : 0;
  for (std::size_t i = first; i < notices_.size(); ++i) {
    ImGui::Separator();
    ImGui::PushStyleColor(ImGuiCol_Text, attention_color);
    ImGui::TextWrapped("%s", notices_[i].c_str());
    ImGui::PopStyleColor();
  }
  ImGui::End();
}

void TreeViewer::marks(int width, int height) {
  ImDrawList& draw = *ImGui::GetForegroundDrawList();
  draw.PushClipRect({0.0F, 0.0F}, {static_cast<float>(width), static_cast<float>(height)});
  std::optional<ImVec2> before;
  for (const analysis::TreePlace& place : picked_) {
    const auto seen = eye_.place_of(input_.ruler->point(place));
    if (!seen) continue;
    draw.AddCircle(at(*seen), 5.0F, accent_mark, 0, 2.0F);
    if (before) draw.AddLine(*before, at(*seen), accent_mark, 1.5F);
    before = at(*seen);
  }
  if (before && !picked_.empty()) {
    const analysis::SegmentFacts one = input_.ruler->facts(picked_.back().edge);
    char text[160];
    std::snprintf(text, sizeof(text), "%s %lld, %.4g mm", input_.reference_name.c_str(),
                  static_cast<long long>(one.reference), one.cone.length_mm);
    draw.AddText({before->x + 9.0F, before->y - 20.0F}, text_color, text);
  }
  // A scale, exact at the target.
  const analysis::GridScale scale = analysis::grid_scale(eye_.pixel_mm() * width / 4.0, 2);
  const float px = static_cast<float>(scale.step_mm / eye_.pixel_mm());
  const float y = static_cast<float>(height) - 18.0F, right = static_cast<float>(width) - 18.0F;
  draw.AddLine({right - px, y}, {right, y}, text_color, 2.0F);
  draw.AddText({right - px, y - 22.0F}, text_color, analysis::tick_text(scale.step_mm, scale).c_str());
  draw.PopClipRect();
  if (!help_) return;
  ImGui::SetNextWindowPos({static_cast<float>(width) / 2.0F, static_cast<float>(height) / 2.0F},
                          ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::Begin("help", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize);
  if (ImGui::BeginTable("keys", 2)) {
    for (const auto& [key, what] : tree_keys) {
      ImGui::TableNextColumn();
      ImGui::TextColored(accent_color, "%s", key);
      ImGui::TableNextColumn();
      ImGui::Text("%s", what);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

/// On the box's floor, and for z on its wall, as in the workstation.
void TreeViewer::grid() {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.PushClipRect({0.0F, 0.0F}, {static_cast<float>(eye_.width_px), static_cast<float>(eye_.height_px)});
  const Vec3 low = input_.blocks->low(), high = input_.blocks->high(), size = high - low;
  const double seen = eye_.pixel_mm() * eye_.height_px;
  const analysis::GridScale scale = analysis::grid_scale(std::max(1e-9, std::min(seen, 4.0 * size.norm())));
  double step = scale.step_mm;
  while (size.maxCoeff() / step > 200.0) step *= 10.0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double tick : analysis::grid_ticks(low[axis], high[axis], step)) {
      const int other = axis == 0 ? 1 : 0;
      Vec3 a = low, b = low;
      a[axis] = b[axis] = tick;
      b[other] = high[other];
      const auto from = eye_.place_of(a), to = eye_.place_of(b);
      if (!from || !to) continue;
      draw.AddLine(at(*from), at(*to), grid_color);
      draw.AddText(at(*from), muted_mark,
                   (std::string(1, "xyz"[axis]) + " " + analysis::tick_text(tick, scale)).c_str());
    }
  draw.PopClipRect();
}

}  // namespace ostia::live
