#pragma once
/// \file Finding a command by what a person types.

#include <QString>
#include <QStringList>
#include <optional>
#include <vector>

namespace ostia::workstation {

/// How well something fits what was typed.
struct Match {
  int rank = 0;            ///< 0 is best
  bool scattered = false;  ///< by single characters alone
  std::vector<int> marks;  ///< places of the text's characters that were typed, ascending
};

/// Upper and lower case are the same. It fits where each typed word is in the text or its menus, in any
/// order, or where the text has all typed characters in their order ("cpr l" in "Turn the CPRs left"). Better
/// is what begins like it, then words that begin so, then what is within words, then the menus, then
/// scattered characters. Nothing typed fits everything.
std::optional<Match> match(const QString& typed, const QString& text, const QStringList& menus);

}  // namespace ostia::workstation
