#include "ostia/meshing/tetrahedralize.h"

#include "tetgen_job.h"
#include "tetrahedra_mending.h"

#include "ostia/core/error.h"
#include "ostia/core/private_folder.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

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
}

namespace {

constexpr double tetgen_share = 0.7;         // of the progress
constexpr double triangles_a_second = 9000;  // measured

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

/// TetGen's own words, without the empty lines around them.
std::string reason(const core::ChildResult& child) {
  std::string text = child.standard_error;
  std::replace(text.begin(), text.end(), '\n', ' ');
  const auto first = text.find_first_not_of(' ');
  if (first == std::string::npos) return "TetGen " + child.describe();
  text = text.substr(first, text.find_last_not_of(' ') - first + 1);
  if (text.size() > 600) text = text.substr(0, 300) + " ... " + text.substr(text.size() - 300);
  return child.signal == 0 ? text : "TetGen " + child.describe() + " after: " + text;
}

/// TetGen tells nothing of its progress: what it commonly takes stands for it, ever slower past that.
class ExpectedProgress {
 public:
  ExpectedProgress(double expected_s, const core::TaskContext& task)
      : thread_([expected_s, task](const std::stop_token& stop) {
          constexpr auto tick = std::chrono::milliseconds(100);
          constexpr double even = 0.8;  // up to here by the clock
          const auto start = std::chrono::steady_clock::now();
          while (!stop.stop_requested()) {
            const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
            const double share = passed.count() / expected_s;
            task.set_progress(share < even
                                  ? share
                                  : even + (1.0 - even) * (1.0 - std::exp(-(share - even) / (1.0 - even))));
            std::this_thread::sleep_for(tick);
          }
        }) {}

 private:
  std::jthread thread_;
};

core::ChildResult run_once(const TetgenJob& job, const core::PrivateFolder& folder,
                           const core::ChildLimits& limits, const core::TaskContext& task) {
  const auto input = folder.path() / "surface.bin", output = folder.path() / "tetrahedra.bin";
  write_job(job, input);
  const double expected_s = 0.5 + static_cast<double>(job.triangles.size()) / triangles_a_second;
  const ExpectedProgress progress(expected_s, task.sub(0.0, tetgen_share));
  return core::run_child(core::worker_program(), {"tetrahedralize", input.string(), output.string()}, limits,
                         task);
}

TetgenResult run_tetgen(TetgenJob job, const TetrahedralizeOptions& options, TetrahedralizeReport& report,
                        const core::TaskContext& task) {
  const core::PrivateFolder folder;
  // TetGen's refinement need not end with a fixed boundary. A first run gets about ten times what it commonly
  // takes; a second asks for less.
  core::ChildLimits first = options.limits;
  const auto usual = std::chrono::seconds(15 + static_cast<std::int64_t>(job.triangles.size()) / 700);
  first.cpu_time = std::min(first.cpu_time, usual);
  core::ChildResult child = run_once(job, folder, first, task);
  if (child.out_of_time && first.cpu_time < options.limits.cpu_time) {
    report.warnings.push_back(
        "TetGen did not end with radius-edge ratio " + std::to_string(job.max_radius_edge_ratio) +
        "; the mesh was made with a bound of 2, a larger size, and no bound on dihedral angles");
    job.max_radius_edge_ratio = std::max(2.0, job.max_radius_edge_ratio);
    job.min_dihedral_deg = 0.0;
    for (double& size : job.sizes) size *= 1.5;
    child = run_once(job, folder, options.limits, task);
  }
  if (child.ok()) return read_result(folder.path() / "tetrahedra.bin");
  const std::string what = "no tetrahedra inside the surface of " + std::to_string(job.triangles.size()) +
                           " triangles: " + reason(child);
  if (child.out_of_time || child.exit_code == 5)
    throw ResourceError(what + "; raise the child's limits or take a larger edge length");
  throw GeometryError(what + "; check the surface for faults, or remesh it");
}

void check_boundary(const geometry::FacedSurface& surface, const TetgenResult& result,
                    const VolumeQuality& quality) {
  bool same = result.points.size() >= surface.mesh.points.size();
  for (std::size_t i = 0; same && i < surface.mesh.points.size(); ++i)
    same = result.points[i] == surface.mesh.points[i];
  if (!same)
    throw GeometryError("TetGen moved or dropped points of the surface; remesh the surface and try again");
  if (quality.boundary_mismatches > 0)
    throw GeometryError("TetGen changed the surface in " + std::to_string(quality.boundary_mismatches) +
                        " places; remesh the surface and try again");
}

}  // namespace

TetrahedralizedVolume tetrahedralize(const geometry::FacedSurface& surface,
                                     const TetrahedralizeOptions& options, const core::TaskContext& task) {
  validate(options);
  task.set_stage("tetrahedra");
  check_surface(surface, options.check_input);
  task.throw_if_cancelled();
  TetgenJob job;
  job.max_radius_edge_ratio = options.max_radius_edge_ratio;
  job.min_dihedral_deg = options.min_dihedral_deg;
  job.points = surface.mesh.points;
  job.triangles = surface.mesh.triangles;
  job.sizes = local_sizes(surface.mesh, options.size_factor);
  TetrahedralizedVolume result;
  TetgenResult filled = run_tetgen(std::move(job), options, result.report, task);
  task.set_progress(tetgen_share);

  geometry::VolumeMesh& mesh = result.mesh;
  mesh.boundary = surface.mesh.triangles;
  mesh.boundary_face_ids = surface.face_ids;
  mesh.faces = surface.faces;
  mesh.points = filled.points;
  mesh.tetrahedra = std::move(filled.tetrahedra);
  result.report.quality = volume_quality(mesh, task);
  check_boundary(surface, filled, result.report.quality);
  if (result.report.quality.inverted > 0)
    throw GeometryError("TetGen made " + std::to_string(result.report.quality.inverted) +
                        " tetrahedra without volume; remesh the surface and try again");
  task.set_progress(0.8);
  result.report.min_dihedral_before_mending_deg = result.report.quality.min_dihedral_deg;
  if (options.mending_rounds > 0) {
    result.report.points_moved = mend_tetrahedra(mesh, options.mend_below_deg, options.mending_rounds, task);
    result.report.quality = volume_quality(mesh, task);
  }
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::meshing
