#include "lumen/sensitivity_measure.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/experiments/carotid_scan.h"
#include "ostia/geometry/contour_set.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/phantom/builtin_case.h"
#include "ostia/reformat/section.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::experiments {
namespace {

using geometry::AnalyticShape;
using geometry::Vec3;

constexpr double clear_of_end_mm = 5.0, clear_of_junction_radii = 4.0;
constexpr double least_area_mm2 = 0.1;  // what is smaller is a speck
constexpr double seed_inset_mm = 2.0;
constexpr double tube_hu = 350.0, tissue_hu = 50.0;

/// Whether a place lies in another tube than `own`.
bool in_another(const AnalyticShape& shape, std::size_t own, const Vec3& place) {
  for (std::size_t t = 0; t < shape.tubes.size(); ++t) {
    const geometry::Centerline& axis = shape.tubes[t].axis;
    for (std::size_t i = 0; t != own && i < axis.size(); ++i)
      if ((axis.points[i] - place).norm() < axis.radius[i]) return true;
  }
  return false;
}

double clearance(const AnalyticShape& shape, std::size_t tube, std::size_t end) {
  const geometry::Centerline& axis = shape.tubes[tube].axis;
  return in_another(shape, tube, axis.points[end]) ? clear_of_junction_radii * axis.radius[end]
                                                   : clear_of_end_mm;
}

/// The image of a closed analytic shape, oblique to the grid.
KnownLumen scanned(std::string name, AnalyticShape shape, std::uint64_t seed) {
  KnownLumen out;
  out.name = std::move(name);
  out.lumen_hu = tube_hu;
  out.around_hu = tissue_hu;
  SurfaceScanOptions how;
  how.seed = seed;
  how.noise = 15.0;
  how.inside = tube_hu;
  how.outside = tissue_hu;
  const geometry::TriMesh surface = geometry::surface_of(shape, 0.2, false);
  how.grid.direction =
      (Eigen::AngleAxisd(0.35, Vec3::UnitX()) * Eigen::AngleAxisd(0.25, Vec3::UnitY())).toRotationMatrix();
  how.grid.spacing = Vec3::Constant(0.4);
  geometry::Box3 box;
  for (const Vec3& p : surface.points) box.extend(how.grid.direction.transpose() * p);
  constexpr double margin_mm = 5.0;
  for (int d = 0; d < 3; ++d)
    how.grid.size[d] = std::llround(std::ceil((box.sizes()[d] + 2.0 * margin_mm) / how.grid.spacing[d]));
  how.grid.origin = how.grid.direction * (box.min() - Vec3::Constant(margin_mm));
  out.image = scan_surface(surface, how);
  out.truth = std::move(shape);
  return out;
}

Vec3 at(const geometry::AnalyticTube& tube, double s) {
  return geometry::AxisCurve(tube.axis).point(s);
}

}  // namespace

KnownLumen stenosed_lumen(std::uint64_t seed) {
  KnownLumen out = scanned("stenosed tube", geometry::stenosed_tube(40.0, 1.75, 0.5, 20.0, 10.0), seed);
  const geometry::AnalyticTube& tube = out.truth.tubes.front();
  out.branches = {{at(tube, seed_inset_mm), std::nullopt, at(tube, 40.0 - seed_inset_mm)}};
  return out;
}

KnownLumen forked_lumen(std::uint64_t seed) {
  KnownLumen out = scanned("Y-junction", geometry::y_junction(18.0, 22.0, 1.9, 1.5, 60.0), seed);
  const Vec3 start = at(out.truth.tubes.front(), seed_inset_mm);
  for (std::size_t t = 1; t < out.truth.tubes.size(); ++t)
    out.branches.push_back({start, std::nullopt,
                            at(out.truth.tubes[t], out.truth.tubes[t].axis.abscissa.back() - seed_inset_mm)});
  return out;
}

KnownLumen coronary_lumen(std::uint64_t seed) {
  phantom::BuiltinOptions options;
  options.seed = seed;
  phantom::BuiltinCase made = phantom::make_builtin_case(options);
  KnownLumen out;
  out.name = "two coronary branches";
  out.image = std::move(made.image);
  out.truth = std::move(made.truth);
  for (const auto& [from, to] : made.branches) out.branches.push_back({from, std::nullopt, to});
  out.lumen_hu = options.lumen_hu;
  out.around_hu = options.myocardium_hu;
  return out;
}

TrueSections true_sections(const AnalyticShape& shape, double step_mm) {
  TrueSections out;
  out.step_mm = step_mm;
  for (std::size_t t = 0; t < shape.tubes.size(); ++t) {
    const geometry::Centerline& axis = shape.tubes[t].axis;
    out.axes.emplace_back(axis);
    const double from = clearance(shape, t, 0),
                 to = out.axes.back().length() - clearance(shape, t, axis.size() - 1);
    out.reach.emplace_back(from, to);
    for (int n = 0; from + n * step_mm <= to; ++n) {
      const double s = from + n * step_mm;
      out.planes.push_back({t, s, out.axes.back().point(s), out.axes.back().frame(s).tangent});
    }
  }
  out.sections = sections_of(geometry::surface_of(shape, 0.15, false), out);
  // A plane in which not even the truth has an outline of its own says nothing of a result.
  std::vector<TrueSections::Plane> planes;
  std::vector<LumenSection> sections;
  for (std::size_t i = 0; i < out.planes.size(); ++i) {
    if (out.sections[i].area_mm2 <= 0.0) continue;
    planes.push_back(out.planes[i]);
    sections.push_back(out.sections[i]);
  }
  out.planes = std::move(planes);
  out.sections = std::move(sections);
  return out;
}

std::vector<LumenSection> sections_of(const geometry::TriMesh& surface, const TrueSections& truth) {
  std::vector<LumenSection> out(truth.planes.size());
  core::parallel_for(out.size(), 1, [&](std::size_t i) {
    const TrueSections::Plane& plane = truth.planes[i];
    double nearest = 3.0;  // mm; what is farther off is another vessel
    for (auto& line : reformat::section(surface, plane.point, plane.tangent)) {
      if (line.size() < 4 || line.front() != line.back()) continue;
      const double area = reformat::enclosed_area(line);
      if (area < least_area_mm2) continue;
      line.pop_back();
      const Vec3 middle = geometry::contour_centroid({0.0, line});
      if ((middle - plane.point).norm() >= nearest) continue;
      nearest = (middle - plane.point).norm();
      out[i] = {area, middle};
    }
  });
  return out;
}

LumenFigures figures_of(const TrueSections& truth, const std::vector<LumenSection>& found) {
  LumenFigures out;
  out.least_diameter_mm = std::numeric_limits<double>::infinity();
  int counted = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double diameter = 2.0 * std::sqrt(found[i].area_mm2 / std::numbers::pi);
    out.volume_mm3 += found[i].area_mm2 * truth.step_mm;
    out.mean_diameter_mm += diameter / static_cast<double>(found.size());
    out.least_diameter_mm = std::min(out.least_diameter_mm, diameter);
    if (found[i].area_mm2 <= 0.0) {
      ++out.lost;
      continue;
    }
    ++counted;
    out.axis_mm += (found[i].centroid - truth.sections[i].centroid).norm();
  }
  if (counted > 0) out.axis_mm /= counted;
  return out;
}

LumenFigures level_set_figures(const KnownLumen& lumen, const TrueSections& truth,
                               const segmentation::SegmentOptions& how) {
  const auto found = segmentation::segment_vessels(lumen.image, lumen.branches, how);
  std::vector<Vec3> seeds;
  for (const auto& branch : lumen.branches) seeds.insert(seeds.end(), {branch.from, branch.to});
  return figures_of(truth, sections_of(segmentation::surface_of(found.level_set, seeds), truth));
}

LumenFigures boundary_figures(const KnownLumen& lumen, const TrueSections& truth,
                              const segmentation::LumenBoundaryOptions& how) {
  std::vector<LumenSection> found(truth.planes.size());
  for (std::size_t t = 0; t < truth.axes.size(); ++t) {
    const auto [from, to] = truth.reach[t];
    if (to - from < 2.0) continue;
    const auto boundary = segmentation::lumen_boundary(lumen.image, truth.axes[t], from, to, how);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (truth.planes[i].tube != t) continue;
      constexpr int around = 64;
      geometry::Contour contour;
      for (int a = 0; a < around; ++a) {
        const double theta = 2.0 * std::numbers::pi * a / around;
        contour.points.push_back(
            truth.axes[t].place(truth.planes[i].s_mm, theta, boundary.at(truth.planes[i].s_mm, theta)));
      }
      // What a polygon of 64 sides lacks of its circle.
      constexpr double turn = 2.0 * std::numbers::pi / around;
      found[i] = {geometry::contour_area(contour) * turn / std::sin(turn),
                  geometry::contour_centroid(contour)};
    }
  }
  return figures_of(truth, found);
}

}  // namespace ostia::experiments
