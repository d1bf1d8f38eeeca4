#include "motion/motion_plots.h"

#include "ostia/figure/color.h"
#include "ostia/figure/plot.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::experiments {
namespace {

using Chosen = std::function<bool(const MotionRun&)>;
using Value = std::function<double(const MotionRun&)>;

/// A curve over the phase for each kind of run among those chosen, mean over hearts.
std::vector<figure::Series> curves(const std::vector<MotionRun>& runs, const Chosen& chosen,
                                   const Value& value) {
  struct Sum {
    double phase, sum;
    int count;
  };
  std::vector<std::pair<std::string, std::vector<Sum>>> found;
  for (const MotionRun& run : runs) {
    if (!chosen(run)) continue;
    const std::string name = name_of(run.method, run.depth, run.sampling);
    auto curve = std::find_if(found.begin(), found.end(), [&](const auto& c) { return c.first == name; });
    if (curve == found.end()) curve = found.insert(found.end(), {name, {}});
    auto at = std::find_if(curve->second.begin(), curve->second.end(),
                           [&](const Sum& s) { return s.phase == run.phase; });
    if (at == curve->second.end()) at = curve->second.insert(curve->second.end(), {run.phase, 0.0, 0});
    at->sum += value(run);
    ++at->count;
  }
  std::vector<figure::Series> series;
  for (auto& [name, sums] : found) {
    std::sort(sums.begin(), sums.end(), [](const Sum& a, const Sum& b) { return a.phase < b.phase; });
    figure::Series one;
    one.name = name;
    if (name == "before registration") one.style = figure::LineStyle::dashed;
    for (const Sum& s : sums) {
      one.x.push_back(100.0 * s.phase);
      one.y.push_back(s.sum / s.count);
    }
    series.push_back(std::move(one));
  }
  return series;
}

constexpr std::size_t named_branches = 4;

}  // namespace

std::string name_of(MotionMethod method, int depth, const std::string& sampling) {
  if (method == MotionMethod::none) return "before registration";
  std::string name = std::string(word(method)) + ", depth " + std::to_string(depth);
  if (sampling != "all") name += ", " + sampling;
  return name;
}
figure::Picture pair_of_plots(const std::vector<MotionRun>& runs, const std::string& title,
                              const Chosen& chosen) {
  figure::PlotOptions how;
  how.title = title + ": Dice";
  how.x_label = "phase, % of RR";
  how.y_range = {{0.0, 1.0}};
  std::vector<figure::Picture> panels;
  panels.push_back(figure::line_plot(curves(runs, chosen, [](const MotionRun& r) { return r.dice; }), how));
  how.title = title + ": distance, target to result";
  how.y_label = "mm";
  how.y_range.reset();
  how.y_from_zero = true;
  panels.push_back(
      figure::line_plot(curves(runs, chosen, [](const MotionRun& r) { return r.distance_mm; }), how));
  return figure::grid(panels, {.columns = 2, .look = figure::Look::light});
}

figure::Picture branch_plots(const std::vector<BranchRun>& branches) {
  std::vector<BranchRun> longest;
  for (const BranchRun& run : branches)
    if (run.heart == branches.front().heart && run.phase == branches.front().phase) longest.push_back(run);
  std::stable_sort(longest.begin(), longest.end(),
                   [](const BranchRun& a, const BranchRun& b) { return a.length_mm > b.length_mm; });
  longest.resize(std::min(longest.size(), named_branches));
  const auto plot = [&](const std::string& title, const std::string& unit, const auto& known,
                        const auto& fitted) {
    std::vector<figure::Series> series;
    for (std::size_t i = 0; i < longest.size(); ++i) {
      figure::Series truth, found;
      truth.name = longest[i].branch;
      found.name = longest[i].branch + ", fitted";
      found.style = figure::LineStyle::dashed;
      truth.color = found.color = figure::palette(i);
      for (const BranchRun& run : branches) {
        if (run.heart != longest[i].heart || run.branch != longest[i].branch || !std::isfinite(known(run)) ||
            !std::isfinite(fitted(run)))
          continue;
        truth.x.push_back(100.0 * run.phase);
        truth.y.push_back(known(run));
        found.y.push_back(fitted(run));
      }
      found.x = truth.x;
      if (truth.x.empty()) continue;
      series.push_back(std::move(truth));
      series.push_back(std::move(found));
    }
    figure::PlotOptions how;
    how.title = branches.front().heart + ": " + title;
    how.x_label = "phase, % of RR";
    how.y_label = unit;
    return figure::line_plot(series, how);
  };
  return figure::grid({plot(
                           "stretch", "", [](const BranchRun& r) { return r.true_stretch; },
                           [](const BranchRun& r) { return r.stretch; }),
                       plot(
                           "size of the torsion", "1/mm", [](const BranchRun& r) { return r.true_size; },
                           [](const BranchRun& r) { return r.size; })},
                      {.columns = 2, .look = figure::Look::light});
}

}  // namespace ostia::experiments
