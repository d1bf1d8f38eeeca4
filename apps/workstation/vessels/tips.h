#pragma once
/// \file What edits of whole vessels do, for the menu and the list of vessels.

#include <QString>

namespace ostia::workstation::vessel_tips {

QString split();
QString merge();
QString cut();
QString connect();

}  // namespace ostia::workstation::vessel_tips
