#include "ostia/experiments/orientation_phantom.h"

#include "ostia/core/error.h"
#include "ostia/phantom/scan.h"
#include "ostia/phantom/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace ostia::experiments {
namespace {

/// A tube as it lies in the scanner.
struct Placed {
  Vec3 from, along;  ///< `along` is a unit vector
  double length = 0.0, radius = 0.0;
  bool joined_from = false, joined_to = false;

  /// Distance of the axis.
  double distance(const Vec3& point) const {
    const double s = std::clamp((point - from).dot(along), 0.0, length);
    return (point - from - s * along).norm();
  }
  bool holds(const Vec3& point) const {
    const double s = (point - from).dot(along);
    if ((s < 0.0 && !joined_from) || (s > length && !joined_to)) return false;
    return distance(point) <= radius;
  }
};

bool meets_another(const std::vector<PhantomTube>& tubes, std::size_t own, const Vec3& end) {
  constexpr double same_place_mm = 1e-6;
  for (std::size_t i = 0; i < tubes.size(); ++i)
    if (i != own &&
        ((tubes[i].from - end).norm() < same_place_mm || (tubes[i].to - end).norm() < same_place_mm))
      return true;
  return false;
}

std::vector<Placed> placed(const std::vector<PhantomTube>& tubes, const Mat3& turn) {
  std::vector<Placed> out;
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    const PhantomTube& tube = tubes[i];
    const Vec3 from = turn * tube.from, to = turn * tube.to;
    out.push_back({from, (to - from).normalized(), (to - from).norm(), tube.radius_mm,
                   meets_another(tubes, i, tube.from), meets_another(tubes, i, tube.to)});
  }
  return out;
}

class TubeScene : public phantom::Scene {
 public:
  TubeScene(std::vector<Placed> tubes, const TubeScanOptions& options)
      : tubes_(std::move(tubes)),
        lumen_{phantom::Label::coronary_lumen, static_cast<float>(options.lumen_hu)},
        gel_{phantom::Label::fat, static_cast<float>(options.gel_hu)} {}

  std::unique_ptr<const phantom::ScenePart> part(const geometry::Box3& box) const override {
    const double reach = 0.5 * box.diagonal().norm();
    const Vec3 centre = box.center();
    std::vector<Placed> near;
    for (const Placed& tube : tubes_)
      if (tube.distance(centre) <= tube.radius + reach) near.push_back(tube);
    return std::make_unique<Part>(*this, std::move(near));
  }

 private:
  class Part : public phantom::ScenePart {
   public:
    Part(const TubeScene& scene, std::vector<Placed> near) : scene_(scene), near_(std::move(near)) {}
    phantom::Material at(const Vec3& point) const override {
      const bool inside =
          std::any_of(near_.begin(), near_.end(), [&](const Placed& t) { return t.holds(point); });
      return inside ? scene_.lumen_ : scene_.gel_;
    }
    std::optional<phantom::Material> uniform() const override {
      return near_.empty() ? std::optional(scene_.gel_) : std::nullopt;
    }
    bool fine_near(const Vec3& point, double reach_mm) const override {
      return std::any_of(near_.begin(), near_.end(),
                         [&](const Placed& t) { return std::abs(t.distance(point) - t.radius) <= reach_mm; });
    }

   private:
    const TubeScene& scene_;
    std::vector<Placed> near_;
  };

  std::vector<Placed> tubes_;
  phantom::Material lumen_, gel_;
};

imaging::Geometry grid_about(const std::vector<Placed>& tubes, const TubeScanOptions& options) {
  geometry::Box3 box;
  for (const Placed& tube : tubes) {
    box.extend(tube.from);
    box.extend(tube.from + tube.length * tube.along);
  }
  imaging::Geometry grid;
  grid.spacing = options.spacing_mm;
  grid.origin = box.min().array() - options.margin_mm;
  for (int d = 0; d < 3; ++d)
    grid.size[static_cast<std::size_t>(d)] =
        static_cast<std::int64_t>(
            std::ceil((box.sizes()[d] + 2.0 * options.margin_mm) / options.spacing_mm[d])) +
        1;
  return grid;
}

Mat3 about(const Vec3& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis).toRotationMatrix();
}

}  // namespace

std::vector<PhantomTube> vascular_phantom() {
  // Nodes of the ring, then the forks.
  const Vec3 a(24.0, 0.0, 3.0), b(12.0, 21.0, -3.0), c(-12.0, 21.0, 4.0), d(-24.0, 0.0, -2.0),
      e(-12.0, -21.0, 3.0), f(12.0, -21.0, -4.0), g(20.0, 38.0, 14.0), h(26.0, -34.0, 16.0);
  return {{"ring ab", a, b, 1.56},
          {"ring bc", b, c, 0.78},
          {"ring cd", c, d, 1.56},
          {"ring de", d, e, 0.98},
          {"ring ef", e, f, 1.17},
          {"ring fa", f, a, 1.37},
          {"stem a", Vec3(34.0, 8.0, -38.0), a, 2.34},
          {"stem d", Vec3(-33.0, -6.0, -36.0), d, 2.34},
          {"stem e", Vec3(-16.0, -34.0, -34.0), e, 1.95},
          {"trunk bg", b, g, 1.56},
          {"branch c", c, Vec3(-22.0, 44.0, 18.0), 1.37},
          {"trunk fh", f, h, 1.37},
          {"branch g1", g, Vec3(8.0, 52.0, 34.0), 1.17},
          {"branch g2", g, Vec3(38.0, 46.0, 32.0), 0.98},
          {"branch h1", h, Vec3(14.0, -44.0, 42.0), 0.98},
          {"branch h2", h, Vec3(46.0, -36.0, 38.0), 0.78},
          {"lone", Vec3(-46.0, -26.0, -14.0), Vec3(-48.0, 20.0, 30.0), 0.78}};
}

std::vector<Orientation> twelve_orientations() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  return {{"as built", Mat3::Identity()},
          {"X45", about(x, 45.0)},
          {"X90", about(x, 90.0)},
          {"Y45", about(y, 45.0)},
          {"Y90", about(y, 90.0)},
          {"Z45", about(z, 45.0)},
          {"Z90", about(z, 90.0)},
          {"X45 Y45", about(y, 45.0) * about(x, 45.0)},
          {"X45 Z45", about(z, 45.0) * about(x, 45.0)},
          {"Y45 Z45", about(z, 45.0) * about(y, 45.0)},
          {"X90 Y45", about(y, 45.0) * about(x, 90.0)},
          {"X45 Y45 Z45", about(z, 45.0) * about(y, 45.0) * about(x, 45.0)}};
}

void validate(const TubeScanOptions& o) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("orientations: ") + what);
  };
  require((o.spacing_mm.array() >= 0.1).all() && (o.spacing_mm.array() <= 5.0).all(),
          "the voxels' sides must lie in [0.1, 5] mm");
  require(o.lumen_hu > o.gel_hu && o.gel_hu >= -1024.0 && o.lumen_hu <= 3071.0,
          "the tubes must be brighter than the gel, both in [-1024, 3071] HU");
  require(o.margin_mm >= 2.0 && o.margin_mm <= 100.0, "margin_mm must lie in [2, 100]");
}

imaging::ImageVolume scan_of(const std::vector<PhantomTube>& tubes, const Orientation& orientation,
                             const TubeScanOptions& options, const core::TaskContext& task) {
  validate(options);
  if (tubes.empty()) throw InvalidInput("orientations: the phantom has no tube");
  std::vector<Placed> turned = placed(tubes, orientation.turn);
  phantom::ScanOptions how;
  how.grid = grid_about(turned, options);
  how.psf_fwhm_mm = options.psf_fwhm_mm;
  how.psf_fwhm_z_mm = options.psf_fwhm_z_mm;
  how.noise_hu = options.noise_hu;
  how.seed = options.seed;
  return phantom::acquire(TubeScene(std::move(turned), options), how, task).image;
}

}  // namespace ostia::experiments
