#include "ostia/geometry/analytic_shapes.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace ostia::geometry {
namespace {

using std::numbers::pi;
constexpr double radians(double degrees) {
  return degrees * pi / 180.0;
}

struct Sample {
  Vec3 point, tangent;
};
using Curve = std::function<Sample(double)>;   // of the abscissa
using Radius = std::function<double(double)>;  // of the abscissa

void require_positive(double value, const char* what) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw InvalidInput(std::string(what) + " of the shape is " + std::to_string(value) +
                       " mm; it must be above 0");
  }
}

AnalyticTube make_tube(std::string name, double length_mm, double step_mm, const Curve& curve,
                       const Radius& radius) {
  require_positive(length_mm, "a length");
  require_positive(step_mm, "the step");
  const auto pieces =
      std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(length_mm / step_mm - 1e-9)));
  AnalyticTube tube;
  tube.name = std::move(name);
  std::vector<Vec3> tangent;
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double s = length_mm * static_cast<double>(i) / static_cast<double>(pieces);
    const Sample sample = curve(s);
    tube.axis.points.push_back(sample.point);
    tangent.push_back(sample.tangent);
    tube.axis.abscissa.push_back(s);
    tube.axis.radius.push_back(radius(s));
    require_positive(tube.axis.radius.back(), "a radius");
  }
  tube.axis.frames = rotation_minimising_frames(tube.axis.points, tangent, initial_normal(tangent.front()));
  return tube;
}

AnalyticShape shape_of(std::vector<AnalyticTube> tubes) {
  AnalyticShape shape;
  shape.tubes = std::move(tubes);
  for (const AnalyticTube& tube : shape.tubes) {
    for (std::size_t i = 0; i < tube.axis.size(); ++i) {
      const Vec3 reach = Vec3::Constant(tube.axis.radius[i] + 2.0);
      shape.box.extend(tube.axis.points[i] - reach).extend(tube.axis.points[i] + reach);
    }
  }
  return shape;
}

Radius linear(double length, double first, double last) {
  return [=](double s) { return first + (last - first) * s / length; };
}

Sample along_z(double s) {
  return {Vec3(0, 0, s), Vec3::UnitZ()};
}

/// A path of straight pieces and circular arcs that join with the same tangent.
class Path {
 public:
  struct Place {
    Vec3 point, tangent, normal;
  };

  explicit Path(const Place& start) : end_(start) {}

  Path& straight(double length) { return add(length, 0.0, 0.0); }
  /// Bends towards the direction at `towards_deg` from the normal, about the tangent.
  Path& arc(double length, double radius, double towards_deg) {
    return add(length, 1.0 / radius, towards_deg);
  }

  double length() const { return length_; }

  Place at(double s) const {
    std::size_t i = 0;
    while (i + 1 < pieces_.size() && s >= pieces_[i + 1].start) ++i;
    return place(pieces_[i], s - pieces_[i].start);
  }
  Sample sample(double s) const {
    const Place p = at(s);
    return {p.point, p.tangent};
  }

 private:
  struct Piece {
    double start, curvature;
    Place from;
    Vec3 towards;
  };

  static Place place(const Piece& piece, double u) {
    const Place& from = piece.from;
    if (piece.curvature == 0.0) return {from.point + u * from.tangent, from.tangent, from.normal};
    const double angle = piece.curvature * u;
    const Eigen::AngleAxisd turn(angle, from.tangent.cross(piece.towards));
    // 1 - cos by the half angle keeps its digits for short arcs.
    const double aside = 2.0 * std::pow(std::sin(0.5 * angle), 2) / piece.curvature;
    return {from.point + std::sin(angle) / piece.curvature * from.tangent + aside * piece.towards,
            turn * from.tangent, turn * from.normal};
  }

  Path& add(double length, double curvature, double towards_deg) {
    const Vec3 binormal = end_.tangent.cross(end_.normal);
    const double angle = radians(towards_deg);
    pieces_.push_back({length_, curvature, end_, std::cos(angle) * end_.normal + std::sin(angle) * binormal});
    end_ = place(pieces_.back(), length);
    length_ += length;
    return *this;
  }

  std::vector<Piece> pieces_;
  Place end_;
  double length_ = 0.0;
};

AnalyticTube tube_along(std::string name, const Path& path, double step_mm, double radius_first,
                        double radius_last) {
  return make_tube(
      std::move(name), path.length(), step_mm, [&path](double s) { return path.sample(s); },
      linear(path.length(), radius_first, radius_last));
}

}  // namespace

AnalyticShape straight_tube(double length_mm, double radius_mm, double step_mm) {
  return tapered_tube(length_mm, radius_mm, radius_mm, step_mm);
}

AnalyticShape tapered_tube(double length_mm, double radius_start_mm, double radius_end_mm, double step_mm) {
  return shape_of(
      {make_tube("tube", length_mm, step_mm, along_z, linear(length_mm, radius_start_mm, radius_end_mm))});
}

AnalyticShape helix_tube(double helix_radius_mm, double pitch_mm, double turns, double radius_mm,
                         double step_mm) {
  require_positive(helix_radius_mm, "the helix radius");
  require_positive(turns, "the number of turns");
  const double rise = pitch_mm / (2.0 * pi), speed = std::hypot(helix_radius_mm, rise);
  const Curve curve = [=](double s) -> Sample {
    const double angle = s / speed;
    return {Vec3(helix_radius_mm * std::cos(angle), helix_radius_mm * std::sin(angle), rise * angle),
            Vec3(-helix_radius_mm * std::sin(angle), helix_radius_mm * std::cos(angle), rise) / speed};
  };
  const double length = 2.0 * pi * turns * speed;
  return shape_of({make_tube("helix", length, step_mm, curve, linear(length, radius_mm, radius_mm))});
}

AnalyticShape torus(double ring_radius_mm, double radius_mm, double step_mm) {
  require_positive(ring_radius_mm - radius_mm, "the hole's radius");
  const Curve curve = [=](double s) -> Sample {
    const double angle = s / ring_radius_mm;
    return {ring_radius_mm * Vec3(std::cos(angle), std::sin(angle), 0.0),
            Vec3(-std::sin(angle), std::cos(angle), 0.0)};
  };
  const double length = 2.0 * pi * ring_radius_mm;
  AnalyticTube tube = make_tube("torus", length, step_mm, curve, linear(length, radius_mm, radius_mm));
  tube.axis.points.back() = tube.axis.points.front();
  tube.axis.frames.back() = tube.axis.frames.front();  // a plane curve brings its normal back
  return shape_of({std::move(tube)});
}

AnalyticShape stenosed_tube(double length_mm, double radius_mm, double severity, double centre_mm,
                            double stenosis_length_mm, double step_mm) {
  require_positive(stenosis_length_mm, "the stenosis length");
  if (!(severity >= 0.0 && severity < 1.0)) {
    throw InvalidInput("the severity of the stenosis is " + std::to_string(severity) +
                       "; it must be in [0, 1)");
  }
  const Radius radius = [=](double s) {
    const double off = (s - centre_mm) / stenosis_length_mm;
    if (std::abs(off) >= 0.5) return radius_mm;
    return radius_mm * (1.0 - 0.5 * severity * (1.0 + std::cos(2.0 * pi * off)));
  };
  return shape_of({make_tube("stenosis", length_mm, step_mm, along_z, radius)});
}

AnalyticShape y_junction(double parent_length_mm, double child_length_mm, double parent_radius_mm,
                         double child_radius_mm, double angle_deg, double step_mm) {
  require_positive(child_length_mm, "the child's length");
  if (!(angle_deg > 0.0 && angle_deg < 180.0)) {
    throw InvalidInput("the angle of the junction is " + std::to_string(angle_deg) +
                       " degrees; it must be in (0, 180)");
  }
  const double half = radians(0.5 * angle_deg);
  // Bends over five parent radii, or half the child where that is short.
  const double bend = std::min(5.0 * parent_radius_mm, 0.5 * child_length_mm / half);
  const Path::Place start{Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX()};
  const auto child = [&](const char* name, double towards_deg) {
    Path path(start);
    path.arc(bend * half, bend, towards_deg).straight(child_length_mm - bend * half);
    return tube_along(name, path, step_mm, child_radius_mm, child_radius_mm);
  };
  const Curve up_to_origin = [=](double s) { return along_z(s - parent_length_mm); };
  return shape_of({make_tube("parent", parent_length_mm, step_mm, up_to_origin,
                             linear(parent_length_mm, parent_radius_mm, parent_radius_mm)),
                   child("child_1", 0.0), child("child_2", 180.0)});
}

AnalyticShape coronary_like_tree(double step_mm) {
  constexpr double first_radius = 2.0, last_radius = 0.8;
  Path main({Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX()});
  main.straight(6).arc(20, 28, 0).arc(20, 32, 200).arc(16, 25, 100).straight(8);
  const Radius main_radius = linear(main.length(), first_radius, last_radius);

  const auto branch_from = [&](double abscissa, double towards_deg, double angle_deg, double bend) {
    Path path(main.at(abscissa));
    path.arc(bend * radians(angle_deg), bend, towards_deg);
    return path;
  };
  Path first = branch_from(10, 100, 62, 15), second = branch_from(26, -80, 55, 15),
       third = branch_from(42, 90, 48, 16);
  first.arc(14, 30, -70).arc(10, 24, 40).straight(5);
  second.arc(14, 28, 80).arc(8, 30, -60).straight(5);
  third.arc(20, 26, 150).straight(6);
  const auto branch = [&](const char* name, const Path& path, double abscissa) {
    return tube_along(name, path, step_mm, 0.8 * main_radius(abscissa), last_radius);
  };
  return shape_of({tube_along("main", main, step_mm, first_radius, last_radius),
                   branch("branch_1", first, 10), branch("branch_2", second, 26),
                   branch("branch_3", third, 42)});
}

}  // namespace ostia::geometry
