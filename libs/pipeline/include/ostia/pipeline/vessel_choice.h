#pragma once
/// \file Parts of a model: chosen vessels, and the trees that it consists of.

#include "ostia/lumen/lumen_model.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// The chosen vessels and those whose wall their way from the root runs in (a side branch needs the vessel it
/// comes from), in the tree's order. Throws InvalidInput for no vessel, or an id that the tree does not have.
std::vector<std::int32_t> with_parents(const geometry::VesselTree& tree,
                                       const std::vector<std::int32_t>& vessels);

/// The model of these vessels and of those that they need (`with_parents`); ids, samples and blending are
/// kept. Sound where `model` is. Throws InvalidInput as `with_parents` does.
lumen::LumenModel part_of(const lumen::LumenModel& model, const std::vector<std::int32_t>& vessels);

/// All that hangs on one root, named by its first vessel.
struct RootedModel {
  std::string name;
  lumen::LumenModel model;
};
/// A heart has two as a rule: left and right. In the order of the vessels. Throws InvalidInput for a model
/// without vessels.
std::vector<RootedModel> rooted_parts(const lumen::LumenModel& model);

}  // namespace ostia::pipeline
