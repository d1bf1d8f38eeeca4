// The picture of docs/methods/plaque.md: cross-sections of the tightest stenosis of a phantom's vessel, with
// the classes of plaque as they are and as they were measured between found walls.
//   plaque_picture DATASET_FOLDER SEED VESSEL OUTPUT.png      (the data set is that of the seed, preset full)

#include "boundary_views.h"
#include "picture.h"

#include "ostia/analysis/plaque.h"
#include "ostia/imaging/sampling.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/segmentation/outer_wall.h"

#include <array>

namespace {

using namespace ostia;
using geometry::Vec3;

constexpr double side_mm = 6.0, pixel_mm = 0.025;

// Low attenuation, fibrofatty, fibrous, calcified; thin wall last.
constexpr std::array<std::array<std::uint8_t, 3>, 5> palette{
    {{200, 50, 40}, {240, 200, 60}, {60, 160, 90}, {235, 240, 255}, {110, 110, 120}}};

/// A flat map in the plane across the axis, coloured where there is wall.
figure::Picture drawn(const analysis::PlaqueMap& map, const imaging::ImageVolume& image,
                      const geometry::AxisCurve& axis, double s_mm) {
  const reformat::Plane plane = reformat::cross_section_plane(axis, s_mm, side_mm, pixel_mm);
  const reformat::PlaneImage slice = reformat::slice(image, plane, imaging::Interpolation::cubic);
  figure::Raster raster = figure::grey_raster(slice, 350.0, 1100.0);
  const geometry::Frame frame = axis.frame(s_mm);
  const Vec3 x = geometry::radial_direction(frame, 0.0),
             y = geometry::radial_direction(frame, 0.5 * bench::pi);
  for (int row = 0; row < plane.height; ++row) {
    for (int column = 0; column < plane.width; ++column) {
      const Vec3 from = reformat::world(plane, geometry::Vec2(column + 0.5, row + 0.5)) - axis.point(s_mm);
      const double rho = std::hypot(from.dot(x), from.dot(y)), theta = std::atan2(from.dot(y), from.dot(x));
      const auto ray = static_cast<std::size_t>(
          std::min(map.around - 1.0,
                   (theta < 0.0 ? theta + 2.0 * bench::pi : theta) / (2.0 * bench::pi) * map.around));
      if (rho < map.lumen_mm[ray] || rho >= map.outer_mm[ray]) continue;
      const auto found = map.at(theta, rho);
      const auto& color = palette[found ? static_cast<std::size_t>(*found) : 4];
      std::uint8_t* pixel = raster.rgba.data() + 4 * (static_cast<std::size_t>(row) * plane.width + column);
      std::copy(color.begin(), color.end(), pixel);
    }
  }
  return figure::picture_of(raster, side_mm * 42.0);
}

std::function<double(double)> along(const segmentation::LumenBoundary& rows, const std::vector<double>& hu) {
  return [&rows, &hu](double s_mm) {
    const double row = std::round((s_mm - rows.from_mm) / rows.step_mm);
    return hu[static_cast<std::size_t>(std::clamp(row, 0.0, static_cast<double>(hu.size() - 1)))];
  };
}

const phantom::CoronaryVessel& vessel_named(const phantom::CoronaryTree& tree, const std::string& name) {
  for (const phantom::CoronaryVessel& vessel : tree.vessels)
    if (vessel.name == name && !vessel.stenoses.empty()) return vessel;
  throw InvalidInput("no vessel " + name + " with a stenosis");
}

/// The scan, the truth and what was measured, row by row.
template <class TrueMap, class FoundMap>
figure::Picture rows_of(const imaging::ImageVolume& image, const geometry::AxisCurve& axis,
                        const std::vector<double>& at, const TrueMap& true_map, const FoundMap& found_map) {
  std::vector<figure::Picture> scan, true_row, found_row;
  for (const double s : at) {
    char title[40];
    std::snprintf(title, sizeof title, "at %.1f mm", s);
    figure::SliceFigureOptions how = bench::look(title, side_mm, 42.0);
    how.rulers = how.scale_bar = false;
    scan.push_back(
        figure::slice_figure(reformat::slice(image, reformat::cross_section_plane(axis, s, side_mm, 0.05),
                                             imaging::Interpolation::cubic),
                             {}, {}, how));
    true_row.push_back(drawn(true_map(s), image, axis, s));
    found_row.push_back(drawn(found_map(s), image, axis, s));
  }
  figure::GridOptions row;
  row.columns = 4;
  row.title = "scan";
  const figure::Picture first = figure::grid(scan, row);
  row.title = "truth";
  const figure::Picture second = figure::grid(true_row, row);
  row.title = "measured";
  const figure::Picture third = figure::grid(found_row, row);
  figure::GridOptions rows;
  rows.columns = 1;
  return figure::grid({first, second, third}, rows);
}

void make(const std::filesystem::path& dataset, const std::string& seed, const std::string& name,
          const std::filesystem::path& out) {
  phantom::CaseOptions options;
  options.seed = std::stoull(seed);
  const phantom::CasePlan plan = phantom::plan_case(options);
  const phantom::CoronaryVessel& vessel = vessel_named(plan.tree, name);
  const phantom::Stenosis& lesion = *std::max_element(
      vessel.stenoses.begin(), vessel.stenoses.end(),
      [](const auto& a, const auto& b) { return a.diameter_stenosis < b.diameter_stenosis; });
  const imaging::ImageVolume image = bench::image_of(dataset);
  const geometry::AxisCurve axis(vessel.axis);
  const segmentation::LumenBoundary lumen = segmentation::lumen_boundary(
      image, axis, std::max(0.0, lesion.s_from_mm - 15.0), std::min(axis.length(), lesion.s_to_mm + 15.0));
  const segmentation::OuterWall outer = segmentation::outer_wall(image, axis, lumen);
  const phantom::VesselField field(plan.tree);
  analysis::PlaqueOptions exact, scanned;
  exact.blur_sigma_mm = 0.0;
  exact.around = scanned.around = 360;
  exact.deep = scanned.deep = 40;
  analysis::WallRadii truth{lesion.s_from_mm,
                            lesion.s_to_mm,
                            [&](double s, double theta) { return vessel.lumen.at(s, theta); },
                            [&](double s, double theta) { return vessel.wall.at(s, theta); },
                            {},
                            {}};
  analysis::WallRadii found = truth;
  found.lumen_mm = [&](double s, double theta) { return lumen.at(s, theta); };
  found.outer_mm = [&](double s, double theta) { return outer.surface.at(s, theta); };
  found.lumen_hu = along(lumen, outer.lumen_hu);
  found.fat_hu = along(lumen, outer.fat_hu);
  const auto material = [&](const Vec3& place) {
    const auto there = field.material(place);
    return there ? static_cast<double>(there->hu) : 45.0;
  };
  const auto hu = [&](const Vec3& place) { return imaging::sample(image, place); };
  const auto true_map = [&](double s) { return analysis::plaque_map(axis, truth, s, material, exact); };
  const auto found_map = [&](double s) { return analysis::plaque_map(axis, found, s, hu, scanned); };
  std::vector<double> at;
  for (const double share : {0.25, 0.42, 0.5, 0.65})
    at.push_back(lesion.s_from_mm + share * (lesion.s_to_mm - lesion.s_from_mm));
  rows_of(image, axis, at, true_map, found_map).write_png(out);
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::bench::make_picture(
      argc, argv, "DATASET_FOLDER SEED VESSEL OUTPUT.png", 4,
      [](const std::vector<std::string>& given) { make(given[0], given[1], given[2], given[3]); });
}
