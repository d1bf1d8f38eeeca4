#include "ostia/phantom/body.h"

#include "body/body_organs.h"
#include "body/place_lattice.h"

#include "ostia/core/error.h"
#include "ostia/phantom/noise.h"
#include "ostia/phantom/vessel_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ostia::phantom {
namespace {

using geometry::Box3;

constexpr double largest_texture = 3.0;
constexpr double largest_in_cells_mm = 100.0;

/// A tube organ's pieces lie in boxes, so that a block finds those that touch it.
struct Prepared {
  Organ organ;
  std::vector<Box3> boxes;
  Box3 box;
};

Prepared prepared(Organ organ) {
  Prepared out;
  for (const Capsule& capsule : organ.capsules) {
    out.boxes.push_back(capsule.box());
    out.box.extend(out.boxes.back());
  }
  out.organ = std::move(organ);
  return out;
}

}  // namespace

struct Body::Impl {
  BodyOptions options;
  CoronaryTree tree;
  VesselField field;
  std::shared_ptr<const NoiseField> noise;
  std::vector<Prepared> organs;
  std::map<std::int32_t, double> before_mm;  // from the ostium to where a vessel begins
  std::map<std::int32_t, double> filling;    // share of the contrast with which it begins
  std::shared_ptr<const HeartWarp> warp;     // or none

  Impl(const HeartShape& heart, const CoronaryTree& coronaries, const BodyOptions& body,
       std::shared_ptr<const HeartWarp> bent)
      : options(body),
        tree(coronaries),
        field(coronaries),
        noise(std::make_shared<const NoiseField>(body.seed)),
        warp(std::move(bent)) {
    for (const CoronaryVessel& vessel : tree.vessels) {
      const auto parent = before_mm.find(vessel.parent);
      before_mm[vessel.id] = parent == before_mm.end() ? 0.0 : parent->second + vessel.parent_s_mm;
      filling[vessel.id] = vessel.parent < 0 ? 1.0 : filling_at(vessel.parent, vessel.parent_s_mm);
    }
    const TissueHu& hu = options.hu;
    const Capsules veins = coronary_veins(heart, tree, field, warp.get(), options.vein_closeness);
    Organs all;
    add_aorta(all, heart, hu);
    all.push_back({{Label::coronary_vein, hu.vein}, {10.0f, 6.0f, 0.0f}, {}, veins, true});
    add_lobes(all, heart, tree, field, warp.get(), options);
    add_groove_fat(all, tree, veins, hu, options.groove_fat);
    add_chambers(all, heart, options, noise);
    add_great_vessels(all, hu);
    add_heart_walls(all, heart, hu, noise);
    add_bones(all, hu);
    add_mediastinum(all, hu, noise);
    add_lungs(all, hu, options.seed);
    add_chest_wall(all, hu, options.seed);
    for (Organ& organ : all) organs.push_back(prepared(std::move(organ)));
  }

  float textured(const Organ& organ, const Vec3& p) const {
    const Texture& t = organ.texture;
    float hu = organ.mixed_hu ? organ.mixed_hu(p) : organ.material.hu;
    if (t.amplitude_hu > 0.0f) {
      const double strength = options.texture * static_cast<double>(t.amplitude_hu);
      const double grain = static_cast<double>(t.grain_mm);
      hu += static_cast<float>(strength * noise->at(p / grain + Vec3::Constant(7.0 * grain)));
    }
    // A tissue never turns into another one by its texture.
    return hu + t.dorsal_hu_per_mm * static_cast<float>(std::clamp(p.y(), -100.0, 100.0));
  }

  /// What closed stretches before an abscissa have left of the contrast.
  double filling_at(std::int32_t id, double s_mm) const {
    double left = filling.at(id);
    for (const CoronaryVessel& vessel : tree.vessels)
      if (vessel.id == id)
        for (const Occlusion& closed : vessel.occlusions)
          if (s_mm > 0.5 * (closed.s_from_mm + closed.s_to_mm)) left *= closed.filling;
    return left;
  }

  /// Contrast is lost along the arteries.
  Material lumen(const Vec3& p) const {
    std::vector<VesselField::Place> places;
    field.places(p, 0.01, places);
    double way = 0.0, deepest = 1e9, filled = 1.0;
    for (const VesselField::Place& place : places) {
      if (place.rho_mm - place.lumen_mm >= deepest) continue;
      deepest = place.rho_mm - place.lumen_mm;
      way = place.s_mm + before_mm.at(place.vessel);
      filled = filling_at(place.vessel, place.s_mm);
    }
    const TissueHu& hu = options.hu;
    const float kept = 1.0f - hu.coronary_drop * static_cast<float>(std::min(1.5, way / 100.0));
    return {Label::coronary_lumen, hu.blood + (hu.arterial - hu.blood) * kept * static_cast<float>(filled)};
  }
};

namespace {

/// How far a place is from a tube's surface at the foot of its axis, negative within; changes by no more than
/// `steepest` a mm.
double outside_mm(const Capsule& tube, const Vec3& p) {
  const Vec3 along = tube.to - tube.from, d = p - tube.from;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp(d.dot(along) / length2, 0.0, 1.0) : 0.0;
  return (d - t * along).norm() - (tube.from_radius + t * (tube.to_radius - tube.from_radius));
}

double steepest(const Capsule& tube) {
  const double length = (tube.to - tube.from).norm();
  return length > 0.0 ? 1.0 + std::abs(tube.to_radius - tube.from_radius) / length : 1.0;
}

/// One organ of those that a place may belong to, with its tubes' pieces in a list.
struct Chosen {
  const Organ* organ;
  std::size_t first, last;  // of the capsules
  bool whole;               // it holds all of the region
};

/// The organs that a region may meet, in order; nothing after one that holds all of it.
struct Choice {
  std::vector<Chosen> organs;
  Capsules capsules;
};

/// A block in cells: most places of a block are near one organ or two of the many that touch it. A cell is
/// looked at when it is first asked for.
class Cells {
 public:
  Cells(const Box3& box, const Choice& of_block)
      : of_block_(of_block), low_(box.min()), side_mm_(std::clamp(box.sizes().maxCoeff() / 5.0, 1.0, 4.0)) {
    for (std::size_t a = 0; a < 3; ++a)
      count_[a] = static_cast<std::int64_t>(std::ceil(box.sizes()[static_cast<Eigen::Index>(a)] / side_mm_));
    cells_.resize(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]));
  }

  const Choice& at(const Vec3& p) {
    std::array<std::int64_t, 3> cell{};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      const double place = (p[axis] - low_[axis]) * a_side_;
      if (!(place >= 0.0 && place < static_cast<double>(count_[a]))) return of_block_;
      cell[a] = static_cast<std::int64_t>(place);
    }
    std::unique_ptr<const Choice>& found =
        cells_[static_cast<std::size_t>(cell[0] + count_[0] * (cell[1] + count_[1] * cell[2]))];
    if (!found) found = chosen(cell);
    return *found;
  }

 private:
  std::unique_ptr<const Choice> chosen(const std::array<std::int64_t, 3>& cell) const {
    const Vec3 low = low_ + side_mm_ * Vec3(static_cast<double>(cell[0]), static_cast<double>(cell[1]),
                                            static_cast<double>(cell[2]));
    const Vec3 rounding = Vec3::Constant(1e-9);
    const Box3 box(low - rounding, low + Vec3::Constant(side_mm_) + rounding);
    const double half = 0.5 * box.diagonal().norm();
    auto out = std::make_unique<Choice>();
    for (const Chosen& one : of_block_.organs) {
      Chosen here = one;
      here.first = out->capsules.size();
      if (!one.whole && one.organ->distance) {
        const double distance = one.organ->distance(box.center());
        if (distance > half) continue;
        here.whole = distance < -half;
      }
      for (std::size_t i = one.first; i < one.last && !here.whole; ++i) {
        const Capsule& capsule = of_block_.capsules[i];
        const double outside = outside_mm(capsule, box.center()), most = steepest(capsule) * half;
        if (outside < most) out->capsules.push_back(capsule);
        here.whole = outside < -most;
      }
      here.last = out->capsules.size();
      if (!here.whole && !one.organ->distance && here.first == here.last) continue;
      out->organs.push_back(here);
      if (here.whole) break;
    }
    return out;
  }

  const Choice& of_block_;
  Vec3 low_;
  double side_mm_, a_side_ = 1.0 / side_mm_;
  std::array<std::int64_t, 3> count_{};
  std::vector<std::unique_ptr<const Choice>> cells_;
};

/// The organs that touch a block.
class BodyPart : public ScenePart {
 public:
  BodyPart(const Body::Impl& body, const Box3& box) : body_(body) {
    double half = 0.5 * box.diagonal().norm() + 1e-9;
    Vec3 middle = box.center();
    Box3 own = box;
    if (body.warp) {
      lattice_.emplace(box, [&](const Vec3& p) { return body.warp->to_own(p); });
      own = lattice_->from();
      middle = own.center();
      half = lattice_->reach(middle) + 1e-9;
    }
    coronary_ = body.field.near(box, 0.0);
    thin_ = body.field.near(box, 2.0);
    for (const Prepared& organ : body.organs) {
      if (organ.organ.distance) {
        const double distance = organ.organ.distance(middle);
        if (distance > half) continue;
        chosen_.organs.push_back({&organ.organ, 0, 0, distance < -half});
        if (distance < -half) break;  // holds the whole block: nothing behind it is met
        continue;
      }
      const Box3& there = organ.organ.stays ? box : own;
      if (!organ.box.intersects(there)) continue;
      Capsules& capsules = chosen_.capsules;
      const std::size_t first = capsules.size();
      for (std::size_t i = 0; i < organ.boxes.size(); ++i)
        if (organ.boxes[i].intersects(there)) capsules.push_back(organ.organ.capsules[i]);
      if (capsules.size() > first) chosen_.organs.push_back({&organ.organ, first, capsules.size(), false});
    }
    const Vec3 sizes = box.sizes();  // a few places of a plane are not worth it
    if (!lattice_ && chosen_.organs.size() > 1 && sizes.minCoeff() > 1.0 &&
        sizes.maxCoeff() < largest_in_cells_mm)
      cells_.emplace(box, chosen_);
  }

  Material at(const Vec3& p) const override {
    if (coronary_) {
      if (const std::optional<Material> m = body_.field.material(p)) {
        if (m->label == Label::coronary_lumen) return body_.lumen(p);
        if (m->label != Label::vessel_wall) return *m;
        // The wall ends where the artery opens into the aorta.
        const Material other = tissue(p);
        return other.label == Label::aorta ? other : *m;
      }
    }
    return tissue(p);
  }

  std::optional<Material> uniform() const override {
    if (coronary_) return std::nullopt;
    if (chosen_.organs.empty()) return Material{};
    const Chosen& first = chosen_.organs.front();
    const Texture& t = first.organ->texture;
    if (!first.whole || t.amplitude_hu > 0.0f || t.dorsal_hu_per_mm != 0.0f) return std::nullopt;
    return first.organ->material;
  }

  bool fine_near(const Vec3& p, double reach_mm) const override {
    if (!thin_ && reach_mm < 2.0) return false;
    if (!body_.field.near(Box3(p, p), reach_mm)) return false;
    return body_.field.value(Boundary::wall, p, reach_mm) < reach_mm;
  }

 private:
  Material tissue(const Vec3& world) const {
    const Vec3 own = lattice_ ? lattice_->at(world) : world;
    const Choice& choice = cells_ ? cells_->at(world) : chosen_;
    for (const Chosen& c : choice.organs) {
      const Vec3& p = c.organ->stays ? world : own;
      bool inside = c.whole;
      if (!inside && c.organ->distance) inside = c.organ->distance(p) < 0.0;
      for (std::size_t i = c.first; i < c.last && !inside; ++i) inside = choice.capsules[i].holds(p);
      if (inside) return {c.organ->material.label, body_.textured(*c.organ, p)};
    }
    return {};
  }

  const Body::Impl& body_;
  std::optional<PlaceLattice> lattice_;
  bool coronary_ = false, thin_ = false;
  Choice chosen_;
  mutable std::optional<Cells> cells_;  // a part is asked from one thread
};

void require_body(bool good, const char* what) {
  if (!good) throw InvalidInput(std::string("body: ") + what);
}

}  // namespace

BodyOptions draw_body(std::uint64_t seed) {
  std::uint64_t index = 0x424f4459000000;
  const auto about = [&](float mean, float deviation) {
    return mean + deviation * static_cast<float>(std::clamp(normal(seed, index++), -2.0, 2.0));
  };
  BodyOptions options;
  options.seed = seed;
  TissueHu& hu = options.hu;
  hu.arterial = about(400.0f, 40.0f);
  hu.coronary_drop = about(0.12f, 0.03f);
  hu.right_heart = about(190.0f, 25.0f);
  hu.pulmonary = about(230.0f, 30.0f);
  hu.vein = about(205.0f, 20.0f);
  hu.superior_vena_cava = about(400.0f, 70.0f);
  hu.myocardium = about(105.0f, 8.0f);
  hu.fat = about(-98.0f, 4.0f);
  hu.epicardial_fat = about(-88.0f, 4.0f);
  hu.lung = about(-862.0f, 12.0f);
  hu.marrow = about(190.0f, 30.0f);
  hu.liver = about(85.0f, 8.0f);
  return options;
}

Body::Body(const HeartShape& heart, const CoronaryTree& tree, const BodyOptions& options,
           std::shared_ptr<const HeartWarp> warp) {
  require_body(options.texture >= 0.0 && options.texture <= largest_texture, "texture must lie in [0, 3]");
  require_body(options.mixing >= 0.0 && options.mixing <= 1.0, "mixing must lie in [0, 1]");
  require_body(options.vein_closeness >= 0.0 && options.vein_closeness <= 1.0,
               "vein_closeness must lie in [0, 1]");
  require_body(options.lobes >= 0.0 && options.lobes <= 1.0, "lobes must lie in [0, 1]");
  require_body(options.groove_fat >= 0.1 && options.groove_fat <= 1.0, "groove_fat must lie in [0.1, 1]");
  const TissueHu& hu = options.hu;
  for (const float value :
       {hu.arterial, hu.right_heart, hu.pulmonary, hu.vein, hu.superior_vena_cava, hu.blood, hu.myocardium,
        hu.muscle, hu.fat, hu.epicardial_fat, hu.lung, hu.marrow, hu.bone, hu.liver})
    require_body(value >= -1024.0f && value <= 3071.0f, "CT numbers must lie in [-1024, 3071] HU");
  require_body(hu.coronary_drop >= 0.0f && hu.coronary_drop <= 0.6f, "coronary_drop must lie in [0, 0.6]");
  impl_ = std::make_unique<const Impl>(heart, tree, options, std::move(warp));
}

Body::~Body() = default;

std::unique_ptr<const ScenePart> Body::part(const geometry::Box3& box) const {
  return std::make_unique<const BodyPart>(*impl_, box);
}

Material Body::at(const Vec3& point_mm) const {
  return part(Box3(point_mm, point_mm))->at(point_mm);
}

}  // namespace ostia::phantom
