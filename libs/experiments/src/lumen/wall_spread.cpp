#include "ostia/experiments/wall_spread.h"

#include "ostia/core/error.h"
#include "ostia/hemodynamics/uncertainty.h"
#include "ostia/imaging/noise.h"
#include "ostia/phantom/noise.h"
#include "ostia/segmentation/lumen_boundary.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::experiments {
namespace {

constexpr double quantile_95 = 1.959963984540054;
constexpr double spread_end_mm = 6.0, apart_mm = 6.0, course_step_mm = 0.5;
const double most_relative = hemodynamics::WallSpread().most_relative;

/// The true axis, moved to the side.
geometry::AxisCurve axis_beside(const geometry::AxisCurve& axis, double angle, double mm) {
  geometry::Centerline line = axis.sampled(0.25);
  for (std::size_t i = 0; i < line.size(); ++i) line.points[i] = axis.place(line.abscissa[i], angle, mm);
  line.radius.clear();
  geometry::complete(line);
  return geometry::AxisCurve(line);
}

double radius_of_ring(const segmentation::LumenBoundary& boundary, double s_mm) {
  constexpr int around = 64;
  double square = 0.0;
  for (int a = 0; a < around; ++a) {
    const double r = boundary.at(s_mm, 2.0 * std::numbers::pi * a / around);
    square += r * r / around;
  }
  return std::sqrt(square);
}

/// The throat, and others as far from it and each other as is asked.
std::vector<double> chosen_places(const NoisyVessel& vessel, int count, std::uint64_t seed) {
  std::vector<double> chosen{vessel.throat_mm};
  const double last = vessel.axis->length() - spread_end_mm;
  for (std::uint64_t k = 0; k < 400 && static_cast<int>(chosen.size()) < count; ++k) {
    const double s = spread_end_mm + (last - spread_end_mm) * phantom::uniform(seed, 300 + k);
    if (std::all_of(chosen.begin(), chosen.end(),
                    [&](double other) { return std::abs(other - s) >= (k < 200 ? apart_mm : 4.0); }))
      chosen.push_back(s);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// ln(truth / found) in units of its spread.
double deviation_of(double true_mm, double found_mm, double sd_mm) {
  const double relative = std::min(most_relative, sd_mm / found_mm);
  return relative > 0.0 ? std::log(true_mm / found_mm) / relative : HUGE_VAL;
}

void add_vessel(std::uint64_t seed, const WallSpreadOptions& options, SpreadRun& run) {
  const NoisyVessel vessel = noisy_vessel(seed);
  const geometry::AxisCurve axis =
      axis_beside(*vessel.axis, 2.0 * std::numbers::pi * phantom::uniform(seed, 200), 0.2);
  const segmentation::LumenBoundary found =
      segmentation::lumen_boundary(vessel.image, axis, 2.0, axis.length() - 2.0);
  const double noise = imaging::noise_level_hu(vessel.image).value_or(vessel.noise_hu);
  analysis::WallEvidenceOptions how;
  how.noise_hu = noise;
  const auto evidence = analysis::wall_evidence(
      vessel.image, axis, [&](double s, double theta) { return found.at(s, theta); }, 3.0,
      axis.length() - 3.0, how);
  const auto sd = analysis::radius_spreads_mm(evidence, noise, options.model);
  analysis::WallSpreadModel seen = options.model, unseen = options.model;
  seen.scale = 1.0, seen.unseen = 0.0;
  unseen.scale = 0.0;
  const auto seen_mm = analysis::radius_spreads_mm(evidence, noise, seen);
  const auto unseen_mm = analysis::radius_spreads_mm(evidence, noise, unseen);
  const auto row_at = [&](double own) {
    const auto at = std::min_element(evidence.begin(), evidence.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.s_mm - own) < std::abs(b.s_mm - own);
    });
    return static_cast<std::size_t>(at - evidence.begin());
  };
  // The foot of a true place on the axis that the search was given.
  const auto foot = [&](double s) { return axis.nearest_foot(vessel.axis->point(s)).s_mm; };
  const auto truth = [&](double s) { return std::sqrt(vessel.lumen.area_at(s) / std::numbers::pi); };
  for (const double s : chosen_places(vessel, options.sections, seed)) {
    SpreadSection one;
    one.seed = seed;
    one.s_mm = s;
    one.true_radius_mm = truth(s);
    one.found_radius_mm = radius_of_ring(found, foot(s));
    one.narrowed = std::abs(s - vessel.throat_mm) < 0.5 * vessel.lesion_mm;
    one.calcified = vessel.calcified;
    const std::size_t row = row_at(foot(s));
    one.evidence = evidence[row];
    one.noise_hu = noise;
    one.seen_mm = seen_mm[row], one.unseen_mm = unseen_mm[row], one.sd_mm = sd[row];
    run.sections.push_back(std::move(one));
  }
  std::vector<double>& course = run.courses.emplace_back();
  for (double s = spread_end_mm; s <= vessel.axis->length() - spread_end_mm; s += course_step_mm)
    course.push_back(deviation_of(truth(s), radius_of_ring(found, foot(s)), sd[row_at(foot(s))]));
}

template <typename Chosen>
SpreadCoverage covered(const std::string& name, const std::vector<SpreadSection>& sections,
                       const Chosen& chosen) {
  SpreadCoverage out;
  out.name = name;
  for (const SpreadSection& one : sections) {
    if (!chosen(one)) continue;
    const double off = one.found_radius_mm - one.true_radius_mm;
    out.sections += 1;
    out.held += std::abs(one.deviation()) <= quantile_95 ? 1.0 : 0.0;
    out.bias_mm += off;
    out.rms_mm += off * off;
    out.sd_mm += one.sd_mm;
    out.half_width += quantile_95 * std::min(most_relative, one.sd_mm / one.found_radius_mm);
  }
  const double count = std::max<double>(1.0, static_cast<double>(out.sections));
  out.held /= count, out.bias_mm /= count, out.sd_mm /= count, out.half_width /= count;
  out.rms_mm = std::sqrt(out.rms_mm / count);
  return out;
}

}  // namespace

double SpreadSection::deviation() const {
  return deviation_of(true_radius_mm, found_radius_mm, sd_mm);
}

void validate(const WallSpreadOptions& options) {
  if (options.vessels < 1 || options.vessels > 2000)
    throw InvalidInput("wall spread: 1 to 2000 vessels are drawn, not " + std::to_string(options.vessels));
  if (options.sections < 1 || options.sections > 8)
    throw InvalidInput("wall spread: 1 to 8 sections of a vessel are looked at, not " +
                       std::to_string(options.sections));
  analysis::validate(options.model);
}

SpreadRun run_wall_spread(const WallSpreadOptions& options, const core::TaskContext& task) {
  validate(options);
  task.set_stage("vessels");
  SpreadRun run;
  for (int i = 0; i < options.vessels; ++i) {
    task.throw_if_cancelled();
    add_vessel(options.first_seed + static_cast<std::uint64_t>(i), options, run);
    task.set_progress(static_cast<double>(i + 1) / options.vessels);
  }
  return run;
}

std::vector<SpreadCoverage> coverage(const std::vector<SpreadSection>& sections) {
  constexpr double loud_hu = 30.0;
  using One = const SpreadSection&;
  return {covered("all", sections, [](One) { return true; }),
          covered("healthy", sections, [](One one) { return !one.narrowed; }),
          covered("narrowed", sections, [](One one) { return one.narrowed; }),
          covered("with calcium", sections, [](One one) { return one.calcified; }),
          covered("without calcium", sections, [](One one) { return !one.calcified; }),
          covered("noise below 30 HU", sections, [](One one) { return one.noise_hu < loud_hu; }),
          covered("noise from 30 HU on", sections, [](One one) { return one.noise_hu >= loud_hu; })};
}

double fitted_scale(const std::vector<SpreadSection>& sections, const analysis::WallSpreadModel& model) {
  if (sections.empty()) return model.scale;
  // The share that is held grows with the scale: halving finds where it is 95 %.
  double low = 0.0, high = 10.0;
  for (int i = 0; i < 40; ++i) {
    const double tried = 0.5 * (low + high);
    double held = 0.0;
    for (SpreadSection one : sections) {
      one.sd_mm = std::min(model.most_mm, std::hypot(tried * one.seen_mm, one.unseen_mm));
      held += std::abs(one.deviation()) <= quantile_95 ? 1.0 : 0.0;
    }
    (held < 0.95 * static_cast<double>(sections.size()) ? low : high) = tried;
  }
  return high;
}

SpreadCorrelation correlation_of(const std::vector<std::vector<double>>& courses) {
  constexpr std::size_t lags = 31;  // up to 15 mm
  constexpr double most = 4.0;      // a few that are far off say nothing of the others
  SpreadCorrelation out;
  std::vector<double> product(lags, 0.0), pairs(lags, 0.0);
  for (const std::vector<double>& course : courses)
    for (std::size_t i = 0; i < course.size(); ++i)
      for (std::size_t k = 0; k < lags && i + k < course.size(); ++k) {
        product[k] += std::clamp(course[i], -most, most) * std::clamp(course[i + k], -most, most);
        pairs[k] += 1.0;
      }
  if (!(pairs[lags - 1] > 0.0) || !(product[0] > 0.0)) return out;
  for (std::size_t k = 0; k < lags; ++k)
    out.by_lag.push_back(product[k] / pairs[k] / (product[0] / pairs[0]));
  double least = HUGE_VAL;
  for (double share = 0.0; share <= 0.95; share += 0.01)
    for (double length = 0.5; length <= 12.0; length += 0.1) {
      double square = 0.0;
      for (std::size_t k = 1; k < lags; ++k) {
        const double a = std::numbers::sqrt3 * course_step_mm * static_cast<double>(k) / length;
        const double off = share + (1.0 - share) * (1.0 + a) * std::exp(-a) - out.by_lag[k];
        square += off * off;
      }
      if (square >= least) continue;
      least = square;
      out.common_share = share, out.length_mm = length;
    }
  return out;
}

}  // namespace ostia::experiments
