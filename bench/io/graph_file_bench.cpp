// Networks of 1.4 and 10 million segments: read from each format, checked, and put in order.

#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/graph_repair.h"
#include "ostia/io/graph_file.h"

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>

namespace ostia::bench {
namespace {

namespace fs = std::filesystem;
using geometry::VesselGraph;

constexpr std::int32_t whole_tree = 1'400'000;

/// A tree that forks in two again and again, with radii by Murray's law and no short decimals.
VesselGraph grown(std::int32_t segments) {
  VesselGraph graph;
  graph.points.reserve(static_cast<std::size_t>(segments) + 1);
  graph.edges.reserve(static_cast<std::size_t>(segments));
  graph.points.emplace_back(0.0, 0.0, 0.0);
  for (std::int32_t i = 1; i <= segments; ++i) {
    const std::int32_t parent = i == 1 ? 0 : i / 2;
    const double order = std::log2(static_cast<double>(i)), angle = 0.7 * i;
    const double length = 20.0 * std::exp2(-order / 3.0), radius = 2.0 * std::exp2(-order / 3.0);
    graph.points.push_back(graph.points[static_cast<std::size_t>(parent)] +
                           length * geometry::Vec3(std::cos(angle), std::sin(angle), 0.3));
    graph.edges.push_back({parent, i, radius, radius});
  }
  return graph;
}

/// As grown trees are written: half a kilobyte for a segment.
void write_gxl(const fs::path& path, const VesselGraph& graph) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(path.c_str(), "wb"), &std::fclose);
  std::fputs("<gxl><graph id=\"tree\">\n", out.get());
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    const geometry::Vec3& p = graph.points[i];
    std::fprintf(out.get(),
                 "  <node id=\"n%zu\">\n    <attr name=\" nodeType\">\n      <string> node </string>\n    "
                 "</attr>\n    <attr name=\" position\">\n      <tup>\n        <float>%.9g</float>\n        "
                 "<float>%.9g</float>\n        <float>%.9g</float>\n      </tup>\n    </attr>\n  </node>\n",
                 i, p.x(), p.y(), p.z());
  }
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    std::fprintf(out.get(),
                 "  <edge id=\"e%zu\" to=\"n%d\" from=\"n%d\">\n    <attr name=\" flow\">\n      "
                 "<float>1</float>\n    </attr>\n    <attr name=\" radius\">\n      <float>%.9g</float>\n    "
                 "</attr>\n  </edge>\n",
                 e, graph.edges[e].to, graph.edges[e].from, graph.edges[e].radius_to);
  std::fputs("</graph></gxl>\n", out.get());
}

void write_legacy(const fs::path& path, const VesselGraph& graph) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(path.c_str(), "wb"), &std::fclose);
  std::fprintf(out.get(), "# vtk DataFile Version 3.0\ntree\nASCII\nDATASET POLYDATA\nPOINTS %zu double\n",
               graph.points.size());
  for (const geometry::Vec3& p : graph.points)
    std::fprintf(out.get(), "%.9g %.9g %.9g\n", p.x(), p.y(), p.z());
  std::fprintf(out.get(), "LINES %zu %zu\n", graph.edges.size(), 3 * graph.edges.size());
  for (const geometry::GraphEdge& e : graph.edges) std::fprintf(out.get(), "2 %d %d\n", e.from, e.to);
  std::fprintf(out.get(), "CELL_DATA %zu\nSCALARS radius double\nLOOKUP_TABLE default\n", graph.edges.size());
  for (const geometry::GraphEdge& e : graph.edges) std::fprintf(out.get(), "%.9g\n", e.radius_to);
}

/// The largest memory from now on, by the system's own mark.
class PeakMemory {
 public:
  PeakMemory() { std::ofstream("/proc/self/clear_refs") << "5"; }
  double mb() const {
    std::ifstream status("/proc/self/status");
    std::string word;
    double kb = 0.0;
    while (status >> word)
      if (word == "VmHWM:") status >> kb;
    return kb / 1024.0;
  }
};

void read_file(benchmark::State& state, const std::string& extension, std::int32_t segments) {
  const fs::path path =
      fs::temp_directory_path() / ("ostia_graph_bench_" + std::to_string(::getpid()) + extension);
  {
    const VesselGraph graph = grown(segments);
    if (extension == ".gxl")
      write_gxl(path, graph);
    else if (extension == ".vtk")
      write_legacy(path, graph);
    else
      io::write_graph(path, graph);
  }
  state.counters["file_mb"] = static_cast<double>(fs::file_size(path)) / (1 << 20);
  const PeakMemory memory;
  std::size_t read = 0;
  for (auto _ : state) read = io::read_graph(path).graph.edges.size();
  if (read != static_cast<std::size_t>(segments)) state.SkipWithError("segments are missing");
  state.counters["peak_mb"] = memory.mb();
  fs::remove(path);
}

void write_file(benchmark::State& state, const std::string& extension) {
  const fs::path path =
      fs::temp_directory_path() / ("ostia_graph_bench_" + std::to_string(::getpid()) + extension);
  const VesselGraph graph = grown(whole_tree);
  const PeakMemory memory;
  for (auto _ : state) io::write_graph(path, graph);
  state.counters["peak_mb"] = memory.mb();
  fs::remove(path);
}

void in_memory(benchmark::State& state, std::int32_t segments,
               const std::function<std::size_t(const VesselGraph&)>& work) {
  const VesselGraph graph = grown(segments);
  const PeakMemory memory;
  std::size_t result = 0;
  for (auto _ : state) result = work(graph);
  state.counters["result"] = static_cast<double>(result);
  state.counters["peak_mb"] = memory.mb();
}

std::size_t branch_count(const VesselGraph& graph) {
  const geometry::GraphIncidence incidence(graph);
  return geometry::branches(graph, incidence).size();
}
std::size_t fault_count(const VesselGraph& graph) {
  return geometry::find_faults(graph).found.size();
}
std::size_t repair_steps(const VesselGraph& graph) {
  return geometry::repaired(graph).steps.size();
}

constexpr auto ms = benchmark::kMillisecond;
BENCHMARK_CAPTURE(read_file, vtp_1400000, ".vtp", whole_tree)->Unit(ms)->Iterations(1);
BENCHMARK_CAPTURE(read_file, swc_1400000, ".swc", whole_tree)->Unit(ms)->Iterations(1);
BENCHMARK_CAPTURE(read_file, csv_1400000, ".csv", whole_tree)->Unit(ms)->Iterations(1);
BENCHMARK_CAPTURE(read_file, gxl_1400000, ".gxl", whole_tree)->Unit(ms)->Iterations(1);
BENCHMARK_CAPTURE(read_file, vtk_1400000, ".vtk", whole_tree)->Unit(ms)->Iterations(1);
BENCHMARK_CAPTURE(write_file, vtp_1400000, ".vtp")->Unit(ms)->Iterations(1);
BENCHMARK_CAPTURE(write_file, swc_1400000, ".swc")->Unit(ms)->Iterations(1);
BENCHMARK_CAPTURE(in_memory, branches_1400000, whole_tree, branch_count)->Unit(ms)->Iterations(1);
BENCHMARK_CAPTURE(in_memory, faults_1400000, whole_tree, fault_count)->Unit(ms)->Iterations(1);
BENCHMARK_CAPTURE(in_memory, repair_1400000, whole_tree, repair_steps)->Unit(ms)->Iterations(1);
BENCHMARK_CAPTURE(in_memory, branches_10000000, 10'000'000, branch_count)->Unit(ms)->Iterations(1);

}  // namespace
}  // namespace ostia::bench

BENCHMARK_MAIN();
