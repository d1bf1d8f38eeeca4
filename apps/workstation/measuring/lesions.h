#pragma once
/// \file The lesions of the case in the window: their plaque is found in the background, and commands walk
/// through them.

#include "measuring/lesion_list.h"
#include "shell/board_work.h"

#include "ostia/session/lesion_board.h"

#include <QObject>
#include <QPointer>
#include <memory>

namespace ostia::workstation {

class CommandTable;
struct Desk;

/// Looks for the plaque of every vessel of a case with an image, after an edit again, in a thread of its own.
/// Goes before the list that it fills, and before the board that it asks.
class Lesions final : public QObject {
  Q_OBJECT
 public:
  /// `found`: where the outer wall's display looks for walls, too.
  Lesions(Desk& desk, session::EvaluabilityBoard& evaluability, std::shared_ptr<session::FoundWalls> found,
          LesionList& list);
  ~Lesions() override;
  session::LesionBoard& board() { return board_; }
  LesionList& list() { return *list_; }
  /// Nothing is being looked for, nor will be before the next edit.
  bool idle() const { return work_.idle(); }

 private:
  Desk& desk_;
  session::LesionBoard board_;
  QPointer<LesionList> list_;
  BoardWork<session::LesionBoard, session::PlaqueWork> work_;
};

void add_lesion_commands(CommandTable& table, Desk& desk, Lesions& lesions);

}  // namespace ostia::workstation
