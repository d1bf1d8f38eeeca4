#pragma once
/// \file Outer walls that several parts of a window want to know: each is looked for once.

#include "ostia/session/outer_walls.h"
#include "ostia/session/session.h"

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace ostia::session {

/// A vessel of a model that no longer changes, and the image that shows its walls.
struct WallsWanted {
  std::shared_ptr<const lumen::LumenModel> model;
  SolvedWalls walls;
  std::shared_ptr<const imaging::ImageVolume> image;
  std::int32_t vessel = 0;
};

/// What was found with one model and one image; what was found with others before is forgotten. Neither is
/// kept alive by it. Any thread.
class FoundWalls {
 public:
  /// A vessel's walls, without maps; null where none can be looked for. Who asks first looks for them, and
  /// the others wait; where the first one gives up, the next one looks. Throws as vessel_walls does.
  std::shared_ptr<const VesselWalls> of(const WallsWanted& wanted,
                                        const core::TaskContext& task = core::no_task());
  /// How often a wall was looked for.
  int searches() const;

 private:
  struct Entry;
  std::shared_ptr<Entry> entry(const WallsWanted& wanted);
  mutable std::mutex mutex_;
  std::condition_variable settled_;
  std::vector<std::shared_ptr<Entry>> entries_;
  int searches_ = 0;
};

}  // namespace ostia::session
