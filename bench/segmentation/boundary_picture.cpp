// The picture of docs/lumen-boundary.md: the found boundary and the true one over both straightened
// reformations and four cross-sections of an annotated section of a phantom's data set.
//   boundary_picture DATASET_FOLDER VESSEL_FOLDER SECTION OUTPUT.png

#include "dataset.h"
#include "picture.h"

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
#include <vector>

namespace {

using namespace ostia;
using geometry::Vec3;

constexpr double pi = std::numbers::pi;

/// A boundary about the axis at one abscissa.
struct Ring {
  double s_mm = 0.0;
  std::vector<double> theta, rho_mm;  ///< by ascending theta in (-pi, pi]
  double at(double angle) const;
};

double Ring::at(double angle) const {
  angle = std::remainder(angle, 2.0 * pi);
  const std::size_t n = theta.size();
  const auto after =
      static_cast<std::size_t>(std::lower_bound(theta.begin(), theta.end(), angle) - theta.begin());
  const std::size_t i = (after + n - 1) % n, j = after % n;
  const double width = theta[j] - theta[i] + (j <= i ? 2.0 * pi : 0.0);
  const double part = angle - theta[i] + (angle < theta[i] ? 2.0 * pi : 0.0);
  return rho_mm[i] + part / width * (rho_mm[j] - rho_mm[i]);
}

/// The true contours of a section in the axis' own coordinates.
std::vector<Ring> truth_of(const std::filesystem::path& file, const std::string& key,
                           const geometry::AxisCurve& axis) {
  std::vector<Ring> out;
  for (const geometry::ContourSection& section : io::read_contours(file).sections) {
    if (section.section != key || section.observer != "truth" || section.boundary != "lumen") continue;
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
  if (out.empty()) throw InvalidInput("no true lumen of section " + key + " in " + file.string());
  return out;
}

std::vector<Ring> rings_of(const segmentation::LumenBoundary& found, const std::vector<Ring>& where) {
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

struct Boundaries {
  std::vector<Ring> truth, found;
};

figure::SliceContour styled(std::vector<std::vector<Vec3>> lines, bool truth) {
  return {std::move(lines), truth ? figure::colors::cut : figure::colors::contour, 1.4,
          truth ? "truth" : "found"};
}

figure::SliceFigureOptions look(const std::string& title, double side_mm, double zoom) {
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
figure::Picture along(const imaging::ImageVolume& image, const reformat::CurvedReformation& view,
                      const Boundaries& boundaries, const std::string& title) {
  const reformat::CurvedOptions& o = view.options();
  const double theta = o.theta_deg * pi / 180.0;
  const auto lines = [&](const std::vector<Ring>& rings) {
    std::vector<std::vector<Vec3>> out(2);
    for (const Ring& ring : rings) {
      out[0].emplace_back(ring.at(theta), ring.s_mm, 0.0);
      out[1].emplace_back(-ring.at(theta + pi), ring.s_mm, 0.0);
    }
    return out;
  };
  return figure::slice_figure(bench::flattened(image, view),
                              {styled(lines(boundaries.truth), true), styled(lines(boundaries.found), false)},
                              {}, look(title, o.width * o.pixel_mm, 20.0));
}

figure::Picture across(const imaging::ImageVolume& image, const geometry::AxisCurve& axis,
                       const Boundaries& boundaries, std::size_t n) {
  const double s = boundaries.truth[n].s_mm, side_mm = 6.0;
  const reformat::Plane plane = reformat::cross_section_plane(axis, s, side_mm, 0.05);
  const auto line = [&](const Ring& ring) {
    std::vector<Vec3> out;
    for (std::size_t i = 0; i <= ring.theta.size(); ++i) {
      const std::size_t k = i % ring.theta.size();
      out.push_back(axis.place(s, ring.theta[k], ring.rho_mm[k]));
    }
    return std::vector<std::vector<Vec3>>{out};
  };
  char title[40];
  std::snprintf(title, sizeof title, "across, at %.0f mm", s);
  return figure::slice_figure(
      reformat::slice(image, plane, imaging::Interpolation::cubic),
      {styled(line(boundaries.truth[n]), true), styled(line(boundaries.found[n]), false)}, {},
      look(title, side_mm, 42.0));
}

void make(const std::filesystem::path& dataset, const std::string& vessel, const std::string& section,
          const std::filesystem::path& out) {
  const imaging::ImageVolume image = bench::image_of(dataset);
  const auto axis = bench::axis_of(dataset, vessel);
  Boundaries boundaries;
  boundaries.truth = truth_of(dataset / "contours.json", section, *axis);
  const double first = boundaries.truth.front().s_mm, last = boundaries.truth.back().s_mm;
  boundaries.found = rings_of(segmentation::lumen_boundary(image, *axis, std::max(0.0, first - 15.0),
                                                           std::min(axis->length(), last + 15.0)),
                              boundaries.truth);
  reformat::CurvedOptions o;
  o.pixel_mm = 0.1;
  o.s_start_mm = first - 1.0;
  o.width = 110;
  o.height = static_cast<int>((last - first + 2.0) / o.pixel_mm);
  const reformat::CurvedReformation view(axis, o);
  std::vector<figure::Picture> sections;
  for (const double share : {0.1, 0.38, 0.48, 0.61})
    sections.push_back(
        across(image, *axis, boundaries, static_cast<std::size_t>(share * boundaries.truth.size())));
  figure::GridOptions pairs;
  pairs.columns = 2;
  figure::GridOptions grid;
  grid.columns = 3;
  grid.letters = true;
  grid.title = "Boundary found in the image, and the truth";
  figure::grid({along(image, view, boundaries, "straightened"),
                along(image, view.twin(), boundaries, "its twin"), figure::grid(sections, pairs)},
               grid)
      .write_png(out);
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::bench::make_picture(
      argc, argv, "DATASET_FOLDER VESSEL_FOLDER SECTION OUTPUT.png", 4,
      [](const std::vector<std::string>& given) { make(given[0], given[1], given[2], given[3]); });
}
