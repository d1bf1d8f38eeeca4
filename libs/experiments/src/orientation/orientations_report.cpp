#include "ostia/experiments/orientations_report.h"

#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/evaluation/agreement_plot.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/plot.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdio>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using core::fixed_text;
using Json = nlohmann::ordered_json;

struct Named {
  TubeQuantity quantity;
  const char* key;
  const char* text;
  const char* of;  ///< "Lengths of ..."
};
constexpr std::array<Named, 3> quantities{
    {{TubeQuantity::length, "length", "length", "Length"},
     {TubeQuantity::radius, "radius", "radius, segmented image", "Radius, from the segmented image"},
     {TubeQuantity::grey_radius, "grey_radius", "radius, grey image", "Radius, from the grey image"}}};

Json json_of(const OrientationsSummary& s) {
  return {{"pairs", s.pairs},
          {"missing", s.missing},
          {"split", s.split},
          {"two_sd_mm", s.two_sd_mm},
          {"farthest_mm", s.farthest_mm},
          {"beyond", s.beyond},
          {"bias_mm", s.bias_mm},
          {"two_sd_truth_mm", s.two_sd_truth_mm}};
}

/// One tube's values over the orientations.
struct Spread {
  std::size_t count = 0;
  double mean = 0.0, sd = 0.0, farthest = 0.0;
};
Spread spread_of(const std::vector<OrientationRun>& runs, std::size_t tube, TubeQuantity quantity) {
  Spread spread;
  for (const OrientationRun& run : runs) {
    if (run.tubes[tube].lines == 0) continue;
    spread.mean += value_of(run.tubes[tube], quantity);
    ++spread.count;
  }
  if (spread.count == 0) return spread;
  spread.mean /= static_cast<double>(spread.count);
  for (const OrientationRun& run : runs) {
    if (run.tubes[tube].lines == 0) continue;
    const double off = value_of(run.tubes[tube], quantity) - spread.mean;
    spread.sd += off * off;
    spread.farthest = std::max(spread.farthest, std::abs(off));
  }
  spread.sd = spread.count > 1 ? std::sqrt(spread.sd / static_cast<double>(spread.count - 1)) : 0.0;
  return spread;
}

Json tube_json(const std::vector<OrientationRun>& runs, std::size_t tube) {
  const TubeMeasure& first = runs.front().tubes[tube];
  Json out{{"tube", first.tube},
           {"true_length_mm", first.true_length_mm},
           {"true_radius_mm", first.true_radius_mm}};
  for (const Named& q : quantities) {
    const Spread s = spread_of(runs, tube, q.quantity);
    out[q.key] = {{"mean_mm", s.mean}, {"two_sd_mm", 2.0 * s.sd}, {"farthest_mm", s.farthest}};
  }
  return out;
}

Json run_json(const OrientationRun& run) {
  Json out{{"orientation", run.name},        {"components", run.components}, {"loops", run.loops},
           {"other_lines", run.other_lines}, {"iterations", run.iterations}, {"tubes", Json::array()}};
  for (const TubeMeasure& tube : run.tubes)
    out["tubes"].push_back({{"tube", tube.tube},
                            {"lines", tube.lines},
                            {"length_mm", tube.length_mm},
                            {"radius_mm", tube.radius_mm},
                            {"grey_radius_mm", tube.grey_radius_mm}});
  return out;
}

std::string measure_rows(const std::vector<OrientationRun>& runs) {
  std::string text =
      "tube,orientation,true_length_mm,true_radius_mm,lines,length_mm,radius_mm,grey_radius_mm\n";
  for (const OrientationRun& run : runs)
    for (const TubeMeasure& m : run.tubes) {
      text += m.tube + "," + m.orientation + "," + fixed_text(m.true_length_mm, 3) + "," +
              fixed_text(m.true_radius_mm, 3) + "," + std::to_string(m.lines);
      for (const Named& q : quantities) text += "," + fixed_text(value_of(m, q.quantity), 4);
      text += "\n";
    }
  return text;
}

figure::Picture plots(const std::vector<OrientationRun>& runs, const std::vector<Named>& rows) {
  std::vector<figure::Picture> panels;
  for (const Named& row : rows) {
    const QuantityPairs mean = against_mean(runs, row.quantity), truth = against_truth(runs, row.quantity);
    evaluation::AgreementPlotOptions how;
    how.title = std::string(row.of) + ": against the tube's mean";
    panels.push_back(evaluation::agreement_plot(mean.reference, mean.result, how));
    how.title = std::string(row.of) + ": against the truth";
    panels.push_back(evaluation::agreement_plot(truth.reference, truth.result, how));
  }
  return figure::grid(panels, {.columns = 2, .look = figure::Look::light});
}

void add_summary(figure::HtmlReport& page, const std::vector<OrientationRun>& runs) {
  std::vector<std::vector<std::string>> rows;
  for (const Named& q : quantities) {
    const OrientationsSummary s = summarize(runs, q.quantity);
    rows.push_back({q.text, std::to_string(s.pairs), std::to_string(s.missing), fixed_text(s.two_sd_mm, 3),
                    fixed_text(s.farthest_mm, 3), std::to_string(s.beyond), fixed_text(s.bias_mm, 3),
                    fixed_text(s.two_sd_truth_mm, 3)});
  }
  page.table({"of", "values", "missing", "2 SD about the mean", "farthest", "beyond 2 SD",
              "bias to the truth", "2 SD to the truth"},
             rows, "Distances in mm.");
}

void add_tables(figure::HtmlReport& page, const std::vector<OrientationRun>& runs) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t t = 0; t < runs.front().tubes.size(); ++t) {
    const TubeMeasure& first = runs.front().tubes[t];
    std::vector<std::string> row{first.tube, fixed_text(first.true_length_mm, 1),
                                 fixed_text(first.true_radius_mm, 2)};
    for (const Named& q : quantities) {
      const Spread s = spread_of(runs, t, q.quantity);
      const double truth = q.quantity == TubeQuantity::length ? first.true_length_mm : first.true_radius_mm;
      row.push_back(fixed_text(s.mean - truth, 3));
      row.push_back(fixed_text(2.0 * s.sd, 3));
    }
    rows.push_back(std::move(row));
  }
  page.section("Tube by tube");
  page.table(
      {"tube", "length", "radius", "length: error", "2 SD", "radius: error", "2 SD", "grey: error", "2 SD"},
      rows, "Mean less truth and twice the standard deviation over the orientations, mm.");
  rows.clear();
  for (const OrientationRun& run : runs) {
    int missing = 0;
    for (const TubeMeasure& tube : run.tubes) missing += tube.lines == 0 ? 1 : 0;
    rows.push_back({run.name, std::to_string(run.components), std::to_string(run.loops),
                    std::to_string(missing), std::to_string(run.other_lines),
                    std::to_string(run.iterations)});
  }
  page.section("Orientation by orientation");
  page.table({"orientation", "parts", "loops", "missing tubes", "other lines", "iterations"}, rows);
}

}  // namespace

std::string parameters_json(const OrientationsOptions& o, std::size_t orientations) {
  const Vec3& voxel = o.scan.spacing_mm;
  return Json{{"orientations", orientations},
              {"voxel_mm", {voxel.x(), voxel.y(), voxel.z()}},
              {"psf_fwhm_mm", o.scan.psf_fwhm_mm},
              {"psf_fwhm_z_mm", o.scan.psf_fwhm_z_mm},
              {"lumen_hu", o.scan.lumen_hu},
              {"gel_hu", o.scan.gel_hu},
              {"noise_hu", o.scan.noise_hu},
              {"seed", o.scan.seed},
              {"vessel_sigma_hu", o.vessel_sigma_hu},
              {"tau", o.tau},
              {"inflation", o.inflation},
              {"curvature", o.curvature},
              {"iterations", o.iterations},
              {"diffusion_iterations", o.diffusion_iterations},
              {"prune_mm", o.prune_mm},
              {"gap_mm", o.gap_mm},
              {"sigma_mm", o.sigma_mm},
              {"knots_mm", o.knots_mm},
              {"settle", o.settle}}
      .dump();
}

std::string orientations_json(const std::vector<OrientationRun>& runs, const OrientationsOptions& options) {
  Json out{{"v", 1}, {"kind", "orientations"}};
  out["parameters"] = Json::parse(parameters_json(options, runs.size()));
  for (const Named& q : quantities) out["summary"][q.key] = json_of(summarize(runs, q.quantity));
  out["tubes"] = Json::array();
  for (std::size_t t = 0; t < runs.front().tubes.size(); ++t) out["tubes"].push_back(tube_json(runs, t));
  out["orientations"] = Json::array();
  for (const OrientationRun& run : runs) out["orientations"].push_back(run_json(run));
  return out.dump(1) + "\n";
}

std::string orientations_text(const std::vector<OrientationRun>& runs) {
  std::string text = "                          values  missing  2 SD (mm)  farthest  bias to truth  2 SD\n";
  for (const Named& q : quantities) {
    const OrientationsSummary s = summarize(runs, q.quantity);
    char line[160];
    std::snprintf(line, sizeof line, "%-25s %6zu %8zu %10.3f %9.3f %+14.3f %5.3f\n", q.text, s.pairs,
                  s.missing, s.two_sd_mm, s.farthest_mm, s.bias_mm, s.two_sd_truth_mm);
    text += line;
  }
  return text;
}

void write_orientations_report(const fs::path& folder, const std::vector<OrientationRun>& runs,
                               const OrientationsOptions& options) {
  core::write_file(folder / "measures.csv", measure_rows(runs));
  const figure::Picture lengths = plots(runs, {quantities[0]});
  const figure::Picture radii = plots(runs, {quantities[1], quantities[2]});
  lengths.write_png(folder / "length.png", 2.0);
  radii.write_png(folder / "radius.png", 2.0);
  figure::HtmlReport page(
      "One phantom in many orientations",
      std::to_string(runs.front().tubes.size()) + " tubes, " + std::to_string(runs.size()) + " scans");
  const Vec3& voxel = options.scan.spacing_mm;
  page.paragraph("Straight tubes scanned in silico with voxels of " + fixed_text(voxel.x(), 2) + " x " +
                 fixed_text(voxel.y(), 2) + " x " + fixed_text(voxel.z(), 2) +
                 " mm, segmented by a level set, thinned and measured; lengths and radii are held against "
                 "each tube's mean over the scans and against the truth.");
  add_summary(page, runs);
  page.picture(lengths, "Lengths.");
  page.picture(radii, "Mean radii.");
  add_tables(page, runs);
  page.write(folder / "report.html");
}

}  // namespace ostia::experiments
