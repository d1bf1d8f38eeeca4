#pragma once
/// \file Colours, font and style of panel and strip.

#include "ostia/figure/color.h"

#include <imgui.h>

namespace ostia::live {

inline const ImVec4 good_color{0.30F, 0.78F, 0.55F, 1.0F}, attention_color{0.95F, 0.75F, 0.25F, 1.0F},
    trouble_color{0.95F, 0.45F, 0.30F, 1.0F}, muted_color{0.58F, 0.63F, 0.68F, 1.0F},
    accent_color{0.42F, 0.72F, 0.95F, 1.0F};
inline constexpr ImU32 text_color = IM_COL32(228, 232, 236, 255), ink_on_grey = IM_COL32(24, 26, 30, 255),
                       muted_mark = IM_COL32(140, 150, 160, 255), grid_color = IM_COL32(52, 58, 64, 255),
                       ecg_color = IM_COL32(110, 220, 150, 255), peak_mark = IM_COL32(230, 159, 0, 255),
                       peak_line = IM_COL32(230, 159, 0, 70), accent_mark = IM_COL32(86, 180, 233, 255);

/// Of the panel, which is filled without Dear ImGui: it blends, which costs a software renderer dear.
inline constexpr figure::Color panel_background{0.105, 0.115, 0.13, 1.0};

/// Dear ImGui's context while it lives, with OpenGL's part of it. Writes no file.
class Windows {
 public:
  /// A context of OpenGL is current. Throws ResourceError.
  Windows();
  ~Windows();
  Windows(const Windows&) = delete;
  Windows& operator=(const Windows&) = delete;
};

}  // namespace ostia::live
