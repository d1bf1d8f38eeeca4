#include "lesions/mouth.h"
#include "names/vessel_way.h"

#include "ostia/analysis/stenosis.h"
#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::analysis {
namespace {

// The first line lies above most sections: residuals above it weigh so much more than those below.
constexpr double upper_weight = 0.95;
constexpr int first_rounds = 8;
// Then sections off the line by more than this share of it lose their say (Tukey's biweight), ever stricter.
constexpr std::array<double, 6> tolerances{0.5, 0.35, 0.25, 0.18, 0.13, 0.1};
constexpr int last_rounds = 8;
constexpr double below_weight = 0.3;  // of what is narrower than the line, beside what is wider
// A step at a branch costs as much as this length of vessel off the line by as much.
constexpr double step_cost_mm = 0.1;
// Where no section has a say, the line's slope dies away over so many windows.
constexpr double straight_windows = 4.0;
constexpr double no_rise = 1e4;  // how hard a rise of the line is held down
constexpr double hold = 1e-9;    // keeps the system definite where nothing is known
constexpr std::size_t band = 3;  // of the normal equations, beside the diagonal

/// Weighted least squares over unknowns in a row; each equation names at most four neighbours.
class BandedFit {
 public:
  explicit BandedFit(std::size_t n) : rows_(n), right_(n, 0.0) {}

  /// weight * (sum_k factors[k] x[first + k] - target)^2
  template <std::size_t N>
  void add(std::size_t first, const std::array<double, N>& factors, double weight, double target = 0.0) {
    static_assert(N <= band + 1);
    for (std::size_t i = 0; i < N; ++i) {
      right_[first + i] += weight * factors[i] * target;
      for (std::size_t j = 0; j <= i; ++j) rows_[first + i][i - j] += weight * factors[i] * factors[j];
    }
  }
  /// By Cholesky's factorisation, L L' = A; element (i, i - k) is rows_[i][k].
  std::vector<double> solved() {
    const std::size_t n = rows_.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t reach = std::min(i, band);
      for (std::size_t k = reach + 1; k-- > 0;) {
        const std::size_t j = i - k;
        double sum = rows_[i][k];
        for (std::size_t m = k + 1; m <= reach && m - k <= band; ++m) sum -= rows_[i][m] * rows_[j][m - k];
        rows_[i][k] = k == 0 ? std::sqrt(std::max(sum, hold)) : sum / rows_[j][0];
      }
    }
    std::vector<double> x = right_;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 1; k <= std::min(i, band); ++k) x[i] -= rows_[i][k] * x[i - k];
      x[i] /= rows_[i][0];
    }
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t k = 1; k <= std::min(n - 1 - i, band); ++k) x[i] -= rows_[i + k][k] * x[i + k];
      x[i] /= rows_[i][0];
    }
    return x;
  }

 private:
  std::vector<std::array<double, band + 1>> rows_;
  std::vector<double> right_;
};

class Line {
 public:
  Line(const LumenProfile& profile, const std::vector<double>& branches_mm, double window_mm)
      : n_(profile.sections.size()), step_mm_(profile.length_mm / static_cast<double>(n_ - 1)) {
    const double width = window_mm / (std::numbers::pi * step_mm_);
    stiffness_ = width * width * width * width;
    const double straight = straight_windows * window_mm / step_mm_;
    flatness_ = stiffness_ / (straight * straight);
    for (const SectionMeasures& section : profile.sections) {
      known_.push_back(section.found && section.diameter_mm > 0.0);
      diameter_.push_back(section.diameter_mm);
    }
    breaks_.assign(n_, false);
    for (const double s : branches_mm) {
      const double at = std::ceil(s / step_mm_ - 1e-9) - 1.0;  // the section before the branch
      if (at >= 1.0 && at + 3.0 <= static_cast<double>(n_)) breaks_[static_cast<std::size_t>(at)] = true;
    }
  }

  std::vector<double> found() const {
    std::vector<double> weights(n_);
    std::vector<double> line = start();
    for (int round = 0; round < first_rounds; ++round) {
      for (std::size_t i = 0; i < n_; ++i)
        weights[i] = !known_[i] ? 0.0 : diameter_[i] > line[i] ? upper_weight : 1.0 - upper_weight;
      line = fitted(weights, line, false);
    }
    for (std::size_t round = 0; round < tolerances.size() + last_rounds; ++round) {
      const double tolerance = tolerances[std::min(round, tolerances.size() - 1)];
      for (std::size_t i = 0; i < n_; ++i) weights[i] = robust_weight(i, line[i], tolerance);
      line = fitted(weights, line, true);
    }
    for (std::size_t i = 1; i < n_; ++i) line[i] = std::min(line[i], line[i - 1]);
    for (double& diameter : line) diameter = std::max(diameter, 0.0);
    return line;
  }

 private:
  std::vector<double> start() const {
    std::vector<double> all;
    for (std::size_t i = 0; i < n_; ++i) {
      if (known_[i]) all.push_back(diameter_[i]);
    }
    if (all.empty()) return std::vector<double>(n_, 0.0);
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return std::vector<double>(n_, *middle);
  }
  double robust_weight(std::size_t i, double line, double tolerance) const {
    if (!known_[i] || !(line > 0.0)) return 0.0;
    const double off = (diameter_[i] - line) / (tolerance * line);
    if (std::abs(off) >= 1.0) return 0.0;
    const double weight = (1.0 - off * off) * (1.0 - off * off);
    return off < 0.0 ? below_weight * weight : weight;
  }

  std::vector<double> fitted(const std::vector<double>& weights, const std::vector<double>& before,
                             bool steps) const {
    BandedFit fit(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      fit.add(i, std::array{1.0}, weights[i], diameter_[i]);
      fit.add(i, std::array{1.0}, 1e-6, before[i]);
    }
    const auto broken = [&](std::size_t i) { return steps && breaks_[i]; };
    for (std::size_t i = 0; i + 1 < n_; ++i) {
      const double rise = before[i + 1] > before[i] ? no_rise : 0.0;
      const double level = broken(i) ? step_cost_mm / step_mm_ : flatness_;
      fit.add(i, std::array{-1.0, 1.0}, rise + level);
    }
    for (std::size_t i = 0; i + 2 < n_; ++i) {
      if (!broken(i) && !broken(i + 1)) fit.add(i, std::array{1.0, -2.0, 1.0}, stiffness_);
    }
    for (std::size_t i = 1; i + 2 < n_; ++i) {  // the slope goes on behind a step
      if (broken(i)) fit.add(i - 1, std::array{1.0, -1.0, -1.0, 1.0}, stiffness_);
    }
    return fit.solved();
  }

  std::size_t n_;
  double step_mm_, stiffness_ = 0.0, flatness_ = 0.0;
  std::vector<double> diameter_;
  std::vector<bool> known_, breaks_;  // a break: between this section and the next
};

/// The line through sections [begin, end) alone.
std::vector<double> line_of_part(const LumenProfile& profile, std::size_t begin, std::size_t end,
                                 const std::vector<double>& branches_mm, double window_mm) {
  const double step = profile.length_mm / static_cast<double>(profile.sections.size() - 1);
  LumenProfile part;
  part.length_mm = step * static_cast<double>(end - begin - 1);
  part.sections.assign(profile.sections.begin() + static_cast<std::ptrdiff_t>(begin),
                       profile.sections.begin() + static_cast<std::ptrdiff_t>(end));
  std::vector<double> branches;
  for (const double s : branches_mm) branches.push_back(s - step * static_cast<double>(begin));
  return Line(part, branches, window_mm).found();
}

}  // namespace

ReferenceLine reference_line(const LumenProfile& profile, const std::vector<double>& branches_mm,
                             const ReferenceOptions& options) {
  if (!(options.window_mm >= 5.0 && options.window_mm <= 100.0))
    throw InvalidInput("the healthy calibre is followed over " + std::to_string(options.window_mm) +
                       " mm; choose 5 to 100 mm");
  if (profile.sections.size() < 2 || !(profile.length_mm > 0.0))
    throw InvalidInput("a reference line needs a profile of at least two sections");
  for (const double s : branches_mm) {
    if (!std::isfinite(s)) throw InvalidInput("a branch leaves at an abscissa that is not finite");
  }
  const std::size_t n = profile.sections.size();
  const double step = profile.length_mm / static_cast<double>(n - 1);
  ReferenceLine whole;
  whole.diameter_mm.assign(n, 0.0);
  const auto add_line = [&](std::size_t begin, std::size_t end) {
    const std::vector<double> line = line_of_part(profile, begin, end, branches_mm, options.window_mm);
    std::copy(line.begin(), line.end(), whole.diameter_mm.begin() + static_cast<std::ptrdiff_t>(begin));
  };
  std::size_t begin = 0;
  for (const JointGroup& one : joint_groups(options.joints)) {
    const double last = std::ceil(one.first_joint_mm / step - 1e-9),
                 own = std::ceil(one.last_joint_mm / step - 1e-9);
    if (!(last >= static_cast<double>(begin) + 2.0 && own + 2.0 <= static_cast<double>(n))) continue;
    add_line(begin, static_cast<std::size_t>(last));
    begin = static_cast<std::size_t>(own);
    whole.joints.push_back({one.first_joint_mm, one.ostium_mm});
  }
  add_line(begin, n);
  for (const Mouth& mouth : mouths_of(profile, whole.joints)) {
    const double first = whole.diameter_mm[mouth.before], last = whole.diameter_mm[mouth.behind];
    for (std::size_t i = mouth.before + 1; i < mouth.behind; ++i)
      whole.diameter_mm[i] = first + (last - first) * static_cast<double>(i - mouth.before) /
                                         static_cast<double>(mouth.behind - mouth.before);
  }
  return whole;
}

std::vector<double> branch_abscissas(const lumen::LumenModel& model, std::int32_t vessel) {
  std::vector<double> branches;
  for (const Leaving& leaving : leaving_branches(model, vessel)) {
    if (branches.empty() || leaving.s_mm > branches.back()) branches.push_back(leaving.s_mm);
  }
  return branches;
}

}  // namespace ostia::analysis
