#include "ostia/hemodynamics/uncertainty.h"

#include "tree_draws.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/hemodynamics/sobol_indices.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace ostia::hemodynamics {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double most_failed = 0.05;

double sorted_quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<std::size_t>(at);
  if (i + 1 >= sorted.size()) return sorted.back();
  const double t = at - static_cast<double>(i);
  return (1.0 - t) * sorted[i] + t * sorted[i + 1];
}

/// Numbers that are none are of trees that did not settle.
Distribution distribution_of(std::vector<double> values, double threshold) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  Distribution out;
  if (values.empty()) return out;
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  out.known = true;
  out.median = sorted_quantile(values, 0.5);
  out.low = sorted_quantile(values, 0.025);
  out.high = sorted_quantile(values, 0.975);
  for (const double value : values) {
    out.mean += value / count;
    out.probability += value <= threshold ? 1.0 / count : 0.0;
  }
  for (const double value : values) out.sd += (value - out.mean) * (value - out.mean) / count;
  out.sd = std::sqrt(out.sd);
  out.probability = std::min(out.probability, 1.0);
  return out;
}

/// What is kept of one tree: of every station only where it is asked for.
struct TreeValues {
  std::vector<double> lesion_before, lesion_behind, outlet, outlet_flow;
  std::vector<float> stations;
};

class UncertaintyStudy {
 public:
  UncertaintyStudy(const Network& network, const Conditions& conditions,
                   const std::vector<LesionPlace>& lesions, const FlowModel& model,
                   const ReadingOptions& reading, const UncertaintyOptions& options)
      : network_(network), conditions_(conditions), model_(model), reading_(reading), options_(options) {
    const RestingFlow resting = resting_flow(network, conditions);
    spreads_ = spreads_of(resting.source, options.spreads);
    const PreparedNetwork prepared(network, flow_model_of(conditions, model));
    nominal_ = flow_state(prepared, conditions, resting, State::hyperaemia);
    lesions_ = read_tree(prepared, nominal_, lesions, reading).lesions;
    outlets_ = prepared.outlets();
    for (std::size_t b = 0; b < prepared.size(); ++b) {
      beyond_.push_back(prepared.beyond_occlusion(b));
      stations_ += network.branches[b].stations.size();
    }
    needed_.assign(prepared.size(), 0);
    for (const LesionReading& one : lesions_)
      needed_[one.read_at.branch] = needed_[one.lesion.from.branch] = 1;
    for (const std::size_t outlet : outlets_) needed_[outlet] = 1;
    draws_.emplace(network, nominal_.solution.flow_ml_s, lesions, spreads_, options);
  }

  PressureUncertainty run(const core::TaskContext& task) {
    pairs_ = static_cast<std::size_t>(options_.samples) / 2;
    whole_.resize(2 * pairs_);
    std::vector<std::size_t> groups;
    if (options_.indices) groups = uncertain_groups();
    mixed_.assign(input_groups, {});
    for (const std::size_t group : groups) mixed_[group].resize(pairs_);
    std::atomic<std::size_t> done{0};
    core::parallel_for(pairs_, 1, [&](std::size_t pair) {
      task.throw_if_cancelled();
      const TreeDraw a = draws_->draw(pair, false), b = draws_->draw(pair, true);
      whole_[pair] = values_of(a, true);
      whole_[pairs_ + pair] = values_of(b, true);
      for (const std::size_t group : groups)
        mixed_[group][pair] = values_of(exchanged(a, b, static_cast<InputGroup>(group)), false);
      task.set_progress(static_cast<double>(++done) / static_cast<double>(pairs_));
    });
    return told(groups);
  }

 private:
  std::vector<std::size_t> uncertain_groups() const {
    std::vector<std::size_t> groups;
    for (std::size_t g = 0; g < input_groups; ++g) {
      const bool wall = g == static_cast<std::size_t>(InputGroup::wall);
      if (wall ? !draws_->walls_are_certain()
               : std::any_of(spreads_.begin(), spreads_.end(), [&](const InputSpread& one) {
                   return static_cast<std::size_t>(one.group) == g && one.sd > 0.0;
                 }))
        groups.push_back(g);
    }
    return groups;
  }

  TreeDraw exchanged(const TreeDraw& a, const TreeDraw& b, InputGroup group) const {
    TreeDraw out{a.inputs, group == InputGroup::wall ? b.wall : a.wall};
    for (std::size_t k = 0; k < spreads_.size(); ++k)
      if (spreads_[k].group == group) out.inputs[k] = b.inputs[k];
    return out;
  }

  /// Empty where the pressures do not settle.
  TreeValues values_of(const TreeDraw& draw, bool all) const {
    try {
      const DrawnInputs inputs = drawn_inputs(conditions_, spreads_, draw.inputs);
      const PreparedNetwork prepared(draws_->moved(network_, draw.wall),
                                     flow_model_of(inputs.conditions, model_));
      RestingFlow resting = resting_flow(prepared.network(), inputs.conditions);
      resting.total_ml_s *= inputs.flow_factor;
      for (double& flow : resting.outlets_ml_s) flow *= inputs.flow_factor;
      const FlowState state =
          flow_state(prepared, inputs.conditions, resting, State::hyperaemia, &nominal_.solution);
      return read(prepared, state.solution, all);
    } catch (const NumericalError&) {
      return {};
    }
  }

  TreeValues read(const PreparedNetwork& prepared, const Solution& solution, bool all) const {
    TreeReadings readings;
    readings.aortic_pa = solution.inlet_pa;
    readings.stations.resize(prepared.size());
    for (std::size_t b = 0; b < prepared.size(); ++b)
      if (all || needed_[b] != 0) readings.stations[b] = along(prepared, solution, b);
    TreeValues values;
    for (const LesionReading& one : lesions_) {
      values.lesion_before.push_back(
          one.ostial ? 1.0 : pressure_at(prepared, readings, one.lesion.from) / readings.aortic_pa);
      values.lesion_behind.push_back(pressure_at(prepared, readings, one.read_at) / readings.aortic_pa);
    }
    for (const std::size_t outlet : outlets_) {
      const auto& stations = readings.stations[outlet];
      const double end = stations.empty() ? solution.to_pa[outlet] : stations.back().pressure_pa;
      values.outlet.push_back(end / readings.aortic_pa);
      values.outlet_flow.push_back(solution.flow_ml_s[outlet]);
    }
    if (!all) return values;
    values.stations.reserve(stations_);
    for (const auto& branch : readings.stations)
      for (const StationFlow& station : branch)
        values.stations.push_back(static_cast<float>(station.pressure_pa / readings.aortic_pa));
    return values;
  }

  template <typename Value>
  std::vector<double> column(const std::vector<TreeValues>& trees, const Value& value) const {
    std::vector<double> out;
    for (const TreeValues& tree : trees) out.push_back(tree.outlet.empty() ? no_number : value(tree));
    return out;
  }

  template <typename Value>
  SobolIndices indices_of(const std::vector<std::size_t>& groups, const Value& value) const {
    SobolIndices out;
    const std::vector<double> both = column(whole_, value);
    const std::span<const double> a(both.data(), pairs_), b(both.data() + pairs_, pairs_);
    for (const std::size_t group : groups) {
      const SobolIndex index = sobol_index(a, b, column(mixed_[group], value));
      // Estimates of what lies between 0 and 1.
      out.first[group] = std::clamp(index.first, 0.0, 1.0);
      out.total[group] = std::clamp(index.total, 0.0, 1.0);
    }
    return out;
  }

  template <typename Value>
  UncertainReading reading_of(const std::vector<std::size_t>& groups, const TreePlace& place, bool known,
                              const Value& value) const {
    UncertainReading out;
    out.place = place;
    if (!known) return out;
    out.ratio = distribution_of(column(whole_, value), reading_.threshold);
    out.indices = indices_of(groups, value);
    return out;
  }

  PressureUncertainty told(const std::vector<std::size_t>& groups) const {
    PressureUncertainty out;
    out.threshold = reading_.threshold;
    out.spreads = spreads_;
    out.wall = options_.wall;
    out.seed = options_.seed;
    out.samples = options_.samples;
    const auto count = [&](const std::vector<TreeValues>& trees) {
      out.trees += static_cast<int>(trees.size());
      for (const TreeValues& tree : trees) out.failed += tree.outlet.empty() ? 1 : 0;
    };
    count(whole_);
    for (const auto& trees : mixed_) count(trees);
    if (out.failed > most_failed * out.trees)
      throw NumericalError("the pressures of " + std::to_string(out.failed) + " of " +
                           std::to_string(out.trees) + " trees do not settle: the spreads are too wide");
    add_lesions(groups, out);
    add_outlets(groups, out);
    add_stations(out);
    return out;
  }

  void add_lesions(const std::vector<std::size_t>& groups, PressureUncertainty& out) const {
    constexpr double never = -HUGE_VAL;
    for (std::size_t i = 0; i < lesions_.size(); ++i) {
      const bool known = !lesions_[i].occluded;
      out.lesions.push_back(reading_of(groups, lesions_[i].read_at, known,
                                       [i](const TreeValues& tree) { return tree.lesion_behind[i]; }));
      const auto fall = [i](const TreeValues& tree) { return tree.lesion_before[i] - tree.lesion_behind[i]; };
      out.lesion_falls.push_back(known ? distribution_of(column(whole_, fall), never) : Distribution());
    }
  }

  void add_outlets(const std::vector<std::size_t>& groups, PressureUncertainty& out) const {
    for (std::size_t k = 0; k < outlets_.size(); ++k) {
      const std::size_t b = outlets_[k];
      const auto& stations = network_.branches[b].stations;
      const TreePlace end{b, stations.empty() ? 0.0 : stations.back().s_mm};
      const bool known = !beyond_[b];
      out.outlets.push_back(
          reading_of(groups, end, known, [k](const TreeValues& tree) { return tree.outlet[k]; }));
      const auto flow = [k](const TreeValues& tree) { return tree.outlet_flow[k]; };
      out.outlet_flow_ml_s.push_back(known ? distribution_of(column(whole_, flow), -HUGE_VAL)
                                           : Distribution());
    }
  }

  void add_stations(PressureUncertainty& out) const {
    std::vector<std::size_t> first;
    std::size_t count = 0;
    for (const Branch& branch : network_.branches) {
      first.push_back(count);
      count += branch.stations.size();
      out.stations.emplace_back(branch.stations.size());
    }
    core::parallel_for(network_.branches.size(), 1, [&](std::size_t b) {
      if (beyond_[b]) return;
      for (std::size_t i = 0; i < out.stations[b].size(); ++i)
        out.stations[b][i] = distribution_of(
            column(whole_,
                   [&](const TreeValues& tree) { return static_cast<double>(tree.stations[first[b] + i]); }),
            reading_.threshold);
    });
  }

  const Network& network_;
  const Conditions& conditions_;
  const FlowModel& model_;
  const ReadingOptions& reading_;
  const UncertaintyOptions& options_;
  std::vector<InputSpread> spreads_;
  FlowState nominal_;
  std::vector<LesionReading> lesions_;
  std::vector<std::size_t> outlets_;
  std::vector<char> beyond_, needed_;
  std::size_t stations_ = 0, pairs_ = 0;
  std::optional<TreeDraws> draws_;
  std::vector<TreeValues> whole_;               // of A, then of B
  std::vector<std::vector<TreeValues>> mixed_;  // of each group
};

}  // namespace

PressureUncertainty pressure_uncertainty(const Network& network, const Conditions& conditions,
                                         const std::vector<LesionPlace>& lesions, const FlowModel& model,
                                         const ReadingOptions& reading, const UncertaintyOptions& options,
                                         const core::TaskContext& task) {
  validate(options);
  task.set_stage("uncertainty");
  return UncertaintyStudy(network, conditions, lesions, model, reading, options).run(task);
}

}  // namespace ostia::hemodynamics
