#pragma once
/// \file Palette and style of the interface, dark and light.

namespace ostia::workstation {

enum class Theme { dark, light };

/// Sets palette and style of the whole application.
void apply_theme(Theme theme);
Theme current_theme();

}  // namespace ostia::workstation
