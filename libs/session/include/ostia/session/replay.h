#pragma once
/// \file A journal applied anew: the proof that a model is what its edits made of it.

#include "ostia/core/task_context.h"
#include "ostia/session/case_file.h"

#include <string>
#include <vector>

namespace ostia::session {

/// What came out, and what is stored.
struct ReplayReport {
  std::size_t edits = 0;
  std::string digest, stored_digest;  ///< lumen::digest
  bool same() const { return digest == stored_digest; }
};

/// Edits applied to a model one after another. Throws as lumen::apply does, naming the edit ("edit 3").
lumen::LumenModel replayed(const lumen::LumenModel& start, const std::vector<lumen::Edit>& edits,
                           const core::TaskContext& task = core::no_task());
/// The edits of a case that are not undone, applied to the model it began with, and compared with the model
/// it holds.
ReplayReport replay(const CaseFile& file, const core::TaskContext& task = core::no_task());

}  // namespace ostia::session
