#include "ostia/experiments/smoothness_report.h"

#include "lumen/smoothness_plots.h"

#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/experiments/orientations_report.h"
#include "ostia/figure/html_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using core::fixed_text;
using Json = nlohmann::ordered_json;
using Figures = std::vector<SurfaceFigures>;

const char* key_of(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::isosurface:
      return "isosurface";
    case SurfaceKind::level:
      return "level";
    case SurfaceKind::areas:
      return "areas";
    case SurfaceKind::elliptic:
      return "elliptic";
    case SurfaceKind::decimated:
      return "decimated";
    default:
      return "smoothed";
  }
}

bool is_reconstructed(SurfaceKind kind) {
  return kind == SurfaceKind::level || kind == SurfaceKind::areas || kind == SurfaceKind::elliptic;
}

std::string level_name(SurfaceKind kind, int level) {
  return "L" + std::to_string(level) +
         (kind == SurfaceKind::level ? std::string() : std::string(" ") + key_of(kind));
}

/// NaN is no number in JSON.
Json json_figure(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json_of(const SurfaceFigures& s) {
  Json out{{"orientation", s.orientation},
           {"kind", key_of(s.kind)},
           {"parameter", s.parameter},
           {"triangles", s.triangles}};
  for (const auto& [name, bend] : {std::pair{"tubes", &s.tubes}, {"wall", &s.wall}, {"whole", &s.whole}})
    out[name] = {{"rms_kappa1_per_mm", json_figure(bend->rms_kappa1)},
                 {"rms_kappa2_per_mm", json_figure(bend->rms_kappa2)},
                 {"trimmed_kappa1_per_mm", json_figure(bend->trimmed_kappa1)},
                 {"trimmed_kappa2_per_mm", json_figure(bend->trimmed_kappa2)},
                 {"vertices", bend->vertices}};
  out["rms_sd_mm"] = s.rms_mm;
  out["hausdorff_mm"] = s.hausdorff_mm;
  out["tubes_rms_sd_mm"] = s.tubes_rms_mm;
  out["true_rms_mm"] = s.true_rms_mm;
  out["tubes_true_mean_mm"] = s.tubes_true_mean_mm;
  out["closed"] = s.closed;
  out["self_intersections"] = s.self_intersections;
  return out;
}

std::string rows_of(const Figures& surfaces) {
  std::string text =
      "orientation,surface,triangles,rms_kappa1_tubes,rms_kappa2_tubes,rms_kappa1_wall,rms_kappa2_wall,"
      "rms_kappa1,rms_kappa2,trimmed_kappa1_tubes,rms_sd_mm,hausdorff_mm,tubes_rms_sd_mm,true_rms_mm,tubes_"
      "true_mean_mm,closed,"
      "self_intersections\n";
  for (const SurfaceFigures& s : surfaces) {
    text += s.orientation + "," + name_of(s) + "," + std::to_string(s.triangles);
    for (const Bending* b : {&s.tubes, &s.wall, &s.whole})
      text += "," + fixed_text(b->rms_kappa1, 5) + "," + fixed_text(b->rms_kappa2, 5);
    text += "," + fixed_text(s.tubes.trimmed_kappa1, 5);
    for (const double d : {s.rms_mm, s.hausdorff_mm, s.tubes_rms_mm, s.true_rms_mm, s.tubes_true_mean_mm})
      text += "," + fixed_text(d, 4);
    text += std::string(s.closed ? ",yes," : ",no,") + std::to_string(s.self_intersections) + "\n";
  }
  return text;
}

void add_tables(figure::HtmlReport& page, const Figures& surfaces) {
  std::vector<std::vector<std::string>> rows;
  for (const LevelSummary& l : summarize(surfaces))
    rows.push_back({level_name(l.kind, l.level), std::to_string(l.scans), fixed_text(l.mean_rms_mm, 3),
                    fixed_text(l.worst_rms_mm, 3), fixed_text(l.worst_hausdorff_mm, 2),
                    fixed_text(l.worst_tubes_rms_mm, 3), fixed_text(l.worst_true_rms_mm, 3),
                    fixed_text(l.worst_kappa1_tubes, 3), fixed_text(l.worst_kappa1_wall, 3),
                    fixed_text(l.worst_kappa1, 3), std::to_string(l.self_intersections)});
  page.table({"level", "scans", "RMS distance: mean", "worst", "Hausdorff", "RMS of the tubes",
              "to the truth", "kappa1: tubes", "with joints", "with ends", "self-intersections"},
             rows, "Distances from the scan's isosurface in mm, curvatures in 1/mm; the worst of all scans.");
  rows.clear();
  for (const SurfaceFigures& s : surfaces)
    rows.push_back({s.orientation, name_of(s), std::to_string(s.triangles), fixed_text(s.tubes.rms_kappa1, 3),
                    fixed_text(s.tubes.trimmed_kappa1, 3), fixed_text(s.tubes.rms_kappa2, 3),
                    fixed_text(s.wall.rms_kappa1, 3), fixed_text(s.whole.rms_kappa1, 3),
                    fixed_text(s.rms_mm, 3), fixed_text(s.hausdorff_mm, 2), fixed_text(s.true_rms_mm, 3),
                    fixed_text(s.tubes_true_mean_mm, 3)});
  page.section("Surface by surface");
  page.table({"orientation", "surface", "triangles", "kappa1: tubes", "without 1 %", "kappa2: tubes",
              "kappa1 with joints", "kappa1 with ends", "RMS distance", "Hausdorff", "to the truth",
              "tubes too wide"},
             rows);
}

}  // namespace

std::string name_of(const SurfaceFigures& s) {
  const std::string json_figure = std::to_string(static_cast<int>(std::lround(s.parameter)));
  switch (s.kind) {
    case SurfaceKind::isosurface:
      return "S0";
    case SurfaceKind::level:
    case SurfaceKind::areas:
    case SurfaceKind::elliptic:
      return level_name(s.kind, static_cast<int>(s.parameter));
    case SurfaceKind::decimated:
      return "S0 less " + std::to_string(static_cast<int>(std::lround(100.0 * s.parameter))) + " %";
    default:
      return "S0 smoothed " + json_figure + " times";
  }
}

std::vector<LevelSummary> summarize(const Figures& surfaces) {
  std::map<std::pair<SurfaceKind, int>, LevelSummary> levels;
  for (const SurfaceFigures& s : surfaces) {
    if (!is_reconstructed(s.kind)) continue;
    LevelSummary& l = levels[{s.kind, static_cast<int>(s.parameter)}];
    l.kind = s.kind;
    l.level = static_cast<int>(s.parameter);
    ++l.scans;
    l.mean_rms_mm += s.rms_mm;
    l.worst_rms_mm = std::max(l.worst_rms_mm, s.rms_mm);
    l.worst_hausdorff_mm = std::max(l.worst_hausdorff_mm, s.hausdorff_mm);
    l.worst_tubes_rms_mm = std::max(l.worst_tubes_rms_mm, s.tubes_rms_mm);
    l.worst_true_rms_mm = std::max(l.worst_true_rms_mm, s.true_rms_mm);
    l.worst_kappa1_tubes = std::max(l.worst_kappa1_tubes, s.tubes.rms_kappa1);
    l.worst_kappa1_wall = std::max(l.worst_kappa1_wall, s.wall.rms_kappa1);
    l.worst_kappa1 = std::max(l.worst_kappa1, s.whole.rms_kappa1);
    l.self_intersections += s.self_intersections;
    l.not_closed += s.closed ? 0U : 1U;
  }
  std::vector<LevelSummary> out;
  for (auto& [key, l] : levels) {
    l.mean_rms_mm /= static_cast<double>(l.scans);
    out.push_back(l);
  }
  return out;
}

std::string parameters_json(const SmoothnessOptions& o, std::size_t orientations) {
  Json out = Json::parse(parameters_json(o.scans, orientations));
  out["levels"] = o.levels;
  out["decimations"] = o.decimations;
  out["smoothings"] = o.smoothings;
  out["relaxation"] = o.relaxation;
  out["vtk_at"] = o.vtk_at;
  out["clear_mm"] = o.clear_mm;
  out["sample_mm"] = o.sample_mm;
  return out.dump();
}

std::string smoothness_json(const Figures& surfaces, const SmoothnessOptions& options,
                            std::size_t orientations) {
  Json out{{"v", 1}, {"kind", "smoothness"}};
  out["parameters"] = Json::parse(parameters_json(options, orientations));
  out["levels"] = Json::array();
  for (const LevelSummary& l : summarize(surfaces))
    out["levels"].push_back({{"kind", key_of(l.kind)},
                             {"level", l.level},
                             {"scans", l.scans},
                             {"mean_rms_sd_mm", l.mean_rms_mm},
                             {"worst_rms_sd_mm", l.worst_rms_mm},
                             {"worst_hausdorff_mm", l.worst_hausdorff_mm},
                             {"worst_tubes_rms_sd_mm", l.worst_tubes_rms_mm},
                             {"worst_true_rms_mm", l.worst_true_rms_mm},
                             {"worst_rms_kappa1_tubes_per_mm", l.worst_kappa1_tubes},
                             {"worst_rms_kappa1_wall_per_mm", l.worst_kappa1_wall},
                             {"worst_rms_kappa1_whole_per_mm", l.worst_kappa1},
                             {"self_intersections", l.self_intersections},
                             {"not_closed", l.not_closed}});
  out["surfaces"] = Json::array();
  for (const SurfaceFigures& s : surfaces) out["surfaces"].push_back(json_of(s));
  return out.dump(1) + "\n";
}

std::string smoothness_text(const Figures& surfaces) {
  std::string text =
      "orientation    surface                  triangles  RMS to S0  Hausdorff  tubes RMS  to truth  kappa1: "
      "tubes  less 1 %  joints  ends\n";
  for (const SurfaceFigures& s : surfaces) {
    char line[200];
    std::snprintf(line, sizeof line, "%-14s %-24s %9zu %10.3f %10.2f %10.3f %9.3f %14.3f %9.3f %7.3f %5.3f\n",
                  s.orientation.c_str(), name_of(s).c_str(), s.triangles, s.rms_mm, s.hausdorff_mm,
                  s.tubes_rms_mm, s.true_rms_mm, s.tubes.rms_kappa1, s.tubes.trimmed_kappa1,
                  s.wall.rms_kappa1, s.whole.rms_kappa1);
    text += line;
  }
  return text;
}

void write_smoothness_report(const fs::path& folder, const Figures& surfaces,
                             const SmoothnessOptions& options) {
  core::write_file(folder / "surfaces.csv", rows_of(surfaces));
  const figure::Picture distances = distances_plot(surfaces), bends = bends_plot(surfaces);
  distances.write_png(folder / "distance.png", 2.0);
  bends.write_png(folder / "smoothness.png", 2.0);
  figure::HtmlReport page("Smoothness and distance of reconstructed surfaces",
                          "The phantom of tubes; VTK's filters on the scan " + compared_at(surfaces));
  page.paragraph(
      "Each scan is segmented; S0 is the isosurface of its level set, L0, L1, ... are reconstructed from its "
      "skeleton, with circles of its radii; L1 areas and L1 elliptic from circles with the areas and "
      "ellipses "
      "with the second moments of S0's sections. kappa1 is the lesser principal curvature, 0 along a "
      "straight tube, by a quadric over each "
      "vertex and its direct neighbours. Tubes: what is farther than " +
      fixed_text(options.clear_mm, 1) + " mm from a joint and from a free end.");
  page.picture(distances, "Left: each scan at each level. Right: one scan, against the number of triangles.");
  page.picture(bends,
               "Left: curvature against triangles. Right: an isosurface with the triangles of L1, smoothed.");
  add_tables(page, surfaces);
  page.write(folder / "report.html");
}

}  // namespace ostia::experiments
