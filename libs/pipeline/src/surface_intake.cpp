#include "ostia/pipeline/surface_intake.h"

#include "specks.h"
#include "spikes.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel_invoke.h"
#include "ostia/core/text.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/pipeline/lumen_axes.h"
#include "ostia/pipeline/model.h"
#include "ostia/pipeline/repair.h"
#include "ostia/pipeline/source.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

// Numbers of a vessel's mean calibre and extent below which it can hardly be in millimetres.
constexpr double least_calibre_mm = 0.6, least_extent_mm = 40.0;
constexpr double least_calibre_cm = 0.02, least_extent_cm = 1.5;

/// An aorta in centimetres has the numbers of a short piece of a coronary in millimetres.
bool may_be_cm(double calibre, double extent) {
  return calibre > 1.0 && calibre < 4.5 && extent > 4.0 && extent < 30.0;
}

std::string near_place(const Vec3& p) {
  return "(" + core::fixed_text(p.x(), 1) + ", " + core::fixed_text(p.y(), 1) + ", " +
         core::fixed_text(p.z(), 1) + ") mm";
}

/// The numbers of the labels on a surface that was changed: those of the nearest triangles before.
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

/// Triangles whose points are numbers, and their labels.
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

/// What the first look at a surface tells.
struct FirstLook {
  bool sound = false;  ///< nothing to be mended before anything else looks at it; open ends are none
  geometry::FilledHoles closed;  ///< where it is sound
};

FirstLook first_look(const TriMesh& mesh) {
  geometry::SurfaceFaults faults = geometry::find_faults(mesh, false);
  faults.open_edges = 0;
  if (!faults.closed_manifold() || faults.components != 1) return {};
  FirstLook look;
  bool whole = false, smooth = false;
  core::parallel_invoke([&] { whole = geometry::self_intersections(mesh).empty(); },
                        [&] {
                          look.closed = geometry::fill_holes(mesh);
                          smooth = geometry::volume(look.closed.mesh) > 0.0 && !has_spikes(mesh);
                        });
  look.sound = whole && smooth;
  return look;
}

double calibre_of_closed(const TriMesh& closed) {
  return 4.0 * std::abs(geometry::volume(closed)) / geometry::area(closed);
}

double calibre_of(const TriMesh& mesh) {
  try {
    return calibre_of_closed(geometry::fill_holes(geometry::oriented(geometry::welded(mesh))).mesh);
  } catch (const Error&) {  // too broken for that: its extent alone decides
    return geometry::bounds(mesh.points).sizes().maxCoeff();
  }
}

/// `look` is at the surface as it was read.
void to_mm(geometry::FacedSurface& surface, const FirstLook& look, const IntakeOptions& options,
           TakenSurface& out, const std::string& what) {
  const double extent = geometry::bounds(surface.mesh.points).sizes().norm();
  if (options.unit_mm) {
    out.unit_mm = *options.unit_mm;
  } else {
    const double calibre = look.sound ? calibre_of_closed(look.closed.mesh) : calibre_of(surface.mesh);
    out.unit_mm = unit_by_calibre(calibre, extent);
    check_vessel_size(out.unit_mm * calibre, what);
    if (out.unit_mm != 1.0)
      out.told.push_back("taken to be in " + std::string(out.unit_mm == 10.0 ? "centimetres" : "metres") +
                         ", since its vessels are " + core::significant_text(calibre, 2) +
                         " wide in the mean; --units mm says otherwise");
    else if (!surface.face_ids.empty() && may_be_cm(calibre, extent))
      out.told.push_back("taken to be in millimetres: vessels " + core::significant_text(calibre, 2) +
                         " mm wide in the mean, " + core::significant_text(extent, 2) +
                         " mm from end to end; were it an aorta in centimetres, say --units cm");
  }
  if (out.unit_mm == 1.0) return;
  for (Vec3& p : surface.mesh.points) p *= out.unit_mm;
}

/// Each part turned, welded, taken apart, its folds cut out; one line for each kind of step.
std::vector<TriMesh> mended(const TriMesh& mesh, std::vector<std::string>& told,
                            const core::TaskContext& task) {
  RepairOptions how;
  how.parts = KeptParts::all;
  std::map<std::string, std::pair<std::size_t, std::string>> counts;  // by the step's key
  std::vector<std::string> order;
  std::vector<TriMesh> parts;
  for (const TriMesh& part : parts_of(geometry::welded(mesh))) {
    task.throw_if_cancelled();
    Repaired fixed;
    try {
      fixed = repaired(part, how, task);
    } catch (const GeometryError&) {  // nothing of this part is left, and it was next to nothing
      told.push_back("a part of " + std::to_string(part.triangles.size()) + " triangles at " +
                     near_place(geometry::bounds(part.points).center()) +
                     " cannot be mended and is left out");
      continue;
    }
    for (const RepairStep& step : fixed.steps) {
      if (!counts.contains(step.what)) order.push_back(step.what);
      auto& [count, text] = counts[step.what];
      count += step.count;
      text = step.text.substr(0, step.text.rfind(':'));
    }
    for (TriMesh& one : parts_of(fixed.mesh)) parts.push_back(std::move(one));
  }
  for (const std::string& what : order)
    told.push_back(counts[what].second + ": " + std::to_string(counts[what].first));
  if (parts.empty()) throw GeometryError("nothing of the surface is left after mending");
  return parts;
}

/// An opening much narrower than the lumen behind it is no end. `filled` is the part with its holes filled.
void close_holes_in_the_wall(TriMesh& part, const geometry::FilledHoles& filled,
                             std::vector<std::string>& told) {
  const auto loops = geometry::boundary_loops(part);
  if (loops.empty()) return;
  const geometry::AabbTree tree(filled.mesh);
  std::vector<bool> close(loops.size(), false);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const meshing::GivenEnd end = meshing::end_at_loop(part, loops[i]);
    close[i] = meshing::is_hole_in_wall(tree, end);
    if (close[i])
      told.push_back("a hole in the wall closed, " + core::fixed_text(2.0 * end.radius_mm, 2) +
                     " mm wide at " + near_place(end.centre));
  }
  if (std::ranges::count(close, true) == 0) return;
  std::vector<bool> keep;
  for (const std::int32_t hole : filled.hole_of_triangle)
    keep.push_back(hole < 0 || close[static_cast<std::size_t>(hole)]);
  part = geometry::subset(filled.mesh, keep);
}

}  // namespace

double unit_by_calibre(double calibre, double extent) {
  if (calibre < least_calibre_cm && extent < least_extent_cm) return 1000.0;
  if (calibre < least_calibre_mm && extent < least_extent_mm) return 10.0;
  return 1.0;
}

TakenSurface take_surface(geometry::FacedSurface surface, const std::string& what,
                          const IntakeOptions& options, const core::TaskContext& task) {
  TakenSurface out;
  if (options.strict) {
    require_sound_surface(surface.mesh, what);
  } else {
    drop_what_is_nowhere(surface, out.told);
  }
  FirstLook look;
  if (!options.strict) look = first_look(surface.mesh);
  to_mm(surface, look, options, out, what);
  if (!options.strict && out.unit_mm != 1.0) look = first_look(surface.mesh);
  task.throw_if_cancelled();
  geometry::FacedSurface ready = surface;
  std::optional<meshing::OpenedCaps> opened;
  const auto open_caps = [&] {
    if (options.open_caps) opened = meshing::without_flat_caps(ready, {}, task.sub(0.8, 1.0));
  };
  if (!options.strict && !look.sound) {
    std::vector<TriMesh> parts = mended(surface.mesh, out.told, task.sub(0.1, 0.7));
    if (const Specks gone = drop_specks(parts); gone.count() > 0) out.told.push_back(gone.text());
    for (TriMesh& part : parts) close_holes_in_the_wall(part, geometry::fill_holes(part), out.told);
    ready.mesh = joined(parts);
    ready.face_ids = labels_on(ready.mesh, surface);
    if (parts.size() > 1)
      out.told.push_back("it has " + std::to_string(parts.size()) +
                         " separate parts, each taken as a system of vessels of its own");
  } else if (!options.strict) {
    // Holes in the wall are rare: caps are looked for as if there were none, at the same time.
    TriMesh whole = ready.mesh;
    core::parallel_invoke([&] { close_holes_in_the_wall(whole, look.closed, out.told); }, open_caps);
    if (whole.triangles.size() != ready.mesh.triangles.size()) {
      ready.mesh = std::move(whole);
      ready.face_ids = labels_on(ready.mesh, surface);
      opened.reset();
    }
  }
  task.throw_if_cancelled();
  if (options.open_caps) {
    if (!opened) open_caps();
    out.lumen = std::move(opened->wall);
    out.ends = std::move(opened->ends);
    if (!out.ends.empty()) {
      std::string names;
      for (const meshing::GivenEnd& end : out.ends)
        if (!end.name.empty()) names += (names.empty() ? ": " : ", ") + end.name;
      out.told.push_back("flat caps taken as its ends: " + std::to_string(out.ends.size()) + names);
    }
  } else {
    out.lumen = std::move(ready.mesh);
  }
  task.set_progress(1.0);
  return out;
}

}  // namespace ostia::pipeline
