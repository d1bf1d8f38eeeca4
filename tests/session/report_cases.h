#pragma once
/// \file Models of which a report is known beforehand.

#include "case_tools.h"

#include "ostia/imaging/volume.h"
#include "ostia/lumen/edit.h"
#include "ostia/session/case_report.h"

namespace ostia::session::testing {

/// A straight vessel along z with a narrowing: its radius dips smoothly to `throat_mm` at `at_mm`.
inline lumen::LumenModel narrowed_tube(const std::string& name, double length_mm, double radius_mm,
                                       double at_mm, double throat_mm, double half_mm = 4.0) {
  geometry::Centerline axis = geometry::straight_tube(length_mm, radius_mm, 0.25).tubes.front().axis;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const double t = (axis.points[i].z() - at_mm) / half_mm;
    if (std::abs(t) < 1.0)
      axis.radius[i] -= (radius_mm - throat_mm) * 0.5 * (1.0 + std::cos(std::numbers::pi * t));
  }
  lumen::SamplingOptions dense;
  dense.spacing_mm = 0.7;
  dense.least_spacing_mm = 0.35;
  return lumen::model_of_tubes(lumen::testing::tree_of(std::move(axis), name), std::nullopt, dense);
}

/// A trunk of 15 mm with two branches, LAD and LCX, and a dip in one of the three parts: 0 trunk, 1, 2.
inline lumen::LumenModel narrowed_y(int part, double at_mm, double share) {
  geometry::AnalyticShape shape = geometry::y_junction(15.0, 25.0, 2.0, 1.5, 70.0);
  geometry::Centerline& axis = shape.tubes[static_cast<std::size_t>(part)].axis;
  double s = 0.0;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    if (i > 0) s += (axis.points[i] - axis.points[i - 1]).norm();
    const double t = (s - at_mm) / 3.5;
    if (std::abs(t) < 1.0) axis.radius[i] *= 1.0 - share * 0.5 * (1.0 + std::cos(std::numbers::pi * t));
  }
  geometry::VesselTree tree = lumen::testing::tree_of(shape);
  tree.vessels[0].name = "LAD";
  tree.vessels[1].name = "LCX";
  lumen::SamplingOptions dense;
  dense.spacing_mm = 0.7;
  dense.least_spacing_mm = 0.35;
  return lumen::model_of_tubes(tree, std::nullopt, dense);
}

/// The same trunk and branches without a narrowing.
inline lumen::LumenModel named_y() {
  geometry::VesselTree tree = lumen::testing::tree_of(geometry::y_junction(15.0, 15.0, 2.0, 1.4, 70.0));
  tree.vessels[0].name = "LAD";
  tree.vessels[1].name = "LCX";
  return lumen::model_of_tubes(tree);
}

/// A vessel of 40 mm whose wall is closed by caps at 15 mm and begins again at 25 mm.
inline lumen::LumenModel shut_tube() {
  const auto wall = [](double, double) { return 1.2; };
  lumen::LumenModel model = lumen::model_of_walls(lumen::testing::straight_vessel(40.0, 1.2), {wall});
  lumen::VesselLumen vessel = *model.vessels.front();
  vessel.samples = lumen::samples_of(*vessel.axis, wall, 0.0, 15.0, 1);
  for (const auto& sample : lumen::samples_of(*vessel.axis, wall, 25.0, 40.0, 100000))
    vessel.samples.push_back(sample);
  model.vessels.front() = std::make_shared<const lumen::VesselLumen>(std::move(vessel));
  return model;
}

inline CaseReport report_of(const lumen::LumenModel& model, const Annotations& annotations = {},
                            const std::vector<JournalEntry>& journal = {},
                            const imaging::ImageVolume* image = nullptr, const ReportOptions& options = {}) {
  return make_case_report(model, solved_surfaces(model), annotations, journal, image, options);
}

/// The search's doubt about a model of one vessel along z.
inline std::vector<coronary::VesselCertainty> hardly_an_artery(const lumen::LumenModel& model,
                                                               double probability) {
  coronary::VesselPiece piece;
  piece.from_mm = 5.0, piece.to_mm = 15.0;
  piece.place = {0.0, 0.0, 10.0};
  piece.probability = probability;
  coronary::VesselCertainty one;
  one.vessel = model.tree.vessels.front().id;
  one.pieces = {piece};
  one.probability = probability;
  return {one};
}

/// Of a case whose vessels a person has all checked.
inline CaseReport checked_report(const lumen::LumenModel& model, const imaging::ImageVolume* image = nullptr,
                                 const ReportOptions& options = {}) {
  Annotations annotations;
  for (const geometry::Vessel& vessel : model.tree.vessels)
    annotations.marks.push_back({vessel.id, true, true, std::nullopt, ""});
  return report_of(model, annotations, {}, image, options);
}

/// A CT in which a tube along z is bright.
inline imaging::ImageVolume tube_image() {
  imaging::ImageVolume image;
  image.geometry.size = {40, 40, 84};
  image.geometry.spacing = {0.5, 0.5, 0.5};
  image.geometry.origin = {-10.0, -10.0, -1.0};
  for (int z = 0; z < 84; ++z)
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x)
        image.voxels.push_back(std::hypot(0.5 * x - 10.0, 0.5 * y - 10.0) < 1.5 ? 400 : -80);
  return image;
}

/// A CT of a vessel along z as a scanner with a blur of 0.3 mm shows it: blood to `lumen_mm`, tissue of
/// `tissue_hu` to `outer_mm`, fat beyond.
inline imaging::ImageVolume walled_image(double lumen_mm, double outer_mm, double tissue_hu) {
  imaging::ImageVolume image = tube_image();
  image.geometry.size = {64, 64, 140};
  image.geometry.spacing = {0.3, 0.3, 0.3};
  image.geometry.origin = {-9.45, -9.45, -1.0};
  image.voxels.clear();
  const auto inside = [](double edge, double rho) {  // to first order in the edge's bend
    return 0.5 * std::erfc((rho - edge + 0.045 / edge) / (0.3 * std::numbers::sqrt2));
  };
  for (int z = 0; z < 140; ++z)
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const double rho = std::hypot(0.3 * x - 9.45, 0.3 * y - 9.45), lumen = inside(lumen_mm, rho);
        const double hu = 400.0 * lumen + tissue_hu * (inside(outer_mm, rho) - lumen) -
                          90.0 * (1.0 - inside(outer_mm, rho));
        image.voxels.push_back(static_cast<std::int16_t>(std::lround(hu)));
      }
  return image;
}

}  // namespace ostia::session::testing
