#include "ostia/meshing/tetrahedralize.h"

#include "mesher/mesher_child.h"
#include "tetrahedra/mending.h"
#include "tetrahedra/quality.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <set>
#include <utility>

namespace ostia::meshing {

using geometry::Vec3;

void validate(const TetrahedralizeOptions& o) {
  auto in = [](double value, double low, double high, const std::string& name) {
    if (!(value >= low && value <= high))
      throw InvalidInput("tetrahedra: " + name + " " + std::to_string(value) + " must lie in [" +
                         std::to_string(low) + ", " + std::to_string(high) + "]");
  };
  in(o.size_factor, 0.1, 10.0, "size_factor");
  in(o.max_radius_edge_ratio, 1.1, 10.0, "max_radius_edge_ratio");
  in(o.min_dihedral_deg, 0.0, 18.0, "min_dihedral_deg");
  in(o.mending_rounds, 0, 100, "mending_rounds");
  in(o.mend_below_deg, 0.0, 60.0, "mend_below_deg");
  in(o.most_growth, 0.0, 1.0, "most_growth");
  if (o.field) validate(*o.field);
}

namespace {

constexpr double mesher_share = 0.7;  // of the progress

void check_surface(const geometry::FacedSurface& surface, bool thorough) {
  const geometry::TriMesh& mesh = surface.mesh;
  if (mesh.triangles.empty()) throw InvalidInput("tetrahedra: the surface has no triangles");
  if (surface.face_ids.size() != mesh.triangles.size())
    throw InvalidInput("tetrahedra: " + std::to_string(surface.face_ids.size()) + " face ids for " +
                       std::to_string(mesh.triangles.size()) + " triangles; one a triangle is needed");
  for (const geometry::Triangle& t : mesh.triangles)
    for (const std::int32_t v : t)
      if (v < 0 || static_cast<std::size_t>(v) >= mesh.points.size())
        throw InvalidInput("tetrahedra: a triangle refers to point " + std::to_string(v) +
                           ", which does not exist");
  if (!thorough) return;
  const geometry::SurfaceFaults faults = geometry::find_faults(mesh, true);
  if (!faults.closed_manifold() || faults.self_intersections > 0)
    throw GeometryError("the surface cannot be filled with tetrahedra: " + faults.summary() +
                        "; cap its ends and repair it first");
  if (!(geometry::volume(mesh) > 0.0))
    throw GeometryError(
        "the surface cannot be filled with tetrahedra: it points inward; orient it outward first");
}

/// What TetGen may not exceed with a circumradius near each point: the mean edge there times the factor, but
/// well above the circumradii of the surface's own triangles. These cannot be refined, and TetGen would add
/// points beside them for ever.
std::vector<double> local_sizes(const geometry::TriMesh& mesh, double factor) {
  constexpr double clearance = 1.15;
  std::vector<double> sum(mesh.points.size(), 0.0), count(mesh.points.size(), 0.0),
      least(mesh.points.size(), 0.0);
  for (const geometry::Triangle& t : mesh.triangles) {
    double lengths = 1.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = static_cast<std::size_t>(t[i]), b = static_cast<std::size_t>(t[(i + 1) % 3]);
      const double length = (mesh.points[a] - mesh.points[b]).norm();
      lengths *= length;
      for (const std::size_t v : {a, b}) sum[v] += length, count[v] += 1.0;
    }
    const Vec3& p = mesh.points[static_cast<std::size_t>(t[0])];
    const double twice_area = (mesh.points[static_cast<std::size_t>(t[1])] - p)
                                  .cross(mesh.points[static_cast<std::size_t>(t[2])] - p)
                                  .norm();
    if (twice_area > 0.0)
      for (const std::int32_t v : t)
        least[static_cast<std::size_t>(v)] =
            std::max(least[static_cast<std::size_t>(v)], clearance * lengths / (2.0 * twice_area));
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (count[i] > 0.0) sum[i] = std::max(factor * sum[i] / count[i], least[i]);
  return sum;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The mesher's tetrahedra have a volume, and TetGen kept the surface.
void check_result(const geometry::FacedSurface& surface, const TetrahedralizedVolume& result) {
  const std::string mesher = result.report.made_by == Mesher::mesh3 ? "Mesh_3" : "TetGen";
  const VolumeQuality& quality = result.report.quality;
  const std::vector<Vec3>& points = result.mesh.points;
  bool same = result.report.made_by == Mesher::mesh3 || points.size() >= surface.mesh.points.size();
  for (std::size_t i = 0; same && mesher == "TetGen" && i < surface.mesh.points.size(); ++i)
    same = points[i] == surface.mesh.points[i];
  if (!same)
    throw GeometryError("TetGen moved or dropped points of the surface; remesh the surface and try again");
  if (quality.boundary_mismatches > 0)
    throw GeometryError(mesher + " changed the surface in " + std::to_string(quality.boundary_mismatches) +
                        " places; remesh the surface and try again");
  if (quality.inverted > 0)
    throw GeometryError(mesher + " made " + std::to_string(quality.inverted) +
                        " tetrahedra without volume; remesh the surface and try again");
}

/// The largest distance found between two surfaces, mm.
double largest_distance(const geometry::TriMesh& fresh, const geometry::TriMesh& old) {
  const geometry::AabbTree to_old(old), to_fresh(fresh);
  double largest = 0.0;
  for (const geometry::Triangle& t : fresh.triangles) {
    const Vec3 &a = fresh.points[static_cast<std::size_t>(t[0])],
               &b = fresh.points[static_cast<std::size_t>(t[1])],
               &c = fresh.points[static_cast<std::size_t>(t[2])];
    for (const Vec3& p :
         {a, b, c, Vec3(0.5 * (a + b)), Vec3(0.5 * (b + c)), Vec3(0.5 * (c + a)), Vec3((a + b + c) / 3.0)})
      largest = std::max(largest, to_old.closest(p).distance);
  }
  for (const geometry::Triangle& t : old.triangles)
    for (const std::int32_t v : t)
      largest = std::max(largest, to_fresh.closest(old.points[static_cast<std::size_t>(v)]).distance);
  return largest;
}

/// The faces' ids that have triangles.
std::set<std::int32_t> ids_of(const std::vector<std::int32_t>& ids) {
  return {ids.begin(), ids.end()};
}

void judge_new_surface(const geometry::FacedSurface& surface, const geometry::VolumeMesh& mesh,
                       TetrahedralizeReport& report) {
  geometry::TriMesh fresh{mesh.points, mesh.boundary};
  const geometry::SurfaceFaults faults = geometry::find_faults(fresh, true);
  if (!faults.closed_manifold() || faults.self_intersections > 0 ||
      ids_of(mesh.boundary_face_ids) != ids_of(surface.face_ids))
    throw GeometryError("Mesh_3 did not keep the shape of the surface (" + faults.summary() +
                        "); take a smaller edge length");
  report.surface_meshed_anew = true;
  report.surface_deviation_mm = largest_distance(fresh, surface.mesh);
  char text[200];
  std::snprintf(text, sizeof text,
                "the surface was meshed anew by CGAL Mesh_3: %zu triangles in place of %zu, at most %.3g mm "
                "from the one given",
                mesh.boundary.size(), surface.mesh.triangles.size(), report.surface_deviation_mm);
  report.warnings.emplace_back(text);
}

void mend(const TetrahedralizeOptions& options, TetrahedralizedVolume& result,
          const core::TaskContext& task) {
  const auto start = std::chrono::steady_clock::now();
  TetrahedralizeReport& report = result.report;
  report.mending = mend_tetrahedra(
      result.mesh, {options.mend_below_deg, options.mending_rounds, options.most_growth}, task);
  report.mending_seconds = seconds_since(start);
  report.quality = volume_quality(result.mesh, task);
  const MendingReport& mending = report.mending;
  constexpr double worth_telling_deg = 10.0;
  if (mending.least_held_deg >= worth_telling_deg) return;
  char text[240];
  std::snprintf(
      text, sizeof text,
      "%zu tetrahedra lie in a wedge of the surface whose own angle is their smallest; the sharpest "
      "has %.3g degrees near %.6g,%.6g,%.6g: smooth the surface there for better elements",
      mending.held_by_surface, mending.least_held_deg, mending.held_place.x(), mending.held_place.y(),
      mending.held_place.z());
  report.warnings.emplace_back(text);
}

void count_bad(const geometry::VolumeMesh& mesh, TetrahedralizeReport& report) {
  const auto at = [&](std::int32_t v) -> const Vec3& { return mesh.points[static_cast<std::size_t>(v)]; };
  const double below_12 = quality_of_angle(12.0);
  for (const geometry::Tetrahedron& t : mesh.tetrahedra) {
    // Few are so bad that their angles need be known.
    if (tetrahedron_quality(at(t[0]), at(t[1]), at(t[2]), at(t[3])) > below_12) continue;
    const double angle = dihedral_range_deg(at(t[0]), at(t[1]), at(t[2]), at(t[3]))[0];
    report.below_10_deg += angle < 10.0 ? 1 : 0;
    report.below_12_deg += angle < 12.0 ? 1 : 0;
  }
}

MesherJob job_of(const geometry::FacedSurface& surface, const TetrahedralizeOptions& options) {
  MesherJob job;
  job.max_radius_edge_ratio = options.max_radius_edge_ratio;
  job.min_dihedral_deg = options.min_dihedral_deg;
  job.points = surface.mesh.points;
  job.triangles = surface.mesh.triangles;
  job.face_ids = surface.face_ids;
  job.sizes = local_sizes(surface.mesh, options.size_factor);
  if (!options.field) return job;
  job.field_points = options.field->points;
  job.field_sizes = options.field->edge_mm;
  for (double& size : job.field_sizes) size *= options.size_factor;
  job.field_gradation = options.field->gradation;
  return job;
}

}  // namespace

TetrahedralizedVolume tetrahedralize(const geometry::FacedSurface& surface,
                                     const TetrahedralizeOptions& options, const core::TaskContext& task) {
  validate(options);
  task.set_stage("tetrahedra");
  check_surface(surface, options.check_input);
  task.throw_if_cancelled();
  TetrahedralizedVolume result;
  TetrahedralizeReport& report = result.report;
  geometry::VolumeMesh& mesh = result.mesh;
  const auto start = std::chrono::steady_clock::now();
  MesherResult filled = run_mesher(job_of(surface, options), options, report, task.sub(0.0, mesher_share));
  report.mesher_seconds = seconds_since(start);
  task.set_progress(mesher_share);

  const bool anew = report.made_by == Mesher::mesh3;
  mesh.boundary = anew ? std::move(filled.boundary) : surface.mesh.triangles;
  mesh.boundary_face_ids = anew ? std::move(filled.boundary_face_ids) : surface.face_ids;
  mesh.faces = surface.faces;
  mesh.points = std::move(filled.points);
  mesh.tetrahedra = std::move(filled.tetrahedra);
  report.quality = volume_quality(mesh, task);
  check_result(surface, result);
  if (anew) judge_new_surface(surface, mesh, report);
  task.set_progress(0.8);
  report.min_dihedral_before_mending_deg = report.quality.min_dihedral_deg;
  if (options.mending_rounds > 0) mend(options, result, task.sub(0.8, 0.95));
  count_bad(mesh, report);
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::meshing
