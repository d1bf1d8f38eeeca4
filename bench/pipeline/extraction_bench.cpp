// The coronary tree of a whole synthetic case, 512 x 512 x 300 voxels: found without a click, and each vessel
// by a click, two clicks or a rough line, as the workstation finds it in an image that is open.

#include "full_case.h"
#include "removed_branches.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/coronary/extract.h"
#include "ostia/session/found_model.h"
#include "ostia/session/new_vessel.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

namespace {

using namespace ostia;
using geometry::Vec3;
using segmentation::MinimalPath;

void count(benchmark::State& state, const bench::Finished& done) {
  state.counters["cpu_s"] = done.cpu_seconds;
  state.counters["peak_mb"] = done.peak_mb;
  if (done.code != 0) state.SkipWithError("it was refused");
}

/// From the start of the program to the case on the disk.
void extract_program(benchmark::State& state, const char* input) {
  const std::filesystem::path image = bench::full_case() / input;
  for (auto _ : state) {
    const auto folder = ostia::testing::temporary_folder("bench");
    const bench::Finished done =
        bench::run_ostia({"extract", image.string(), "-o", (folder / "heart.ostia").string()});
    state.SetIterationTime(done.seconds);
    count(state, done);
  }
}
BENCHMARK_CAPTURE(extract_program, dicom, "dicom")
    ->Name("ostia extract, DICOM folder to case")
    ->Unit(benchmark::kSecond)
    ->UseManualTime();
BENCHMARK_CAPTURE(extract_program, nrrd, "image00.nrrd")
    ->Name("ostia extract, NRRD to case")
    ->Unit(benchmark::kSecond)
    ->UseManualTime();

void tree_of_an_open_image(benchmark::State& state) {
  const imaging::ImageVolume& image = bench::full_image();
  std::size_t vessels = 0;
  for (auto _ : state) vessels = coronary::extract(image).vessels.tree.vessels.size();
  state.counters["vessels"] = static_cast<double>(vessels);
}
BENCHMARK(tree_of_an_open_image)
    ->Name("volume to labelled tree, image open")
    ->Unit(benchmark::kSecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void model_of_an_open_image(benchmark::State& state) {
  const imaging::ImageVolume& image = bench::full_image();
  std::size_t vessels = 0;
  for (auto _ : state) vessels = session::found_model(image).model.tree.vessels.size();
  state.counters["vessels"] = static_cast<double>(vessels);
}
BENCHMARK(model_of_an_open_image)
    ->Name("volume to labelled tree with walls, image open")
    ->Unit(benchmark::kSecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

constexpr double end_radius_mm = 0.6;  // where a vessel is as thin as this a clinician clicks

std::size_t distal_end(const phantom::CoronaryVessel& vessel) {
  std::size_t last = vessel.axis.size() - 1;
  while (last > 0 && vessel.axis.radius[last] < end_radius_mm) --last;
  return last;
}

/// Those that leave another vessel and are no thinner from their beginning on.
std::vector<const phantom::CoronaryVessel*> vessels(bool side_branches) {
  constexpr double least_length_mm = 5.0;
  std::vector<const phantom::CoronaryVessel*> chosen;
  for (const phantom::CoronaryVessel& vessel : bench::full_plan().tree.vessels)
    if ((vessel.parent >= 0) == side_branches && vessel.axis.abscissa[distal_end(vessel)] >= least_length_mm)
      chosen.push_back(&vessel);
  return chosen;
}

/// One vessel of the case, found by `find`; its name, the way's length and how far it is off the true axis.
template <class Find>
void find_vessel(benchmark::State& state, bool side_branches, const Find& find) {
  const auto chosen = vessels(side_branches);
  const auto which = static_cast<std::size_t>(state.range(0));
  if (which >= chosen.size()) return state.SkipWithError("the case has no more of them");
  const phantom::CoronaryVessel& vessel = *chosen[which];
  const imaging::ImageVolume& image = bench::full_image();
  const geometry::VesselTree rest = segmentation::testing::without(bench::full_plan().tree, vessel.id);
  state.SetLabel(vessel.name);
  try {
    MinimalPath way;
    for (auto _ : state) way = find(image, vessel, rest);
    double off = 0.0;
    for (const Vec3& p : way.points) off += (geometry::closest(vessel.axis.points, p).point - p).norm();
    state.counters["off_axis_mm"] = off / static_cast<double>(way.points.size());
    state.counters["length_mm"] = way.length_mm;
  } catch (const Error& error) {
    state.SkipWithError(error.what());
  }
}

/// A tree without the vessel is there; its distal end is clicked.
void one_click(benchmark::State& state) {
  find_vessel(state, true, [](const auto& image, const auto& vessel, const auto& rest) {
    return segmentation::path_to_tree(image, vessel.axis.points[distal_end(vessel)], rest);
  });
}

/// No tree is there: an artery's beginning and its distal end are clicked, no farther off than a front may
/// run.
MinimalPath between(const imaging::ImageVolume& image, const phantom::CoronaryVessel& vessel) {
  constexpr double farthest_mm = 140.0;
  std::size_t end = distal_end(vessel);
  while (vessel.axis.abscissa[end] > farthest_mm) --end;
  return segmentation::path_between(image, vessel.axis.points.front(), vessel.axis.points[end]);
}
void two_clicks(benchmark::State& state) {
  find_vessel(state, false,
              [](const auto& image, const auto& vessel, const auto&) { return between(image, vessel); });
}
void two_clicks_and_wall(benchmark::State& state) {
  find_vessel(state, false, [](const auto& image, const auto& vessel, const auto&) {
    const MinimalPath way = between(image, vessel);
    benchmark::DoNotOptimize(session::model_of_way(way, "V1", image));
    return way;
  });
}

/// Straight pieces of 10 mm from the vessel's beginning to where it is clicked: they cut the corners.
std::vector<Vec3> rough_line(const phantom::CoronaryVessel& vessel) {
  constexpr double apart_mm = 10.0;
  const std::size_t last = distal_end(vessel);
  std::vector<Vec3> line;
  for (std::size_t i = 0; i < last; ++i)
    if (vessel.axis.abscissa[i] >= apart_mm * static_cast<double>(line.size()))
      line.push_back(vessel.axis.points[i]);
  line.push_back(vessel.axis.points[last]);
  return line;
}
void rough_line_to_tree(benchmark::State& state) {
  find_vessel(state, true, [](const auto& image, const auto& vessel, const auto& rest) {
    return segmentation::path_along_to_tree(image, rough_line(vessel), rest);
  });
}
void rough_line_alone(benchmark::State& state) {
  find_vessel(state, false, [](const auto& image, const auto& vessel, const auto&) {
    return segmentation::path_along(image, rough_line(vessel));
  });
}

BENCHMARK(one_click)
    ->Name("guided: one click back to the tree")
    ->DenseRange(0, 7)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(two_clicks)
    ->Name("guided: two clicks")
    ->DenseRange(0, 1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(two_clicks_and_wall)
    ->Name("guided: two clicks, first vessel with its wall")
    ->DenseRange(0, 1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(rough_line_to_tree)
    ->Name("guided: rough line of a branch")
    ->DenseRange(0, 7)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(rough_line_alone)
    ->Name("guided: rough line of an artery")
    ->DenseRange(0, 1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
