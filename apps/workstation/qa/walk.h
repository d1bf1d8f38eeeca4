#pragma once
/// \file A reader's walk through the window, written down: what hands and keys do, step by step, so that the
/// window can be walked through again, looked at and measured.

#include <QPointF>
#include <QString>
#include <QStringList>
#include <QVector>
#include <array>
#include <filesystem>
#include <optional>
#include <vector>

namespace ostia::workstation {

constexpr double walk_notch = 120.0;  ///< of a wheel, as the display counts it

/// A place on a widget: a part of its size (0,0 to 1,1), or what lies there of the patient, and so many
/// pixels of the interface beside it.
struct WalkPlace {
  enum class Of { widget, cursor, wall };
  Of of = Of::widget;
  QPointF part;    ///< of the widget's size
  QPointF beside;  ///< pixels
};

/// One line of a walk:
/// ```
/// command ID                          a command of the table, as its menu or key runs it
/// key WIDGET KEY                      a key for a widget that has the focus ("Ctrl+Down")
/// type WIDGET "TEXT"                  for a widget, letter by letter
/// click|double WIDGET PLACE [HOLD]    with the mouse; HOLD: left, middle, right, shift, ctrl, alt with "+"
/// between drag WIDGET PLACE PLACE ... [HOLD] wheel WIDGET PLACE NOTCHES [HOLD]   positive: away from the
/// hand go X,Y,Z                            the cursor to a place of the patient, LPS mm file NAME the answer
/// to the next file dialog, a name in the walk's folder look NAME                           a picture of the
/// window, NAME.png in the walk's folder expect WHAT >=|<=|= NUMBER          what must be so now ("vessels",
/// "edits" ...: WalkPlayer::Counts)
/// ```
/// WIDGET is an object's name ("cpr1"), or "parent/Class:2" for the third of its class below a named one.
/// PLACE is "0.5,0.25", "cursor", "wall" (the lumen's line to the right of the cursor), each with "+4,-2"
/// for pixels beside it.
struct WalkStep {
  enum class Kind { command, key, type, click, double_click, drag, wheel, go, file, look, expect };
  Kind kind = Kind::command;
  QString what;  ///< command, widget, name, or what is counted
  QString text;  ///< key, text, or comparison
  QVector<WalkPlace> places;
  std::array<double, 3> world_mm{};
  double number = 0.0;  ///< notches, or what is expected
  Qt::MouseButton button = Qt::LeftButton;
  Qt::KeyboardModifiers held = Qt::NoModifier;
  int line = 0;  ///< in its file, from 1
};

/// Throws InvalidInput with file, line and the form that was expected.
std::vector<WalkStep> read_walk(const std::filesystem::path& file);
/// `name` is what messages call it. Empty lines and those that begin with "#" are passed over.
std::vector<WalkStep> parse_walk(const QString& text, const QString& name);
/// One line without its end; parse_walk makes the same step of it.
QString walk_line(const WalkStep& step);

}  // namespace ostia::workstation
