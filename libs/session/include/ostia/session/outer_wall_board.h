#pragma once
/// \file The outer walls that are known of the workbench's model, and the work that finds them.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/session/outer_walls.h"
#include "ostia/session/ruled_surface.h"
#include "ostia/session/workbench.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

namespace ostia::session {

/// A vessel whose outer wall is to be found, on a model that no longer changes.
struct OuterWallWork {
  std::shared_ptr<const lumen::LumenModel> model;
  SolvedWalls walls;
  std::shared_ptr<const imaging::ImageVolume> image;
  std::int32_t vessel = 0;
  std::optional<VesselWalls> found(const core::TaskContext& task = core::no_task()) const;  ///< any thread
};

/// Watches the workbench: what is known ends with the model, the image or the case that it was found with.
/// One thread.
class OuterWallBoard {
 public:
  explicit OuterWallBoard(Workbench& bench);
  OuterWallBoard(const OuterWallBoard&) = delete;
  OuterWallBoard& operator=(const OuterWallBoard&) = delete;

  Property<bool> shown{false};         ///< the walls' lines
  Property<bool> plaque_shown{false};  ///< what lies between lumen and outer wall, by class
  Signal<> changed;                    ///< something is known that was not, or the other way round

  struct Known {
    std::optional<VesselWalls> walls;  ///< nothing where it was looked for and not found
    RuledSurface surface;              ///< the outer wall as rings about the axis
  };
  const std::map<std::int32_t, Known>& known() const { return known_; }
  /// The selected vessel's; null where nothing is known.
  const VesselWalls* of_selected() const;
  std::uint64_t revision() const { return revision_; }  ///< another number whenever `known` is another
  /// What has to be done for the selected vessel; nothing where it is known or cannot be (no case, no image).
  std::optional<OuterWallWork> work() const;
  /// Takes what the work found; false, and nothing taken, where model or image are others by now.
  bool take(const OuterWallWork& work, std::optional<VesselWalls> found);

 private:
  void drop();
  Workbench& bench_;
  std::map<std::int32_t, Known> known_;
  std::uint64_t revision_ = 1;
  std::vector<Subscription> own_;
};

}  // namespace ostia::session
