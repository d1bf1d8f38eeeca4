#include "walls/vessels_beside.h"

#include "ostia/core/error.h"
#include "ostia/session/case_report.h"

#include <string>

namespace ostia::session {

analysis::SurfaceOfVessel solved_surfaces(const lumen::LumenModel& model, const core::TaskContext& task) {
  using Solved = std::shared_ptr<const lumen::ImplicitSurface>;
  task.throw_if_cancelled();
  const std::vector<Solved> walls = beside<Solved>(
      model.vessels.size(), task,
      [&](std::size_t i, const core::TaskContext& part) {
        Solved wall = std::make_shared<const lumen::ImplicitSurface>(lumen::solve(*model.vessels[i]));
        part.set_progress(1.0);
        return wall;
      },
      own_lengths(model));
  std::map<std::int32_t, Solved> solved;
  for (std::size_t i = 0; i < walls.size(); ++i) solved[model.vessels[i]->vessel] = walls[i];
  return [solved = std::move(solved)](std::int32_t vessel) {
    const auto found = solved.find(vessel);
    if (found == solved.end())
      throw InvalidInput("there is no vessel " + std::to_string(vessel) + " in the model");
    return found->second;
  };
}

}  // namespace ostia::session
