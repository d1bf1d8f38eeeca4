#include "lumen/smoothness_plots.h"

#include "ostia/experiments/smoothness_report.h"
#include "ostia/figure/plot.h"

#include <map>
#include <utility>

namespace ostia::experiments {

using Figures = std::vector<SurfaceFigures>;

std::string compared_at(const Figures& surfaces) {
  for (const SurfaceFigures& s : surfaces)
    if (s.kind == SurfaceKind::decimated || s.kind == SurfaceKind::smoothed) return s.orientation;
  return {};
}

namespace {

using FigureValue = double (*)(const SurfaceFigures&);

/// One curve over those of a kind in one orientation.
figure::Series curve(const Figures& surfaces, SurfaceKind kind, const std::string& orientation, FigureValue x,
                     FigureValue y, const std::string& name) {
  figure::Series out;
  out.name = name;
  for (const SurfaceFigures& s : surfaces) {
    const bool whole = s.kind == SurfaceKind::isosurface && kind == SurfaceKind::decimated;
    if (s.orientation != orientation || (s.kind != kind && !whole)) continue;
    out.x.push_back(x(s));
    out.y.push_back(y(s));
  }
  return out;
}

double thousands(const SurfaceFigures& s) {
  return 1e-3 * static_cast<double>(s.triangles);
}
double distance(const SurfaceFigures& s) {
  return s.rms_mm;
}
double kappa1(const SurfaceFigures& s) {
  return s.tubes.trimmed_kappa1;
}
double kappa2(const SurfaceFigures& s) {
  return s.tubes.trimmed_kappa2;
}
double iterations(const SurfaceFigures& s) {
  return s.parameter;
}

/// Figure 5(a): each scan's distance at each level.
figure::Picture scans_plot(const Figures& surfaces) {
  std::map<std::pair<SurfaceKind, double>, figure::Series> levels;
  for (const SurfaceFigures& s : surfaces) {
    if (s.kind != SurfaceKind::level && s.kind != SurfaceKind::elliptic) continue;
    figure::Series& series = levels[{s.kind, s.parameter}];
    series.name = name_of(s);
    series.x.push_back(static_cast<double>(series.x.size() + 1));
    series.y.push_back(s.rms_mm);
  }
  std::vector<figure::Series> all;
  for (auto& [key, series] : levels) all.push_back(std::move(series));
  figure::PlotOptions how;
  how.title = "Distance from the isosurface";
  how.x_label = "scan";
  how.y_label = "RMS (mm)";
  how.y_from_zero = true;
  return figure::line_plot(all, how);
}

/// Figures 5(b) and 5(c).
figure::Picture triangles_plot(const Figures& surfaces, FigureValue value, const char* title,
                               const char* label) {
  const std::string at = compared_at(surfaces);
  figure::PlotOptions how;
  how.title = title;
  how.x_label = "thousand triangles";
  how.y_label = label;
  how.y_from_zero = true;
  return figure::line_plot(
      {curve(surfaces, SurfaceKind::level, at, thousands, value, "reconstructed, level by level"),
       curve(surfaces, SurfaceKind::decimated, at, thousands, value, "isosurface, decimated")},
      how);
}

/// Figure 5(d).
figure::Picture smoothing_plot(const Figures& surfaces) {
  const std::string at = compared_at(surfaces);
  figure::PlotOptions how;
  how.title = "Curvatures of the smoothed isosurface";
  how.x_label = "iterations";
  how.y_label = "RMS on the tubes but for 1 % (1/mm)";
  how.y_from_zero = true;
  for (const SurfaceFigures& s : surfaces)
    if (s.orientation == at && s.kind == SurfaceKind::level && s.parameter == 1.0) {
      how.references.push_back({figure::ReferenceLine::Along::y, kappa1(s), "kappa1 of L1"});
      how.references.push_back({figure::ReferenceLine::Along::y, kappa2(s), "kappa2 of L1"});
    }
  return figure::line_plot({curve(surfaces, SurfaceKind::smoothed, at, iterations, kappa1, "kappa1"),
                            curve(surfaces, SurfaceKind::smoothed, at, iterations, kappa2, "kappa2")},
                           how);
}

}  // namespace

figure::Picture distances_plot(const Figures& surfaces) {
  return figure::grid(
      {scans_plot(surfaces), triangles_plot(surfaces, distance, "Distance and triangles", "RMS (mm)")},
      {.columns = 2, .look = figure::Look::light});
}

figure::Picture bends_plot(const Figures& surfaces) {
  return figure::grid(
      {triangles_plot(surfaces, kappa1, "Curvature along the tubes", "RMS of kappa1 but for 1 % (1/mm)"),
       smoothing_plot(surfaces)},
      {.columns = 2, .look = figure::Look::light});
}

}  // namespace ostia::experiments
