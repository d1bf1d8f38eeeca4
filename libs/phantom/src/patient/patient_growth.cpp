#include "patient/patient_growth.h"

#include "heart/heart_place.h"
#include "scan/smooth_process.h"

#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

using geometry::Centerline;

constexpr double growth_degree = std::numbers::pi / 180.0;
constexpr double grown_step_mm = 4.0, least_grown_mm = 8.0, most_grown_mm = 170.0;
constexpr double thin_mm = 0.6, thinner_per_mm = 0.011;
constexpr double apex_depth = 0.95, ring_depth_share = 0.16;

std::uint64_t stream_of(const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return 0x47524f0000000000 ^ (hash >> 24);
}

/// A step on the heart's surface: about its axis and along it, mm.
struct Way {
  double around = 0.0, down = 0.0;
};

/// Ahead in a groove, or towards the apex; nothing where the vessel has come to its end.
class Guide {
 public:
  Guide(const Ground& ground, const std::string& name, const Way& last)
      : ground_(ground), name_(name), way_(last) {
    const double b = ground.heart.posterior_groove_rad / growth_degree,
                 a = ground.heart.anterior_groove_rad / growth_degree;
    if (name == "RCA") last_deg_ = ground.dominance == Dominance::left ? -48.0 : b - 34.0;
    if (name == "LCX") {
      last_deg_ = a + 88.0;
      if (ground.dominance == Dominance::left) last_deg_ = b + 360.0 + 8.0;
      if (ground.dominance == Dominance::balanced) last_deg_ = b + 360.0 - 26.0;
    }
  }

  /// The next place, `grown_step_mm` on; false at the end.
  bool next(HeartPlace& place) {
    const HeartShape& heart = ground_.heart;
    const Groove groove = groove_of(name_);
    const double wide = width(place);
    if (groove == Groove::atrioventricular && std::abs(place.depth) < ring_depth_share) {
      const double side = name_ == "RCA" ? -1.0 : 1.0;
      if (side * (last_deg_ - unwound(place.phi_rad) / growth_degree) < 0.0) return false;
      place.phi_rad += side * grown_step_mm / wide;
      const HeartPlace there = in_groove(heart, groove, place);
      place.depth += 0.35 * (there.depth - place.depth);
      return true;
    }
    if (place.depth > apex_depth) return false;
    if (groove == Groove::anterior || groove == Groove::posterior) {
      place.depth +=
          grown_step_mm / heart.length_mm * std::max(0.35, std::sqrt(1.0 - place.depth * place.depth));
      const HeartPlace there = in_groove(heart, groove, place);
      place.phi_rad += 0.35 * (there.phi_rad - place.phi_rad);
      return true;
    }
    constexpr double turning = 0.12;  // of the way to the apex, a step
    way_.around *= 1.0 - turning;
    way_.down += turning * (1.0 - way_.down);
    const double size = std::hypot(way_.around, way_.down);
    if (size < 1e-6) return false;
    place.phi_rad += grown_step_mm * way_.around / size / wide;
    place.depth += grown_step_mm * way_.down / size / heart.length_mm *
                   std::max(0.35, std::sqrt(std::max(0.0, 1.0 - place.depth * place.depth)));
    return true;
  }

 private:
  double width(const HeartPlace& place) const {
    const double mean = 0.5 * (ground_.heart.half_width_right_mm + ground_.heart.half_width_up_mm);
    return mean * std::sqrt(std::max(0.08, 1.0 - place.depth * place.depth));
  }
  /// The RCA's angle falls from 60 degrees on, the LCX's rises from the anterior groove on.
  double unwound(double phi_rad) const {
    const double about =
        name_ == "RCA" ? -60.0 * growth_degree : ground_.heart.anterior_groove_rad + 110.0 * growth_degree;
    return about + std::remainder(phi_rad - about, 2.0 * std::numbers::pi);
  }

  const Ground& ground_;
  std::string name_;
  Way way_;
  double last_deg_ = 0.0;
};

/// The direction of a line's last 8 mm on the heart's surface.
Way last_way(const Ground& ground, const std::vector<Vec3>& own) {
  const double length = geometry::length(own);
  const HeartPlace before = heart_place(ground.heart, geometry::at_abscissa(own, length - 8.0).point);
  const HeartPlace at = heart_place(ground.heart, own.back());
  const double mean = 0.5 * (ground.heart.half_width_right_mm + ground.heart.half_width_up_mm);
  Way way{std::remainder(at.phi_rad - before.phi_rad, 2.0 * std::numbers::pi) * mean *
              std::sqrt(std::max(0.08, 1.0 - at.depth * at.depth)),
          (at.depth - before.depth) * ground.heart.length_mm};
  const double size = std::hypot(way.around, way.down);
  return size < 1e-6 ? Way{0.0, 1.0} : Way{way.around / size, way.down / size};
}

/// An LAD about the apex, or one that has left its groove; a branch over the atria, or far from the heart.
bool has_arrived(const HeartShape& heart, const std::string& name, const HeartPlace& place) {
  constexpr double about_apex = 0.82, off_groove_deg = 40.0, atria = 0.02, far_mm = 12.0;
  if (groove_of(name) == Groove::anterior) {
    const double off = place.phi_rad - in_groove(heart, Groove::anterior, place).phi_rad;
    return place.depth > about_apex || std::abs(off) > off_groove_deg * growth_degree;
  }
  return groove_of(name) != Groove::atrioventricular &&
         (place.depth < atria || std::abs(place.outwards_mm) > far_mm);
}

CoursePlan plan_with(const Ground& ground) {
  // The plan draws its dominance; the patient's is known.
  for (std::uint64_t k = 0; k < 400; ++k) {
    CoursePlan plan = plan_courses(ground.heart, ground.seed + 1000003 * k);
    if (plan.dominance == ground.dominance) return plan;
  }
  return plan_courses(ground.heart, ground.seed);
}

}  // namespace

std::vector<Vec3> grown_end(const Ground& ground, const std::string& name, const std::vector<Vec3>& points,
                            double end_radius_mm) {
  if (groove_of(name) == Groove::within) return {};
  std::vector<Vec3> own;
  for (const Vec3& p : points) own.push_back(ground.warp.to_own(p));
  HeartPlace place = heart_place(ground.heart, own.back());
  if (has_arrived(ground.heart, name, place)) return {};
  Guide guide(ground, name, last_way(ground, own));
  double most = std::clamp((end_radius_mm - thin_mm) / thinner_per_mm, 0.0, 60.0);
  // Behind its groove a right or circumflex artery is a branch like others.
  const bool in_ring =
      groove_of(name) == Groove::atrioventricular && std::abs(place.depth) < ring_depth_share;
  if (name == "LAD" || in_ring) most = most_grown_mm;
  const double height_from = place.outwards_mm;
  std::vector<Vec3> out;
  for (double s = grown_step_mm; s <= most; s += grown_step_mm) {
    if (!guide.next(place)) break;
    HeartPlace there = place;
    const double fade = std::min(1.0, s / 12.0);
    const double usual = usual_height_mm(ground.heart, groove_of(name), place);
    there.outwards_mm = usual + (height_from - usual) * std::exp(-s / 8.0);
    const double aside = 1.1 * fade * smooth_process(ground.seed, stream_of(name), s, 9.0);
    if (groove_of(name) == Groove::atrioventricular)
      there.depth += aside / ground.heart.length_mm;
    else
      there.phi_rad += aside / (0.5 * (ground.heart.half_width_right_mm + ground.heart.half_width_up_mm));
    out.push_back(ground.warp.to_world(
        ground.heart.epicardium(there.phi_rad, std::min(0.97, there.depth), there.outwards_mm)));
  }
  if (static_cast<double>(out.size()) * grown_step_mm < least_grown_mm) out.clear();
  return out;
}

std::optional<UsualVessel> usual_vessel(const Ground& ground, const std::string& name,
                                        const Centerline* parent, double lcx_s_mm) {
  const CoursePlan plan = plan_with(ground);
  double planned_lcx = 0.0;
  for (const Course& course : plan.courses)
    if (course.name == "LCX") planned_lcx = course.parent_s_mm;
  for (const Course& planned : plan.courses) {
    if (planned.name != name) continue;
    UsualVessel out;
    out.course = planned;
    Centerline own_parent;
    if (parent != nullptr) {
      double s = planned.parent_s_mm;
      if (planned.parent == "LAD") s += lcx_s_mm - planned_lcx;
      if (planned.parent_s_mm == at_crux) {
        const Vec3 crux =
            ground.warp.to_world(ground.heart.epicardium(ground.heart.posterior_groove_rad, 0.02, 4.0));
        const auto foot = geometry::closest(parent->points, crux);
        constexpr double near_mm = 14.0;
        if ((foot.point - crux).norm() > near_mm) return std::nullopt;
        s = std::min(foot.abscissa, parent->abscissa.back() - 6.0);
      }
      if (s < 1.0 || s > parent->abscissa.back() - 6.0) return std::nullopt;
      out.parent_s_mm = s;
      for (const Vec3& p : parent->points) own_parent.points.push_back(ground.warp.to_own(p));
      geometry::complete(own_parent);
      const auto place = geometry::at_abscissa(parent->points, s);
      out.course.parent_s_mm =
          own_parent.abscissa[place.segment] +
          place.t * (own_parent.abscissa[place.segment + 1] - own_parent.abscissa[place.segment]);
    }
    constexpr double bend_mm = 4.0;
    const Centerline own =
        draw_axis(ground.heart, out.course, parent == nullptr ? nullptr : &own_parent, bend_mm, ground.seed);
    for (std::size_t i = 0; i < own.size(); i += 10)
      out.points.push_back(ground.warp.to_world(own.points[i]));
    if (parent != nullptr) out.points.front() = geometry::at_abscissa(parent->points, out.parent_s_mm).point;
    return out;
  }
  return std::nullopt;
}

}  // namespace ostia::phantom
