#pragma once
/// \file The pressures of the workbench's case while it is edited: what is known, the work that finds it, and
/// what a person says to it. No toolkit, no thread of its own.

#include "ostia/session/pressure_readout.h"
#include "ostia/session/workbench.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

/// What has to be computed, on a model that no longer changes.
struct PressureWork {
  std::shared_ptr<const PressureReport> before;  ///< null: all is measured
  std::shared_ptr<const lumen::LumenModel> model;
  SolvedWalls walls;
  std::vector<MovedWall> moved;  ///< since `before`
  PressureReportOptions options;
  std::int64_t number = 0;
  bool band = false;  ///< how sure `before` is, by the image where there is one
  std::shared_ptr<const imaging::ImageVolume> image;
  bool whole() const { return before == nullptr; }  ///< takes seconds in a large tree, else milliseconds

  /// Any thread. Throws as pressure_tree and make_pressure_report do.
  std::shared_ptr<const PressureReport> found(const core::TaskContext& task = core::no_task()) const;
};

/// Watches the workbench while `shown` is set. One thread.
class PressureBoard {
 public:
  explicit PressureBoard(Workbench& bench);
  PressureBoard(const PressureBoard&) = delete;
  PressureBoard& operator=(const PressureBoard&) = delete;

  Property<bool> shown{false};  ///< a person wants to see pressures; nothing is computed before
  Signal<> wanted;              ///< there is work
  Signal<> changed;             ///< `now` or `problem` is another

  /// As it was when work was done last: while a wall is pulled a moment behind it. Null: not known.
  const std::shared_ptr<const PressureReport>& now() const { return now_; }
  /// Why nothing is known; empty where all is well.
  const std::string& problem() const { return problem_; }
  /// A wall or an input is another than that of `now`.
  bool behind() const;
  /// Of these, something that takes milliseconds waits.
  bool small_waits() const { return now_ && (!moved_.empty() || options_changed_); }

  /// The next piece of work, which is then in flight: nothing else is given out before `take`. Small work
  /// goes before measuring all anew, which is done after edits only when `rested` was called; how sure it is
  /// comes last.
  std::optional<PressureWork> begin();
  /// After edits: nobody has edited for a while.
  void rested();
  /// What it found; null with why, or without a word where it was cancelled. What was meanwhile made obsolete
  /// by another case or tree is dropped.
  void take(const PressureWork& work, std::shared_ptr<const PressureReport> found,
            const std::string& why = {});
  bool in_flight() const { return in_flight_.has_value(); }
  /// How sure `now` is will be known without another edit.
  bool band_to_come() const { return now_ && (band_wanted_ || (in_flight_ && in_flight_->band)); }

  /// What the case keeps; without a case, nothing.
  PressureNotes notes() const;
  /// Steps of the case, which can be undone. Throw InvalidInput.
  void set_input(const std::string& key, std::optional<double> value);  ///< nothing: its usual value
  void add_what_if(const WhatIf& what_if);
  void remove_what_if(std::size_t index);
  void clear_what_ifs();
  /// The selected vessel's narrowing at the cursor, or else a stretch of 15 mm about it.
  WhatIf stretch_at_cursor() const;
  std::optional<double> ffr_at_cursor() const;

 private:
  void forget();
  void look_at_options();
  void walls_moved(const ModelEvent& event);
  Workbench& bench_;
  std::shared_ptr<const PressureReport> now_;
  std::string problem_;
  std::vector<MovedWall> moved_;
  PressureReportOptions options_;
  bool options_changed_ = false, whole_wanted_ = true, edited_ = false, band_wanted_ = true;
  std::int64_t number_ = 0;
  std::optional<PressureWork> in_flight_;
  std::vector<Subscription> own_;
};

}  // namespace ostia::session
