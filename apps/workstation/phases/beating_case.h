#pragma once
/// \file The case that beats: a motion opened beside it, and the phase that all views show.

#include "phases/loader.h"

#include "ostia/geometry/cage_motion.h"
#include "ostia/session/beating.h"
#include "ostia/session/phase_clock.h"
#include "ostia/session/signal.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

class QMainWindow;
class QToolBar;

namespace ostia::workstation {

struct Desk;
class PhaseBar;
class PhaseProfile;

/// Reads a motion in the background and shows the case at any of its phases. The motion goes with the case;
/// it is kept nowhere.
class BeatingCase final : public QObject {
  Q_OBJECT
 public:
  /// Its tool bar and its dock are put into `window`, hidden until there is a motion.
  BeatingCase(Desk& desk, QMainWindow& window);
  ~BeatingCase() override;
  void ask();  ///< for the file
  void open(const std::filesystem::path& file);
  void close();
  void put_away();  ///< hides the tool bar and the dock, which are shown with a motion alone
  /// Images of the phases, in a folder: looked for in the background, read as they are looked at.
  void open_images(const std::filesystem::path& folder);
  void take_images(std::vector<session::PhaseSource> sources);  ///< that are known already
  const PhaseLoader& images() const { return images_; }
  /// The motion with the tree as it is now. Throws InvalidInput without a motion.
  std::shared_ptr<const session::Beating> carrying();
  bool shown() const { return motion_.has_value(); }
  session::PhaseClock& clock() { return clock_; }
  void toggle();     ///< plays or pauses; nothing without a motion
  void go_to_own();  ///< the phase that the case is of

 signals:
  void shown_changed();

 private:
  void take(const geometry::CageMotion& motion);
  void show();  // the clock's phase
  void next_frame();
  const std::shared_ptr<const session::Beating>& beating();
  Desk& desk_;
  session::PhaseClock clock_;
  void ask_images();
  QToolBar* room_;
  PhaseBar* bar_;
  PhaseProfile* profile_;
  PhaseLoader images_;
  std::optional<geometry::CageMotion> motion_;
  std::shared_ptr<const session::Beating> beating_;  // of the model as it is; null: to be made anew
  QTimer frame_;
  QElapsedTimer since_frame_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
