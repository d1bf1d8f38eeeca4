#pragma once
/// \file Groups of commands, and what gestures do, in words.

#include <QString>
#include <vector>

namespace ostia::workstation {

/// The part of the interface that a command belongs to ("Tools"), for lists.
QString command_group(const QString& id);
/// A menu's text without mnemonic and dots.
QString plain_text(QString text);

struct MouseGesture {
  QString where, gesture, does;
};
std::vector<MouseGesture> mouse_gestures();

}  // namespace ostia::workstation
