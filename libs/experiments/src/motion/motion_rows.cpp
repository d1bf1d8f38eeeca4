#include "ostia/experiments/motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

namespace ostia::experiments {
namespace {

/// All phases first, then fewer and fewer.
int rank(const std::string& sampling) {
  constexpr std::array<const char*, 5> order{"all", "odd 10", "even 10", "odd 5", "even 5"};
  return static_cast<int>(std::find(order.begin(), order.end(), sampling) - order.begin());
}

using Place = std::pair<std::string, long>;
Place place_of(const MotionRun& run) {
  return {run.heart, std::lround(1e6 * run.phase)};
}

/// Hearts and phases at which every method was run that was run at all, beside the cage over all phases.
/// A method at another depth is another method.
std::set<Place> common_places(const std::vector<MotionRun>& runs) {
  using Method = std::pair<MotionMethod, int>;
  std::set<Method> methods;
  for (const MotionRun& run : runs)
    if (run.method > MotionMethod::cage) methods.insert({run.method, run.depth});
  std::set<Place> common;
  for (const MotionRun& run : runs) {
    const auto there = [&](const Method& method) {
      return std::any_of(runs.begin(), runs.end(), [&](const MotionRun& other) {
        return other.method == method.first && other.depth == method.second &&
               place_of(other) == place_of(run);
      });
    };
    if (!methods.empty() && std::all_of(methods.begin(), methods.end(), there)) common.insert(place_of(run));
  }
  return common;
}

void add(MotionRow& row, const MotionRun& run) {
  ++row.runs;
  row.seconds += run.seconds;
  row.processor_seconds += run.processor_seconds;
  row.distance_mm += run.distance_mm;
  row.distance_sd_mm += run.distance_mm * run.distance_mm;
  row.dice += run.dice;
  row.dice_sd += run.dice * run.dice;
  row.vertex_mm += run.vertex_mm;
  row.least_dice = std::min(row.least_dice, run.dice);
  row.worst_vertex_mm = std::max(row.worst_vertex_mm, run.vertex_mm);
  row.inverted_cells += run.inverted_cells;
  row.new_intersections += run.new_intersections;
}

/// Sums become means and deviations.
void finish(MotionRow& row) {
  const auto n = static_cast<double>(row.runs);
  for (double* mean : {&row.seconds, &row.processor_seconds, &row.distance_mm, &row.dice, &row.vertex_mm})
    *mean /= n;
  row.distance_sd_mm = std::sqrt(std::max(0.0, row.distance_sd_mm / n - row.distance_mm * row.distance_mm));
  row.dice_sd = std::sqrt(std::max(0.0, row.dice_sd / n - row.dice * row.dice));
}

}  // namespace

std::vector<MotionRow> rows_of(const std::vector<MotionRun>& runs, bool compared) {
  const std::set<Place> common = compared ? common_places(runs) : std::set<Place>{};
  std::vector<MotionRow> rows;
  for (const MotionRun& run : runs) {
    if (compared && (run.sampling != "all" || !common.contains(place_of(run)))) continue;
    auto row = std::find_if(rows.begin(), rows.end(), [&](const MotionRow& r) {
      return r.method == run.method && r.depth == run.depth && r.sampling == run.sampling;
    });
    if (row == rows.end()) {
      rows.push_back({run.method, run.depth, run.sampling});
      row = rows.end() - 1;
      row->least_dice = 1.0;
    }
    add(*row, run);
  }
  for (MotionRow& row : rows) finish(row);
  std::stable_sort(rows.begin(), rows.end(), [](const MotionRow& a, const MotionRow& b) {
    return std::tuple(rank(a.sampling), a.method, a.depth) < std::tuple(rank(b.sampling), b.method, b.depth);
  });
  return rows;
}

}  // namespace ostia::experiments
