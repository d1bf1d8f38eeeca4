#include "body/body_organs.h"
#include "body/smooth_step.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace ostia::phantom {
namespace {

using MixedHu = std::function<float(const Vec3&)>;

/// Shapes that several tissues share.
struct Ventricles {
  Distance base, left_outer, left_cavity, right_outer, right_cavity, epicardium;
};

Ventricles ventricles_of(const HeartFrame& f, const Noise& noise) {
  const double w = f.wide, h = f.high, l = f.long_;
  Ventricles v;
  const double shear = 14.5 / 92.0;  // the left ventricle's axis meets the heart's at the apex
  const Vec3 left(-14.5 * w, 0.0, 0.0);
  // The base is round: it falls off towards the free walls.
  v.base = f.ellipsoid_at({0, 0, 48.0 * l}, {62.0 * w, 58.0 * h, 51.0 * l});
  const Distance floor = f.ellipsoid_at({0, 0, 48.0 * l}, {62.0 * w, 58.0 * h, 47.5 * l});
  v.epicardium = f.ellipsoid_at(Vec3::Zero(), {46.0 * w, 40.0 * h, 92.0 * l});
  v.left_outer = f.ellipsoid_at(left, {31.5 * w, 37.0 * h, 90.0 * l}, shear);
  const Vec3 inner(31.5 * w - 9.3, 37.0 * h - 9.8, 90.0 * l - 6.5);
  v.left_cavity = uneven(both(f.ellipsoid_at(left, inner, shear), floor), 0.4, 10.0, noise);
  const Distance right_of_septum = half_space(f.world(-21.0 * w, 0, 0), -f.heart.right);
  v.right_outer = both(f.ellipsoid_at(Vec3::Zero(), {45.0 * w, 38.5 * h, 87.0 * l}), right_of_septum);
  const Distance right_inner = f.ellipsoid_at(Vec3::Zero(), {41.8 * w, 35.3 * h, 81.0 * l});
  v.right_cavity =
      uneven(without(both(both(right_inner, right_of_septum), floor), v.left_outer), 0.6, 8.0, noise);
  return v;
}

struct Atria {
  Distance left, right, left_shape, right_shape;
  Capsules appendage, veins, caval_lower, caval_upper;
};

Atria atria_of(const HeartFrame& f, const Noise& noise) {
  Atria a;
  a.left_shape = f.ellipsoid_at({-17.0 * f.wide, -9.0, -21.5}, {28.0, 23.0, 20.0});
  a.right_shape = f.ellipsoid_at({34.0 * f.wide, -7.0, -22.5}, {22.5, 30.0, 21.0});
  a.left = uneven(a.left_shape, 0.9, 14.0, noise);
  a.right = uneven(a.right_shape, 1.0, 12.0, noise);
  a.appendage = tube({{14, 24, 22}, {28, 22, 38}, {38, 13, 50}, {37, 2, 57}}, {9.0, 8.0, 7.0, 3.5});
  append(a.appendage, tube({{38, 13, 50}, {46, 6, 50}, {49, -2, 47}}, {5.0, 3.5, 2.0}));
  for (const auto& way : {std::vector<Vec3>{{-12, 27, 16}, {-34, 28, 24}, {-56, 24, 34}},
                          std::vector<Vec3>{{-12, 34, 6}, {-34, 40, -2}, {-56, 50, -14}},
                          std::vector<Vec3>{{8, 30, 18}, {30, 32, 30}, {52, 26, 42}},
                          std::vector<Vec3>{{8, 36, 10}, {30, 44, 7}, {54, 54, -6}}})
    append(a.veins, tube(way, {8.5, 6.8, 5.6}));
  a.caval_upper =
      tube({{-36, 2, 10}, {-36, 0, 40}, {-34, -2, 80}, {-32, -4, 160}}, {9.5, 9.0, 9.0, 8.5}, 4.0);
  a.caval_lower =
      tube({{-36, 8, -14}, {-33, 17, -40}, {-29, 26, -75}, {-26, 34, -150}}, {12, 12.0, 12.5, 12}, 4.0);
  return a;
}

Capsules outflow() {
  return tube({{-3, -34, -8}, {2, -35, 8}, {7, -32, 22}}, {13.0, 11.5, 10.0});
}
Capsules pulmonary_trunk() {
  Capsules out = tube({{7, -32, 22}, {14, -30, 38}, {20, -12, 54}, {19, 6, 60}}, {10.5, 12.5, 13.5, 12.5});
  append(out, tube({{19, 4, 60}, {-2, 14, 58}, {-28, 20, 52}, {-54, 22, 42}}, {11.0, 10.0, 9.5, 7.0}));
  append(out, tube({{19, 4, 60}, {32, 18, 62}, {44, 30, 55}, {54, 36, 40}}, {11.0, 10.0, 9.0, 7.0}));
  return out;
}

Capsules papillary(const HeartFrame& f) {
  Capsules out = tube({f.world(-24, 20, 56), f.world(-24, 13, 44), f.world(-22, 9, 33)}, {5.5, 4.5, 3.0});
  append(out, tube({f.world(-18, -21, 54), f.world(-19, -14, 44), f.world(-20, -9, 34)}, {5.5, 4.5, 3.0}));
  for (int i = 0; i < 7; ++i) {  // trabeculae
    const double a = 0.9 * i;
    out.push_back({f.world(-12 + 22 * std::cos(a), 25 * std::sin(a), 36.0),
                   f.world(-8 + 12 * std::cos(a + 0.4), 14 * std::sin(a + 0.4), 70.0), 1.6, 1.9});
  }
  return out;
}

/// Of the superior cava's contrast, what the atrium is mixed of: undiluted contrast is soon thinned.
float inflow_of(const TissueHu& hu) {
  constexpr float most = 600.0f;
  return std::min(hu.superior_vena_cava, most);
}

/// Contrast that comes from one arm and is not yet mixed with the blood from elsewhere. What it becomes on
/// its way: layers and swirls in the superior cava, a jet into the atrium, less and less of it from there on.
class RightHeartContrast {
 public:
  RightHeartContrast(const HeartShape& heart, const BodyOptions& options, Noise noise)
      : heart_(heart), hu_(options.hu), mixing_(options.mixing), noise_(std::move(noise)) {}

  MixedHu cava() const {
    // It is heavier than blood, and flows in long threads.
    return mixed(hu_.superior_vena_cava, hu_.blood + 60.0f, hu_.superior_vena_cava,
                 [noise = noise_](const Vec3& p) {
                   const Vec3 thread(p.x() / 5.0, p.y() / 5.0, p.z() / 16.0 + 11.3);
                   return 0.5 + p.y() / 20.0 + 0.55 * noise->at(thread);
                 });
  }
  MixedHu atrium() const {
    const double middle = HeartFrame(heart_).world(34.0, -7.0, -22.5).z();
    const float even = 0.3f * (0.5f * (hu_.right_heart + inflow_of(hu_))) + 0.7f * hu_.right_heart;
    const float jet = 0.5f * (hu_.right_heart + inflow_of(hu_));
    return mixed(even, hu_.blood + 35.0f, jet, [middle, noise = noise_](const Vec3& p) {
      return 0.5 + (p.z() - middle) / 80.0 + 0.25 * noise->at(p / 8.0 + Vec3::Constant(5.1));
    });
  }
  MixedHu ventricle() const {
    const float low = 0.5f * (hu_.blood + hu_.right_heart);
    return mixed(hu_.right_heart, low, 2.0f * hu_.right_heart - low, swirls(10.0, 0.5));
  }
  MixedHu pulmonary() const {
    return mixed(hu_.pulmonary, 0.88f * hu_.pulmonary, 1.12f * hu_.pulmonary, swirls(12.0, 0.5));
  }

 private:
  using Share = std::function<double(const Vec3&)>;
  Share swirls(double grain_mm, double strength) const {
    return [=, noise = noise_](const Vec3& p) {
      return 0.5 + strength * noise->at(p / grain_mm + Vec3::Constant(19.7));
    };
  }
  /// From `even` everywhere to a share of `high` in `low`.
  MixedHu mixed(float even, float low, float high, Share share) const {
    if (mixing_ <= 0.0) return {};
    return [=, amount = static_cast<float>(mixing_), share = std::move(share)](const Vec3& p) {
      const auto part = static_cast<float>(smooth_step(share(p), 0.0, 1.0).value);
      return even + amount * (low + (high - low) * part - even);
    };
  }

  HeartShape heart_;
  TissueHu hu_;
  double mixing_;
  Noise noise_;
};

}  // namespace

HeartFrame::HeartFrame(const HeartShape& shape)
    : heart(shape),
      wide(shape.half_width_right_mm / 46.0),
      high(shape.half_width_up_mm / 40.0),
      long_(shape.length_mm / 92.0) {
  axes << heart.right, heart.up, heart.long_axis;
}

Vec3 HeartFrame::world(double right_mm, double up_mm, double along_mm) const {
  return heart.base + axes * Vec3(right_mm, up_mm, along_mm);
}

Distance HeartFrame::ellipsoid_at(const Vec3& centre, const Vec3& semi_axes, double shear) const {
  geometry::Mat3 local = geometry::Mat3::Identity();
  local(0, 2) = -shear;
  const geometry::Mat3 to_unit = semi_axes.cwiseInverse().asDiagonal() * local * axes.transpose();
  return ellipsoid(world(centre.x(), centre.y(), centre.z()), to_unit);
}

Distance aortic_root(const AorticRoot& root, double wall_mm) {
  const Vec3 side = root.axis.cross(root.left_sinus);
  const double right = std::atan2(root.right_sinus.dot(side), root.right_sinus.dot(root.left_sinus));
  const double third = right > 0.0 ? 0.5 * (right + 2.0 * M_PI) : 0.5 * (right - 2.0 * M_PI);
  // The radius changes along the axis and the angle: what is left of the bound on its slope is divided out.
  constexpr double steepest = 2.2;
  // The wall ends at the annulus; the outflow tract is open to the ventricle.
  const double lowest = wall_mm > 0.0 ? 1.0 : -6.0;
  return [=](const Vec3& p) {
    const Vec3 d = p - root.annulus;
    const double h = d.dot(root.axis);
    const double x = d.dot(root.left_sinus), y = d.dot(side);
    const double rho = std::hypot(x, y);
    const double from_ends = std::max(lowest - h, h - root.sinus_height_mm - 8.0);
    const double t = std::clamp(h / root.sinus_height_mm, 0.0, 1.0);
    double radius = root.annulus_radius_mm + t * (root.ascending_radius_mm - root.annulus_radius_mm);
    const double bulge = std::sin(M_PI * std::pow(t, 1.45));  // widest at 0.62 of the height
    if (bulge > 0.0 && rho > 1e-6) {
      const double angle = std::atan2(y, x);
      double nearest = std::abs(angle);
      for (const double sinus : {right, third})
        nearest = std::min(nearest, std::abs(std::remainder(angle - sinus, 2.0 * M_PI)));
      const double lobe = 0.45 + 0.55 * std::pow(std::cos(std::min(1.5 * nearest, 0.5 * M_PI)), 2.0);
      radius += std::max(0.0, bulge * lobe * (root.sinus_radius_mm - radius));
    }
    return std::max(rho - radius - wall_mm, from_ends) / steepest;
  };
}

Capsules aorta_above_root(const HeartShape& heart) {
  const AorticRoot& root = heart.root;
  const double r = root.ascending_radius_mm;
  const Vec3 start = root.annulus + root.sinus_height_mm * root.axis;
  return tube({start,
               start + 15.0 * root.axis,
               start + Vec3(-7, -4, 35),
               start + Vec3(-6, 0, 60),
               start + Vec3(0, 22, 84),
               start + Vec3(20, 60, 84),
               {22, 74, 70},
               {20, 72, 20},
               {16, 71, -50},
               {12, 72, -150}},
              {r, r, r, r, 0.95 * r, 0.9 * r, 0.85 * r, 0.82 * r, 0.8 * r, 0.76 * r}, 3.0);
}

Distance heart_outline(const HeartShape& heart) {
  const HeartFrame f(heart);
  const Noise none = std::make_shared<const NoiseField>(1);  // cavities alone are uneven
  const Ventricles v = ventricles_of(f, none);
  const Atria a = atria_of(f, none);
  return either({both(either({both(v.left_outer, v.epicardium), v.right_outer}), v.base),
                 grown(a.left_shape, 3.2), grown(a.right_shape, 3.4), aortic_root(heart.root, 1.4)});
}

void add_aorta(Organs& organs, const HeartShape& heart, const TissueHu& hu) {
  const Texture blood{5.0f, 9.0f, 0.0f};
  const Capsules tubes = aorta_above_root(heart);
  organs.push_back({{Label::aorta, hu.arterial}, blood, aortic_root(heart.root, 0.0), {}});
  organs.push_back({{Label::aorta, hu.arterial}, blood, {}, tubes});
}

void add_groove_fat(Organs& organs, const CoronaryTree& tree, const Capsules& veins, const TissueHu& hu,
                    double thickness) {
  Capsules fat;
  for (const CoronaryVessel& vessel : tree.vessels) {
    if (vessel.name.starts_with("S")) continue;  // septal branches run in muscle
    const auto& axis = vessel.axis;
    for (std::size_t i = 0; i + 1 < axis.size(); i += 15) {
      const std::size_t j = std::min(i + 15, axis.size() - 1);
      const auto sheath = [&](std::size_t at) {
        return std::max(axis.radius[at] + thickness * 2.6,
                        vessel.wall.max_at(axis.abscissa[at]) + thickness * 1.0);
      };
      fat.push_back({axis.points[i], axis.points[j], sheath(i), sheath(j)});
    }
  }
  append(fat, grown(veins, thickness * 1.3));
  organs.push_back({{Label::epicardial_fat, hu.epicardial_fat}, {7.0f, 4.0f, 0.0f}, {}, fat, true});
}

void add_chambers(Organs& organs, const HeartShape& heart, const BodyOptions& options, const Noise& noise) {
  const TissueHu& hu = options.hu;
  const RightHeartContrast contrast(heart, options, noise);
  const HeartFrame f(heart);
  const Ventricles v = ventricles_of(f, noise);
  const Atria a = atria_of(f, noise);
  const float mixed = 0.5f * (hu.right_heart + inflow_of(hu));
  organs.push_back({{Label::vessel_wall, 50.0f}, {}, aortic_root(heart.root, 1.4), {}});
  organs.push_back({{Label::myocardium, hu.myocardium + 10.0f}, {8.0f, 4.0f, 0.0f}, {}, papillary(f)});
  organs.push_back({{Label::left_ventricle, hu.arterial - 8.0f}, {9.0f, 9.0f, 0.0f}, v.left_cavity, {}});
  organs.push_back({{Label::pulmonary_artery, hu.pulmonary},
                    {10.0f, 10.0f, 0.0f},
                    {},
                    pulmonary_trunk(),
                    false,
                    contrast.pulmonary()});
  organs.push_back({{Label::right_ventricle, hu.right_heart},
                    {20.0f, 12.0f, 0.0f},
                    {},
                    outflow(),
                    false,
                    contrast.ventricle()});
  organs.push_back({{Label::right_ventricle, hu.right_heart},
                    {24.0f, 12.0f, 0.2f},
                    v.right_cavity,
                    {},
                    false,
                    contrast.ventricle()});
  organs.push_back({{Label::left_atrium, hu.arterial - 4.0f}, {7.0f, 9.0f, 0.0f}, a.left, {}});
  organs.push_back({{Label::left_atrium, hu.arterial - 14.0f}, {16.0f, 4.0f, 0.0f}, {}, a.appendage});
  organs.push_back({{Label::left_atrium, hu.arterial - 4.0f}, {7.0f, 9.0f, 0.0f}, {}, a.veins});
  organs.push_back({{Label::right_atrium, 0.3f * mixed + 0.7f * hu.right_heart},
                    {34.0f, 11.0f, 0.0f},
                    a.right,
                    {},
                    false,
                    contrast.atrium()});
  organs.push_back(
      {{Label::vein, hu.superior_vena_cava}, {45.0f, 7.0f, 0.0f}, {}, a.caval_upper, false, contrast.cava()});
  organs.push_back({{Label::vein, hu.blood + 45.0f}, {14.0f, 10.0f, 0.0f}, {}, a.caval_lower});
  organs.push_back({{Label::vessel_wall, 50.0f}, {}, {}, grown(aorta_above_root(heart), 1.5)});
}

void add_great_vessels(Organs& organs, const TissueHu& hu) {
  organs.push_back({{Label::vessel_wall, hu.myocardium - 50.0f}, {}, {}, grown(pulmonary_trunk(), 1.0)});
}

void add_heart_walls(Organs& organs, const HeartShape& heart, const TissueHu& hu, const Noise& noise) {
  const HeartFrame f(heart);
  const Ventricles v = ventricles_of(f, noise);
  const Atria a = atria_of(f, noise);
  const Texture muscle{9.0f, 7.0f, 0.0f};
  const Material wall{Label::myocardium, hu.myocardium};
  organs.push_back(
      {wall, muscle, both(either({both(v.left_outer, v.epicardium), v.right_outer}), v.base), {}});
  organs.push_back({wall, muscle, {}, grown(outflow(), 2.5)});
  const Material thin{Label::myocardium, hu.myocardium - 15.0f};
  organs.push_back({thin, muscle, either({grown(a.left_shape, 3.2), grown(a.right_shape, 3.4)}), {}});
  organs.push_back({thin, muscle, {}, grown(a.appendage, 1.0)});
  // The pericardial sac: fat within, a thin line about it.
  const double w = f.wide, h = f.high, l = f.long_;
  const Distance sac_shape = either({both(f.ellipsoid_at({1.0, 0.0, 0.0}, {52.8 * w, 46.8 * h, 97.5 * l}),
                                          half_space(f.world(0, 0, -14.0), -f.heart.long_axis)),
                                     f.ellipsoid_at({4.0, -4.0, -18.0}, {53.0 * w, 36.0 * h, 26.0}),
                                     ellipsoid({2, -18, 30}, Vec3(36.0, 32.0, 34.0))});
  organs.push_back({{Label::epicardial_fat, hu.epicardial_fat},
                    {8.0f, 5.0f, 0.0f},
                    uneven(sac_shape, 1.1, 17.0, noise),
                    {}});
  organs.push_back({{Label::muscle, 25.0f}, {}, uneven(grown(sac_shape, 1.2), 1.1, 17.0, noise), {}});
}

Capsules pacing_lead(const HeartShape& heart, int which) {
  const HeartFrame f(heart);
  std::vector<Vec3> way{{-31, -4, 150}, {-33, -1, 80}, {-35, 1, 40}, {-37, 3, 14}};
  const double w = f.wide, l = f.long_;
  if (which == 0) {
    way.push_back(f.world(44.0 * w, -8.0, -18.0));
    way.push_back(f.world(35.0 * w, -10.0, -2.0));
    for (const Vec3& at : {Vec3(30, -12, 20), Vec3(26, -10, 42), Vec3(22, -6, 64)})
      way.push_back(f.world(at.x() * w, at.y(), at.z() * l));
  } else {
    for (const Vec3& at : {Vec3(38, -16, -24), Vec3(30, -14, -14), Vec3(32, 4, -10), Vec3(36, 15, -17)})
      way.push_back(f.world(at.x() * w, at.y(), at.z()));
  }
  constexpr double coil = 0.6, electrode = 1.0;
  Capsules out = tube(way, std::vector<double>(way.size(), coil), 2.0);
  // The tip and the ring behind it.
  for (const std::size_t from_end : {std::size_t{1}, std::size_t{7}}) {
    Capsule& piece = out[out.size() - from_end];
    piece.from_radius = piece.to_radius = electrode;
  }
  return out;
}

}  // namespace ostia::phantom
