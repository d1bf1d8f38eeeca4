#include "ostia/phantom/body.h"

#include "body_organs.h"

#include "ostia/core/error.h"
#include "ostia/phantom/noise.h"
#include "ostia/phantom/vessel_field.h"

#include <algorithm>
#include <cmath>

namespace ostia::phantom {
namespace {

constexpr std::uint64_t body_stream = 0x424f445900000000;

double half_diagonal(const geometry::Box3& box) {
  return 0.5 * box.diagonal().norm();
}

}  // namespace

struct Body::Impl {
  HeartShape heart;
  BodyOptions options;
  VesselField arteries;
  Organs organs;
  std::vector<geometry::Centerline> axes;  ///< of the arteries

  Impl(const HeartShape& shape, const CoronaryTree& tree, const BodyOptions& how)
      : heart(shape), options(how), arteries(tree) {}

  /// The material of an organ at a place, with its inner variation.
  Material inner(const Organ& organ, std::size_t index, const Vec3& p) const {
    Material m = organ.material;
    if (organ.texture.amplitude_hu > 0.0f) {
      const double coarse = smooth_noise(options.seed + 31 * index, p, organ.texture.grain_mm);
      m.hu += static_cast<float>(options.texture * organ.texture.amplitude_hu * coarse);
    }
    return m;
  }

  /// The arteries' material; contrast fades along them as it reaches distal parts later.
  std::optional<Material> artery(const Vec3& p) const {
    std::optional<Material> m = arteries.material(p);
    if (m && m->label == Label::coronary_lumen) {
      thread_local std::vector<VesselField::Place> places;
      arteries.places(p, 0.0, places);
      const double s = places.empty() ? 0.0 : std::clamp(places.front().s_mm, 0.0, 100.0);
      const float above = options.hu.arterial - options.hu.blood;
      m->hu = options.hu.arterial - above * options.hu.coronary_drop * static_cast<float>(s / 100.0);
    }
    return m;
  }
};

namespace {

class BodyPart : public ScenePart {
 public:
  BodyPart(const Body::Impl& body, const geometry::Box3& box) : body_(body) {
    arteries_ = body.arteries.near(box, 0.0);
    near_arteries_ = body.arteries.near(box, 2.0);
    const Vec3 centre = box.center();
    const double reach = half_diagonal(box);
    for (std::size_t i = 0; i < body.organs.size(); ++i) {
      const Organ& organ = body.organs[i];
      const double d = organ.distance(centre);
      if (d > organ.slope * reach) {
        if (organ.thin && d < organ.slope * reach + 2.0) thin_.push_back(i);
        continue;
      }
      here_.push_back(i);
      if (organ.thin) thin_.push_back(i);
      if (d < -organ.slope * reach) {  // it fills the box: what lies behind is hidden
        filled_ = true;
        break;
      }
    }
  }

  Material at(const Vec3& p) const override {
    if (arteries_) {
      if (const auto m = body_.artery(p)) return *m;
    }
    for (std::size_t n = 0; n < here_.size(); ++n) {
      const Organ& organ = body_.organs[here_[n]];
      if ((filled_ && n + 1 == here_.size()) || organ.distance(p) < 0.0)
        return body_.inner(organ, here_[n], p);
    }
    return {};
  }

  std::optional<Material> uniform() const override {
    if (arteries_ || here_.size() > 1) return std::nullopt;
    if (here_.empty()) return Material{};
    const Organ& organ = body_.organs[here_[0]];
    if (!filled_ || organ.texture.amplitude_hu > 0.0f) return std::nullopt;
    return organ.material;
  }

  bool fine_near(const Vec3& p, double reach_mm) const override {
    if (near_arteries_ && body_.arteries.value(Boundary::wall, p, reach_mm + 0.01) < reach_mm) return true;
    return std::any_of(thin_.begin(), thin_.end(),
                       [&](std::size_t i) { return std::abs(body_.organs[i].distance(p)) < reach_mm; });
  }

 private:
  const Body::Impl& body_;
  std::vector<std::size_t> here_, thin_;
  bool filled_ = false, arteries_ = false, near_arteries_ = false;
};

void require(bool good, const char* what) {
  if (!good) throw InvalidInput(std::string("body: ") + what);
}

}  // namespace

BodyOptions draw_body(std::uint64_t seed) {
  BodyOptions out;
  out.seed = seed;
  std::uint64_t index = body_stream;
  const auto about = [&](float& value, double deviation) {
    value += static_cast<float>(deviation * std::clamp(normal(seed, index++), -2.0, 2.0));
  };
  about(out.hu.arterial, 35.0);
  about(out.hu.right_heart, 35.0);
  about(out.hu.pulmonary, 40.0);
  about(out.hu.vein, 20.0);
  about(out.hu.superior_vena_cava, 110.0);
  about(out.hu.myocardium, 8.0);
  about(out.hu.fat, 4.0);
  about(out.hu.lung, 14.0);
  about(out.hu.marrow, 30.0);
  about(out.hu.liver, 10.0);
  return out;
}

Body::Body(const HeartShape& heart, const CoronaryTree& tree, const BodyOptions& options) {
  require(options.hu.arterial >= 150.0f && options.hu.arterial <= 1000.0f,
          "hu.arterial must lie in [150, 1000]");
  require(options.texture >= 0.0 && options.texture <= 3.0, "texture must lie in [0, 3]");
  auto body = std::make_unique<Impl>(heart, tree, options);
  const std::vector<geometry::Centerline> veins = coronary_veins(heart, tree);
  // Arteries as the fat around them needs them: outer walls, not the stretch within the aorta's wall or the
  // septum.
  std::vector<geometry::Centerline> sheaths = veins;
  for (const CoronaryVessel& vessel : tree.vessels) {
    geometry::Centerline line;
    for (std::size_t i = 0; i < vessel.axis.size(); i += 5) {
      if (vessel.parent >= 0 && heart.epicardial_distance(vessel.axis.points[i]) < -1.0) break;
      line.points.push_back(vessel.axis.points[i]);
      line.radius.push_back(vessel.wall.max_at(vessel.axis.abscissa[i]));
    }
    if (line.points.size() < 2) continue;
    geometry::complete(line);
    sheaths.push_back(std::move(line));
  }
  add_coronary_veins(body->organs, veins, options);
  add_aorta(body->organs, heart, options);
  add_groove_fat(body->organs, heart, sheaths, options);
  add_chambers(body->organs, heart, options);
  add_great_vessels(body->organs, heart, options);
  add_myocardium_and_fat(body->organs, heart, options);
  add_thorax(body->organs, options);
  impl_ = std::move(body);
}
Body::~Body() = default;

std::unique_ptr<const ScenePart> Body::part(const geometry::Box3& box) const {
  return std::make_unique<BodyPart>(*impl_, box);
}

Material Body::at(const Vec3& point_mm) const {
  return BodyPart(*impl_, geometry::Box3(point_mm, point_mm)).at(point_mm);
}

}  // namespace ostia::phantom
