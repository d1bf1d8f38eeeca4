#pragma once
/// \file Progress and cancellation of long work.

#include <memory>
#include <string>

namespace ostia::core {

/// A handle on the shared state of one running job: what the algorithm reports and the interface polls.
///
/// Semantics, all safe from any thread:
/// - copies and sub-ranges share one state: cancelling one cancels all;
/// - a cancel cannot be taken back; it is seen by `throw_if_cancelled` from the next call on;
/// - `set_progress(f)` takes f in [0, 1] of this handle's own range (clamped); the job's progress never
/// falls;
/// - a library never calls back into a user interface.
class TaskContext {
 public:
  TaskContext();  ///< A new job at progress 0.

  void set_progress(double fraction) const;
  double progress() const;  ///< Of the whole job, in [0, 1].

  void cancel() const;
  bool cancelled() const;
  void throw_if_cancelled() const;  ///< Throws ostia::Cancelled.

  /// Names what is being done now ("level set"); shown beside the progress bar.
  void set_stage(std::string stage) const;
  std::string stage() const;

  /// A handle whose [0, 1] is [from, to] of this one's range; 0 <= from <= to <= 1.
  TaskContext sub(double from, double to) const;

 private:
  struct State;
  friend const TaskContext& no_task();
  explicit TaskContext(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;  // null: nobody is watching
  double from_ = 0.0;
  double to_ = 1.0;
};

/// The context of work that nobody watches: keeps no progress and cannot be cancelled.
const TaskContext& no_task();

}  // namespace ostia::core
