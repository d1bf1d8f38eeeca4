// The only file that sees TetGen. It may throw an int, call exit or abort, and prints its reasons on standard
// output: it runs in a child process only.
#include "mesher/mesh3_worker.h"
#include "mesher/mesher_job.h"
#include "sizing/interior_sizes.h"

#include "ostia/core/error.h"
#include "ostia/meshing/tetrahedralize.h"

#include <pthread.h>
#include <tetgen.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <unordered_map>
#include <utility>

namespace ostia::meshing {

namespace {

/// What TetGen's integer exceptions mean.
const char* meaning(int code) {
  switch (code) {
    case 1:
      return "out of memory";
    case 3:
      return "the surface intersects itself";
    case 4:
      return "the surface has a feature too small to resolve";
    case 5:
      return "two triangles of the surface are too close to each other";
    case 10:
      return "the surface is not acceptable";
    default:
      return "internal error of TetGen";
  }
}

void fill(tetgenio& in, const MesherJob& job) {
  in.numberofpoints = static_cast<int>(job.points.size());
  in.pointlist = new REAL[3 * job.points.size()];
  for (std::size_t i = 0; i < job.points.size(); ++i)
    for (int k = 0; k < 3; ++k) in.pointlist[3 * i + static_cast<std::size_t>(k)] = job.points[i][k];
  if (job.field_points.empty()) {  // TetGen leads the surface's sizes inside
    in.pointmtrlist = new REAL[job.points.size()];
    in.numberofpointmtrs = 1;
    std::copy(job.sizes.begin(), job.sizes.end(), in.pointmtrlist);
  }
  in.numberoffacets = static_cast<int>(job.triangles.size());
  in.facetlist = new tetgenio::facet[job.triangles.size()];
  for (std::size_t i = 0; i < job.triangles.size(); ++i) {
    tetgenio::facet& facet = in.facetlist[i];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    for (std::size_t k = 0; k < 3; ++k) facet.polygonlist[0].vertexlist[k] = job.triangles[i][k];
  }
}

/// Whether a tetrahedron is too large for the field, for TetGen to ask.
class FieldJudge {
 public:
  explicit FieldJudge(const MesherJob& job) : sizes_(job) {}
  bool too_large(REAL* a, REAL* b, REAL* c, REAL* d) {
    const geometry::Vec3 p = at(a), u = at(b) - p, v = at(c) - p, w = at(d) - p;
    const geometry::Vec3 n = v.cross(w);
    const double six_volumes = u.dot(n);
    if (six_volumes == 0.0) return false;
    const geometry::Vec3 centre =
        (u.squaredNorm() * n + v.squaredNorm() * w.cross(u) + w.squaredNorm() * u.cross(v)) /
        (2.0 * six_volumes);
    const double least = std::min({size(a), size(b), size(c), size(d)});
    return centre.squaredNorm() > least * least;
  }

 private:
  static geometry::Vec3 at(const REAL* p) { return {p[0], p[1], p[2]}; }
  /// Kept for each point of TetGen's, since it asks many times; its memory may become another point's.
  double size(const REAL* p) {
    auto& [place, value] = known_[p];
    if (value == 0.0 || place != at(p)) place = at(p), value = sizes_(place);
    return value;
  }
  struct Known {
    geometry::Vec3 place = geometry::Vec3::Zero();
    double value = 0.0;
  };
  InteriorSizes sizes_;
  std::unordered_map<const REAL*, Known> known_;
};

/// TetGen's question carries nothing of its asker's. The process does one job.
std::unique_ptr<FieldJudge> judge_of_job;

bool unsuitable(REAL* a, REAL* b, REAL* c, REAL* d, REAL*, REAL) {
  return judge_of_job->too_large(a, b, c, d);
}

MesherResult collect(const tetgenio& out) {
  MesherResult result;
  for (int i = 0; i < out.numberofpoints; ++i)
    result.points.emplace_back(out.pointlist[3 * i], out.pointlist[3 * i + 1], out.pointlist[3 * i + 2]);
  for (int i = 0; i < out.numberoftetrahedra; ++i) {
    const int* t = out.tetrahedronlist + i * out.numberofcorners;
    result.tetrahedra.push_back({t[0], t[1], t[2], t[3]});
  }
  return result;
}

/// Says why TetGen threw, and ends the process.
[[noreturn]] void report_and_exit() {
  int status = 6;
  try {
    if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const int code) {
    std::fprintf(stderr, "TetGen stopped: %s (code %d)\n", meaning(code), code);
    status = code == 1 ? 5 : code == 3 || code == 4 || code == 5 || code == 10 ? 3 : 6;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "TetGen stopped: out of memory\n");
    status = 5;
  } catch (...) {
    std::fprintf(stderr, "TetGen stopped: unknown exception\n");
  }
  std::fflush(nullptr);
  _exit(status);
}

struct Run {
  std::string switches;
  tetgenio in, out;
};

void* run_tetgen(void* run) {
  auto* r = static_cast<Run*>(run);
  ::tetrahedralize(r->switches.data(), &r->in, &r->out);
  return nullptr;
}

/// TetGen frees its memory before it throws and again while the stack unwinds, which crashes. On a thread
/// without any handler nothing unwinds: the program's terminate handler runs first, and has the exception.
void tetrahedralize_without_unwinding(Run& run) {
  std::set_terminate(report_and_exit);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, std::size_t{64} << 20);
  pthread_t thread{};
  if (pthread_create(&thread, &attributes, run_tetgen, &run) != 0) throw std::bad_alloc();
  pthread_join(thread, nullptr);
}

MesherResult run_tetgen_job(const MesherJob& job) {
  // p: of a surface; Y: boundary kept; q: quality; m: size field; J: no point dropped, so that numbers
  // stay; M: triangles in one plane stay apart; Q: quiet.
  Run run;
  run.switches = "pYq" + std::to_string(job.max_radius_edge_ratio) + "/" +
                 std::to_string(job.min_dihedral_deg) + (job.field_points.empty() ? "mJMQ" : "JMQ");
  fill(run.in, job);
  if (!job.field_points.empty()) {
    judge_of_job = std::make_unique<FieldJudge>(job);
    run.in.tetunsuitable = unsuitable;
  }
  tetrahedralize_without_unwinding(run);
  return collect(run.out);
}

}  // namespace

int tetrahedralize_in_worker(const std::filesystem::path& input, const std::filesystem::path& output) {
  // The parent keeps standard error only.
  std::fflush(stdout);
  if (dup2(STDERR_FILENO, STDOUT_FILENO) < 0) return 6;
  try {
    const MesherJob job = read_job(input);
    write_result(job.mesher == MesherJob::mesh3 ? run_mesh3(job) : run_tetgen_job(job), output);
    return 0;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "the mesher ran out of memory\n");
    return 5;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.exit_code());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 6;
  }
}

}  // namespace ostia::meshing
