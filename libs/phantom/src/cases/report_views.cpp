#include "cases/report_views.h"

#include "coronaries/axis_place.h"

#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/figure/slice_figure.h"
#include "ostia/imaging/sampling.h"
#include "ostia/reformat/plane.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::phantom {
namespace {

using figure::Picture;
using figure::SliceContour;
using figure::SliceFigureOptions;
using reformat::Plane;
using reformat::PlaneImage;

constexpr double coronary_level_hu = 200.0, coronary_window_hu = 800.0;

Vec3 image_centre(const imaging::Geometry& grid) {
  return grid.world(0.5 * Vec3(static_cast<double>(grid.size[0] - 1), static_cast<double>(grid.size[1] - 1),
                               static_cast<double>(grid.size[2] - 1)));
}

SliceFigureOptions look(std::string title, int width) {
  SliceFigureOptions options;
  options.title = std::move(title);
  options.level_hu = coronary_level_hu;
  options.window_hu = coronary_window_hu;
  options.image_width_px = width;
  options.rulers = false;
  return options;
}

double pixel_of(const imaging::Geometry& grid) {
  return std::max(0.4, grid.spacing.minCoeff());
}

struct PlacedStenosis {
  const CoronaryVessel* vessel = nullptr;
  const Stenosis* stenosis = nullptr;
};

/// Those whose throat lies inside the image, the worst first.
std::vector<PlacedStenosis> stenoses_in(const CasePlan& plan, const imaging::Geometry& grid) {
  std::vector<PlacedStenosis> out;
  for (const CoronaryVessel& vessel : plan.tree.vessels) {
    for (const Stenosis& stenosis : vessel.stenoses) {
      if (grid.contains(place_at(vessel.axis, stenosis.s_throat_mm).point))
        out.push_back({&vessel, &stenosis});
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const PlacedStenosis& a, const PlacedStenosis& b) {
    return a.stenosis->diameter_stenosis > b.stenosis->diameter_stenosis;
  });
  return out;
}

std::vector<Vec3> closed(std::vector<Vec3> line) {
  line.push_back(line.front());
  return line;
}

/// Radii along a path from an ostium: which vessel, and where on it.
struct OnVessel {
  const CoronaryVessel* vessel = nullptr;
  double s_mm = 0.0;
};
OnVessel on_vessel(const CoronaryTree& tree, const ChallengeVessel& vessel, double s) {
  double before = 0.0;
  for (std::size_t k = 0; k < vessel.path.size(); ++k) {
    const CoronaryVessel& one = vessel_of(tree, vessel.path[k]);
    const bool last = k + 1 == vessel.path.size();
    const double used = last ? one.axis.abscissa.back() : vessel_of(tree, vessel.path[k + 1]).parent_s_mm;
    if (last || s <= before + used) return {&one, std::clamp(s - before, 0.0, one.axis.abscissa.back())};
    before += used;
  }
  return {};
}

/// A straightened picture lies in a space of its own, `along` the vessel and `across` it. Its axes are
/// oblique so that no one takes them for the patient's.
const Vec3 along_axis = Vec3(0.6, 0.48, 0.64), across_axis = Vec3(-0.8, 0.36, 0.48);
Vec3 straight_place(double along, double across) {
  return along * along_axis + across * across_axis;
}

PlaneImage straightened(const imaging::ImageVolume& image, const geometry::Centerline& axis, double half_mm,
                        double pixel_mm) {
  PlaneImage out;
  out.plane.origin = straight_place(0.0, -half_mm);
  out.plane.u = along_axis;
  out.plane.v = across_axis;
  out.plane.pixel_mm = pixel_mm;
  out.plane.width = std::max(1, static_cast<int>(axis.abscissa.back() / pixel_mm));
  out.plane.height = static_cast<int>(2.0 * half_mm / pixel_mm);
  out.values.resize(static_cast<std::size_t>(out.plane.width) * static_cast<std::size_t>(out.plane.height));
  core::parallel_for(static_cast<std::size_t>(out.plane.width), 16, [&](std::size_t column) {
    const AxisPlace place = place_at(axis, (static_cast<double>(column) + 0.5) * pixel_mm);
    for (int row = 0; row < out.plane.height; ++row) {
      const double across = -half_mm + (row + 0.5) * pixel_mm;
      const Vec3 point = place.point + across * place.frame.normal;
      out.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(out.plane.width) + column] =
          image.geometry.contains(point) ? static_cast<float>(imaging::sample(image, point))
                                         : std::numeric_limits<float>::quiet_NaN();
    }
  });
  return out;
}

/// The true boundary on both sides of a straightened view: first along, then against the frame's normal. The
/// path's frames turn away from the vessel's own at a junction, so the angle is looked up.
SliceContour boundary_lines(const CasePlan& plan, const ChallengeVessel& vessel,
                            const geometry::Centerline& axis, double offset_mm, Boundary boundary) {
  SliceContour out;
  out.color = boundary == Boundary::lumen ? figure::colors::contour : figure::colors::cut;
  out.label = boundary == Boundary::lumen ? "lumen" : "outer wall";
  out.width_px = 1.0;
  out.lines.resize(2);
  for (double s = 0.0; s < axis.abscissa.back(); s += 0.5) {
    const OnVessel on = on_vessel(plan.tree, vessel, s + offset_mm);
    if (on.vessel == nullptr || on.s_mm < on.vessel->s_free_mm) continue;
    const Vec3 normal = place_at(axis, s).frame.normal;
    const double theta = geometry::angle_of(place_at(on.vessel->axis, on.s_mm).frame, normal);
    const RadialProfile& radii = boundary == Boundary::lumen ? on.vessel->lumen : on.vessel->wall;
    out.lines[0].push_back(straight_place(s, radii.at(on.s_mm, theta)));
    out.lines[1].push_back(straight_place(s, -radii.at(on.s_mm, theta + std::numbers::pi)));
  }
  std::erase_if(out.lines, [](const std::vector<Vec3>& line) { return line.size() < 2; });
  return out;
}

/// The axis of a vessel of the data set, and how far its first point is from the ostium.
std::pair<geometry::Centerline, double> axis_of(const CasePlan& plan, const ChallengeVessel& vessel) {
  const geometry::Centerline whole = path_from_ostium(plan.tree, vessel.path.back());
  const Vec3 start = vessel.point_s, end = vessel.point_e;
  geometry::Centerline out;
  double offset = 0.0;
  bool inside = false;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (!inside && (whole.points[i] - start).norm() < 1e-6) {
      inside = true;
      offset = whole.abscissa[i];
    }
    if (!inside) continue;
    out.points.push_back(whole.points[i]);
    out.radius.push_back(whole.radius[i]);
    if ((whole.points[i] - end).norm() < 1e-6) break;
  }
  geometry::complete(out);
  return {std::move(out), offset};
}

}  // namespace

PlaneImage maximum_projection(const imaging::ImageVolume& image, const Plane& plane, double thickness_mm,
                              const core::TaskContext& task) {
  PlaneImage out;
  out.plane = plane;
  const double step = image.geometry.spacing.minCoeff();
  const int layers = std::max(1, static_cast<int>(thickness_mm / step));
  for (int layer = 0; layer < layers; ++layer) {
    task.throw_if_cancelled();
    Plane moved = plane;
    moved.origin += (layer + 0.5 - 0.5 * layers) * step * plane.normal();
    const PlaneImage one = reformat::slice(image, moved, imaging::Interpolation::nearest, task);
    if (out.values.empty()) {
      out.values = one.values;
      continue;
    }
    for (std::size_t i = 0; i < one.values.size(); ++i) {
      if (std::isnan(out.values[i]) || one.values[i] > out.values[i]) {
        if (!std::isnan(one.values[i])) out.values[i] = one.values[i];
      }
    }
  }
  return out;
}

Picture axial_gallery(const imaging::ImageVolume& image) {
  const imaging::Geometry& grid = image.geometry;
  std::vector<Picture> panels;
  constexpr int count = 8;
  for (int i = 0; i < count; ++i) {
    const double share = 0.92 - 0.84 * i / (count - 1);  // from above
    Vec3 centre = image_centre(grid);
    centre.z() = grid.world(Vec3(0, 0, share * static_cast<double>(grid.size[2] - 1))).z();
    const Plane plane = reformat::axial_plane(grid, centre, pixel_of(grid));
    panels.push_back(figure::slice_figure(reformat::slice(image, plane), {}, {},
                                          look("z " + core::fixed_text(centre.z(), 0) + " mm", 300)));
  }
  return figure::grid(panels, {.columns = 4});
}

Picture projections(const CasePlan& plan, const imaging::ImageVolume& image, const core::TaskContext& task) {
  const imaging::Geometry& grid = image.geometry;
  const double pixel = pixel_of(grid);
  const Vec3 root = plan.heart.root.annulus + plan.heart.root.axis * 0.7 * plan.heart.root.sinus_height_mm;
  const Vec3 middle = plan.heart.base + 0.4 * plan.heart.length_mm * plan.heart.long_axis;
  std::vector<Picture> panels;
  const auto add = [&](const Plane& plane, double thickness, const SliceFigureOptions& options) {
    panels.push_back(
        figure::slice_figure(maximum_projection(image, plane, thickness, task), {}, {}, options));
  };
  add(reformat::axial_plane(grid, root, pixel), 8.0, look("axial slab at the ostia, 8 mm", 380));
  add(reformat::coronal_plane(grid, root, pixel), 12.0, look("coronal slab at the root, 12 mm", 380));
  add(reformat::sagittal_plane(grid, root, pixel), 12.0, look("sagittal slab at the root, 12 mm", 380));
  SliceFigureOptions wide = look("coronal slab through the heart, 60 mm", 380);
  wide.level_hu = 300.0;
  wide.window_hu = 1000.0;
  add(reformat::coronal_plane(grid, middle, pixel), 60.0, wide);
  return figure::grid(panels, {.columns = 2});
}

Picture straightened_views(const CasePlan& plan, const imaging::ImageVolume& image) {
  std::vector<Picture> panels;
  const double pixel = 0.25;
  for (const ChallengeVessel& vessel : plan.challenge.vessels) {
    const auto [axis, offset] = axis_of(plan, vessel);
    if (axis.size() < 2) continue;
    const PlaneImage view = straightened(image, axis, 12.0, pixel);
    SliceFigureOptions options =
        look(vessel.name + ", straightened from its start", 4 * view.plane.width / 2);
    options.image_width_px = std::clamp(options.image_width_px, 200, 1100);
    options.patient_letters = false;
    options.scale_bar = true;
    panels.push_back(figure::slice_figure(view, {}, {}, options));
    options.title = vessel.name + " with the true boundaries";
    panels.push_back(figure::slice_figure(view,
                                          {boundary_lines(plan, vessel, axis, offset, Boundary::wall),
                                           boundary_lines(plan, vessel, axis, offset, Boundary::lumen)},
                                          {}, options));
  }
  return figure::grid(panels, {.columns = 1});
}

bool has_stenosis_in(const CasePlan& plan, const imaging::Geometry& grid) {
  return !stenoses_in(plan, grid).empty();
}

Picture stenosis_sections(const CasePlan& plan, const imaging::ImageVolume& image) {
  std::vector<PlacedStenosis> all = stenoses_in(plan, image.geometry);
  if (all.size() > 8) all.resize(8);
  std::vector<Picture> panels;
  for (const PlacedStenosis& one : all) {
    const double s = one.stenosis->s_throat_mm;
    const Plane plane = reformat::cross_section_plane(one.vessel->axis, s, 16.0, 0.1);
    const auto contour = [&](Boundary boundary) {
      SliceContour out;
      out.lines = {closed(true_contour(*one.vessel, boundary, s, 64).points)};
      out.color = boundary == Boundary::lumen ? figure::colors::contour : figure::colors::cut;
      out.label = boundary == Boundary::lumen ? "lumen" : "outer wall";
      return out;
    };
    const std::string title = one.vessel->name + " at " + core::fixed_text(s, 1) + " mm, " +
                              core::fixed_text(100.0 * one.stenosis->diameter_stenosis, 0) + " %";
    SliceFigureOptions options = look(title, 280);
    options.window_hu = 1000.0;
    const PlaneImage view = reformat::slice(image, plane, imaging::Interpolation::cubic);
    panels.push_back(
        figure::slice_figure(view, {contour(Boundary::wall), contour(Boundary::lumen)}, {}, options));
  }
  return figure::grid(panels, {.columns = 4});
}

}  // namespace ostia::phantom
