#pragma once
/// \file What commands and gestures do, in words.

#include <QString>
#include <vector>

namespace ostia::workstation {

/// One sentence on a command; empty for one that needs none.
QString command_tip(const QString& id);
/// The part of the interface that a command belongs to ("Tools"), for lists.
QString command_group(const QString& id);
/// A menu's text without mnemonic and dots.
QString plain_text(QString text);

struct MouseGesture {
  QString where, gesture, does;
};
std::vector<MouseGesture> mouse_gestures();

}  // namespace ostia::workstation
