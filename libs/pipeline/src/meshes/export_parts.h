#pragma once
/// \file What exports of several trees have in common.

#include "ostia/core/error.h"
#include "ostia/pipeline/model.h"
#include "ostia/pipeline/vessel_choice.h"
#include "ostia/pipeline/vessel_export.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace ostia::pipeline {

/// Another tree's surface into the same one: walls become one face, caps get further ids.
void append(geometry::FacedSurface& to, const geometry::FacedSurface& surface);

/// A folder's name for each tree: its own, without what file systems or shells take amiss, each once.
std::vector<std::string> folder_names(const std::vector<RootedModel>& parts);

/// Where each tree's share of the work begins in [0, 1], and the end of the last one.
std::vector<double> shares_of(const std::vector<RootedModel>& parts, const meshing::SizingOptions& sizing);

/// Another mesh's figures to those of all; the verdict is left alone.
void add(const MeshQuality& one, MeshQuality& all);

/// The vessels chosen; none: all of the model.
std::vector<std::int32_t> all_or(const lumen::LumenModel& model, const std::vector<std::int32_t>& chosen);
/// The cells of the wall that is remeshed: half of what shows all there is, and no wider than half an edge.
double cell_for(const lumen::LumenModel& model, const meshing::SizingOptions& sizing);
/// The wall of one tree, closed and in one piece; where it is too narrow for the cells, with finer ones.
/// Throws GeometryError where it is neither.
geometry::TriMesh sound_wall(const RootedModel& part, double cell_mm, const core::TaskContext& task);

std::string name_of(SurfaceEnds ends);
nlohmann::json sizing_json(const meshing::SizingOptions& sizing);

/// What geometry refuses, with the tree in front.
template <class Call>
auto naming(const std::string& tree, const Call& call) {
  try {
    return call();
  } catch (const GeometryError& error) {
    throw GeometryError(tree + error.what());
  } catch (const ResourceError& error) {
    throw ResourceError(tree + error.what());
  }
}

}  // namespace ostia::pipeline
