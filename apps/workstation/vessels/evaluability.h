#pragma once
/// \file How far vessels can be judged, in the window: found in the background, shown, set by the reader.

#include "shell/board_work.h"

#include "ostia/session/evaluability_board.h"
#include "ostia/view/evaluability_layer.h"

#include <QObject>
#include <QPointer>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::workstation {

struct Desk;
class PictureWidget;
class ProfileWidget;
class SceneWidget;

/// Looks at every vessel of a case with an image, after an edit again, in a thread of its own. Goes before
/// the views that it draws on.
class Evaluability final : public QObject {
  Q_OBJECT
 public:
  Evaluability(Desk& desk, const std::vector<PictureWidget*>& pictures, ProfileWidget& profile,
               SceneWidget& scene);
  ~Evaluability() override;
  session::EvaluabilityBoard& board() { return board_; }
  /// The reader's word on the stretch of the chosen measurement along the vessel or, without one, on the
  /// stretch that the cursor is in; nothing: as the program finds it.
  void judge(std::optional<analysis::Evaluability> grade);
  /// Nothing is being looked at, nor will be before the next edit.
  bool idle() const { return work_.idle(); }
  /// Why there is no stretch to judge; empty where there is one.
  QString why_not() const;

 private:
  void color_tree();
  Desk& desk_;
  session::EvaluabilityBoard board_;
  QPointer<ProfileWidget> profile_;
  QPointer<SceneWidget> scene_;
  std::vector<std::unique_ptr<view::EvaluabilityLayer>> layers_;
  BoardWork<session::EvaluabilityBoard, session::EvaluabilityWork> work_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
