#include "ostia/pipeline/motion_images.h"

#include "images/image_cage.h"
#include "images/image_cage_solver.h"
#include "images/image_splines.h"
#include "motion/motion_phases.h"
#include "reports/wall_profiles.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/imaging/filters.h"

#include <algorithm>
#include <array>
#include <optional>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;
using imaging::FloatVolume;
using imaging::ImageVolume;
using Points = std::vector<Vec3>;

constexpr double least_inside = 0.9;      // of the template, in its own image
constexpr double least_seen = 0.7;        // of it, in another phase's
constexpr double wall_sigma_mm = 0.5;     // against noise, for the profiles
constexpr double wall_margin_mm = 4.0;    // about the wall
constexpr double least_contrast_hu = 40;  // of a wall that shows

std::string named(const PhaseView& view) {
  return "phase " + percent_text(view.phase) + (view.name.empty() ? "" : " (" + view.name + ")");
}

/// The view of the template's phase.
std::size_t own_view(const std::vector<PhaseView>& views, double phase) {
  std::string all;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (is_same_phase(views[i].phase, phase)) return i;  // the only one: require_views has seen to it
    all += (all.empty() ? "" : ", ") + percent_text(views[i].phase);
  }
  throw InvalidInput(
      "the template is at " + percent_text(phase) +
      " of the cycle, and there is no image of that phase to compare the others with; there are " + all);
}

void require_views(const TriMesh& shape, const std::vector<PhaseView>& views) {
  if (shape.triangles.empty()) throw InvalidInput("the template has no triangles");
  if (views.size() < least_phases)
    throw InvalidInput("a motion needs images of three phases at least; there " +
                       std::string(views.size() == 1 ? "is " : "are ") + std::to_string(views.size()));
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!(views[i].phase >= 0.0 && views[i].phase < 1.0))
      throw InvalidInput(named(views[i]) + ": phases are from 0 to below 100 % of the cycle");
    const PhaseView& before = views[i > 0 ? i - 1 : views.size() - 1];  // they rise
    if (is_same_phase(before.phase, views[i].phase))
      throw InvalidInput(named(before) + " and " + named(views[i]) +
                         " are the same phase; leave one of the two out");
  }
}

/// What the template looks like where it is known.
struct Known {
  const TriMesh& shape;
  const ImageCage& cage;
  const std::optional<ImageSplines>& splines;  // where they carry it
  const WallProfiles& wall;
  const ImagePhasesOptions& options;
};

FloatVolume smooth_about(const ImageVolume& image, const Points& points, const core::TaskContext& task) {
  const FloatVolume part = part_about(image, geometry::bounds(points), wall_margin_mm);
  return part.voxels.empty() ? part : imaging::gaussian_blurred(part, wall_sigma_mm, task);
}

Points carried_points(const ImageCage& cage, const TriMesh& shape, const Points& control_points) {
  Points points(shape.points.size());
  core::parallel_for(points.size(), 1024, [&](std::size_t i) {
    points[i] =
        geometry::carried(cage.grid(), geometry::cage_point(cage.grid(), shape.points[i]), control_points);
  });
  return points;
}

/// Why a phase's image does not show the vessel; empty where it does.
std::string unseen(const ImageCageFit& fit, const ImagePhasesOptions& options) {
  if (fit.inside_share < least_seen)
    return "only " + core::rounded_text(100.0 * fit.inside_share, 0) +
           " % of the template would lie within its image";
  if (fit.likeness < options.least_likeness)
    return "its image does not show the vessel as the template's does (correlation " +
           core::cut_text(fit.likeness, 2) + ")";
  return {};
}

/// The template where it is in another image, before its wall is looked for.
struct CarriedTemplate {
  ImageCageFit fit;
  Points points;
  std::string why;  ///< there is nothing to compare; else empty
};

CarriedTemplate carried_by_cage(const Known& known, const ImageVolume& image,
                                const std::vector<Points>& starts, const core::TaskContext& task) {
  CarriedTemplate out{known.cage.fitted(image, starts, task), {}, {}};
  out.points = carried_points(known.cage, known.shape, out.fit.control_points);
  return out;
}

CarriedTemplate carried_by_splines(const Known& known, const ImageVolume& image, const Points& start,
                                   const core::TaskContext& task) {
  const geometry::CageGrid& grid = known.cage.grid();
  CarriedTemplate out;
  try {
    const registration::Transform map = known.splines->fitted(
        image, [&](const Vec3& p) { return geometry::carried(grid, geometry::cage_point(grid, p), start); },
        task.sub(0.0, 0.9));
    Points control_points = geometry::rest_points(grid);
    for (Vec3& p : control_points) p = map(p);
    out.points = known.shape.points;
    core::parallel_for(out.points.size(), 1024, [&](std::size_t i) { out.points[i] = map(out.points[i]); });
    out.fit = known.cage.judged(image, std::move(control_points), task.sub(0.9, 1.0));
  } catch (const InvalidInput& error) {
    out.why = std::string("its image cannot be laid onto the template's: ") + error.what();
  }
  return out;
}

/// One phase; its cage where the vessel was found, for the next one.
std::optional<Points> find_in(const Known& known, const PhaseView& view, const std::vector<Points>& starts,
                              PhaseSurface& surface, ImagePhase& told, const core::TaskContext& task) {
  const std::shared_ptr<const ImageVolume> image = view.read(task.sub(0.0, 0.2));
  CarriedTemplate found = known.splines
                              ? carried_by_splines(known, *image, starts.front(), task.sub(0.2, 0.9))
                              : carried_by_cage(known, *image, starts, task.sub(0.2, 0.9));
  ImageCageFit& fit = found.fit;
  told.likeness = fit.likeness;
  told.inside_share = fit.inside_share;
  surface.why = found.why.empty() ? unseen(fit, known.options) : found.why;
  if (!surface.why.empty()) return std::nullopt;
  TriMesh carried{std::move(found.points), known.shape.triangles};
  FoundWall wall = found_wall(carried, known.wall, smooth_about(*image, carried.points, task));
  told.found = true;
  told.wall_shift_mm = wall.mean_shift_mm;
  surface.surface = {std::move(wall.points), std::move(carried.triangles)};
  // Beyond what is compared a spline may press a cell together: no start for what keeps cells whole.
  if (least_jacobian_of(known.cage.grid(), fit.control_points) >= least_jacobian)
    surface.start = fit.control_points;
  return std::move(fit.control_points);
}

/// Where a phase is looked for: at its neighbour's, and where it would be if the motion went on.
std::vector<Points> starts_from(const Points& last, const Points& before) {
  std::vector<Points> starts{last};
  if (before.empty()) return starts;
  starts.push_back(last);
  for (std::size_t p = 0; p < last.size(); ++p) starts[1][p] += last[p] - before[p];
  return starts;
}

void find_on_way(const Known& known, const std::vector<PhaseView>& views, const std::vector<std::size_t>& way,
                 ImagePhases& out, const core::TaskContext& task) {
  Points last = geometry::rest_points(known.cage.grid()), before;
  for (std::size_t k = 0; k < way.size(); ++k) {
    task.throw_if_cancelled();
    const std::size_t i = way[k];
    task.set_stage("looking for the vessel at " + percent_text(views[i].phase));
    const auto n = static_cast<double>(way.size());
    std::optional<Points> found =
        find_in(known, views[i], starts_from(last, before), out.surfaces[i], out.found[i],
                task.sub(static_cast<double>(k) / n, static_cast<double>(k + 1) / n));
    if (!found) {
      before.clear();  // the steps are no longer even
      continue;
    }
    before = std::move(last);
    last = std::move(*found);
  }
}

void require_template_in(const TriMesh& shape, const PhaseView& view, const ImageVolume& image) {
  std::size_t inside = 0;
  for (const Vec3& p : shape.points) inside += image.geometry.contains(p) ? 1 : 0;
  const double share = static_cast<double>(inside) / static_cast<double>(shape.points.size());
  if (share < least_inside)
    throw InvalidInput("only " + core::rounded_text(100.0 * share, 0) +
                       " % of the template lie within the image of its " + named(view) +
                       ": it is of another patient, in another frame (LPS is expected) or in another unit "
                       "(say which with --units)");
}

}  // namespace

ImagePhases surfaces_from_images(const TriMesh& shape, std::vector<PhaseView> views,
                                 const ImagePhasesOptions& options, const core::TaskContext& task) {
  std::ranges::sort(views, {}, &PhaseView::phase);
  require_views(shape, views);
  const std::size_t own = own_view(views, options.template_phase);
  task.set_stage("reading the template's image");
  const std::shared_ptr<const ImageVolume> still = views[own].read(task.sub(0.0, 0.02));
  require_template_in(shape, views[own], *still);
  const ImageCage cage(shape, *still, options.depth, options.margin, task.sub(0.02, 0.05));
  std::optional<ImageSplines> splines;
  if (options.carrier == ImageCarrier::b_splines) splines.emplace(shape, still);
  const WallProfiles wall = wall_profiles(shape, smooth_about(*still, shape.points, task));
  ImagePhases out;
  if (wall_contrast(wall) < least_contrast_hu)
    out.warnings.push_back("the template's inside is hardly brighter than what is about it in the image of " +
                           percent_text(views[own].phase) + ": is it the surface of that phase?");
  std::vector<double> phases;
  for (const PhaseView& view : views) {
    phases.push_back(view.phase);
    out.surfaces.push_back({view.phase, view.name, {}, {}, {}});
    out.found.push_back({view.phase});
  }
  out.surfaces[own].surface = shape;
  out.found[own] = {views[own].phase, 1.0, 1.0, 0.0, true};
  const std::array<Way, 2> both = ways(phases, own);
  const core::TaskContext rest = task.sub(0.05, 1.0);
  const Known known{shape, cage, splines, wall, options};
  core::parallel_for(2, 1, [&](std::size_t k) {
    find_on_way(known, views, both[k].phases, out, k == 0 ? rest : rest.sub(0.0, 1.0));
  });
  task.set_progress(1.0);
  return out;
}

}  // namespace ostia::pipeline
