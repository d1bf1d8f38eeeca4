#include "walls/section_contour.h"

#include "ostia/lumen/views.h"
#include "ostia/reformat/plane.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace ostia::analysis {
namespace {

using std::numbers::pi;
constexpr double on_wall_mm = 1e-6;
constexpr int most_rounds = 400;
// Steps along a ray: as far as the field says, a little more to get behind the wall, never less than this.
constexpr double stride = 1.05, behind_mm = 0.01, least_step_mm = 0.06;
// A few rays to a tenth of their length tell how the axis lies in the lumen. Rays start from the axis where
// the largest radius is no more than so many times the least, and from the centroid elsewhere.
constexpr int rough_rays = 16;
constexpr double rough_share = 0.1, most_uneven_from_axis = 2.5;
// Rays see a lumen well whose radii differ no more than this.
constexpr double most_uneven = 4.0;
// A side whose middle is farther from the wall than this share of its length leaves the wall.
constexpr double astray_share = 0.12, astray_mm = 0.005;
constexpr double suspect_slope = 0.5;  // of a side against the circle about the middle
constexpr int few_rays = 32;           // with fewer, all sides are looked at
constexpr double search_step_mm = 0.12;
// Where the field is less than this outside, a lumen thinner than the search's step may be near.
constexpr double promising_mm = 0.15;
constexpr int most_promising = 8;
constexpr double trace_pixel_mm = 0.05, trace_cell_mm = 0.2, trace_bend_mm = 0.002, least_side_mm = 0.002;
constexpr int bend_rounds = 6;

Vec2 direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

/// The way along one ray: inside at `inner`, outside at `outer` once it is bracketed.
struct Ray {
  Vec2 along = Vec2::Zero();
  double inner = 0.0, f_inner = 0.0, outer = 0.0, f_outer = 0.0, at = 0.0;
  double left = 0.0, f_left = 0.0;  // the place that was last of the bracket
  bool bracketed = false, done = false;
  int unhalved = 0;  // rounds in a row that have not halved the bracket

  double next() const {
    if (!bracketed) return inner + std::max(-stride * f_inner, least_step_mm) + behind_mm;
    const double width = outer - inner;
    if (unhalved > 2) return inner + 0.5 * width;
    const double guess = interpolated();
    const double straight = inner + width * f_inner / (f_inner - f_outer);
    const double margin = std::min(0.25 * on_wall_mm, 0.1 * width);
    return std::clamp(guess > inner && guess < outer ? guess : straight, inner + margin, outer - margin);
  }
  void take(double f, double share) {
    done = std::abs(f) <= std::max(on_wall_mm, share * at) || (bracketed && outer - inner < on_wall_mm);
    if (done) return;
    const double before = outer - inner;
    double &end = f < 0.0 ? inner : outer, &f_end = f < 0.0 ? f_inner : f_outer;
    left = std::exchange(end, at);
    f_left = std::exchange(f_end, f);
    unhalved = bracketed && outer - inner > 0.5 * before ? unhalved + 1 : 0;
    bracketed = bracketed || f >= 0.0;
  }

 private:
  /// Inverse quadratic interpolation through the bracket and the place before (Brent 1973, chapter 4).
  double interpolated() const {
    const double a = f_inner, b = f_outer, c = f_left;
    if (a == c || b == c) return -1.0;
    return inner * b * c / ((a - b) * (a - c)) + outer * a * c / ((b - a) * (b - c)) +
           left * a * b / ((c - a) * (c - b));
  }
};

class Finder {
 public:
  Finder(const lumen::ScalarField& field, const geometry::AxisCurve& axis, double s_mm, int around)
      : field_(field), axis_(axis), s_mm_(s_mm), around_(around), plane_(axis, s_mm) {}

  SectionContour find() {
    const bool astray = !(value(Vec2::Zero()) < 0.0);
    Vec2 seed = Vec2::Zero();
    if (astray) {
      const auto near = lumen_near();
      if (!near) return {SectionContour::State::shut, {}};
      seed = *near;
    }
    SectionContour contour = about(seed, astray);
    if (astray && contour.state == SectionContour::State::found && !belongs(contour.points))
      return {SectionContour::State::shut, {}};
    return contour;
  }

 private:
  struct Star {
    std::vector<Vec2> points;
    bool closed = true;
    double uneven = 1.0;  // largest over least radius
  };

  double value(const Vec2& p) const { return field_.value(plane_.world(p)); }
  void values(const std::vector<Vec2>& points, std::vector<double>& out) {
    places_.resize(points.size());
    out.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) places_[i] = plane_.world(points[i]);
    field_.values(places_, out);
  }

  SectionContour about(const Vec2& seed, bool astray) {
    Vec2 middle = seed;
    double first_angle = 0.0;
    const Star rough = shoot(seed, 0.0, rough_rays, rough_share);
    if (!rough.closed) return {SectionContour::State::open, {}};
    if (rough.uneven > most_uneven_from_axis) {
      const Vec2 centroid = measures_of(rough.points).centroid;
      if (value(centroid) < 0.0) middle = centroid;
    }
    if (middle != seed && !astray) {  // the first point is still at theta = 0 from the axis
      const Vec2 first = shoot(seed, 0.0, 1, 0.0).points.front() - middle;
      first_angle = std::atan2(first.y(), first.x());
    }
    Star star = shoot(middle, first_angle, around_, 0.0);
    if (!star.closed) return {SectionContour::State::open, {}};
    if (star.uneven <= most_uneven && follows_wall(middle, star.points))
      return {SectionContour::State::found, std::move(star.points)};
    return traced(middle, astray ? middle : Vec2(Vec2::Zero()));
  }

  /// Where `count` rays from a place in the lumen first meet the wall: to 1e-6 mm in the field, or to a share
  /// of their length.
  Star shoot(const Vec2& centre, double first_angle, int count, double share) {
    std::vector<Ray> rays(static_cast<std::size_t>(count));
    const double f = value(centre);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      rays[k].along = direction(first_angle + 2.0 * pi * static_cast<double>(k) / count);
      rays[k].f_inner = f;
    }
    Star star;
    for (int round = 0; round < most_rounds; ++round) {
      if (!advance(rays, centre)) break;
      for (std::size_t i = 0; i < active_.size(); ++i) {
        Ray& ray = rays[active_[i]];
        ray.take(found_[i], share);
        if (!ray.done && !ray.bracketed && points_[i].norm() > reach_mm) star.closed = false;
      }
      if (!star.closed) return star;
    }
    double least = INFINITY, largest = 0.0;
    for (const Ray& ray : rays) {
      star.points.push_back(centre + ray.at * ray.along);
      star.closed = star.closed && star.points.back().norm() <= reach_mm * (1.0 + share);
      least = std::min(least, ray.at);
      largest = std::max(largest, ray.at);
    }
    star.uneven = largest / least;
    return star;
  }
  /// Asks the field at the next place of each ray that is not done; false where all are.
  bool advance(std::vector<Ray>& rays, const Vec2& centre) {
    active_.clear();
    points_.clear();
    for (std::size_t k = 0; k < rays.size(); ++k) {
      if (rays[k].done) continue;
      rays[k].at = rays[k].next();
      active_.push_back(k);
      points_.push_back(centre + rays[k].at * rays[k].along);
    }
    values(points_, found_);
    return !active_.empty();
  }

  /// Rays that pass a bulge of the wall leave a gap in what they see.
  bool follows_wall(const Vec2& centre, const std::vector<Vec2>& points) {
    std::vector<Vec2> middles;
    std::vector<double> lengths, found;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec2 &a = points[k], &b = points[(k + 1) % points.size()];
      const double r_a = (a - centre).norm(), r_b = (b - centre).norm();
      const bool suspect = std::abs(r_b - r_a) > suspect_slope * pi * (r_a + r_b) / around_;
      if (!suspect && around_ >= few_rays) continue;
      middles.push_back(0.5 * (a + b));
      lengths.push_back((b - a).norm());
    }
    if (middles.empty()) return true;
    values(middles, found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (std::abs(found[i]) > astray_share * lengths[i] + astray_mm) return false;
    }
    return true;
  }

  /// A place inside the lumen nearest to the axis.
  std::optional<Vec2> lumen_near() {
    std::vector<Vec2> points, all;
    std::vector<double> found, f;
    for (int ring = 1; ring * search_step_mm <= search_mm; ++ring) {
      const double r = ring * search_step_mm;
      const int count = std::max(6, static_cast<int>(std::ceil(2.0 * pi * r / search_step_mm)));
      points.clear();
      for (int k = 0; k < count; ++k) points.push_back(r * direction(2.0 * pi * k / count));
      values(points, found);
      const auto least = std::min_element(found.begin(), found.end());
      if (*least < 0.0) return points[static_cast<std::size_t>(least - found.begin())];
      all.insert(all.end(), points.begin(), points.end());
      f.insert(f.end(), found.begin(), found.end());
    }
    return thin_lumen_near(all, f);
  }

  /// Goes down the field from where it is least, for a lumen between the places that were asked.
  std::optional<Vec2> thin_lumen_near(const std::vector<Vec2>& points, const std::vector<double>& f) const {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < f.size(); ++i) {
      if (f[i] < promising_mm) order.push_back(i);
    }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return f[a] < f[b] || (f[a] == f[b] && a < b); });
    std::vector<Vec2> tried;
    for (const std::size_t i : order) {
      if (tried.size() == static_cast<std::size_t>(most_promising)) break;
      const auto close = [&](const Vec2& p) { return (p - points[i]).norm() < 2.0 * search_step_mm; };
      if (std::any_of(tried.begin(), tried.end(), close)) continue;
      tried.push_back(points[i]);
      if (const auto inside = descend(points[i])) return inside;
    }
    return std::nullopt;
  }
  std::optional<Vec2> descend(Vec2 p) const {
    for (int step = 0; step < 12; ++step) {
      const lumen::FieldSample at = field_.value_and_gradient(plane_.world(p));
      if (at.value < 0.0) return p;
      const Vec2 slope(at.gradient.dot(plane_.x), at.gradient.dot(plane_.y));
      const double steep = slope.norm();
      if (!(steep > 1e-6)) return std::nullopt;
      p -= std::min(at.value / steep + 1e-3, search_step_mm) / steep * slope;
    }
    return std::nullopt;
  }

  bool belongs(const std::vector<Vec2>& points) const {
    const Vec2 middle = measures_of(points).centroid;
    const geometry::AxisFoot foot = axis_.nearest_foot(plane_.world(middle));
    return std::abs(foot.s_mm - s_mm_) <= 2.0 + 2.0 * middle.norm();
  }

  /// The line along the wall about a place inside.
  SectionContour traced(const Vec2& inside, const Vec2& origin) {
    const double side = 2.0 * (reach_mm + 0.5);
    const reformat::Plane picture = reformat::cross_section_plane(axis_, s_mm_, side, trace_pixel_mm);
    const lumen::ContourLineOptions options{.step_px = trace_cell_mm / trace_pixel_mm,
                                            .largest_mm = trace_cell_mm,
                                            .bend_px = trace_bend_mm / trace_pixel_mm};
    const Vec2 seed = reformat::project(picture, plane_.world(inside)).picture_px;
    SectionContour best{SectionContour::State::open, {}};
    double least_area = INFINITY;
    for (const lumen::ContourLine& line :
         lumen::contour_lines(field_, lumen::view_of(picture), {seed}, options)) {
      if (!line.closed()) continue;
      std::vector<Vec2> points;
      for (std::size_t i = 0; i + 1 < line.world.size(); ++i) points.push_back(plane_.plane(line.world[i]));
      points = thinned(points);
      const double area = measures_of(points).area_mm2;
      if (points.size() < 3 || area >= least_area || !(area > 0.0) || !encloses(points, inside)) continue;
      least_area = area;
      best = {SectionContour::State::found, std::move(points)};
    }
    if (best.state == SectionContour::State::found) {
      for (int round = 0; round < bend_rounds && round_off(best.points); ++round) {
      }
      start_at_zero(best.points, origin);
    }
    return best;
  }

  /// Gives each side whose middle is off the wall a point there, along its normal; false where none is.
  bool round_off(std::vector<Vec2>& line) {
    std::vector<Vec2> middles;
    for (std::size_t i = 0; i < line.size(); ++i)
      middles.push_back(0.5 * (line[i] + line[(i + 1) % line.size()]));
    std::vector<double> f;
    values(middles, f);
    std::vector<Vec2> rounded;
    for (std::size_t i = 0; i < line.size(); ++i) {
      rounded.push_back(line[i]);
      const Vec2 side = line[(i + 1) % line.size()] - line[i];
      if (std::abs(f[i]) <= trace_bend_mm || side.norm() < 2.0 * least_side_mm) continue;
      if (const auto p = wall_beside(middles[i], f[i], side)) rounded.push_back(*p);
    }
    const bool changed = rounded.size() > line.size();
    line = std::move(rounded);
    return changed;
  }
  /// The wall on the normal of a side, no farther than the side is long.
  std::optional<Vec2> wall_beside(const Vec2& middle, double f, const Vec2& side) const {
    const double sign = f < 0.0 ? 1.0 : -1.0;  // outwards from inside, inwards from outside
    Ray ray;
    ray.along = sign * Vec2(side.y(), -side.x()).normalized();
    ray.f_inner = sign * f;
    for (int round = 0; round < most_rounds && !ray.done; ++round) {
      ray.at = ray.next();
      if (!ray.bracketed && ray.inner > side.norm()) return std::nullopt;
      ray.take(sign * value(middle + ray.at * ray.along), 0.0);
    }
    if (ray.at > side.norm()) return std::nullopt;
    return middle + ray.at * ray.along;
  }

  /// Without points that are so near each other that rounding decides how the line bends there.
  static std::vector<Vec2> thinned(const std::vector<Vec2>& line) {
    std::vector<Vec2> kept;
    for (const Vec2& p : line) {
      if (kept.empty() || (p - kept.back()).norm() >= least_side_mm) kept.push_back(p);
    }
    while (kept.size() > 3 && (kept.back() - kept.front()).norm() < least_side_mm) kept.pop_back();
    return kept;
  }
  static bool encloses(const std::vector<Vec2>& line, const Vec2& p) {
    bool inside = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Vec2 &a = line[i], &b = line[(i + 1) % line.size()];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > p.x()) inside = !inside;
    }
    return inside;
  }
  static void start_at_zero(std::vector<Vec2>& points, const Vec2& origin) {
    const auto off = [&](const Vec2& p) {
      return std::abs(std::atan2(p.y() - origin.y(), p.x() - origin.x()));
    };
    const auto first = std::min_element(points.begin(), points.end(),
                                        [&](const Vec2& a, const Vec2& b) { return off(a) < off(b); });
    std::rotate(points.begin(), first, points.end());
  }

  const lumen::ScalarField& field_;
  const geometry::AxisCurve& axis_;
  double s_mm_;
  int around_;
  SectionPlane plane_;
  std::vector<Vec3> places_;  // these four are kept for their room
  std::vector<std::size_t> active_;
  std::vector<Vec2> points_;
  std::vector<double> found_;
};

}  // namespace

SectionPlane::SectionPlane(const geometry::AxisCurve& axis, double s_mm) : origin(axis.point(s_mm)) {
  const geometry::Frame frame = axis.frame(s_mm);
  x = geometry::radial_direction(frame, 0.0);
  y = geometry::radial_direction(frame, 0.5 * pi);
  normal = frame.tangent;
}

SectionContour section_contour(const lumen::ScalarField& field, const geometry::AxisCurve& axis, double s_mm,
                               int around) {
  return Finder(field, axis, s_mm, around).find();
}

}  // namespace ostia::analysis
