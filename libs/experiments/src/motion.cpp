#include "ostia/experiments/motion.h"

#include "motion_scores.h"

#include "ostia/core/error.h"
#include "ostia/experiments/mixture_deformation.h"
#include "ostia/motion/cage_descent.h"
#include "ostia/motion/cage_registration.h"
#include "ostia/motion/moving_cage.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>

namespace ostia::experiments {
namespace {

using geometry::TriMesh;
using geometry::Vec3;
using Points = std::vector<Vec3>;

struct Word {
  MotionMethod method;
  const char* text;
};
constexpr std::array<Word, 8> words{{{MotionMethod::none, "none"},
                                     {MotionMethod::cage, "cage"},
                                     {MotionMethod::descent, "descent"},
                                     {MotionMethod::descent_free, "descent-free"},
                                     {MotionMethod::tps_l2, "tps-l2"},
                                     {MotionMethod::tps_kc, "tps-kc"},
                                     {MotionMethod::grbf_l2, "grbf-l2"},
                                     {MotionMethod::grbf_kc, "grbf-kc"}}};

/// Phases outward from the template's in both directions, each with the one before it on its way.
struct Step {
  std::size_t phase;
  std::size_t from;
};
std::vector<Step> outward(std::size_t count, std::size_t first) {
  std::vector<Step> steps{{first, first}};
  for (std::size_t k = 1; steps.size() < count; ++k) {
    steps.push_back({(first + k) % count, (first + k - 1) % count});
    if (steps.size() < count) steps.push_back({(first + count - k) % count, (first + count - k + 1) % count});
  }
  return steps;
}

/// One heart under the microscope.
class HeartRuns {
 public:
  HeartRuns(const MotionOptions& options, int number, const core::TaskContext& task)
      : options_(options), heart_(made(options, number, task)), number_(number) {
    template_intersections_ = intersections(heart_.model);
    first_ = 0;
    for (std::size_t k = 0; k < heart_.phases.size(); ++k)
      if (std::abs(heart_.phases[k].phase - heart_.template_phase) < 1e-9) first_ = k;
  }

  void run(std::vector<MotionRun>& runs, const core::TaskContext& task) {
    for (const HeartPhaseModel& phase : heart_.phases)
      runs.push_back(scored(phase, heart_.model.points, {}, task));
    const double parts = static_cast<double>(options_.depths.size()) + 1.0;
    for (std::size_t d = 0; d < options_.depths.size(); ++d)
      all_phases(options_.depths[d], runs,
                 task.sub(static_cast<double>(d) / parts, static_cast<double>(d + 1) / parts));
    sampled(runs, task);
    if (number_ < options_.compared_hearts) compare(runs, task.sub(1.0 - 1.0 / parts, 1.0));
  }

 private:
  static BeatingHeart made(const MotionOptions& options, int number, const core::TaskContext& task) {
    BeatingHeartOptions one = options.heart;
    one.seed += static_cast<std::uint64_t>(number);
    return beating_heart(one, task.sub(0.0, 0.1));
  }

  MotionRun scored(const HeartPhaseModel& phase, const Points& points, MotionRun run,
                   const core::TaskContext& task) const {
    task.throw_if_cancelled();
    if (run.sampling.empty()) run.sampling = "all";
    score(heart_, phase, points, template_intersections_, options_.dice_resolution_mm, run,
          task.sub(0.0, 0.0));
    return run;
  }

  /// The template on every phase, each from its neighbour's cage.
  void all_phases(int depth, std::vector<MotionRun>& runs, const core::TaskContext& task) {
    std::vector<motion::Registration> found(heart_.phases.size());
    const std::vector<Step> steps = outward(heart_.phases.size(), first_);
    std::vector<MotionRun> mine(heart_.phases.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const auto [k, from] = steps[i];
      motion::RegistrationOptions how;
      how.depth = depth;
      if (from != k) how.start = found[from].control_points;
      const auto begin = std::chrono::steady_clock::now();
      found[k] =
          motion::register_cage(heart_.model, heart_.phases[k].segmented, how,
                                task.sub(static_cast<double>(i) / static_cast<double>(steps.size()),
                                         static_cast<double>(i + 1) / static_cast<double>(steps.size())));
      MotionRun run;
      run.method = MotionMethod::cage;
      run.depth = depth;
      run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      run.inverted_cells = inverted_cells(found[k].grid, found[k].control_points);
      mine[k] = scored(heart_.phases[k], found[k].surface.points, run, task);
    }
    runs.insert(runs.end(), mine.begin(), mine.end());
    if (depth != options_.depth) return;
    grid_ = found[first_].grid;
    known_.clear();
    for (motion::Registration& one : found) known_.push_back(std::move(one.control_points));
  }

  /// Some phases known, all the others from their splines ([Yi] 5.1.3).
  void sampled(std::vector<MotionRun>& runs, const core::TaskContext& task) const {
    struct Sampling {
      const char* name;
      std::size_t from, step;
    };
    const std::size_t n = heart_.phases.size();
    for (const Sampling& s : {Sampling{"odd", 1, 2}, {"even", 0, 2}, {"odd", 1, 4}, {"even", 0, 4}}) {
      std::vector<double> phases;
      std::vector<Points> places;
      for (std::size_t k = s.from; k < n; k += s.step) {
        phases.push_back(heart_.phases[k].phase);
        places.push_back(known_[k]);
      }
      if (phases.size() < 3) continue;
      const motion::CyclicSpline spline(phases, places);
      const motion::CarriedPoints carried(grid_, heart_.model.points);
      for (const HeartPhaseModel& phase : heart_.phases) {
        const Points points = spline.at(phase.phase);
        MotionRun run;
        run.method = MotionMethod::cage;
        run.depth = options_.depth;
        run.sampling = std::string(s.name) + " " + std::to_string(phases.size());
        run.inverted_cells = inverted_cells(grid_, points);
        runs.push_back(scored(phase, carried.places(points), run, task));
      }
    }
  }

  void compare(std::vector<MotionRun>& runs, const core::TaskContext& task) const {
    const double all = static_cast<double>(options_.methods.size() * options_.compared_phases.size());
    double done = 0.0;
    for (const MotionMethod method : options_.methods)
      for (const HeartPhaseModel& phase : heart_.phases) {
        const bool asked = std::any_of(options_.compared_phases.begin(), options_.compared_phases.end(),
                                       [&](double p) { return std::abs(p - phase.phase) < 1e-9; });
        if (!asked) continue;
        runs.push_back(with(method, phase, task.sub(done / all, (done + 1.0) / all)));
        done += 1.0;
      }
  }

  MotionRun with(MotionMethod method, const HeartPhaseModel& phase, const core::TaskContext& task) const {
    MotionRun run;
    run.method = method;
    run.depth = options_.depth;
    const auto begin = std::chrono::steady_clock::now();
    const auto stop = [&] {
      run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    if (method == MotionMethod::descent || method == MotionMethod::descent_free) {
      motion::DescentOptions how;
      how.depth = options_.depth;
      how.with_energy = method == MotionMethod::descent;
      const motion::Registration found =
          motion::register_cage_by_descent(heart_.model, phase.segmented, how, task);
      stop();
      run.inverted_cells = inverted_cells(found.grid, found.control_points);
      return scored(phase, found.surface.points, run, task);
    }
    MixtureOptions how;
    how.depth = options_.depth;
    const bool splines = method == MotionMethod::tps_l2 || method == MotionMethod::tps_kc;
    how.kind = splines ? DeformationKind::thin_plate_spline : DeformationKind::gaussian_basis;
    how.cost = method == MotionMethod::tps_l2 || method == MotionMethod::grbf_l2
                   ? MixtureCost::l2
                   : MixtureCost::kernel_correlation;
    const MixtureDeformation found = deform_by_mixtures(heart_.model, phase.segmented, how, task);
    stop();
    return scored(phase, found.surface.points, run, task);
  }

  const MotionOptions& options_;
  BeatingHeart heart_;
  int number_;
  std::size_t template_intersections_ = 0, first_ = 0;
  geometry::CageGrid grid_;
  std::vector<Points> known_;  // control points of all phases at options_.depth
};

}  // namespace

const char* word(MotionMethod method) {
  for (const Word& one : words)
    if (one.method == method) return one.text;
  return "";
}

MotionMethod motion_method_of(const std::string& text) {
  std::string known;
  for (const Word& one : words) {
    if (text == one.text) return one.method;
    known += (known.empty() ? "" : ", ") + std::string(one.text);
  }
  throw InvalidInput("there is no method " + text + "; there are " + known);
}

void validate(const MotionOptions& o) {
  validate(o.heart);
  if (o.hearts < 1 || o.hearts > 100)
    throw InvalidInput("motion of " + std::to_string(o.hearts) + " hearts: 1 to 100 can be studied");
  for (const MotionMethod method : o.methods)
    if (method <= MotionMethod::cage)
      throw InvalidInput(std::string("the method ") + word(method) + " is run anyway: leave it out");
  const bool mixtures = std::any_of(o.methods.begin(), o.methods.end(),
                                    [](MotionMethod method) { return method >= MotionMethod::tps_l2; });
  if (mixtures && o.depth > 4)
    throw InvalidInput("thin-plate splines and Gaussian basis functions go to depth 4, not " +
                       std::to_string(o.depth));
  for (const double phase : o.compared_phases) {
    const double number = phase * o.heart.phases;
    if (!(phase >= 0.0 && phase < 1.0) || std::abs(number - std::round(number)) > 1e-6)
      throw InvalidInput("methods cannot be compared at " + std::to_string(100.0 * phase) + " %: there are " +
                         std::to_string(o.heart.phases) + " phases, from 0 % on");
  }
  for (const int depth : o.depths)
    if (depth < 1 || depth > 5) throw InvalidInput("a cage's depth must lie in [1, 5]");
  if (std::find(o.depths.begin(), o.depths.end(), o.depth) == o.depths.end())
    throw InvalidInput("the depth " + std::to_string(o.depth) + " that is compared must be among all depths");
}

std::vector<MotionRun> run_motion(const MotionOptions& options, const core::TaskContext& task) {
  validate(options);
  std::vector<MotionRun> runs;
  for (int i = 0; i < options.hearts; ++i) {
    const core::TaskContext part =
        task.sub(static_cast<double>(i) / options.hearts, static_cast<double>(i + 1) / options.hearts);
    part.set_stage("heart " + std::to_string(i + 1) + " of " + std::to_string(options.hearts));
    HeartRuns(options, i, part).run(runs, part.sub(0.1, 1.0));
  }
  return runs;
}

std::vector<MotionRow> rows_of(const std::vector<MotionRun>& runs, bool compared) {
  const auto was_compared = [&](const MotionRun& run) {
    return std::any_of(runs.begin(), runs.end(), [&](const MotionRun& other) {
      return other.heart == run.heart && other.phase == run.phase && other.method > MotionMethod::cage;
    });
  };
  std::vector<MotionRow> rows;
  for (const MotionRun& run : runs) {
    if (compared && !was_compared(run)) continue;
    auto row = std::find_if(rows.begin(), rows.end(), [&](const MotionRow& r) {
      return r.method == run.method && r.depth == run.depth && r.sampling == run.sampling;
    });
    if (row == rows.end()) {
      rows.push_back({run.method, run.depth, run.sampling});
      row = rows.end() - 1;
      row->least_dice = 1.0;
    }
    ++row->runs;
    row->seconds += run.seconds;
    row->distance_mm += run.distance_mm;
    row->distance_sd_mm += run.distance_mm * run.distance_mm;
    row->dice += run.dice;
    row->dice_sd += run.dice * run.dice;
    row->vertex_mm += run.vertex_mm;
    row->least_dice = std::min(row->least_dice, run.dice);
    row->worst_vertex_mm = std::max(row->worst_vertex_mm, run.vertex_mm);
    row->inverted_cells += run.inverted_cells;
    row->new_intersections += run.new_intersections;
  }
  for (MotionRow& row : rows) {
    const auto n = static_cast<double>(row.runs);
    for (double* mean : {&row.seconds, &row.distance_mm, &row.dice, &row.vertex_mm}) *mean /= n;
    row.distance_sd_mm = std::sqrt(std::max(0.0, row.distance_sd_mm / n - row.distance_mm * row.distance_mm));
    row.dice_sd = std::sqrt(std::max(0.0, row.dice_sd / n - row.dice * row.dice));
  }
  return rows;
}

}  // namespace ostia::experiments
