#pragma once
/// \file The tree of a synthetic case with its wall, as the 3D scene shows it.

#include "ostia/lumen/live_model.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/phantom/phantom_case.h"

#include <memory>
#include <utility>

namespace ostia::bench {

struct SceneCase {
  phantom::CasePlan plan;
  std::shared_ptr<const lumen::LumenModel> model;
  std::shared_ptr<const geometry::TriMesh> wall;
};

inline SceneCase scene_case(double cell_mm, phantom::Preset preset = phantom::Preset::full) {
  phantom::CaseOptions options;
  options.preset = preset;
  SceneCase made{phantom::plan_case(options), nullptr, nullptr};
  made.model =
      std::make_shared<const lumen::LumenModel>(lumen::model_of_tubes(phantom::vessel_tree(made.plan.tree)));
  lumen::LiveModel live(made.model);
  made.wall = std::make_shared<const geometry::TriMesh>(live.wall(cell_mm));
  return made;
}

}  // namespace ostia::bench
