#include "intake_mending.h"

#include "intake_ends.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/meshing/flat_caps.h"
#include "ostia/pipeline/lumen_axes.h"
#include "ostia/pipeline/repair.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

constexpr double told_volume_change = 0.02;  // by mending

/// Of a part with its holes filled; nothing where it is too broken for one.
std::optional<double> volume_of_part(const TriMesh& part) try {
  return std::abs(geometry::volume(geometry::fill_holes(geometry::oriented(part)).mesh));
} catch (const Error&) {
  return std::nullopt;
}

/// A line where mending took away, or added, what a person would miss.
void tell_volume(const TriMesh& part, const TriMesh& mended, std::vector<std::string>& told) {
  const std::optional<double> before = volume_of_part(part), after = volume_of_part(mended);
  if (!before || !after || std::abs(*after - *before) <= told_volume_change * *before) return;
  told.push_back("mending changed the volume of the part about " +
                 place_text(geometry::bounds(part.points).center()) + " by " +
                 core::fixed_text(100.0 * (*after - *before) / *before, 1) + " % (" +
                 core::significant_text(*before, 4) + " to " + core::significant_text(*after, 4) +
                 " mm3): look at what is left before it is used");
}

}  // namespace

std::vector<std::int32_t> labels_on(const TriMesh& mesh, const geometry::FacedSurface& before) {
  if (before.face_ids.empty()) return {};
  if (mesh.triangles == before.mesh.triangles && mesh.points.size() == before.mesh.points.size())
    return before.face_ids;
  const geometry::AabbTree tree(before.mesh);
  std::vector<std::int32_t> labels;
  for (const geometry::Triangle& t : mesh.triangles) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : t) middle += mesh.points[static_cast<std::size_t>(v)] / 3.0;
    labels.push_back(before.face_ids[static_cast<std::size_t>(tree.closest(middle).triangle)]);
  }
  return labels;
}

void drop_what_is_nowhere(geometry::FacedSurface& surface, std::vector<std::string>& told) {
  std::vector<bool> keep;
  for (const geometry::Triangle& t : surface.mesh.triangles)
    keep.push_back(std::ranges::all_of(
        t, [&](std::int32_t v) { return surface.mesh.points[static_cast<std::size_t>(v)].allFinite(); }));
  const auto gone = std::ranges::count(keep, false);
  if (gone == 0) return;
  if (gone == std::ssize(keep)) throw GeometryError("no triangle of the surface has a finite place");
  std::vector<std::int32_t> old;
  surface.mesh = geometry::subset(surface.mesh, keep, &old);
  if (!surface.face_ids.empty()) {
    std::vector<std::int32_t> ids;
    for (const std::int32_t t : old) ids.push_back(surface.face_ids[static_cast<std::size_t>(t)]);
    surface.face_ids = std::move(ids);
  }
  told.push_back("triangles with points that are not finite dropped: " + std::to_string(gone));
}

MendedParts mended(const TriMesh& mesh, std::vector<std::string>& told, const core::TaskContext& task) {
  RepairOptions how;
  how.parts = KeptParts::all;
  std::map<std::string, std::pair<std::size_t, std::string>> counts;  // by the step's key
  std::vector<std::string> order;
  MendedParts out;
  for (const TriMesh& part : parts_of(geometry::welded(mesh))) {
    task.throw_if_cancelled();
    Repaired fixed;
    try {
      fixed = repaired(part, how, task);
    } catch (const GeometryError&) {  // nothing of this part is left, and it was next to nothing
      told.push_back("a part of " + std::to_string(part.triangles.size()) + " triangles at " +
                     place_text(geometry::bounds(part.points).center()) +
                     " cannot be mended and is left out");
      continue;
    }
    for (const RepairStep& step : fixed.steps) {
      if (!counts.contains(step.what)) order.push_back(step.what);
      auto& [count, text] = counts[step.what];
      count += step.count;
      text = step.text.substr(0, step.text.rfind(':'));
    }
    tell_volume(part, fixed.mesh, told);
    if (!fixed.rough.empty()) {
      told.push_back(fixed.rough);
      out.rough = true;
    }
    for (TriMesh& one : parts_of(fixed.mesh)) out.parts.push_back(std::move(one));
  }
  for (const std::string& what : order)
    told.push_back(counts[what].second + ": " + std::to_string(counts[what].first));
  if (out.parts.empty()) throw GeometryError("nothing of the surface is left after mending");
  return out;
}

Rims rims_of(const TriMesh& part, const geometry::FilledHoles& filled, bool tree_in_any_case) {
  Rims rims{geometry::boundary_loops(part), nullptr};
  if (tree_in_any_case || !rims.loops.empty())
    rims.tree = std::make_shared<const geometry::AabbTree>(filled.mesh);
  return rims;
}

std::vector<meshing::GivenEnd> close_holes_in_the_wall(TriMesh& part, const geometry::FilledHoles& filled,
                                                       const Rims& rims, std::vector<std::string>& told) {
  std::vector<meshing::GivenEnd> closed;
  const auto& loops = rims.loops;
  std::vector<bool> close(loops.size(), false);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const meshing::GivenEnd end = meshing::end_at_loop(part, loops[i]);
    close[i] = meshing::is_hole_in_wall(*rims.tree, end);
    if (!close[i]) continue;
    told.push_back("a hole in the wall closed, " + core::fixed_text(2.0 * end.radius_mm, 2) + " mm wide at " +
                   place_text(end.centre));
    closed.push_back(end);
  }
  if (closed.empty()) return closed;
  std::vector<bool> keep;
  for (const std::int32_t hole : filled.hole_of_triangle)
    keep.push_back(hole < 0 || close[static_cast<std::size_t>(hole)]);
  part = geometry::subset(filled.mesh, keep);
  return closed;
}

std::vector<meshing::GivenEnd> close_holes_in_the_wall(TriMesh& part, std::vector<std::string>& told) {
  const geometry::FilledHoles filled = geometry::fill_holes(part);
  return close_holes_in_the_wall(part, filled, rims_of(part, filled), told);
}

}  // namespace ostia::pipeline
