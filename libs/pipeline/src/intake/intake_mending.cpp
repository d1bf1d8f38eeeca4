#include "intake/intake_mending.h"

#include "intake/intake_ends.h"

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
// Openings of one end that is covered in part face the same way. Two round ends beside each other are as far
// apart as their radii together, aslant ones a little less.
constexpr double same_way_cosine = 0.5, least_apart_radii = 0.8;
// Or they lie in one plane about, and are narrower than the lumen behind them, which has room for both.
constexpr double in_plane_radii = 0.5, most_apart_radii = 4.0, slit_radii = 0.05;
constexpr double second_opening_share = 0.75, both_areas_share = 1.1;

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

/// Whether it opens the same end as a larger opening.
bool opens_end_of(const meshing::GivenEnd& larger, const meshing::GivenEnd& opening,
                  const geometry::AabbTree& closed) {
  if (opening.normal.dot(larger.normal) < same_way_cosine) return false;
  const Vec3 between = opening.centre - larger.centre;
  const double apart = between.norm();
  if (apart < least_apart_radii * (opening.radius_mm + larger.radius_mm)) return true;
  if (apart > most_apart_radii * larger.radius_mm ||
      std::abs(between.dot(larger.normal)) > in_plane_radii * larger.radius_mm)
    return false;
  const double depth = larger.radius_mm / std::max(opening.radius_mm, slit_radii * larger.radius_mm);
  const double width = meshing::lumen_width_behind(closed, opening, depth);
  const double areas = opening.radius_mm * opening.radius_mm + larger.radius_mm * larger.radius_mm;
  return apart < 2.0 * width && opening.radius_mm < second_opening_share * width &&
         areas < both_areas_share * width * width;
}

/// Of the openings of an end that is covered in part the largest is the end; the others.
std::vector<bool> second_openings(const std::vector<meshing::GivenEnd>& rims,
                                  const geometry::AabbTree& closed) {
  std::vector<bool> second(rims.size(), false);
  for (std::size_t i = 0; i < rims.size(); ++i)
    for (std::size_t k = 0; k < rims.size() && !second[i]; ++k) {
      const bool larger =
          rims[k].radius_mm > rims[i].radius_mm || (k < i && rims[k].radius_mm == rims[i].radius_mm);
      second[i] = larger && opens_end_of(rims[k], rims[i], closed);
    }
  return second;
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
  std::vector<meshing::GivenEnd> ends, closed;
  for (const auto& loop : rims.loops) ends.push_back(meshing::end_at_loop(part, loop));
  if (ends.empty()) return closed;
  std::vector<bool> close(ends.size(), false);
  const std::vector<bool> second = second_openings(ends, *rims.tree);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const bool hole = meshing::is_hole_in_wall(*rims.tree, ends[i]);
    close[i] = hole || second[i];
    if (!close[i]) continue;
    told.push_back((hole ? "a hole in the wall closed, " : "a second opening of one end closed, ") +
                   core::fixed_text(2.0 * ends[i].radius_mm, 2) + " mm wide at " +
                   place_text(ends[i].centre));
    closed.push_back(ends[i]);
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
