#include "wall/between.h"

#include "wall/sampling.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::lumen {
namespace {

using std::numbers::pi;
constexpr double together_rad = 0.2;  // samples seen so near to each other are one knot
constexpr double gap_share = 1.6;     // of the spacing: a longer way around without samples is a gap

// A place of the wall across the vessel, its angle counted from the new line.
struct Knot {
  double turn = 0.0, rho_mm = 0.0, slope = 0.0;  // slope: d rho / d s
};

enum class Trust { all, drawn };

// The kept wall around an abscissa, moved there along its tangent planes; all of it, or what was drawn alone.
std::vector<Knot> knots_at(const std::vector<WallPlace>& kept, Trust trust, double s_mm, double theta,
                           double window_mm) {
  struct Weighted {
    Knot knot;
    double weight;
  };
  std::vector<Weighted> seen;
  for (const WallPlace& place : kept) {
    const double away = s_mm - place.sample->s_mm;
    if (std::abs(away) >= window_mm) continue;
    if (trust == Trust::drawn && place.sample->origin != SampleOrigin::edit) continue;
    double turn = angle_between(place.theta, theta);
    if (turn < 0.0) turn += 2.0 * pi;
    const double near = 1.0 - std::abs(away) / window_mm;
    seen.push_back({{turn, place.rho_mm + place.slope * away, place.slope}, near * near});
  }
  std::sort(seen.begin(), seen.end(),
            [](const Weighted& a, const Weighted& b) { return a.knot.turn < b.knot.turn; });
  std::vector<Knot> knots;
  for (std::size_t i = 0; i < seen.size();) {
    Knot mean{0.0, 0.0, 0.0};
    double sum = 0.0;
    const double first = seen[i].knot.turn;
    for (; i < seen.size() && seen[i].knot.turn < first + together_rad; ++i) {
      mean.turn += seen[i].weight * seen[i].knot.turn;
      mean.rho_mm += seen[i].weight * seen[i].knot.rho_mm;
      mean.slope += seen[i].weight * seen[i].knot.slope;
      sum += seen[i].weight;
    }
    if (!(sum > 1e-6)) continue;
    mean = {mean.turn / sum, mean.rho_mm / sum, mean.slope / sum};
    if (mean.turn > together_rad && mean.turn < 2.0 * pi - together_rad && mean.rho_mm > least_radius_mm)
      knots.push_back(mean);
  }
  return knots;
}

// The C2 cubic through knots that close after a whole turn.
class PeriodicSpline {
 public:
  explicit PeriodicSpline(std::vector<Knot> knots) : knots_(std::move(knots)) {
    const auto n = static_cast<Eigen::Index>(knots_.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd right(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Index before = (i + n - 1) % n, after = (i + 1) % n;
      const double h0 = width(before), h1 = width(i);
      matrix(i, before) += h0;
      matrix(i, i) += 2.0 * (h0 + h1);
      matrix(i, after) += h1;
      right[i] = 6.0 * ((rho(after) - rho(i)) / h1 - (rho(i) - rho(before)) / h0);
    }
    bend_ = matrix.partialPivLu().solve(right);
  }
  double width(Eigen::Index i) const {
    const auto k = static_cast<std::size_t>(i);
    return k + 1 < knots_.size() ? knots_[k + 1].turn - knots_[k].turn
                                 : knots_.front().turn + 2.0 * pi - knots_[k].turn;
  }
  // Radius and its derivative by the angle, at a share t of the piece after knot i.
  std::pair<double, double> at(Eigen::Index i, double t) const {
    const Eigen::Index next = (i + 1) % bend_.size();
    const double h = width(i), u = 1.0 - t, a = bend_[i], b = bend_[next];
    const double value =
        u * rho(i) + t * rho(next) + h * h / 6.0 * ((u * u * u - u) * a + (t * t * t - t) * b);
    const double slope =
        (rho(next) - rho(i)) / h + h / 6.0 * ((1.0 - 3.0 * u * u) * a + (3.0 * t * t - 1.0) * b);
    return {value, slope};
  }

  // At an angle from the first knot; no farther from the knots' radii than a third.
  double radius(double turn) const {
    double past = std::fmod(turn, 2.0 * pi);
    if (past < 0.0) past += 2.0 * pi;
    std::size_t i = 0;
    while (i + 1 < knots_.size() && knots_[i + 1].turn <= past) ++i;
    const auto k = static_cast<Eigen::Index>(i);
    const double a = knots_[i].rho_mm, b = knots_[(i + 1) % knots_.size()].rho_mm;
    return std::clamp(at(k, (past - knots_[i].turn) / width(k)).first, 0.7 * std::min(a, b),
                      1.3 * std::max(a, b));
  }

 private:
  std::vector<Knot> knots_;
  Eigen::VectorXd bend_;  // second derivatives
  double rho(Eigen::Index i) const { return knots_[static_cast<std::size_t>(i)].rho_mm; }
};

void fill(const AxisCurve& axis, double s_mm, double theta, const std::vector<Knot>& knots, std::size_t i,
          const PeriodicSpline& spline, double spacing_mm, std::vector<SurfaceSample>& out) {
  const Knot &a = knots[i], &b = knots[(i + 1) % knots.size()];
  const double width = spline.width(static_cast<Eigen::Index>(i)), mean = 0.5 * (a.rho_mm + b.rho_mm);
  if (width * mean < gap_share * spacing_mm) return;
  const auto pieces = static_cast<int>(std::max(2.0, std::round(width * mean / spacing_mm)));
  const geometry::Frame frame = axis.frame(s_mm);
  const Vec3 bend = axis.curvature_vector(s_mm);
  for (int k = 1; k < pieces; ++k) {
    const double t = static_cast<double>(k) / pieces, at = theta + a.turn + t * width;
    const auto [value, around] = spline.at(static_cast<Eigen::Index>(i), t);
    const double rho =
        std::clamp(value, 0.7 * std::min(a.rho_mm, b.rho_mm), 1.3 * std::max(a.rho_mm, b.rho_mm));
    const Vec3 radial = geometry::radial_direction(frame, at);
    const double along = (1.0 - t) * a.slope + t * b.slope;
    const double stretch = std::max(0.1, 1.0 - rho * bend.dot(radial));
    SurfaceSample sample;
    sample.position = axis.point(s_mm) + rho * radial;
    sample.normal = (radial - around / rho * geometry::radial_direction(frame, at + 0.5 * pi) -
                     along / stretch * frame.tangent)
                        .normalized();
    sample.s_mm = s_mm;
    sample.origin = SampleOrigin::start;
    out.push_back(sample);
  }
}

}  // namespace

std::vector<SurfaceSample> samples_between(const AxisCurve& axis, const std::vector<WallPlace>& kept,
                                           const std::vector<SurfaceSample>& line, double spacing_mm) {
  std::vector<SurfaceSample> out;
  for (const SurfaceSample& drawn : line) {
    const WallPlace place = wall_place(axis, drawn);
    const Knot own{0.0, place.rho_mm, place.slope};
    const auto knots_of = [&](Trust trust) {
      std::vector<Knot> knots = knots_at(kept, trust, drawn.s_mm, place.theta, 1.2 * spacing_mm);
      knots.insert(knots.begin(), own);
      return knots;
    };
    const std::vector<Knot> all = knots_of(Trust::all), lines = knots_of(Trust::drawn);
    if (all.size() < 2) continue;
    const PeriodicSpline through_all(all), through_lines(lines);
    // Where the next wall is drawn, too, the spline is of drawn lines alone: what is still to be corrected
    // elsewhere does not bend it.
    const bool drawn_after = lines.size() > 1 && lines[1].turn < all[1].turn + together_rad;
    const bool drawn_before = lines.size() > 1 && lines.back().turn > all.back().turn - together_rad;
    const auto side = [&](bool is_drawn, bool after) {
      const std::vector<Knot>& knots = is_drawn ? lines : all;
      fill(axis, drawn.s_mm, place.theta, knots, after ? 0 : knots.size() - 1,
           is_drawn ? through_lines : through_all, spacing_mm, out);
    };
    side(drawn_after, true);
    side(drawn_before, false);
  }
  return out;
}

namespace {

bool has_new_wall(const WallChange& change, double s_mm, double within_mm) {
  return std::any_of(change.added().begin(), change.added().end(), [&](const SurfaceSample& sample) {
    return sample.origin == SampleOrigin::edit && std::abs(sample.s_mm - s_mm) <= within_mm;
  });
}

bool runs_past(const WallChange& change, double s_mm, double sign) {
  const AxisCurve& axis = *change.vessel().axis;
  const Vec3 end = axis.point(s_mm), tangent = axis.frame(s_mm).tangent;
  return std::any_of(change.added().begin(), change.added().end(), [&](const SurfaceSample& sample) {
    return std::abs(sample.s_mm - s_mm) < 1e-6 && sign * (sample.position - end).dot(tangent) > 0.1;
  });
}

void renew_cap(WallChange& change, double s_mm, CapSide side) {
  const VesselLumen& vessel = change.vessel();
  const AxisCurve& axis = *vessel.axis;
  const double sign = side == CapSide::beyond ? 1.0 : -1.0,
               middle = 0.5 * (vessel.own_from_mm + axis.length());
  std::vector<std::size_t> caps;
  for (std::size_t i = 0; i < vessel.samples.size(); ++i)
    if (vessel.samples[i].origin == SampleOrigin::cap && sign * (vessel.samples[i].s_mm - middle) > 0.0)
      caps.push_back(i);
  const double wide = sample_spacing_mm(vessel, farthest_mm);
  if (caps.empty() || !has_new_wall(change, s_mm, 0.75 * wide) || runs_past(change, s_mm, sign)) return;

  std::vector<SurfaceSample> samples = change.kept();
  samples.insert(samples.end(), change.added().begin(), change.added().end());
  std::vector<WallPlace> places;
  for (const SurfaceSample& sample : samples)
    if (sample.origin != SampleOrigin::cap && std::abs(sample.s_mm - s_mm) < 1.5 * wide)
      places.push_back(wall_place(axis, sample));
  if (places.empty()) return;
  const auto nearest =
      std::min_element(places.begin(), places.end(), [&](const WallPlace& a, const WallPlace& b) {
        return std::abs(a.sample->s_mm - s_mm) < std::abs(b.sample->s_mm - s_mm);
      });
  const double theta = nearest->theta;
  std::vector<Knot> knots = knots_at(places, Trust::all, s_mm, theta, 1.5 * wide);
  if (knots.size() < 3) return;
  const double away = s_mm - nearest->sample->s_mm;
  knots.insert(knots.begin(), {0.0, nearest->rho_mm + nearest->slope * away, nearest->slope});
  const PeriodicSpline profile(std::move(knots));
  change.remove(caps);
  const RadialWall wall = [&](double, double at) {
    return std::max(least_radius_mm, profile.radius(at - theta));
  };
  for (const SurfaceSample& sample : cap_of(axis, wall, s_mm, side, wide, 8)) change.add(sample);
}

}  // namespace

void renew_caps(WallChange& change) {
  const VesselLumen& vessel = change.vessel();
  renew_cap(change, vessel.own_from_mm, CapSide::before);
  renew_cap(change, vessel.axis->length(), CapSide::beyond);
}

}  // namespace ostia::lumen
