#pragma once
/// \file Commands that change where the person looks, and how.

#include <vector>

class QActionGroup;

namespace ostia::workstation {

class CommandTable;
struct Desk;
class PictureWidget;
class SceneWidget;

void add_view_commands(CommandTable& table, Desk& desk, const std::vector<PictureWidget*>& pictures,
                       SceneWidget& scene, QActionGroup& tools);

}  // namespace ostia::workstation
