#include "vessels/tips.h"

#include "commands/command.h"

namespace ostia::workstation::vessel_tips {

QString split() {
  return Command::tr(
      "Makes two vessels of this one; the second begins at the cursor and "
      "takes the side branches from there on.");
}

QString merge() {
  return Command::tr("Makes this vessel part of the one from whose end it goes on; takes a split back.");
}

QString cut() {
  return Command::tr(
      "Cuts the vessel in two; what lies distal of the cursor, with its "
      "branches, is a tree of its own.");
}

QString connect() {
  return Command::tr(
      "A new piece of vessel leads from the cursor to where the vessel that you choose begins.");
}

}  // namespace ostia::workstation::vessel_tips
