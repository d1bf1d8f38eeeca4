#pragma once
/// \file Where the vessels of one part of a surface begin and end.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/pipeline/lumen_axes.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// Where a vessel may end.
struct PartEnd {
  geometry::Vec3 point = geometry::Vec3::Zero();
  double radius_mm = 0.0;
  std::string name;
  std::optional<geometry::FaceKind> kind;
  bool asked = false;      ///< a target of the user's
  bool blind = false;      ///< closed: a tip
  double length_mm = 0.0;  ///< of a tip's branch
};

/// What one part is asked for.
struct PartRequest {
  std::optional<geometry::Vec3> source;
  std::vector<geometry::Vec3> targets;
  std::vector<std::string> names;  ///< as many, or none
};

/// One part's ends: its inlet and its targets, those asked for first.
struct PartEnds {
  std::optional<geometry::Vec3> source;
  std::vector<PartEnd> targets;
  bool leave_blind = false;  ///< blind branches stay closed: they are only told
  std::vector<std::string> told;
};

/// Points that were given go to the part whose wall is nearest.
std::vector<PartRequest> shared_out(const std::vector<geometry::TriMesh>& parts, const AxesRequest& request);

/// Its inlet and its targets, as lumen_axes has them.
PartEnds ends_of_part(const geometry::TriMesh& part, const PartRequest& asked, const AxesRequest& request,
                      const core::TaskContext& task);

/// Blind branches, from the inlet on, that no target lies on.
std::vector<PartEnd> blind_ends(const geometry::TriMesh& part, const PartRequest& asked,
                                const std::optional<geometry::Vec3>& from, const core::TaskContext& task);

}  // namespace ostia::pipeline
