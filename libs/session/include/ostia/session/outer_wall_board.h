#pragma once
/// \file The outer walls that are known of the workbench's model, and the work that finds them.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/session/found_walls.h"
#include "ostia/session/ruled_surface.h"
#include "ostia/session/workbench.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

namespace ostia::session {

/// A vessel whose outer wall is to be found.
struct OuterWallWork : WallsWanted {
  std::shared_ptr<FoundWalls> known;  ///< where it is looked for, or was
  /// With maps; any thread. Throws as vessel_walls does.
  std::optional<VesselWalls> found(const core::TaskContext& task = core::no_task()) const;
};

/// Watches the workbench: what is known ends with the model, the image or the case that it was found with.
/// One thread.
class OuterWallBoard {
 public:
  /// `walls`: what others who look for walls find, too.
  explicit OuterWallBoard(Workbench& bench,
                          std::shared_ptr<FoundWalls> walls = std::make_shared<FoundWalls>());
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
  /// For others who look for walls of the same models.
  const std::shared_ptr<FoundWalls>& found() const { return found_; }
  std::uint64_t revision() const { return revision_; }  ///< another number whenever `known` is another
  /// What has to be done for the selected vessel; nothing where it is known or cannot be (no case, no image).
  std::optional<OuterWallWork> work() const;
  /// Takes what the work found; false, and nothing taken, where model or image are others by now.
  bool take(const OuterWallWork& work, std::optional<VesselWalls> found);

 private:
  void drop();
  Workbench& bench_;
  std::shared_ptr<FoundWalls> found_;
  std::map<std::int32_t, Known> known_;
  std::uint64_t revision_ = 1;
  std::vector<Subscription> own_;
};

}  // namespace ostia::session
