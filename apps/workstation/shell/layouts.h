#pragma once
/// \file Arrangements of the whole window (hanging protocols): three that are built in, and a person's own.

#include "shell/named_presets.h"

#include <QObject>
#include <map>
#include <string>

class QMainWindow;
class QMenu;

namespace ostia::workstation {

class CommandTable;
struct Desk;
class FloatingViews;
class HeartVolume;
class PanelLayout;
class PlanesDock;

/// A layout is the window's place and size, docks with theirs (also those that float on another monitor),
/// views in windows of their own and where these are, the panels' sizes, whether the tree is there and
/// whether the three planes fill the window, and the look of the heart in 3D.
class Layouts final : public QObject {
  Q_OBJECT
 public:
  using Values = NamedPresets::Values;
  Layouts(Desk& desk, QMainWindow& window, PanelLayout& panels, PlanesDock& planes, HeartVolume& heart);

  void show_reading();                 ///< all views, the three planes put away
  void show_planes();                  ///< the three planes alone, in the window
  void show_flat();                    ///< 2D views alone: the tree gives its room to them
  void show_own(const QString& name);  ///< nothing where there is none
  /// As the window is now; one of the same name is replaced. Throws InvalidInput for a name without letters.
  void save(const QString& name);
  void forget(const QString& name);
  QStringList names() const { return own_layouts_.names(); }
  /// Which one the window begins with: "reading", "planes", "flat", "own:NAME"; empty: as it was left.
  void set_first(const QString& which);
  QString first() const;
  QString shown() const { return shown_; }  ///< that was shown last, as `first` says it

  Values now() const;                  ///< all that makes the window's arrangement
  void arrange(const Values& values);  ///< keys that are missing stay as they are
  void begin();                        ///< after the window was arranged as it was left

 private:
  void centre(bool shown);
  void keep_something();
  void show(const QString& which);
  Desk& desk_;
  QMainWindow& window_;
  PanelLayout& panels_;
  PlanesDock& planes_;
  HeartVolume& heart_;
  NamedPresets own_layouts_;
  QString shown_;
};

void add_layout_commands(CommandTable& table, Desk& desk, Layouts& layouts, PlanesDock& planes);
/// "view.float_cpr1" and so on: each takes a view out of the window, or puts it back.
void add_floating_commands(CommandTable& table, FloatingViews& views);
/// Adds a person's own layouts whenever the menu is about to be shown.
void list_own_layouts(QMenu& menu, Layouts& layouts);

}  // namespace ostia::workstation
