#include "ostia/session/replay.h"

#include "ostia/core/error.h"

namespace ostia::session {

lumen::LumenModel replayed(const lumen::LumenModel& start, const std::vector<lumen::Edit>& edits,
                           const core::TaskContext& task) {
  lumen::LumenModel model = start;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    task.throw_if_cancelled();
    try {
      model = lumen::apply(model, edits[i]).model;
    } catch (const InvalidInput& e) {
      throw InvalidInput("edit " + std::to_string(i + 1) + " of " + std::to_string(edits.size()) + ": " +
                         e.what());
    }
    task.set_progress(static_cast<double>(i + 1) / static_cast<double>(edits.size()));
  }
  return model;
}

ReplayReport replay(const CaseFile& file, const core::TaskContext& task) {
  const std::vector<lumen::Edit> edits = file.edits();
  ReplayReport report;
  report.edits = edits.size();
  report.digest = lumen::digest(replayed(*file.starting_model(), edits, task));
  report.stored_digest = lumen::digest(*file.model());
  return report;
}

}  // namespace ostia::session
