#pragma once
/// \file The pressures of the case in the window: computed beside it while walls are edited, shown on the
/// CPRs, the profile and the tree.

#include "ostia/core/task_context.h"
#include "ostia/session/pressure_board.h"
#include "ostia/view/pressure_layer.h"

#include <QElapsedTimer>
#include <QObject>
#include <QPointer>
#include <QThreadPool>
#include <QTimer>
#include <map>
#include <memory>
#include <vector>

namespace ostia::workstation {

struct Desk;
class PictureWidget;
class ProfileWidget;
class SceneWidget;

/// Does the board's work as soon as there is any, never in the window's thread: after an edit of a wall that
/// of its branch, and all anew, at low priority, when the hand has been let alone. Goes before the views that
/// it draws on.
class Pressures final : public QObject {
  Q_OBJECT
 public:
  Pressures(Desk& desk, const std::vector<PictureWidget*>& pictures, ProfileWidget& profile,
            SceneWidget& scene);
  ~Pressures() override;
  session::PressureBoard& board() { return board_; }
  session::Property<bool> map{true};  ///< the tree's wall in the colours of FFR, while pressures are shown
  session::Property<double> left_percent{0.0,
                                         session::Range<double>{0.0, 90.0, 5.0}};  ///< of an opened stretch
  session::Property<double> narrow_percent{50.0,
                                           session::Range<double>{5.0, 95.0, 5.0}};  ///< of a narrowed one
  /// Nothing is computed, nor will be before the next edit.
  bool idle() const;
  /// From an edit until what is shown was that of it, at the last one.
  double last_behind_ms() const { return behind_ms_; }
  /// As if the narrowing at the cursor were opened; as if it, or what is about the cursor, were narrower.
  void open_at_cursor();
  void narrow_at_cursor();

 private:
  void look();
  void start(const session::PressureWork& work);
  void done(const session::PressureWork& work, std::shared_ptr<const session::PressureReport> found,
            const std::string& why);
  void color_wall();
  void show_map();
  Desk& desk_;
  session::PressureBoard board_;
  QPointer<ProfileWidget> profile_;
  QPointer<SceneWidget> scene_;
  std::vector<std::unique_ptr<view::PressureLayer>> layers_;
  QThreadPool quick_, slow_;
  core::TaskContext task_;
  QTimer rest_, map_soon_, look_soon_;
  QElapsedTimer since_edit_;
  bool edited_ = false, long_ = false, ending_ = false;
  double behind_ms_ = 0.0;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
