#include "ostia/pipeline/surface_intake.h"

#include "intake/intake_ends.h"
#include "intake/intake_mending.h"
#include "intake/intake_units.h"
#include "intake/specks.h"
#include "intake/spikes.h"
#include "motion/nested_shells.h"

#include "ostia/core/parallel.h"
#include "ostia/core/parallel_invoke.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/pipeline/lumen_surface.h"
#include "ostia/pipeline/model.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;

constexpr double blunt_rim_deg = 10.0;  // of labelled caps on a wall that was smoothed all over

/// What the first look at a surface tells.
struct FirstLook {
  bool sound = false;     ///< nothing to be mended before anything else looks at it; open ends are none
  bool all_used = false;  ///< nor a point that no triangle uses
  bool inward = false;    ///< though it was so all over: it is sound once its triangles are turned
  geometry::FilledHoles closed;  ///< where it is sound
};

void turn_round(TriMesh& mesh) {
  for (geometry::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

/// What it tells is of the surface as it faces outward.
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
                          const double volume = geometry::volume(look.closed.mesh);
                          look.inward = volume < 0.0;
                          if (look.inward) turn_round(look.closed.mesh);
                          smooth = volume != 0.0 && !has_spikes(mesh);
                        });
  look.sound = whole && smooth;
  return look;
}

/// The tetrahedra take as long as all else that centerlines need, and need nothing of it. One thread does
/// them when they are asked for.
std::shared_ptr<centerline::DelaunayAhead> tetrahedra_ahead(const TriMesh& mesh,
                                                            const IntakeOptions& options) {
  if (!options.for_axes || options.strict || core::max_threads() < 2) return nullptr;
  return std::make_shared<centerline::DelaunayAhead>(mesh.points);
}

/// One surface on its way in.
class Intake {
 public:
  /// `surface` in mm; `opened`: the same without its caps, where that is known.
  Intake(geometry::FacedSurface surface, std::optional<meshing::OpenedCaps> opened,
         const IntakeOptions& options, TakenSurface& out, const core::TaskContext& task)
      : came_(std::move(surface)),
        ready_(came_),
        options_(options),
        out_(out),
        task_(task),
        opened_(std::move(opened)) {}

  void mend() {
    // What is wrong at the rims of caps would be cut out together with the caps.
    early_ends_ = take_caps_off(ready_);
    const geometry::FacedSurface before = ready_;
    MendedParts whole = mended(before.mesh, out_.told, task_.sub(0.1, 0.7));
    std::vector<TriMesh>& parts = whole.parts;
    if (whole.rough) {  // smoothing has made round what was flat, and rims blunt
      caps_.by_shape = false;
      caps_.least_rim_deg = blunt_rim_deg;
    }
    const std::size_t count = parts.size();
    for (std::string& line : drop_outer_walls(parts)) out_.told.push_back(std::move(line));
    const bool shells_gone = parts.size() < count;
    if (const Specks gone = drop_specks(parts); gone.count() > 0) out_.told.push_back(gone.text());
    std::vector<meshing::GivenEnd> closed;
    for (TriMesh& part : parts)
      std::ranges::move(close_holes_in_the_wall(part, out_.told), std::back_inserter(closed));
    ready_.mesh = joined(parts);
    ready_.face_ids = labels_on(ready_.mesh, before);
    keep_early_ends();
    if (!shells_gone) out_.lost = rims_gone(before.mesh, ready_.mesh);
    // A hole that was closed has been told, and was wider or narrower while the wall was rough.
    std::erase_if(out_.lost, [&](const meshing::GivenEnd& rim) {
      return std::ranges::any_of(closed, [&](const meshing::GivenEnd& hole) {
        return (rim.centre - hole.centre).norm() <= std::max(rim.radius_mm, hole.radius_mm);
      });
    });
    labels_may_be_gone_ = !shells_gone;
    if (parts.size() > 1)
      out_.told.push_back("it has " + std::to_string(parts.size()) +
                          " separate parts, each taken as a system of vessels of its own");
  }

  /// Holes in the wall are rare: caps are looked for as if there were none, at the same time. Returns what is
  /// known of the surface where it stays as it is.
  std::optional<centerline::KnownSurface> look_for_holes(
      geometry::FilledHoles& closed, std::shared_ptr<centerline::DelaunayAhead> tetrahedra) {
    TriMesh whole = ready_.mesh;
    Rims rims;
    core::parallel_invoke(
        [&] {
          rims = rims_of(whole, closed, options_.for_axes);
          close_holes_in_the_wall(whole, closed, rims, out_.told);
        },
        [&] {
          if (!opened_) open_caps();
        });
    if (whole.triangles.size() == ready_.mesh.triangles.size())
      return centerline::KnownSurface{std::move(rims.loops), std::move(closed.mesh), std::move(rims.tree),
                                      std::move(tetrahedra)};
    ready_.mesh = std::move(whole);
    ready_.face_ids = labels_on(ready_.mesh, came_);
    opened_.reset();
    return std::nullopt;
  }

  void finish() {
    task_.throw_if_cancelled();
    if (!opened_) open_caps();
    out_.lumen = std::move(opened_->wall);
    out_.ends.insert(out_.ends.end(), opened_->ends.begin(), opened_->ends.end());
    tell_ends();
  }

 private:
  void open_caps() { opened_ = meshing::without_flat_caps(ready_, caps_, task_.sub(0.8, 1.0)); }

  /// Those that are still open; of the others tell_ends says what is lost.
  void keep_early_ends() {
    const std::vector<meshing::GivenEnd> open = open_rims(ready_.mesh);
    for (const meshing::GivenEnd& end : early_ends_)
      if (std::ranges::any_of(open, [&](const meshing::GivenEnd& rim) {
            return (rim.centre - end.centre).norm() <= 0.5 * end.radius_mm;
          }))
        out_.ends.push_back(end);
  }

  /// Whether it is among the labels that no end came of, which have a line of their own.
  bool is_told_below(const meshing::GivenEnd& label) const {
    return std::ranges::any_of(opened_->not_taken, [&](const meshing::LabelNotTaken& one) {
      return one.like_an_end &&
             (one.end.centre - label.centre).norm() <= std::max(one.end.radius_mm, label.radius_mm);
    });
  }

  void tell_ends() {
    if (labels_may_be_gone_) {
      for (const meshing::GivenEnd& label : labels_without_end(came_, out_.ends)) {
        if (is_told_below(label)) continue;
        out_.told.push_back("the label " + words_of(label) +
                            ", has no end after mending (cut the file open there)");
        std::erase_if(out_.lost, [&](const meshing::GivenEnd& rim) {
          return (rim.centre - label.centre).norm() <= label.radius_mm;
        });
        out_.lost.push_back(label);
      }
    }
    for (std::string& line : warnings_of(opened_->not_taken)) out_.told.push_back(std::move(line));
    for (const meshing::LabelNotTaken& label : opened_->not_taken)
      if (label.like_an_end) out_.lost.push_back(label.end);
    if (out_.ends.empty()) return;
    std::string names;
    for (const meshing::GivenEnd& end : out_.ends)
      if (!end.name.empty()) names += (names.empty() ? ": " : ", ") + end.name;
    out_.told.push_back("flat caps taken as its ends: " + std::to_string(out_.ends.size()) + names);
  }

  geometry::FacedSurface came_, ready_;
  const IntakeOptions& options_;
  TakenSurface& out_;
  const core::TaskContext& task_;
  meshing::FlatCapOptions caps_;
  std::vector<meshing::GivenEnd> early_ends_;  ///< of caps that came off before mending
  std::optional<meshing::OpenedCaps> opened_;
  bool labels_may_be_gone_ = false;
};

/// A wall with its lumen is closed and has handles; of a sound surface the first look tells.
bool may_be_wall(const TriMesh& mesh, const FirstLook& look) {
  if (!look.sound || !look.all_used) return true;
  return look.closed.mesh.triangles.size() == mesh.triangles.size() && handles_of(mesh) > 0;
}

/// The lumen alone, where the surface is a wall of some thickness.
std::optional<TakenSurface> taken_from_wall(const geometry::FacedSurface& surface, const FirstLook& look,
                                            const std::string& what, const IntakeOptions& options,
                                            const core::TaskContext& task) {
  std::optional<LumenInWall> within;
  if (may_be_wall(surface.mesh, look)) within = lumen_in_wall(surface);
  if (!within) return std::nullopt;
  TakenSurface out = take_surface({std::move(within->lumen), {}, {}}, what, options, task);
  out.told.insert(out.told.begin(), within->text(out.unit_mm));
  for (meshing::GivenEnd& end : within->ends) {
    end.centre *= out.unit_mm;
    end.radius_mm *= out.unit_mm;
    out.ends.push_back(std::move(end));
  }
  out.known.reset();
  return out;
}

}  // namespace

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
  if (!options.strict) {
    look = first_look(surface.mesh);
    if (look.sound && look.inward) {
      turn_round(surface.mesh);
      out.told.push_back("triangles turned the way of the others, or outward: " +
                         std::to_string(surface.mesh.triangles.size()));
    }
    if (auto lumen = taken_from_wall(surface, look, what, options, task)) {
      lumen->told.insert(lumen->told.begin(), out.told.begin(), out.told.end());
      return std::move(*lumen);
    }
  }
  std::optional<meshing::OpenedCaps> opened =
      to_mm(surface, look.sound ? std::optional(calibre_of_closed(look.closed.mesh)) : std::nullopt, options,
            out, what);
  if (!options.strict && out.unit_mm != 1.0) {
    tetrahedra = look.sound ? tetrahedra_ahead(surface.mesh, options) : nullptr;
    look = first_look(surface.mesh);
  }
  if (!look.sound) tetrahedra.reset();
  task.throw_if_cancelled();
  Intake intake(std::move(surface), std::move(opened), options, out, task);
  std::optional<centerline::KnownSurface> known;
  if (!options.strict && !look.sound) intake.mend();
  if (!options.strict && look.sound) known = intake.look_for_holes(look.closed, tetrahedra);
  intake.finish();
  if (known && look.all_used && out.ends.empty())
    out.known = std::make_shared<const centerline::KnownSurface>(std::move(*known));
  task.set_progress(1.0);
  return out;
}

}  // namespace ostia::pipeline
