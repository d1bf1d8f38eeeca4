#include "flow_extension/shape.h"

#include "cutting/plane_triangulation.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/polyline.h"
#include "ostia/geometry/thin_plate_spline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

using std::numbers::pi;
constexpr std::size_t most_landmarks_on_section = 192, landmarks_on_circle = 48;

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

/// Angles at which a circle's inscribed polygon has edges in the proportions of these: of a section that is
/// round already they are its own.
std::vector<double> angles_by_edges(const std::vector<Vec3>& loop) {
  std::vector<double> edge;
  double sum = 0.0, longest = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    edge.push_back((loop[(i + 1) % loop.size()] - loop[i]).norm());
    sum += edge.back();
    longest = std::max(longest, edge.back());
  }
  const auto turn = [&](double radius) {
    double total = 0.0;
    for (const double e : edge) total += 2.0 * std::asin(std::min(1.0, e / (2.0 * radius)));
    return total;
  };
  double low = std::max(0.5 * longest, 0.5 * sum / pi), high = sum;
  const bool round = turn(low) >= 2.0 * pi;
  for (int i = 0; round && i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (turn(middle) > 2.0 * pi ? low : high) = middle;
  }
  std::vector<double> angles{0.0};
  for (std::size_t i = 0; i + 1 < edge.size(); ++i)
    angles.push_back(angles.back() +
                     (round ? 2.0 * std::asin(edge[i] / (2.0 * low)) : 2.0 * pi * edge[i] / sum));
  return angles;
}

/// In a section's frame: x along its normal, y along its binormal, z along the axis.
Vec3 to_local(const Section& section, const Vec3& p) {
  const Vec3 d = p - section.centre;
  return {d.dot(section.frame.normal), d.dot(section.frame.binormal), d.dot(section.frame.tangent)};
}

/// The cylinder's beginning warped onto the section.
class Warp {
 public:
  Warp(const Section& section, double transition)
      : transition_(transition), angles_(angles_by_edges(section.loop)) {
    std::vector<Vec3> target;
    for (const Vec3& p : section.loop) target.push_back(to_local(section, p));
    turn_onto(target);
    const std::size_t n = target.size();
    const std::size_t step = (n + most_landmarks_on_section - 1) / most_landmarks_on_section;
    std::vector<Vec3> from, to;
    for (std::size_t i = 0; i < n; i += step) {
      from.push_back(on_cylinder(section.radius, angles_[i], 0.0));
      to.push_back(target[i]);
    }
    // Two circles that stay, so that the cylinder goes on without a bend.
    for (const double z : {transition, 1.2 * transition})
      for (std::size_t i = 0; i < landmarks_on_circle; ++i) {
        from.push_back(
            on_cylinder(section.radius, 2.0 * pi * static_cast<double>(i) / landmarks_on_circle, z));
        to.push_back(from.back());
      }
    spline_.emplace(from, to);
    for (std::size_t i = 0; i < n; ++i)
      rest_.push_back(target[i] - (*spline_)(on_cylinder(section.radius, angles_[i], 0.0)));
  }

  const std::vector<double>& angles() const { return angles_; }
  static Vec3 on_cylinder(double radius, double angle, double z) {
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }
  Vec3 operator()(const Vec3& p) const {
    if (p.z() >= transition_) return p;
    const double fade = 1.0 - smooth_step(2.0 * p.z() / transition_ - 1.0);
    return p + fade * ((*spline_)(p)-p);
  }
  /// What the landmarks left out of a section with many points have missed.
  const Vec3& rest(std::size_t i) const { return rest_[i]; }

 private:
  /// Turns the angles so that the circle's points lie nearest to the section's.
  void turn_onto(const std::vector<Vec3>& target) {
    double along = 0.0, across = 0.0;
    for (std::size_t i = 0; i < target.size(); ++i) {
      const double c = std::cos(angles_[i]), s = std::sin(angles_[i]);
      along += c * target[i].x() + s * target[i].y();
      across += c * target[i].y() - s * target[i].x();
    }
    const double turn = std::atan2(across, along);
    for (double& a : angles_) a += turn;
  }
  double transition_;
  std::vector<double> angles_;
  std::optional<geometry::ThinPlateSpline> spline_;
  std::vector<Vec3> rest_;
};

/// Abscissas of the rings: a row of nearly equilateral triangles between two, whose edges shrink or grow from
/// those of the section to those of the circle.
std::vector<double> ring_places(const Section& section, double length, double transition) {
  const auto n = static_cast<double>(section.loop.size());
  const double first = mean_edge(section.loop), last = 2.0 * section.radius * std::sin(pi / n);
  const auto row = [&](double s) {
    return 0.5 * std::sqrt(3.0) * (first + smooth_step(s / transition) * (last - first));
  };
  constexpr int steps = 4000;
  std::vector<double> rows{0.0};  // how many rows fit up to each step
  for (int i = 0; i < steps; ++i)
    rows.push_back(rows.back() + length / steps / row((i + 0.5) * length / steps));
  const int count = std::max(2, static_cast<int>(std::lround(rows.back())));
  std::vector<double> places;
  std::size_t at = 0;
  for (int k = 1; k < count; ++k) {
    const double wanted = rows.back() * k / count;
    while (rows[at + 1] < wanted) ++at;
    const double t = (wanted - rows[at]) / (rows[at + 1] - rows[at]);
    places.push_back((static_cast<double>(at) + t) * length / steps);
  }
  places.push_back(length);
  return places;
}

}  // namespace

double polygon_area(const std::vector<Vec3>& loop) {
  return 0.5 * loop_normal(loop).norm();
}

Vec3 polygon_centre(const std::vector<Vec3>& loop) {
  const Vec3 normal = loop_normal(loop);
  Vec3 sum = Vec3::Zero();
  double weights = 0.0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const double w = (loop[i] - loop[0]).cross(loop[i + 1] - loop[0]).dot(normal);
    sum += w / 3.0 * (loop[i] + loop[i + 1] - 2.0 * loop[0]);
    weights += w;
  }
  return loop[0] + sum / weights;
}

Section section_of(const std::string& name, const std::vector<Vec3>& loop, const Vec3& direction,
                   double area) {
  Section section;
  section.name = name;
  section.loop = loop;
  section.centre = polygon_centre(loop);
  section.frame.tangent = direction;
  section.frame.normal = geometry::initial_normal(direction);
  section.frame.binormal = direction.cross(section.frame.normal);
  const auto n = static_cast<double>(loop.size());
  section.radius = std::sqrt(2.0 * area / (n * std::sin(2.0 * pi / n)));
  for (const Vec3& p : loop) {
    const double z = (p - section.centre).dot(direction);
    section.ahead = std::max(section.ahead, z);
    section.behind = std::max(section.behind, -z);
  }
  return section;
}

ExtensionAxis::ExtensionAxis(const Section& section) : centre_(section.centre), frame_(section.frame) {}

ExtensionAxis::ExtensionAxis(const Section& section, double length, double angle, const Vec3& side)
    : ExtensionAxis(section) {
  const double straight = 1.05 * section.ahead;
  const double radius = (length - straight) / angle;
  constexpr int steps = 400;
  std::vector<Vec3> points;
  const int before = static_cast<int>(std::ceil(steps * straight / length));
  for (int i = 0; i < before; ++i) points.push_back(centre_ + straight * i / before * frame_.tangent);
  for (int i = 0; i <= steps; ++i) {
    const double a = angle * i / steps;
    points.push_back(centre_ + straight * frame_.tangent +
                     radius * (std::sin(a) * frame_.tangent + (1.0 - std::cos(a)) * side));
  }
  set_curve(std::move(points));
}

ExtensionAxis::ExtensionAxis(const Section& section, const std::vector<Vec3>& through)
    : ExtensionAxis(section) {
  std::vector<Vec3> points{centre_};
  // The curve leaves the section along the axis' first direction, past where the section itself reaches.
  const double straight = std::max(1.05 * section.ahead, 0.25 * section.radius);
  points.push_back(centre_ + straight * frame_.tangent);
  for (const Vec3& p : through)
    if ((p - centre_).dot(frame_.tangent) > straight || points.size() > 2) points.push_back(p);
  set_curve(std::move(points));
}

void ExtensionAxis::set_curve(std::vector<Vec3> points) {
  geometry::Centerline line;
  line.points = std::move(points);
  geometry::complete(line, frame_.normal);
  curve_.emplace(line);
}

double ExtensionAxis::length() const {
  return curve_ ? curve_->length() : std::numeric_limits<double>::infinity();
}

Vec3 ExtensionAxis::point(double s) const {
  return curve_ && s > 0.0 ? curve_->point(s) : Vec3(centre_ + s * frame_.tangent);
}

geometry::Frame ExtensionAxis::frame(double s) const {
  return curve_ && s > 0.0 ? curve_->frame(s) : frame_;
}

double ExtensionAxis::tightest_bend(double length) const {
  double curvature = 0.0;
  for (int i = 0; curve_ && i <= 400; ++i)
    curvature = std::max(curvature, curve_->curvature_vector(length * i / 400.0).norm());
  return curvature > 1e-12 ? 1.0 / curvature : std::numeric_limits<double>::infinity();
}

Rings extension_rings(const Section& section, const ExtensionAxis& axis, double length, double transition) {
  const std::size_t n = section.loop.size();
  const Warp warp(section, transition);
  Rings out;
  out.abscissa = ring_places(section, length, transition);
  out.rings.resize(out.abscissa.size());
  const double step = 2.0 * pi / static_cast<double>(n);
  double offset = 0.0;  // of the even angles from the section's own, in the mean
  for (std::size_t i = 0; i < n; ++i)
    offset += (warp.angles()[i] - step * static_cast<double>(i)) / static_cast<double>(n);
  constexpr std::size_t rest_rings = 5;
  for (const double s : out.abscissa) out.centres.push_back(axis.point(s));
  core::parallel_for(out.abscissa.size(), 4, [&](std::size_t k) {
    const double s = out.abscissa[k];
    const bool last = k + 1 == out.abscissa.size();
    const double even = last ? 1.0 : smooth_step(s / std::min(transition, length));
    const double half = k % 2 == 0 ? 0.5 : 0.0;
    const auto own = [&](std::size_t i) {  // angle of a point, and of the one past the last
      return i < n ? warp.angles()[i] : warp.angles()[i - n] + 2.0 * pi;
    };
    for (std::size_t i = 0; i < n; ++i) {
      const double uneven = half == 0.0 ? own(i) : 0.5 * (own(i) + own(i + 1));
      const double angle = uneven + even * (offset + step * (static_cast<double>(i) + half) - uneven);
      Vec3 local = warp(Warp::on_cylinder(section.radius, angle, s));
      if (k + 1 < rest_rings && !last)
        local += (1.0 - static_cast<double>(k + 1) / rest_rings) *
                 (half == 0.0 ? warp.rest(i) : Vec3(0.5 * (warp.rest(i) + warp.rest((i + 1) % n))));
      if (last) local = Warp::on_cylinder(section.radius, angle, s);
      const geometry::Frame frame = axis.frame(local.z());
      out.rings[k].push_back(axis.point(local.z()) + local.x() * frame.normal + local.y() * frame.binormal);
    }
  });
  return out;
}

}  // namespace ostia::meshing
