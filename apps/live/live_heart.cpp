#include "live_heart.h"

#include <utility>

namespace ostia::live {
namespace {

constexpr int placed_phases = 10;

/// Of the surface at all phases, so that nothing leaves the picture.
std::vector<geometry::Vec3> places_of(const LiveInput& input, const motion::MovingCage& cage,
                                      const core::TaskContext& task) {
  const motion::CarriedPoints carried(input.motion.grid, input.surface.points);
  std::vector<geometry::Vec3> all;
  all.reserve(placed_phases * input.surface.points.size());
  for (int k = 0; k < placed_phases; ++k) {
    task.throw_if_cancelled();
    const auto places = carried.places(cage.at(static_cast<double>(k) / placed_phases));
    all.insert(all.end(), places.begin(), places.end());
  }
  return all;
}

}  // namespace

LiveHeart read_heart(const Options& options, const core::TaskContext& task) {
  task.set_stage(options.motion.empty() ? "making the sample heart"
                                        : "reading " + options.motion.filename().string());
  LiveInput input = read_input(options);
  task.throw_if_cancelled();
  task.set_progress(0.6);
  task.set_stage("preparing the surface");
  motion::MovingCage cage(input.motion);
  glview::ShownSurface surface = glview::shown_surface(input.surface, input.motion.grid, task);
  task.set_progress(0.9);
  std::vector<geometry::Vec3> places = places_of(input, cage, task);
  task.set_progress(1.0);
  return {std::move(input), std::move(cage), std::move(surface), std::move(places)};
}

}  // namespace ostia::live
