#pragma once
/// \file Walks through the window again, as a written walk says.

#include "qa/walk.h"

#include "ostia/session/workbench.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <vector>

class QMainWindow;

namespace ostia::workstation {

class CommandTable;
class PictureWidget;

/// Does one step when the one before has come to rest: no work in the background, nothing painted any more.
/// A step that cannot be done (no such widget, a command that is not enabled, a dialog in front of the
/// widget) or that expects what is not so ends the walk.
class WalkPlayer final : public QObject {
  Q_OBJECT
 public:
  using Counts = std::map<QString, std::function<double()>>;
  struct Stage {
    QMainWindow* window = nullptr;
    session::Workbench* bench = nullptr;
    const CommandTable* commands = nullptr;
    std::function<bool()> idle{};    ///< whether no work goes on in the background
    Counts counts{};                 ///< what "expect" may ask for, beside the player's own
    std::filesystem::path folder{};  ///< for pictures, files and walk.csv
  };
  /// One step that was done.
  struct Done {
    WalkStep step;
    double ms = 0.0;          ///< until all was at rest
    double blocked_ms = 0.0;  ///< the longest time in which the interface's thread answered nothing
  };

  WalkPlayer(Stage stage, std::vector<WalkStep> steps, QObject* parent = nullptr);
  ~WalkPlayer() override;
  /// With the first step once the window is at rest.
  void start();
  double longest_block_ms() const;  ///< with what was opened before the first step
  /// Why it ended early; empty where it did not.
  const QString& failure() const { return failure_; }

 signals:
  void ended();

 private:
  bool eventFilter(QObject* object, QEvent* event) override;
  void tick();
  void wait_for_rest();
  void begin(const WalkStep& step);
  void finish_step();
  void mouse(const WalkStep& step);
  void keys(const WalkStep& step);
  void answer_file_dialog(const WalkStep& step);
  void look(const QString& name);
  void expect(const WalkStep& step);
  QWidget& widget(const QString& name) const;
  QPointF at(const WalkPlace& place, QWidget& widget) const;
  QPointF on_picture(const WalkPlace& place, PictureWidget& picture) const;
  void fail(const QString& why);
  void end();

  Stage stage_;
  std::vector<WalkStep> steps_;
  std::vector<Done> done_;
  std::deque<std::function<void()>> acts_;  // of the step that is being done
  QString failure_;
  QElapsedTimer step_clock_, quiet_, beat_;
  QTimer heartbeat_;
  double blocked_ms_ = 0.0;
  double opening_ms_ = 0.0, opening_blocked_ms_ = 0.0;  // until the first step could begin
  bool doing_ = false, ended_ = false;
};

}  // namespace ostia::workstation
