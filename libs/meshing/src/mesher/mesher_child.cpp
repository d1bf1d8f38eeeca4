#include "mesher/mesher_child.h"

#include "ostia/core/error.h"
#include "ostia/core/private_folder.h"
#include "ostia/core/worker_program.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>

namespace ostia::meshing {

namespace {

constexpr double tetgen_triangles_a_second = 9000, mesh3_triangles_a_second = 4000;  // measured
constexpr int refused = 3, out_of_memory = 5;                                        // exit codes

/// The mesher's own words, without the empty lines around them.
std::string reason(const core::ChildResult& child, const std::string& mesher) {
  std::string text = child.standard_error;
  std::replace(text.begin(), text.end(), '\n', ' ');
  const auto first = text.find_first_not_of(' ');
  if (first == std::string::npos) return mesher + " " + child.describe();
  text = text.substr(first, text.find_last_not_of(' ') - first + 1);
  if (text.size() > 600) text = text.substr(0, 300) + " ... " + text.substr(text.size() - 300);
  return child.signal == 0 ? text : mesher + " " + child.describe() + " after: " + text;
}

/// The meshers tell nothing of their progress: what it commonly takes stands for it, ever slower past that.
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

core::ChildResult run_once(const MesherJob& job, const core::PrivateFolder& folder,
                           const core::ChildLimits& limits, const core::TaskContext& task) {
  const auto input = folder.path() / "surface.bin", output = folder.path() / "tetrahedra.bin";
  write_job(job, input);
  const double rate = job.mesher == MesherJob::tetgen ? tetgen_triangles_a_second : mesh3_triangles_a_second;
  const ExpectedProgress progress(0.5 + static_cast<double>(job.triangles.size()) / rate, task);
  return core::run_child(core::worker_program(), {"tetrahedralize", input.string(), output.string()}, limits,
                         task);
}

/// TetGen's refinement need not end with a fixed boundary. A first run gets about ten times what it commonly
/// takes; a second asks for less.
core::ChildResult run_tetgen(MesherJob job, const core::PrivateFolder& folder,
                             const TetrahedralizeOptions& options, TetrahedralizeReport& report,
                             const core::TaskContext& task) {
  core::ChildLimits first = options.limits;
  const auto usual = std::chrono::seconds(15 + static_cast<std::int64_t>(job.triangles.size()) / 700 +
                                          static_cast<std::int64_t>(job.field_points.size()) / 400);
  first.cpu_time = std::min(first.cpu_time, usual);
  core::ChildResult child = run_once(job, folder, first, task);
  if (child.ok() || (child.signal == 0 && child.exit_code == refused)) return child;
  const std::string failure =
      child.out_of_time ? "did not end with radius-edge ratio " + std::to_string(job.max_radius_edge_ratio)
                        : "failed (" + reason(child, "TetGen") + ")";
  job.max_radius_edge_ratio = std::max(2.0, job.max_radius_edge_ratio);
  job.min_dihedral_deg = 0.0;
  for (double& size : job.sizes) size *= 1.5;
  for (double& size : job.field_sizes) size *= 1.5;
  child = run_once(job, folder, options.limits, task);
  if (child.ok())
    report.warnings.push_back("TetGen " + failure +
                              "; the mesh was made with a bound of 2, a larger size, and no bound on "
                              "dihedral angles");
  return child;
}

[[noreturn]] void fail(const std::string& what, const core::ChildResult& child) {
  if (child.out_of_time || child.exit_code == out_of_memory)
    throw ResourceError(what + "; raise the child's limits or take a larger edge length");
  throw GeometryError(what + "; check the surface for faults, or remesh it");
}

}  // namespace

MesherResult run_mesher(MesherJob job, const TetrahedralizeOptions& options, TetrahedralizeReport& report,
                        const core::TaskContext& task) {
  const core::PrivateFolder folder;
  const auto output = folder.path() / "tetrahedra.bin";
  const std::string what =
      "no tetrahedra inside the surface of " + std::to_string(job.triangles.size()) + " triangles: ";
  std::string why;
  report.made_by = Mesher::tetgen;
  if (options.mesher != Mesher::mesh3) {
    job.mesher = MesherJob::tetgen;
    const core::ChildResult child = run_tetgen(job, folder, options, report, task);
    if (child.ok()) return read_result(output);
    why = reason(child, "TetGen");
    // An unchecked surface that TetGen refuses is at fault itself: another mesher would hide it.
    const bool at_fault = !options.check_input && child.signal == 0 && child.exit_code == refused;
    if (options.mesher == Mesher::tetgen || at_fault) fail(what + why, child);
    report.warnings.push_back("TetGen failed (" + why + "); the second mesher, CGAL Mesh_3, took over");
  }
  report.made_by = Mesher::mesh3;
  job.mesher = MesherJob::mesh3;
  const core::ChildResult child = run_once(job, folder, options.mesh3_limits, task);
  if (child.ok()) return read_result(output);
  fail(what + reason(child, "Mesh_3") + (why.empty() ? "" : ", and before that " + why), child);
}

}  // namespace ostia::meshing
