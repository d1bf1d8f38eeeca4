#include "ostia/pipeline/surface_intake.h"

#include "intake_ends.h"
#include "intake_units.h"
#include "nested_shells.h"
#include "specks.h"
#include "spikes.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
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
#include <optional>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

// Numbers of a vessel's mean calibre and extent below which it can hardly be in millimetres.
constexpr double least_calibre_mm = 0.6, least_extent_mm = 40.0;
constexpr double least_calibre_cm = 0.02, least_extent_cm = 1.5;
constexpr double told_volume_change = 0.02;  // by mending

/// An aorta in centimetres has the numbers of a short piece of a coronary in millimetres.
bool may_be_cm(double calibre, double extent) {
  return calibre > 1.0 && calibre < 4.5 && extent > 4.0 && extent < 30.0;
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
  bool sound = false;     ///< nothing to be mended before anything else looks at it; open ends are none
  bool all_used = false;  ///< nor a point that no triangle uses
  geometry::FilledHoles closed;  ///< where it is sound
};

FirstLook first_look(const TriMesh& mesh) {
  geometry::SurfaceFaults faults = geometry::find_faults(mesh, false);
  faults.open_edges = 0;
  if (!faults.closed_manifold() || faults.components != 1) return {};
  FirstLook look;
  look.all_used = faults.unused_points == 0;
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

/// Where the calibre leaves it open, the ends say it.
void settle_cm_by_ends(const geometry::FacedSurface& surface, TakenSurface& out, const std::string& sizes) {
  const std::optional<EndWidths> ends = end_widths(surface);
  if (!ends) return;
  const std::string thinnest = core::significant_text(ends->thinnest, 2),
                    widest = core::significant_text(ends->widest, 2);
  if (speak_for_cm(*ends)) {
    out.unit_mm = 10.0;
    out.told.push_back("taken to be in centimetres, since its thinnest end is " + thinnest +
                       " wide, which no vessel's is in millimetres, and its widest " + widest +
                       "; --units mm says otherwise");
  } else if (leave_cm_open(*ends)) {
    out.told.push_back("taken to be in millimetres: " + sizes + ", ends " + thinnest + " to " + widest +
                       " mm wide; were it an aorta in centimetres, say --units cm");
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
    else if (may_be_cm(calibre, extent))
      settle_cm_by_ends(surface, out,
                        "vessels " + core::significant_text(calibre, 2) + " mm wide in the mean, " +
                            core::significant_text(extent, 2) + " mm from end to end");
  }
  if (out.unit_mm == 1.0) return;
  for (Vec3& p : surface.mesh.points) p *= out.unit_mm;
}

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
    for (TriMesh& one : parts_of(fixed.mesh)) parts.push_back(std::move(one));
  }
  for (const std::string& what : order)
    told.push_back(counts[what].second + ": " + std::to_string(counts[what].first));
  if (parts.empty()) throw GeometryError("nothing of the surface is left after mending");
  return parts;
}

/// A part's open ends.
struct Rims {
  std::vector<std::vector<std::int32_t>> loops;
  std::shared_ptr<const geometry::AabbTree> tree;  ///< of the part with its holes filled; null if not needed
};

Rims rims_of(const TriMesh& part, const geometry::FilledHoles& filled, bool tree_in_any_case = false) {
  Rims rims{geometry::boundary_loops(part), nullptr};
  if (tree_in_any_case || !rims.loops.empty())
    rims.tree = std::make_shared<const geometry::AabbTree>(filled.mesh);
  return rims;
}

/// An opening much narrower than the lumen behind it is no end. `filled` is the part with its holes filled.
void close_holes_in_the_wall(TriMesh& part, const geometry::FilledHoles& filled, const Rims& rims,
                             std::vector<std::string>& told) {
  const auto& loops = rims.loops;
  std::vector<bool> close(loops.size(), false);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const meshing::GivenEnd end = meshing::end_at_loop(part, loops[i]);
    close[i] = meshing::is_hole_in_wall(*rims.tree, end);
    if (close[i])
      told.push_back("a hole in the wall closed, " + core::fixed_text(2.0 * end.radius_mm, 2) +
                     " mm wide at " + place_text(end.centre));
  }
  if (std::ranges::count(close, true) == 0) return;
  std::vector<bool> keep;
  for (const std::int32_t hole : filled.hole_of_triangle)
    keep.push_back(hole < 0 || close[static_cast<std::size_t>(hole)]);
  part = geometry::subset(filled.mesh, keep);
}

void close_holes_in_the_wall(TriMesh& part, std::vector<std::string>& told) {
  const geometry::FilledHoles filled = geometry::fill_holes(part);
  close_holes_in_the_wall(part, filled, rims_of(part, filled), told);
}

/// The tetrahedra take as long as all else that centerlines need, and need nothing of it. One thread does
/// them when they are asked for.
std::shared_ptr<centerline::DelaunayAhead> tetrahedra_ahead(const TriMesh& mesh,
                                                            const IntakeOptions& options) {
  if (!options.for_axes || options.strict || core::max_threads() < 2) return nullptr;
  return std::make_shared<centerline::DelaunayAhead>(mesh.points);
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
  std::shared_ptr<centerline::DelaunayAhead> tetrahedra = tetrahedra_ahead(surface.mesh, options);
  FirstLook look;
  if (!options.strict) look = first_look(surface.mesh);
  to_mm(surface, look, options, out, what);
  if (!options.strict && out.unit_mm != 1.0) {
    tetrahedra = look.sound ? tetrahedra_ahead(surface.mesh, options) : nullptr;
    look = first_look(surface.mesh);
  }
  if (!look.sound) tetrahedra.reset();
  task.throw_if_cancelled();
  geometry::FacedSurface ready = surface;
  centerline::KnownSurface known;
  bool as_it_was = false;  // the surface that is known
  bool labels_may_be_gone = false;
  std::optional<meshing::OpenedCaps> opened;
  const auto open_caps = [&] {
    if (options.open_caps) opened = meshing::without_flat_caps(ready, {}, task.sub(0.8, 1.0));
  };
  if (!options.strict && !look.sound) {
    std::vector<TriMesh> parts = mended(surface.mesh, out.told, task.sub(0.1, 0.7));
    const std::size_t before = parts.size();
    for (std::string& line : drop_outer_walls(parts)) out.told.push_back(std::move(line));
    const bool shells_gone = parts.size() < before;
    if (const Specks gone = drop_specks(parts); gone.count() > 0) out.told.push_back(gone.text());
    for (TriMesh& part : parts) close_holes_in_the_wall(part, out.told);
    ready.mesh = joined(parts);
    ready.face_ids = labels_on(ready.mesh, surface);
    if (!shells_gone) out.lost = rims_gone(surface.mesh, ready.mesh);
    labels_may_be_gone = !shells_gone;
    if (parts.size() > 1)
      out.told.push_back("it has " + std::to_string(parts.size()) +
                         " separate parts, each taken as a system of vessels of its own");
  } else if (!options.strict) {
    // Holes in the wall are rare: caps are looked for as if there were none, at the same time.
    TriMesh whole = ready.mesh;
    Rims rims;
    core::parallel_invoke(
        [&] {
          rims = rims_of(whole, look.closed, options.for_axes);
          close_holes_in_the_wall(whole, look.closed, rims, out.told);
        },
        open_caps);
    as_it_was = whole.triangles.size() == ready.mesh.triangles.size();
    if (as_it_was) {
      known = {std::move(rims.loops), std::move(look.closed.mesh), std::move(rims.tree), tetrahedra};
    } else {
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
    if (labels_may_be_gone) {
      for (const meshing::GivenEnd& label : labels_without_end(surface, out.ends)) {
        out.told.push_back("the label " + words_of(label) +
                           ", has no end after mending (cut the file open there)");
        out.lost.push_back(label);
      }
    }
    for (std::string& line : warnings_of(opened->not_taken)) out.told.push_back(std::move(line));
    for (const meshing::LabelNotTaken& label : opened->not_taken)
      if (label.like_an_end) out.lost.push_back(label.end);
    if (!out.ends.empty()) {
      std::string names;
      for (const meshing::GivenEnd& end : out.ends)
        if (!end.name.empty()) names += (names.empty() ? ": " : ", ") + end.name;
      out.told.push_back("flat caps taken as its ends: " + std::to_string(out.ends.size()) + names);
    }
  } else {
    out.lumen = std::move(ready.mesh);
  }
  if (as_it_was && look.all_used && out.ends.empty())
    out.known = std::make_shared<const centerline::KnownSurface>(std::move(known));
  task.set_progress(1.0);
  return out;
}

}  // namespace ostia::pipeline
