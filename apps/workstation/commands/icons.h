#pragma once
/// \file Pictures on buttons, drawn as lines in the theme's colours at any size.

#include <QIcon>
#include <QString>

namespace ostia::workstation {

/// Of a command ("tool.brush"); a null icon for one that has no picture.
QIcon command_icon(const QString& id);

}  // namespace ostia::workstation
