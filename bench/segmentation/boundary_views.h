#pragma once
/// \file Boundaries about an axis as the docs' pictures show them: over straightened reformations and
/// cross-sections.

#include "dataset.h"

#include "ostia/figure/slice_figure.h"
#include "ostia/io/contour_file.h"
#include "ostia/segmentation/lumen_boundary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace ostia::bench {

using geometry::Vec3;

inline constexpr double pi = std::numbers::pi;

/// A boundary about the axis at one abscissa.
struct Ring {
  double s_mm = 0.0;
  std::vector<double> theta, rho_mm;  ///< by ascending theta in (-pi, pi]
  double at(double angle) const;
};

inline double Ring::at(double angle) const {
  angle = std::remainder(angle, 2.0 * pi);
  const std::size_t n = theta.size();
  const auto after =
      static_cast<std::size_t>(std::lower_bound(theta.begin(), theta.end(), angle) - theta.begin());
  const std::size_t i = (after + n - 1) % n, j = after % n;
  const double width = theta[j] - theta[i] + (j <= i ? 2.0 * pi : 0.0);
  const double part = angle - theta[i] + (angle < theta[i] ? 2.0 * pi : 0.0);
  return rho_mm[i] + part / width * (rho_mm[j] - rho_mm[i]);
}

/// The true contours of a section in the axis' own coordinates; `boundary` is "lumen" or "wall".
inline std::vector<Ring> truth_of(const std::filesystem::path& file, const std::string& key,
                                  const geometry::AxisCurve& axis, const std::string& boundary = "lumen") {
  std::vector<Ring> out;
  for (const geometry::ContourSection& section : io::read_contours(file).sections) {
    if (section.section != key || section.observer != "truth" || section.boundary != boundary) continue;
    for (const geometry::Contour& contour : section.contours) {
      Ring ring;
      ring.s_mm = axis.nearest_foot(geometry::contour_centroid(contour)).s_mm;
      std::vector<std::pair<double, double>> polar;
      for (const Vec3& point : contour.points) {
        const auto foot = axis.foot_near(point, ring.s_mm, 2.0);
        if (foot) polar.emplace_back(foot->theta, foot->rho_mm);
      }
      std::sort(polar.begin(), polar.end());
      for (const auto& [theta, rho] : polar) ring.theta.push_back(theta), ring.rho_mm.push_back(rho);
      out.push_back(std::move(ring));
    }
  }
  if (out.empty()) throw InvalidInput("no true " + boundary + " of section " + key + " in " + file.string());
  return out;
}

inline std::vector<Ring> rings_of(const segmentation::LumenBoundary& found, const std::vector<Ring>& where) {
  std::vector<Ring> out;
  for (const Ring& ring : where) {
    out.push_back({ring.s_mm, {}, {}});
    for (int n = 1; n <= 96; ++n) {
      const double theta = -pi + 2.0 * pi * n / 96.0;
      out.back().theta.push_back(theta);
      out.back().rho_mm.push_back(found.at(ring.s_mm, theta));
    }
  }
  return out;
}

/// Rings and how they are drawn.
struct DrawnRings {
  std::vector<Ring> rings;
  figure::Color color;
  double width_px = 1.4;
  std::string label;
};

inline figure::SliceFigureOptions look(const std::string& title, double side_mm, double zoom) {
  figure::SliceFigureOptions how;
  how.title = title;
  how.window_hu = 1100.0;
  how.level_hu = 350.0;
  how.patient_letters = false;
  how.plane_name = false;
  how.image_width_px = static_cast<int>(std::lround(side_mm * zoom));
  return how;
}

/// The view as a flat picture: x is mm from the axis, y mm along it.
inline figure::Picture along(const imaging::ImageVolume& image, const reformat::CurvedReformation& view,
                             const std::vector<DrawnRings>& drawn, const std::string& title) {
  const reformat::CurvedOptions& o = view.options();
  const double theta = o.theta_deg * pi / 180.0;
  std::vector<figure::SliceContour> contours;
  for (const DrawnRings& one : drawn) {
    std::vector<std::vector<Vec3>> lines(2);
    for (const Ring& ring : one.rings) {
      lines[0].emplace_back(ring.at(theta), ring.s_mm, 0.0);
      lines[1].emplace_back(-ring.at(theta + pi), ring.s_mm, 0.0);
    }
    contours.push_back({std::move(lines), one.color, one.width_px, one.label});
  }
  return figure::slice_figure(flattened(image, view), contours, {}, look(title, o.width * o.pixel_mm, 20.0));
}

/// Both reformations of a stretch of the axis.
inline std::vector<figure::Picture> both_along(const imaging::ImageVolume& image,
                                               std::shared_ptr<const geometry::AxisCurve> axis,
                                               double from_mm, double to_mm,
                                               const std::vector<DrawnRings>& drawn) {
  reformat::CurvedOptions o;
  o.pixel_mm = 0.1;
  o.s_start_mm = from_mm - 1.0;
  o.width = 110;
  o.height = static_cast<int>((to_mm - from_mm + 2.0) / o.pixel_mm);
  const reformat::CurvedReformation view(std::move(axis), o);
  return {along(image, view, drawn, "straightened"), along(image, view.twin(), drawn, "its twin")};
}

/// The cross-section of ring `n` of each.
inline figure::Picture across(const imaging::ImageVolume& image, const geometry::AxisCurve& axis,
                              const std::vector<DrawnRings>& drawn, std::size_t n, double side_mm = 6.0) {
  const double s = drawn.front().rings[n].s_mm;
  const reformat::Plane plane = reformat::cross_section_plane(axis, s, side_mm, 0.05);
  std::vector<figure::SliceContour> contours;
  for (const DrawnRings& one : drawn) {
    const Ring& ring = one.rings[n];
    std::vector<Vec3> line;
    for (std::size_t i = 0; i <= ring.theta.size(); ++i) {
      const std::size_t k = i % ring.theta.size();
      line.push_back(axis.place(s, ring.theta[k], ring.rho_mm[k]));
    }
    contours.push_back({{std::move(line)}, one.color, one.width_px, one.label});
  }
  char title[40];
  std::snprintf(title, sizeof title, "across, at %.0f mm", s);
  return figure::slice_figure(reformat::slice(image, plane, imaging::Interpolation::cubic), contours, {},
                              look(title, side_mm, 42.0));
}

}  // namespace ostia::bench
