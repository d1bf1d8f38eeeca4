#pragma once
/// \file Writes down what hands and keys do in the window, for a WalkPlayer.

#include "qa/walk.h"

#include <QObject>
#include <QPointer>
#include <QWidget>
#include <filesystem>
#include <optional>

class QAction;
class QMouseEvent;

namespace ostia::workstation {

class CommandTable;

/// From when it is made: each step is a line of the file as soon as it is done. Commands are written as
/// commands, whether a menu, a button or a key ran them. What is typed is written down as it was typed.
class WalkRecorder final : public QObject {
  Q_OBJECT
 public:
  /// Throws IoError where the file cannot be written.
  WalkRecorder(const CommandTable& commands, std::filesystem::path file, QObject* parent = nullptr);
  ~WalkRecorder() override;

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  void mouse(QWidget& widget, const QMouseEvent& event);
  void key(const QWidget& widget, const class QKeyEvent& event);
  void write(const WalkStep& step);
  void write_typed();
  static WalkPlace place(const QWidget& widget, const QPointF& at);

  std::filesystem::path file_;
  WalkStep gesture_;                 // while a button is down
  QPointer<QWidget> holding_;        // the widget under it
  std::optional<WalkStep> clicked_;  // until it is known that it is no double click's first
  WalkStep typed_;                   // until something else happens
};

}  // namespace ostia::workstation
