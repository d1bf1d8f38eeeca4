#include "ostia/cohort/status.h"

#include "status_counter.h"

namespace ostia::cohort {
namespace fs = std::filesystem;

std::string name_of(StageState state) {
  switch (state) {
    case StageState::ok:
      return "ok";
    case StageState::quality:
      return "quality";
    case StageState::failed:
      return "failed";
    case StageState::stale:
      return "stale";
    case StageState::damaged:
      return "damaged";
    case StageState::waiting:
      break;
  }
  return "waiting";
}

CohortStatus read_status(const fs::path& folder, const StatusOptions& options,
                         const core::TaskContext& task) {
  const OpenCohort cohort(folder);
  StatusCounter counter(cohort.count("refused"));
  cohort.for_each(options, task, [&](const CohortScan& scan) { counter.take(scan); });
  return counter.result();
}

}  // namespace ostia::cohort
