#include "coronaries/coronary_courses.h"

#include "ostia/geometry/polyline.h"
#include "ostia/geometry/spline.h"
#include "ostia/phantom/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

using geometry::ArcLengthSpline;
using geometry::Centerline;

constexpr double course_step_mm = 0.1;
constexpr double degrees = std::numbers::pi / 180.0;

/// Random numbers of one vessel: a stream of the seed and the vessel's name.
class Stream {
 public:
  Stream(std::uint64_t seed, const std::string& name) : seed_(seed) {
    std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    index_ = hash << 16;
  }
  double between(double low, double high) { return low + (high - low) * uniform(seed_, index_++); }
  double about(double mean, double deviation) {
    return mean + deviation * std::clamp(normal(seed_, index_++), -2.0, 2.0);
  }

 private:
  std::uint64_t seed_, index_ = 0;
};

/// A smooth random deviation along a course: three waves.
class Waves {
 public:
  Waves(Stream& random, double amplitude_mm) {
    for (int i = 0; i < 3; ++i) {
      length_[i] = random.between(18.0, 55.0);
      phase_[i] = random.between(0.0, 2.0 * std::numbers::pi);
      // Short waves are low: the curvature of a wave grows with the square of its frequency.
      height_[i] = amplitude_mm * std::pow(length_[i] / 55.0, 1.5) * random.between(0.5, 1.0);
    }
  }
  double at(double s_mm) const {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i)
      sum += height_[i] * std::sin(2.0 * std::numbers::pi * s_mm / length_[i] + phase_[i]);
    return sum;
  }

 private:
  double length_[3], phase_[3], height_[3];
};

/// Points of the way about 4 mm apart, moved sideways by the waves.
std::vector<Vec3> way_points(const HeartShape& heart, const Course& course, Stream& random) {
  std::vector<Vec3> flat;  // phi, depth and height as lengths in mm
  const double width = heart.half_width_up_mm, length = heart.length_mm;
  for (const Waypoint& w : course.way)
    flat.emplace_back(w.phi_deg * degrees * width, w.depth * length, w.outwards_mm);
  const ArcLengthSpline spline(flat);
  const Waves aside(random, 2.8), along(random, 1.4), out(random, 0.8);
  const int steps = std::max(2, static_cast<int>(std::lround(spline.length() / 4.0)));
  std::vector<Vec3> points;
  for (int i = 0; i <= steps; ++i) {
    const double s = spline.length() * i / steps;
    const Vec3 at = spline.point(s), ahead = spline.tangent(s);
    const double fade = std::min(1.0, s / 12.0);  // the beginning is given
    const double a = fade * aside.at(s), b = fade * along.at(s);
    const double phi = (at.x() - a * ahead.y() + b * ahead.x()) / width;
    const double depth = std::min(0.97, (at.y() + a * ahead.x() + b * ahead.y()) / length);
    points.push_back(heart.epicardium(phi, depth, at.z() + fade * out.at(s)));
  }
  return points;
}

/// A branch leaves along its parent and bends away towards its way.
std::vector<Vec3> leaving(const Centerline& parent, double s_mm, const Vec3& towards) {
  const auto place = geometry::at_abscissa(parent.points, s_mm);
  const Vec3 tangent = parent.frames[place.segment].tangent;
  const Vec3 to = towards - place.point;
  Vec3 aside = to - tangent * tangent.dot(to);
  aside.normalize();
  const double angle = std::clamp(std::atan2(to.dot(aside), to.dot(tangent)), 35.0 * degrees, 75.0 * degrees);
  const double reach = std::min(5.0, 0.4 * to.norm());
  const Vec3 direction = std::cos(angle) * tangent + std::sin(angle) * aside;
  return {place.point, place.point + 0.45 * reach * (0.7 * direction + 0.3 * tangent).normalized(),
          place.point + reach * direction};
}

std::vector<Waypoint> varied(std::vector<Waypoint> way, Stream& random, double phi_deg = 3.0) {
  const double turn = random.about(0.0, phi_deg);
  for (std::size_t i = 1; i < way.size(); ++i) way[i].phi_deg += turn;
  return way;
}

std::vector<Vec3> from_sinus(const AorticRoot& root, const Vec3& sinus, double out_mm) {
  const Vec3 ostium =
      root.annulus + 0.62 * root.sinus_height_mm * root.axis + (root.sinus_radius_mm - 0.6) * sinus;
  return {ostium, ostium + 0.5 * out_mm * sinus, ostium + out_mm * sinus};
}

}  // namespace

CoursePlan plan_courses(const HeartShape& heart, std::uint64_t seed) {
  Stream random(seed, "courses");
  CoursePlan plan;
  const double draw = random.between(0.0, 1.0);
  plan.dominance = draw < 0.82 ? Dominance::right : draw < 0.91 ? Dominance::left : Dominance::balanced;
  const bool right = plan.dominance != Dominance::left, left = plan.dominance != Dominance::right;
  const bool ramus = random.between(0.0, 1.0) < 0.2;
  const double a = heart.anterior_groove_rad / degrees, b = heart.posterior_groove_rad / degrees;
  // Diameters: Dodge et al. 1992.
  const double lad = random.about(1.85, 0.18);
  const double lcx = plan.dominance == Dominance::left ? random.about(2.1, 0.25) : random.about(1.7, 0.22);
  const double main = std::cbrt(lad * lad * lad + lcx * lcx * lcx);
  const double rca = right ? random.about(1.95, 0.27) : random.about(1.4, 0.2);
  const double main_length = random.between(8.0, 14.0);

  auto& out = plan.courses;
  const auto add = [&](Course course) { out.push_back(std::move(course)); };
  const AorticRoot& root = heart.root;
  add({"LAD", "", 0.0, from_sinus(root, root.left_sinus, 5.0),
       varied({{a + 4, 0.12, 5.0},
               {a + 1, 0.24, 4.2},
               {a - 2, 0.42, 3.6},
               {a - 3, 0.6, 3.2},
               {a - 5, 0.8, 2.8},
               {a - 7, 0.95, 2.3}},
              random),
       main, 0.75});
  std::vector<Waypoint> groove{
      {a + 24, 0.02, 5.5}, {a + 40, -0.02, 5.0}, {a + 62, -0.02, 4.6}, {a + 84, -0.01, 4.2}};
  if (left) groove.push_back({a + 104.0, 0.0, 4.0});  // on towards the crux, the left way round
  if (plan.dominance == Dominance::balanced) groove.push_back({b + 360.0 - 26.0, 0.03, 3.6});
  if (plan.dominance == Dominance::left) {
    groove.push_back({b + 360.0 - 12.0, 0.02, 4.0});
    groove.push_back({b + 360.0 + 8.0, 0.06, 3.6});
  }
  add({"LCX", "LAD", main_length, {}, varied(groove, random, 2.0), lcx / main, 0.8});
  if (plan.dominance == Dominance::left) out.back().taper_power = 3.0;
  if (ramus)
    add({"RI",
         "LAD",
         main_length + 1.0,
         {},
         varied({{a + 16, 0.16, 4.0}, {a + 28, 0.32, 3.0}, {a + 35, 0.5, 2.4}}, random),
         0.55,
         0.65,
         false});
  add({"D1",
       "LAD",
       main_length + random.between(16.0, 24.0),
       {},
       varied({{a + 12, 0.3, 3.4}, {a + 20, 0.45, 2.7}, {a + 26, 0.66, 2.2}}, random),
       0.66,
       0.65});
  add({"D2",
       "LAD",
       main_length + random.between(40.0, 50.0),
       {},
       varied({{a + 6, 0.53, 2.9}, {a + 14, 0.66, 2.4}, {a + 20, 0.8, 2.0}}, random),
       0.62,
       0.6,
       false});
  add({"S1",
       "LAD",
       main_length + random.between(11.0, 15.0),
       {},
       {{a - 3, 0.32, -2.0}, {a - 6, 0.4, -8.0}, {a - 10, 0.48, -14.0}},
       0.38,
       0.5,
       false});
  add({"OM1",
       "LCX",
       random.between(12.0, 18.0),
       {},
       varied({{a + 44, 0.16, 3.4}, {a + 52, 0.36, 2.6}, {a + 58, 0.6, 2.2}}, random),
       0.7,
       0.65});
  add({"OM2",
       "LCX",
       random.between(36.0, 44.0),
       {},
       varied({{a + 74, 0.16, 3.2}, {a + 80, 0.34, 2.5}, {a + 84, 0.52, 2.2}}, random),
       0.68,
       0.65,
       false});
  std::vector<Waypoint> right_groove{
      {42, -0.03, 6.5}, {30, -0.02, 5.4}, {10, -0.01, 4.6}, {-22, 0.0, 4.4}, {-58, 0.01, 4.2}};
  if (right) {
    right_groove.push_back({b + 3.0, 0.02, 4.0});
    if (plan.dominance == Dominance::right) {
      right_groove.push_back({b - 22.0, 0.03, 3.6});
      right_groove.push_back({b - 34.0, 0.1, 2.8});
    } else {
      right_groove.push_back({b - 8.0, 0.03, 3.6});
    }
  } else {
    right_groove.pop_back();
    right_groove.push_back({-48, 0.03, 3.6});
  }
  add({"RCA", "", 0.0, from_sinus(root, root.right_sinus, 5.0), right_groove, rca, 0.75});
  out.back().taper_power = 3.0;
  add({"CB",
       "RCA",
       random.between(9.0, 14.0),
       {},
       varied({{66, 0.12, 4.0}, {74, 0.22, 3.2}, {80, 0.32, 2.6}}, random),
       0.42,
       0.55,
       false});
  add({"AM",
       "RCA",
       random.between(58.0, 70.0),
       {},
       varied({{-10, 0.18, 3.2}, {-14, 0.36, 2.6}, {-16, 0.55, 2.2}}, random),
       0.52,
       0.6,
       false});
  const std::vector<Waypoint> posterior{
      {b + 1, 0.16, 3.4}, {b, 0.34, 2.8}, {b, 0.52, 2.5}, {b + 2, 0.7, 2.2}};
  if (right) {
    add({"PDA", "RCA", at_crux, {}, varied(posterior, random, 2.0), 0.68, 0.65});
  } else {
    std::vector<Waypoint> left_posterior = posterior;
    for (Waypoint& w : left_posterior) w.phi_deg += 360.0;
    add({"PDA", "LCX", at_crux, {}, varied(left_posterior, random, 2.0), 0.8, 0.65});
  }
  return plan;
}

double least_bend_mm(const Centerline& axis) {
  constexpr std::size_t reach = 8;
  double most = 1e-6;
  for (std::size_t i = reach; i + reach < axis.size(); i += 3) {
    const Vec3 behind = axis.points[i] - axis.points[i - reach],
               ahead = axis.points[i + reach] - axis.points[i];
    most = std::max(most, (ahead - behind).norm() / (behind.norm() * ahead.norm()));
  }
  return 1.0 / most;
}

Centerline draw_axis(const HeartShape& heart, const Course& course, const Centerline* parent,
                     double least_bend, std::uint64_t seed, const std::optional<Vec3>& end) {
  Stream random(seed, course.name);
  std::vector<Vec3> controls = course.beginning;
  const std::vector<Vec3> way = way_points(heart, course, random);
  if (parent != nullptr) controls = leaving(*parent, course.parent_s_mm, way.front());
  const Vec3 last = controls.back();
  // Waypoints too near to the beginning, or behind it, would fold the curve.
  std::size_t first = 0;
  while (first + 2 < way.size() && (way[first] - last).norm() < 5.0) ++first;
  controls.insert(controls.end(), way.begin() + static_cast<std::ptrdiff_t>(first), way.end());
  if (end) controls.push_back(*end);
  // A first spline resampled every 3 mm and smoothed takes out what bends too sharply.
  const std::vector<Vec3> even = geometry::resample(controls, 3.0);
  const std::vector<double> t = geometry::abscissas(even);
  const std::vector<double> weights(t.size(), 1.0);
  Centerline axis;
  for (double stiffness = 120.0; stiffness < 1e5; stiffness *= 8.0) {
    const ArcLengthSpline spline(geometry::smoothing_spline(t, even, weights, stiffness, true));
    const auto steps = static_cast<std::size_t>(std::ceil(spline.length() / course_step_mm));
    axis.points.clear();
    for (std::size_t i = 0; i <= steps; ++i)
      axis.points.push_back(
          spline.point(spline.length() * static_cast<double>(i) / static_cast<double>(steps)));
    if (least_bend_mm(axis) >= least_bend) break;
  }
  geometry::complete(
      axis, parent == nullptr
                ? Vec3(Vec3::Zero())
                : parent->frames[geometry::at_abscissa(parent->points, course.parent_s_mm).segment].normal);
  return axis;
}

}  // namespace ostia::phantom
