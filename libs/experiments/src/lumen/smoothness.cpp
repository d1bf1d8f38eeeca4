#include "ostia/experiments/smoothness.h"

#include "lumen/vtk_filters.h"
#include "motion/level_set_image.h"
#include "orientation/orientation_lines.h"

#include "ostia/core/error.h"
#include "ostia/evaluation/surface_distance.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/reconstruction/surface.h"

#include <algorithm>
#include <cmath>

namespace ostia::experiments {
namespace {

using geometry::TriMesh;

/// Holds surfaces of one scan against its isosurface and the truth.
class Judge {
 public:
  Judge(const std::vector<PhantomTube>& tubes, const Orientation& orientation, const TriMesh& isosurface,
        const SmoothnessOptions& options)
      : tubes_(tubes),
        orientation_(orientation),
        isosurface_(isosurface),
        clear_mm_(options.clear_mm),
        sample_mm_(options.sample_mm) {}

  SurfaceFigures figures(const TriMesh& mesh, SurfaceKind kind, double parameter,
                         const core::TaskContext& task) const {
    SurfaceFigures out;
    out.orientation = orientation_.name;
    out.kind = kind;
    out.parameter = parameter;
    out.triangles = mesh.triangles.size();
    const auto place = [this](const Vec3& p) { return place_of(tubes_, in_phantom(p), clear_mm_); };
    const auto of_tube = [&](const Vec3& p) { return place(p) == PhantomPlace::tube; };
    out.tubes = bending_of(mesh, of_tube, task);
    out.wall = bending_of(
        mesh, [&](const Vec3& p) { return place(p) != PhantomPlace::end; }, task);
    out.whole = bending_of(mesh, {}, task);
    if (kind != SurfaceKind::isosurface) {
      const evaluation::SurfaceDistances d =
          evaluation::compare_surfaces(isosurface_, mesh, {sample_mm_, {}, {}}, task);
      out.rms_mm = d.rms_sd_mm;
      out.hausdorff_mm = d.max_sd_mm;
      out.tubes_rms_mm =
          evaluation::compare_surfaces(isosurface_, mesh, {sample_mm_, of_tube, of_tube}, task).rms_sd_mm;
    }
    add_truth(mesh, out);
    out.closed = geometry::find_faults(mesh, false).closed_manifold();
    out.self_intersections = geometry::self_intersections(mesh).size();
    return out;
  }

 private:
  void add_truth(const TriMesh& mesh, SurfaceFigures& out) const {
    const std::vector<double> area = vertex_areas(mesh);
    double squares = 0.0, all = 0.0, sum = 0.0, of_tubes = 0.0;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const Vec3 p = in_phantom(mesh.points[i]);
      const double d = distance_to_phantom(tubes_, p);
      squares += area[i] * d * d;
      all += area[i];
      if (place_of(tubes_, p, clear_mm_) != PhantomPlace::tube) continue;
      sum += area[i] * d;
      of_tubes += area[i];
    }
    out.true_rms_mm = std::sqrt(squares / all);
    out.tubes_true_mean_mm = of_tubes > 0.0 ? sum / of_tubes : 0.0;
  }

  Vec3 in_phantom(const Vec3& point) const { return orientation_.turn.transpose() * point; }

  const std::vector<PhantomTube>& tubes_;
  const Orientation& orientation_;
  const TriMesh& isosurface_;
  double clear_mm_, sample_mm_;
};

/// The skeleton's network with sections as the isosurface has them, as circles and as ellipses.
void add_sections(const geometry::VesselGraph& network, const TriMesh& isosurface, const Judge& judge,
                  const SmoothnessOptions& options, std::vector<SurfaceFigures>& out,
                  const core::TaskContext& task) {
  const reconstruction::FittedSections fit =
      reconstruction::fit_elliptic_sections(network, isosurface, {}, task.sub(0.0, 0.2));
  reconstruction::ReconstructionOptions how;
  how.level = level_of_sections(options);
  const TriMesh circles =
      reconstruction::reconstruct_surface(fit.graph, how, task.sub(0.2, 0.4)).surface.mesh;
  out.push_back(judge.figures(circles, SurfaceKind::areas, how.level, task.sub(0.4, 0.6)));
  const TriMesh ellipses =
      reconstruction::reconstruct_surface(fit.graph, fit.sections, how, task.sub(0.6, 0.8)).surface.mesh;
  out.push_back(judge.figures(ellipses, SurfaceKind::elliptic, how.level, task.sub(0.8, 1.0)));
}

/// What VTK makes of the isosurface; smoothed from about as many triangles as `triangles` on.
void add_vtk(const TriMesh& isosurface, std::size_t triangles, const Judge& judge,
             const SmoothnessOptions& options, std::vector<SurfaceFigures>& out,
             const core::TaskContext& task) {
  const double all = static_cast<double>(options.decimations.size() + options.smoothings.size() + 1);
  double done = 0.0;
  const auto part = [&] {
    task.throw_if_cancelled();
    done += 1.0;
    return task.sub((done - 1.0) / all, done / all);
  };
  for (const double share : options.decimations)
    out.push_back(judge.figures(decimated_by_vtk(isosurface, share), SurfaceKind::decimated, share, part()));
  const double share =
      1.0 - static_cast<double>(triangles) / static_cast<double>(isosurface.triangles.size());
  const TriMesh alike = share > 0.0 ? decimated_by_vtk(isosurface, share) : isosurface;
  out.push_back(judge.figures(alike, SurfaceKind::smoothed, 0.0, part()));
  for (const int iterations : options.smoothings)
    out.push_back(judge.figures(smoothed_by_vtk(alike, iterations, options.relaxation), SurfaceKind::smoothed,
                                iterations, part()));
}

}  // namespace

int level_of_sections(const SmoothnessOptions& options) {
  return std::min(1, options.levels - 1);
}

void validate(const SmoothnessOptions& o) {
  validate(o.scans);
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("smoothness: ") + what);
  };
  require(o.levels >= 1 && o.levels <= 4, "levels must lie in [1, 4]");
  for (const double share : o.decimations)
    require(share > 0.0 && share < 1.0, "decimations must lie in (0, 1)");
  for (const int iterations : o.smoothings) require(iterations > 0, "smoothings must be positive");
  require(o.relaxation > 0.0 && o.relaxation <= 1.0, "relaxation must lie in (0, 1]");
  require(o.clear_mm > 0.0, "clear_mm must be positive");
  require(o.sample_mm > 0.0, "sample_mm must be positive");
}

std::vector<SurfaceFigures> measure_smoothness(const std::vector<PhantomTube>& tubes,
                                               const Orientation& orientation, bool vtk,
                                               const SmoothnessOptions& options,
                                               const core::TaskContext& task) {
  validate(options);
  const ScannedLines scan = scanned_lines(tubes, orientation, options.scans, task.sub(0.0, 0.4));
  const TriMesh isosurface = isosurface_of(scan.surface.level_set, task.sub(0.4, 0.42));
  centerline::SectionOptions sections = scan.sections;
  sections.move_points = false;  // the lines were smoothed
  const centerline::MeasuredSkeleton lines = centerline::measured(
      scan.lines.skeleton.graph, share_inside(scan.surface.level_set), sections, task.sub(0.42, 0.5));
  const geometry::VesselGraph network = network_of(lines.graph, options.scans.knots_mm);
  const Judge judge(tubes, orientation, isosurface, options);
  std::vector<SurfaceFigures> out;
  out.push_back(judge.figures(isosurface, SurfaceKind::isosurface, 0.0, task.sub(0.5, 0.55)));
  std::size_t alike = 0;
  task.set_stage("reconstructing");
  for (int level = 0; level < options.levels; ++level) {
    const double at = 0.55 + 0.2 * level / options.levels, step = 0.2 / options.levels;
    reconstruction::ReconstructionOptions how;
    how.level = level;
    const TriMesh mesh =
        reconstruction::reconstruct_surface(network, how, task.sub(at, at + 0.7 * step)).surface.mesh;
    if (level <= 1) alike = mesh.triangles.size();
    out.push_back(judge.figures(mesh, SurfaceKind::level, level, task.sub(at + 0.7 * step, at + step)));
  }
  add_sections(network, isosurface, judge, options, out, task.sub(0.75, 0.8));
  task.set_stage("decimating and smoothing");
  if (vtk) add_vtk(isosurface, alike, judge, options, out, task.sub(0.8, 1.0));
  return out;
}

std::vector<SurfaceFigures> measure_smoothness(const std::vector<PhantomTube>& tubes,
                                               const std::vector<Orientation>& orientations,
                                               const SmoothnessOptions& options,
                                               const core::TaskContext& task) {
  if (orientations.empty()) throw InvalidInput("smoothness: there is no orientation to scan in");
  std::vector<SurfaceFigures> all;
  const double share = 1.0 / static_cast<double>(orientations.size());
  const std::size_t vtk_at = std::min(options.vtk_at, orientations.size() - 1);
  for (std::size_t i = 0; i < orientations.size(); ++i) {
    const double at = share * static_cast<double>(i);
    for (SurfaceFigures& figures :
         measure_smoothness(tubes, orientations[i], i == vtk_at, options, task.sub(at, at + share)))
      all.push_back(std::move(figures));
  }
  return all;
}

}  // namespace ostia::experiments
