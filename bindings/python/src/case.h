#pragma once
/// \file The case file as Python has it.

#include "call.h"
#include "rooms.h"

#include "ostia/core/error.h"
#include "ostia/lumen/edit.h"
#include "ostia/session/case_file.h"

#include <mutex>
#include <optional>
#include <utility>

namespace ostia::python {

/// An open case, used by one thread at a time.
class Case {
 public:
  explicit Case(session::CaseFile file) : file_(std::move(file)) {}

  /// Runs `work` on the file without the interpreter's lock.
  template <class Work>
  auto with_file(Work&& work) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock())
      throw UsageError("case: another thread is at work in it; take turns, or open it twice");
    if (!file_) throw UsageError("case: it is closed; open it again");
    return unlocked([&] { return work(*file_); });
  }
  void close();
  bool closed() const { return !file_; }

 private:
  std::mutex mutex_;
  std::optional<session::CaseFile> file_;
};

void bind_case(py::module_& m);

/// An edit from its name and fields by keyword, or from its line. Throws InvalidInput.
lumen::Edit edit_of(const py::object& op, const py::kwargs& fields);

}  // namespace ostia::python
