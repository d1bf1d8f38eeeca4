#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/experiments/certainty.h"
#include "ostia/figure/plot.h"

#include <nlohmann/json.hpp>

#include <span>
#include <string_view>

namespace ostia::experiments {
namespace {

using core::fixed_text;
using CertaintyJson = nlohmann::ordered_json;
using evaluation::Calibration;

/// Of which of the pieces, and how well they are known.
struct JudgedGroup {
  std::string of, search;
  Calibration calibration;
};

std::vector<JudgedGroup> groups_of(const CertaintyRuns& runs) {
  std::vector<JudgedGroup> groups;
  const auto add = [&](const char* of, const std::vector<JudgedPiece>& pieces) {
    for (const SearchKind search : {SearchKind::usual, SearchKind::loose}) {
      std::vector<JudgedPiece> some;
      for (const JudgedPiece& one : pieces)
        if (one.search == search) some.push_back(one);
      if (!some.empty()) groups.push_back({of, name_of(search), calibration_of(forecasts_of(some))});
    }
    groups.push_back({of, "both", calibration_of(forecasts_of(pieces))});
  };
  add("vessels", runs.vessels);
  add("centimetres", runs.pieces);
  return groups;
}

std::string table_of(const std::vector<JudgedPiece>& pieces, std::span<const std::string_view> looks) {
  std::vector<std::string> cells{"scan",  "search", "vessel", "from_mm",
                                 "to_mm", "within", "right",  "probability"};
  cells.insert(cells.end(), looks.begin(), looks.end());
  std::string text = core::csv_line(cells);
  for (const JudgedPiece& one : pieces) {
    cells = {one.scan,
             name_of(one.search),
             one.vessel,
             fixed_text(one.from_mm, 2),
             fixed_text(one.to_mm, 2),
             fixed_text(one.within, 3),
             one.right() ? "1" : "0",
             fixed_text(one.probability, 4)};
    for (const double look : one.looks) cells.push_back(fixed_text(look, 5));
    text += core::csv_line(cells);
  }
  return text;
}

/// The share that is right over the probability that was said.
figure::Picture reliability_plot(const CertaintyRuns& runs) {
  std::vector<figure::Series> series;
  const auto add = [&](const char* name, const std::vector<JudgedPiece>& pieces) {
    figure::Series bins{name};
    bins.style = figure::LineStyle::solid;
    for (const evaluation::CalibrationBin& bin : calibration_of(forecasts_of(pieces)).bins) {
      if (bin.count < 5) continue;
      bins.x.push_back(bin.said);
      bins.y.push_back(bin.right);
    }
    if (!bins.x.empty()) series.push_back(std::move(bins));
  };
  add("vessels", runs.vessels);
  add("centimetres", runs.pieces);
  figure::Series even{"as it should be", {0.0, 1.0}, {0.0, 1.0}};
  even.style = figure::LineStyle::dashed;
  even.color = figure::Color{0.6, 0.6, 0.6};
  series.push_back(std::move(even));
  figure::PlotOptions how;
  how.title = "Of what was given a probability, how much is right";
  how.x_label = "probability, mean of a bin of five or more";
  how.y_label = "share that is right";
  how.x_range = how.y_range = figure::Range{0.0, 1.0};
  how.width_px = 560, how.height_px = 520;
  return figure::line_plot(series, how);
}

}  // namespace

std::string parameters_json(const CertaintyOptions& options) {
  return CertaintyJson{{"first_seed", options.first_seed},
                       {"patients", options.patients},
                       {"scans", options.scans},
                       {"voxel_mm", options.voxel_mm}}
      .dump();
}

std::string certainty_json(const CertaintyRuns& runs) {
  CertaintyJson out{{"v", 1}, {"kind", "certainty"}, {"searches", runs.searches}, {"refused", runs.refused}};
  out["groups"] = CertaintyJson::array();
  for (const JudgedGroup& group : groups_of(runs)) {
    const Calibration& c = group.calibration;
    CertaintyJson bins = CertaintyJson::array();
    for (const evaluation::CalibrationBin& bin : c.bins)
      bins.push_back({{"from", bin.from},
                      {"to", bin.to},
                      {"count", bin.count},
                      {"said", bin.said},
                      {"right", bin.right}});
    out["groups"].push_back({{"of", group.of},
                             {"search", group.search},
                             {"count", c.count},
                             {"right", c.right},
                             {"expected_error", c.expected_error},
                             {"largest_error", c.largest_error},
                             {"brier", c.brier},
                             {"brier_of_rate", c.brier_of_rate},
                             {"bins", bins}});
  }
  return out.dump(1) + "\n";
}

std::string certainty_text(const CertaintyRuns& runs) {
  std::string text = std::to_string(runs.searches) + " searches, " + std::to_string(runs.refused) +
                     " of them refused\nof | search | how many | right | calibration error | largest | Brier "
                     "score | of the base rate\n";
  for (const JudgedGroup& group : groups_of(runs)) {
    const Calibration& c = group.calibration;
    text += group.of + " | " + group.search + " | " + std::to_string(c.count) + " | " +
            fixed_text(c.right, 3) + " | " + fixed_text(c.expected_error, 3) + " | " +
            fixed_text(c.largest_error, 3) + " | " + fixed_text(c.brier, 3) + " | " +
            fixed_text(c.brier_of_rate, 3) + "\n";
  }
  return text;
}

void write_certainty_report(const std::filesystem::path& folder, const CertaintyRuns& runs) {
  core::write_file(folder / "pieces.csv", table_of(runs.pieces, coronary::piece_looks));
  core::write_file(folder / "vessels.csv", table_of(runs.vessels, coronary::vessel_looks));
  reliability_plot(runs).write_png(folder / "reliability.png", 2.0);
  try {
    core::write_file(folder / "certainty_weights.h", source_of(fitted_weights(runs)));
  } catch (const InvalidInput&) {  // all of one kind: nothing to be fitted
  }
}

}  // namespace ostia::experiments
