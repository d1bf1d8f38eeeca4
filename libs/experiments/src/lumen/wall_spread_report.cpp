#include "ostia/core/csv.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/experiments/wall_spread.h"
#include "ostia/figure/plot.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace ostia::experiments {
namespace {

using core::fixed_text;
using SpreadJson = nlohmann::ordered_json;

SpreadJson model_json(const analysis::WallSpreadModel& model) {
  return {{"scale", model.scale},     {"noise", model.noise},      {"size", model.size},
          {"slope", model.slope},     {"bend", model.bend},        {"unseen", model.unseen},
          {"most_mm", model.most_mm}, {"reach_mm", model.reach_mm}};
}

SpreadJson coverage_json(const SpreadRun& run) {
  SpreadJson all = SpreadJson::array();
  for (const SpreadCoverage& one : coverage(run.sections))
    all.push_back({{"name", one.name},
                   {"sections", one.sections},
                   {"held", one.held},
                   {"bias_mm", one.bias_mm},
                   {"rms_mm", one.rms_mm},
                   {"sd_mm", one.sd_mm},
                   {"half_width", one.half_width}});
  return all;
}

std::string padded(const std::string& text, std::size_t width) {
  return text.size() < width ? text + std::string(width - text.size(), ' ') : text;
}

std::string coverage_text(const std::string& title, const SpreadRun& run) {
  std::string text =
      padded(title, 22) + "sections   held, %   bias, mm   RMS, mm   SD told, mm   interval, +- %\n";
  for (const SpreadCoverage& one : coverage(run.sections)) {
    if (one.sections == 0) continue;
    text += padded(one.name, 22) + padded(std::to_string(one.sections), 11) +
            padded(fixed_text(100.0 * one.held, 1), 10) + padded(fixed_text(one.bias_mm, 3), 11) +
            padded(fixed_text(one.rms_mm, 3), 10) + padded(fixed_text(one.sd_mm, 3), 14) +
            fixed_text(100.0 * one.half_width, 1) + "\n";
  }
  return text;
}

/// What was missed over what was told, against the lines within which 95 % should lie.
void write_spread_picture(const std::filesystem::path& file, const SpreadRun& judged) {
  figure::Series points{"sections"};
  points.style = figure::LineStyle::points;
  double most = 0.0;
  for (const SpreadSection& one : judged.sections) {
    points.x.push_back(one.sd_mm);
    points.y.push_back(one.true_radius_mm - one.found_radius_mm);
    most = std::max(most, one.sd_mm);
  }
  const double gap = std::numeric_limits<double>::quiet_NaN();
  figure::Series bounds{"95 %"};
  bounds.style = figure::LineStyle::dashed;
  bounds.x = {0.0, most, gap, 0.0, most};
  bounds.y = {0.0, -1.96 * most, gap, 0.0, 1.96 * most};
  bounds.color = figure::Color{0.6, 0.6, 0.6};
  figure::PlotOptions how;
  how.title = "What a section's radius was missed by";
  how.x_label = "standard deviation that the image lets expect, mm";
  how.y_label = "true less found radius, mm";
  figure::line_plot({points, bounds}, how).write_png(file);
}

}  // namespace

std::string parameters_json(const WallSpreadOptions& fitting, const WallSpreadOptions& judged) {
  const auto of = [](const WallSpreadOptions& one) {
    return SpreadJson{{"first_seed", one.first_seed},
                      {"vessels", one.vessels},
                      {"sections", one.sections},
                      {"model", model_json(one.model)}};
  };
  return SpreadJson{{"fitting", of(fitting)}, {"judged", of(judged)}}.dump();
}

std::string wall_spread_json(const SpreadRun& fitting, const SpreadRun& judged,
                             const WallSpreadOptions& options) {
  const SpreadCorrelation correlation = correlation_of(fitting.courses);
  return SpreadJson{{"v", 1},
                    {"kind", "wall-spread"},
                    {"model", model_json(options.model)},
                    {"fitted_scale", fitted_scale(fitting.sections, options.model)},
                    {"correlation",
                     {{"common_share", correlation.common_share}, {"length_mm", correlation.length_mm}}},
                    {"fitting", coverage_json(fitting)},
                    {"judged", coverage_json(judged)}}
             .dump(1) +
         "\n";
}

std::string wall_spread_text(const SpreadRun& fitting, const SpreadRun& judged,
                             const WallSpreadOptions& options) {
  const SpreadCorrelation correlation = correlation_of(fitting.courses);
  return coverage_text("judged", judged) + "\n" + coverage_text("chosen on", fitting) + "\n" +
         "scale that holds 95 % there: " + fixed_text(fitted_scale(fitting.sections, options.model), 3) +
         ", used: " + fixed_text(options.model.scale, 3) +
         "\nerrors along a vessel: " + fixed_text(100.0 * correlation.common_share, 0) +
         " % of the variance in common, the rest over " + fixed_text(correlation.length_mm, 1) + " mm\n";
}

void write_wall_spread_report(const std::filesystem::path& folder, const SpreadRun& fitting,
                              const SpreadRun& judged) {
  std::string text =
      core::csv_line({"set", "seed", "s_mm", "narrowed", "calcium", "true_mm", "found_mm", "sd_mm",
                      "deviation", "noise_hu", "contrast_hu", "blur_mm", "clear_share"});
  const auto add = [&](const char* set, const SpreadRun& run) {
    for (const SpreadSection& one : run.sections)
      text += core::csv_line({set, std::to_string(one.seed), fixed_text(one.s_mm, 2),
                              one.narrowed ? "1" : "0", one.calcified ? "1" : "0",
                              fixed_text(one.true_radius_mm, 4), fixed_text(one.found_radius_mm, 4),
                              fixed_text(one.sd_mm, 4), fixed_text(one.deviation(), 3),
                              fixed_text(one.noise_hu, 1), fixed_text(one.evidence.contrast_hu, 0),
                              fixed_text(one.evidence.blur_mm, 3), fixed_text(one.evidence.clear_share, 3)});
  };
  add("fitting", fitting);
  add("judged", judged);
  core::write_file(folder / "sections.csv", text);
  std::string lags = core::csv_line({"lag_mm", "correlation"});
  const std::vector<double> by_lag = correlation_of(fitting.courses).by_lag;
  for (std::size_t k = 0; k < by_lag.size(); ++k)
    lags += core::csv_line({fixed_text(0.5 * static_cast<double>(k), 1), fixed_text(by_lag[k], 4)});
  core::write_file(folder / "correlation.csv", lags);
  write_spread_picture(folder / "wall-spread.png", judged);
}

}  // namespace ostia::experiments
