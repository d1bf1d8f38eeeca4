#include "ostia/experiments/carotid_report.h"

#include "ostia/core/files.h"
#include "ostia/evaluation/distance_picture.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/plot.h"
#include "ostia/figure/slice_figure.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/surface_file.h"
#include "ostia/reformat/plane_image.h"
#include "ostia/reformat/section.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using geometry::Vec3;
using segmentation::WallFeature;

const char* feature_name(WallFeature feature) {
  switch (feature) {
    case WallFeature::edges:
      return "edges";
    case WallFeature::upwind:
      return "upwind";
    case WallFeature::centred:
      return "centred";
    case WallFeature::gaussian:
      return "gaussian";
  }
  return "";
}

std::string of_spread(const Spread& s) {
  char text[96];
  std::snprintf(text, sizeof text, "%+.3f +- %.3f [%+.2f, %+.2f]", s.mean, s.sd, s.low, s.high);
  return text;
}

Json json_of(const Spread& s) {
  return {{"points", s.points}, {"mean_mm", s.mean}, {"sd_mm", s.sd}, {"low_mm", s.low}, {"high_mm", s.high}};
}

geometry::TriMesh in_phantom_frame(const CarotidRun& run) {
  geometry::TriMesh mesh = run.model;
  for (Vec3& p : mesh.points) p = run.alignment.motion(p);
  return mesh;
}

/// How far along the lumen's length a height lies is not needed here: by radius, in steps of half a mm.
struct CalibreColumn {
  double from_mm = 0.0;
  Spread spread;
};

std::vector<CalibreColumn> by_calibre(const CarotidRun& run) {
  constexpr double step_mm = 0.5;
  std::vector<CalibreColumn> out;
  for (double from = 0.0; from < 5.0; from += step_mm) {
    std::vector<double> there;
    for (std::size_t i = 0; i < run.radius_mm.size(); ++i)
      if (run.radius_mm[i] >= from && run.radius_mm[i] < from + step_mm) there.push_back(run.distance_mm[i]);
    if (there.size() >= 20) out.push_back({from, spread_of(there)});
  }
  return out;
}

figure::Picture calibre_plot(const CarotidResult& result, CarotidScan scan) {
  std::vector<figure::Series> series;
  for (const CarotidRun& run : result.runs) {
    if (run.scan != scan) continue;
    figure::Series line{feature_name(run.feature)};
    for (const CalibreColumn& c : by_calibre(run)) {
      line.x.push_back(c.from_mm + 0.25);
      line.y.push_back(c.spread.mean);
    }
    if (!line.x.empty()) series.push_back(std::move(line));
  }
  figure::PlotOptions how;
  how.title = name_of(scan);
  how.x_label = "radius of the lumen (mm)";
  how.y_label = "mean signed distance (mm)";
  how.width_px = 460;
  how.height_px = 360;
  how.y_range = figure::Range{-0.3, 0.6};
  how.references = {{figure::ReferenceLine::Along::y, 0.0, ""}};
  return figure::line_plot(series, how);
}

figure::Picture slice_of(const CarotidPhantom& phantom, const CarotidResult& result,
                         const CarotidImage& image) {
  const geometry::TriMesh truth = [&] {
    geometry::TriMesh mesh = phantom.lumen;
    for (Vec3& p : mesh.points) p = image.pose(p);
    return mesh;
  }();
  const Vec3 at = geometry::bounds(truth.points).center();
  const reformat::Plane plane = reformat::sagittal_plane(image.image.geometry, at, 0.15);
  std::vector<figure::SliceContour> lines(1);
  lines[0].lines = reformat::section(truth, at, plane.normal());
  lines[0].label = "truth";
  lines[0].color = {0.2, 0.75, 0.3};
  for (const CarotidRun& run : result.runs) {
    if (run.scan != image.scan) continue;
    figure::SliceContour line;
    line.lines = reformat::section(run.model, at, plane.normal());
    line.label = feature_name(run.feature);
    line.color = run.feature == WallFeature::centred  ? figure::Color{0.25, 0.55, 0.95}
                 : run.feature == WallFeature::upwind ? figure::Color{0.95, 0.5, 0.1}
                                                      : figure::Color{0.85, 0.3, 0.75};
    line.width_px = 1.2;
    lines.push_back(std::move(line));
  }
  figure::SliceFigureOptions how;
  how.title = name_of(image.scan);
  how.image_width_px = 420;
  how.level_hu = image.scan == CarotidScan::ct ? 200.0 : 500.0;
  how.window_hu = image.scan == CarotidScan::ct ? 500.0 : 1400.0;
  how.plane_name = false;
  return figure::slice_figure(reformat::slice(image.image, plane), lines, {}, how);
}

figure::Picture slices(const CarotidPhantom& phantom, const CarotidResult& result) {
  std::vector<figure::Picture> panels;
  for (const CarotidImage& image : result.images) panels.push_back(slice_of(phantom, result, image));
  return figure::grid(panels, {.columns = 3});
}

figure::Picture distances(const CarotidPhantom& phantom, const CarotidResult& result) {
  std::vector<figure::Picture> panels;
  for (const CarotidRun& run : result.runs) {
    if (run.feature == WallFeature::edges) continue;
    const geometry::TriMesh model = in_phantom_frame(run);
    evaluation::DistanceFigureOptions how;
    how.range_mm = 0.5;
    how.title = std::string(name_of(run.scan)) + ", " + feature_name(run.feature);
    how.width_px = 520;
    how.height_px = 460;
    panels.push_back(
        evaluation::distance_figure(model, evaluation::signed_distances(phantom.lumen, model), how));
  }
  if (panels.empty()) return slices(phantom, result);
  return figure::grid(panels, {.columns = 2});
}

figure::Picture calibres(const CarotidResult& result) {
  std::vector<figure::Picture> panels;
  for (const CarotidImage& image : result.images) panels.push_back(calibre_plot(result, image.scan));
  return figure::grid(panels, {.columns = 3, .look = figure::Look::light});
}

/// What [Antiga], table 1, has; empty where the feature is not of the paper.
std::string of_paper(const CarotidRun& run) {
  const bool centred = run.feature == WallFeature::centred;
  if (!centred && run.feature != WallFeature::upwind) return "";
  switch (run.scan) {
    case CarotidScan::ct:
      return centred ? "-0.08 +- 0.06" : "0.02 +- 0.07";
    case CarotidScan::mr_axial:
      return centred ? "-0.17 +- 0.10" : "-0.07 +- 0.12";
    case CarotidScan::mr_coronal:
      return centred ? "-0.24 +- 0.08" : "-0.01 +- 0.15";
  }
  return "";
}

std::string table_csv(const CarotidResult& result) {
  std::string text = "scan,feature,against,points,mean_mm,sd_mm,low_mm,high_mm\n";
  for (const CarotidRun& run : result.runs) {
    const std::pair<const char*, const Spread*> rows[] = {{"surface", &run.surface},
                                                          {"points", &run.points},
                                                          {"surface, wide", &run.wide_surface},
                                                          {"points, wide", &run.wide_points}};
    for (const auto& [against, s] : rows) {
      char row[200];
      std::snprintf(row, sizeof row, "%s,%s,\"%s\",%zu,%.4f,%.4f,%.4f,%.4f\n", name_of(run.scan),
                    feature_name(run.feature), against, s->points, s->mean, s->sd, s->low, s->high);
      text += row;
    }
  }
  return text;
}

std::string calibre_csv(const CarotidResult& result) {
  std::string text = "scan,feature,radius_from_mm,points,mean_mm,sd_mm\n";
  for (const CarotidRun& run : result.runs) {
    for (const CalibreColumn& c : by_calibre(run)) {
      char row[160];
      std::snprintf(row, sizeof row, "%s,%s,%.1f,%zu,%.4f,%.4f\n", name_of(run.scan),
                    feature_name(run.feature), c.from_mm, c.spread.points, c.spread.mean, c.spread.sd);
      text += row;
    }
  }
  return text;
}

std::string file_name(const CarotidRun& run) {
  std::string name = std::string(name_of(run.scan)) + "-" + feature_name(run.feature) + ".vtp";
  for (char& c : name) c = c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

}  // namespace

std::string parameters_json(const CarotidOptions& o) {
  Json out{{"ct_fwhm_mm", o.ct_fwhm_mm},
           {"ct_slice_mm", o.ct_slice_mm},
           {"ct_noise", o.ct_noise},
           {"mr_noise", o.mr_noise},
           {"thresholds", o.thresholds},
           {"tilt_deg", o.tilt_deg},
           {"seed_inset_mm", o.seed_inset_mm},
           {"end_mm", o.end_mm},
           {"section_step_mm", o.section_step_mm},
           {"section_points", o.section_points},
           {"measured_bias_mm", o.measured_bias_mm},
           {"measured_sigma_mm", o.measured_sigma_mm},
           {"wide_mm", o.wide_mm},
           {"seed", o.seed}};
  for (const CarotidScan scan : o.scans) out["scans"].push_back(name_of(scan));
  for (const WallFeature feature : o.features) out["features"].push_back(feature_name(feature));
  return out.dump();
}

std::string carotid_json(const CarotidResult& result, const CarotidOptions& options) {
  Json out{{"v", 1}, {"kind", "carotid"}};
  out["parameters"] = Json::parse(parameters_json(options));
  out["measured_points"] = json_of(result.measured_error);
  out["runs"] = Json::array();
  for (const CarotidRun& run : result.runs)
    out["runs"].push_back({{"scan", name_of(run.scan)},
                           {"feature", feature_name(run.feature)},
                           {"to_surface", json_of(run.surface)},
                           {"to_points", json_of(run.points)},
                           {"wide_to_surface", json_of(run.wide_surface)},
                           {"wide_to_points", json_of(run.wide_points)},
                           {"threshold", run.threshold},
                           {"iterations", run.iterations},
                           {"converged", run.converged},
                           {"aligned_from_rms_mm", run.alignment.rms_before_mm},
                           {"aligned_to_rms_mm", run.alignment.rms_mm}});
  return out.dump(1) + "\n";
}

std::string carotid_text(const CarotidResult& result) {
  std::string text = "measured points against the surface: " + of_spread(result.measured_error) + " mm\n";
  for (const CarotidRun& run : result.runs) {
    char row[300];
    std::snprintf(row, sizeof row, "%-10s %-8s surface %s  points %s  paper %s\n", name_of(run.scan),
                  feature_name(run.feature), of_spread(run.surface).c_str(), of_spread(run.points).c_str(),
                  of_paper(run).c_str());
    text += row;
  }
  return text;
}

void write_carotid_report(const fs::path& folder, const CarotidPhantom& phantom,
                          const CarotidResult& result) {
  core::write_file(folder / "table.csv", table_csv(result));
  core::write_file(folder / "by-calibre.csv", calibre_csv(result));
  const figure::Picture in_slices = slices(phantom, result), coloured = distances(phantom, result),
                        over_radius = calibres(result);
  in_slices.write_png(folder / "slices.png", 1.5);
  coloured.write_png(folder / "distances.png", 1.5);
  over_radius.write_png(folder / "calibre.png", 2.0);
  for (const CarotidRun& run : result.runs) io::write_surface(folder / file_name(run), in_phantom_frame(run));
  figure::HtmlReport page("The carotid phantom", "CT and two MR series of one lumen, in silico");
  page.paragraph(
      "Level set with advection alone (w1 = w2 = 0, w3 = 1), no regularisation; models laid onto the true "
      "surface by iterative closest points; signed distances of their vertices in mm, positive outside.");
  std::vector<std::vector<std::string>> rows;
  for (const CarotidRun& run : result.runs)
    rows.push_back({name_of(run.scan), feature_name(run.feature), of_spread(run.surface),
                    of_spread(run.points), of_spread(run.wide_surface), of_paper(run)});
  page.table({"scan", "feature", "surface", "measured points", "surface, where wide", "paper"}, rows,
             "Mean +- standard deviation [range]");
  page.picture(over_radius, "Mean signed distance over the lumen's radius.");
  page.picture(in_slices, "A slice of each scan.");
  page.picture(coloured, "Models coloured by their signed distance.");
  page.write(folder / "report.html");
}

}  // namespace ostia::experiments
