#include "ostia/experiments/wall_spread.h"
#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/noise.h"
#include "ostia/phantom/scan.h"
#include "ostia/phantom/vessel_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::experiments {
namespace {

using geometry::Vec3;

constexpr double spread_length_mm = 44.0, arc_radius_mm = 60.0;

/// Lumen of its own brightness and what is about it; a plane beside the axis parts fat from muscle.
class VesselScene : public phantom::Scene {
 public:
  VesselScene(const phantom::CoronaryTree& tree, double lumen_hu, double muscle_from_mm)
      : field_(tree), lumen_hu_(static_cast<float>(lumen_hu)), muscle_from_mm_(muscle_from_mm) {}

  std::unique_ptr<const phantom::ScenePart> part(const geometry::Box3& box) const override {
    return std::make_unique<Part>(*this, box);
  }

 private:
  class Part : public phantom::ScenePart {
   public:
    Part(const VesselScene& scene, const geometry::Box3& box)
        : scene_(scene), near_(scene.field_.near(box, 0.0)), thin_(scene.field_.near(box, 2.0)) {
      low_ = box.min().y(), high_ = box.max().y();
    }
    phantom::Material at(const Vec3& point) const override {
      if (near_)
        if (const auto found = scene_.field_.material(point))
          return found->label == phantom::Label::coronary_lumen
                     ? phantom::Material{phantom::Label::coronary_lumen, scene_.lumen_hu_}
                     : *found;
      return around(point.y());
    }
    std::optional<phantom::Material> uniform() const override {
      if (near_ || (low_ < scene_.muscle_from_mm_ && high_ >= scene_.muscle_from_mm_)) return std::nullopt;
      return around(high_);
    }
    bool fine_near(const Vec3& point, double reach_mm) const override {
      if (!thin_) return false;
      std::vector<phantom::VesselField::Place> places;
      scene_.field_.places(point, reach_mm, places);
      return !places.empty();
    }

   private:
    phantom::Material around(double y) const {
      return y < scene_.muscle_from_mm_ ? phantom::Material{phantom::Label::epicardial_fat, -85.0F}
                                        : phantom::Material{phantom::Label::myocardium, 95.0F};
    }
    const VesselScene& scene_;
    bool near_, thin_;
    double low_ = 0.0, high_ = 0.0;
  };

  phantom::VesselField field_;
  float lumen_hu_;
  double muscle_from_mm_;
};

/// An arc in the plane of x and z, about along z.
geometry::Centerline gentle_arc() {
  geometry::Centerline line;
  const int steps = static_cast<int>(spread_length_mm / 0.1);
  for (int i = 0; i <= steps; ++i) {
    const double angle = (i * 0.1 - 0.5 * spread_length_mm) / arc_radius_mm;
    line.points.emplace_back(arc_radius_mm * (1.0 - std::cos(angle)), 0.0, arc_radius_mm * std::sin(angle));
  }
  return line;
}

phantom::CoronaryVessel healthy_vessel(double radius_mm, double taper, std::uint64_t seed) {
  phantom::CoronaryVessel vessel;
  vessel.name = "LAD";
  vessel.axis = gentle_arc();
  vessel.axis.radius.assign(vessel.axis.points.size(), radius_mm);
  geometry::complete(vessel.axis);
  const double length = vessel.axis.abscissa.back();
  const auto mean = [&](double s) { return radius_mm * (1.0 - taper * std::min(s, length) / length); };
  for (std::size_t i = 0; i < vessel.axis.size(); ++i) vessel.axis.radius[i] = mean(vessel.axis.abscissa[i]);
  vessel.healthy_radius_mm = vessel.axis.radius;
  constexpr int around = 48;
  constexpr double step = 0.25;
  const auto rows = static_cast<int>(std::ceil(length / step)) + 1;
  const double turn = 2.0 * std::numbers::pi * phantom::uniform(seed, 90);
  std::vector<double> lumen, wall;
  for (int row = 0; row < rows; ++row)
    for (int c = 0; c < around; ++c) {
      const double theta = 2.0 * std::numbers::pi * c / around, r = mean(row * step);
      lumen.push_back(r * (1.0 + 0.04 * std::cos(2.0 * theta + turn + 0.1 * row * step)));
      wall.push_back(1.12 * lumen.back() + 0.25);
    }
  vessel.lumen = phantom::RadialProfile(step, around, std::move(lumen));
  vessel.wall = phantom::RadialProfile(step, around, std::move(wall));
  return vessel;
}

imaging::Geometry grid_about_vessel(double plane_mm, double slice_mm, std::uint64_t seed) {
  imaging::Geometry grid;
  const double half = 10.0, height = spread_length_mm + 12.0;
  grid.spacing = Vec3(plane_mm, plane_mm, slice_mm);
  grid.size = {static_cast<std::int64_t>(2.0 * half / plane_mm) + 1,
               static_cast<std::int64_t>(2.0 * half / plane_mm) + 1,
               static_cast<std::int64_t>(height / slice_mm) + 1};
  const Vec3 shift(phantom::uniform(seed, 80), phantom::uniform(seed, 81), phantom::uniform(seed, 82));
  grid.origin = Vec3(-half + 2.0, -half, -0.5 * height) + grid.spacing.cwiseProduct(shift);
  return grid;
}

}  // namespace

NoisyVessel noisy_vessel(std::uint64_t seed) {
  const auto between = [&](std::uint64_t what, double low, double high) {
    return low + (high - low) * phantom::uniform(seed, what);
  };
  NoisyVessel out;
  phantom::CoronaryVessel vessel = healthy_vessel(between(1, 0.9, 2.0), between(2, 0.05, 0.25), seed);
  phantom::LesionOptions lesion;
  lesion.s_throat_mm = between(3, 18.0, 26.0);
  lesion.length_mm = between(4, 6.0, 16.0);
  lesion.diameter_stenosis = between(5, 0.2, 0.6);
  lesion.eccentricity = between(6, 0.1, 0.6);
  lesion.theta = between(7, 0.0, 2.0 * std::numbers::pi);
  const double kind = phantom::uniform(seed, 8);
  lesion.kind = kind < 0.4   ? phantom::PlaqueKind::soft
                : kind < 0.8 ? phantom::PlaqueKind::fibrous
                             : phantom::PlaqueKind::mixed;
  lesion.seed = seed;
  phantom::add_lesion(vessel, lesion);
  out.calcified = lesion.kind == phantom::PlaqueKind::mixed;
  out.throat_mm = lesion.s_throat_mm, out.lesion_mm = lesion.length_mm;
  out.lumen = vessel.lumen;
  out.axis = std::make_shared<const geometry::AxisCurve>(vessel.axis);
  out.lumen_hu = between(9, 300.0, 520.0);
  out.noise_hu = between(10, 12.0, 45.0);
  out.fwhm_mm = between(11, 0.6, 0.8);
  out.voxel_mm = between(12, 0.33, 0.5);
  phantom::ScanOptions scan;
  scan.grid = grid_about_vessel(out.voxel_mm, between(13, 0.4, 0.625), seed);
  scan.psf_fwhm_mm = out.fwhm_mm;
  scan.psf_fwhm_z_mm = std::max(out.fwhm_mm + 0.05, scan.grid.spacing.z());
  scan.noise_hu = out.noise_hu;
  scan.seed = seed;
  phantom::CoronaryTree tree;
  tree.vessels.push_back(std::move(vessel));
  out.image = phantom::acquire(VesselScene(tree, out.lumen_hu, between(14, -1.0, 4.0)), scan).image;
  return out;
}

}  // namespace ostia::experiments
