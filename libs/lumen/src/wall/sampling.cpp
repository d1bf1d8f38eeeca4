#include "wall/sampling.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ostia::lumen {
namespace {

using std::numbers::pi;
constexpr double slope_step_mm = 0.05, slope_step_rad = 0.02;
constexpr double grid_step_mm = 0.1;  // the density of rings is found at these steps
constexpr int around_table = 64;
// Between rings a straight chord may miss the wall by this share of the spacing.
constexpr double sag_share = 0.01;
// How fast the distance between rings may change along the vessel.
constexpr double spacing_slope = 0.5;
// A sample nearer to another than this share of the spacing tells nothing new.
constexpr double crowded_ring_share = 0.45;
// A place this deep inside another ring's wall is not on the vessel's wall.
constexpr double covered_mm = 1e-3;

/// The wall with its derivatives.
class Wall {
 public:
  Wall(const AxisCurve& axis, const RadialWall& radius) : axis_(&axis), radius_(&radius) {}
  double radius(double s, double theta) const {
    const double r = (*radius_)(s, theta);
    if (!(r > 0.0) || !std::isfinite(r))
      throw InvalidInput("the wall is " + std::to_string(r) + " mm from the axis at " + std::to_string(s) +
                         " mm; a wall needs a positive distance everywhere");
    return r;
  }
  double along(double s, double theta) const {
    return slope_of([&](double at) { return radius(at, theta); }, s, 0.0, axis_->length(), slope_step_mm);
  }
  double around(double s, double theta) const {
    return slope_of([&](double at) { return radius(s, at); }, theta, theta - 1.0, theta + 1.0,
                    slope_step_rad);
  }
  double mean(double s) const {
    double sum = 0.0;
    for (int k = 0; k < 16; ++k) sum += radius(s, 2.0 * pi * k / 16.0);
    return sum / 16.0;
  }
  /// How much longer than the axis the wall is there: negative where the axis bends more tightly.
  double stretch(double s, double theta, double r) const {
    return 1.0 - r * axis_->curvature_vector(s).dot(geometry::radial_direction(axis_->frame(s), theta));
  }
  const AxisCurve& axis() const { return *axis_; }

 private:
  const AxisCurve* axis_;
  const RadialWall* radius_;
};

/// Normal of c(s) + r(s, theta) d(s, theta) with frames that do not turn about the axis:
/// d - r_theta / r e - r_s / (1 - r k.d) T.
SurfaceSample sample_at(const Wall& wall, double s, double theta) {
  const geometry::Frame frame = wall.axis().frame(s);
  const Vec3 d = geometry::radial_direction(frame, theta);
  const Vec3 e = geometry::radial_direction(frame, theta + 0.5 * pi);
  const double r = wall.radius(s, theta);
  SurfaceSample sample;
  sample.position = wall.axis().place(s, theta, r);
  sample.normal =
      (d - wall.around(s, theta) / r * e - wall.along(s, theta) / wall.stretch(s, theta, r) * frame.tangent)
          .normalized();
  sample.s_mm = s;
  return sample;
}

/// The distance between rings that the wall asks for at an abscissa.
double wanted_spacing(const Wall& wall, double s, const SamplingOptions& options) {
  const double half = 2.0 * grid_step_mm, length = wall.axis().length();
  const double low = std::max(0.0, s - half), high = std::min(length, s + half);
  const double kappa = wall.axis().curvature_vector(s).norm();
  double wanted = std::min(options.spacing_mm, 2.0 * pi * wall.mean(s) / options.least_around);
  for (int k = 0; k < 8; ++k) {
    const double theta = 2.0 * pi * k / 8.0;
    const double centre = 0.5 * (low + high), h = 0.5 * (high - low);
    const double r = wall.radius(centre, theta);
    const double before = wall.radius(low, theta), after = wall.radius(high, theta);
    const double slope = (after - before) / (2.0 * h);
    const double bend = std::abs(after - 2.0 * r + before) / (h * h);
    const double sag = sag_share * options.spacing_mm;
    if (bend > 0.0) wanted = std::min(wanted, std::sqrt(8.0 * sag / bend));
    wanted = std::min(wanted, options.spacing_mm / std::hypot(1.0, slope) / (1.0 + 0.5 * r * kappa));
  }
  return std::clamp(wanted, options.least_spacing_mm, options.spacing_mm);
}

struct SampleRing {
  double s = 0.0, spacing = 0.0;
};

/// Rings from end to end, as many as the density's integral asks for.
std::vector<SampleRing> rings_of(const Wall& wall, double from, double to, const SamplingOptions& options) {
  const auto cells =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil((to - from) / grid_step_mm)));
  const double step = (to - from) / static_cast<double>(cells);
  std::vector<double> spacing(cells + 1);
  for (std::size_t i = 0; i <= cells; ++i)
    spacing[i] = wanted_spacing(wall, from + step * static_cast<double>(i), options);
  for (std::size_t i = 1; i <= cells; ++i)
    spacing[i] = std::min(spacing[i], spacing[i - 1] + spacing_slope * step);
  for (std::size_t i = cells; i-- > 0;)
    spacing[i] = std::min(spacing[i], spacing[i + 1] + spacing_slope * step);

  std::vector<double> passed(cells + 1, 0.0);
  for (std::size_t i = 1; i <= cells; ++i)
    passed[i] = passed[i - 1] + 0.5 * step * (1.0 / spacing[i - 1] + 1.0 / spacing[i]);
  const auto count = std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(passed.back() - 1e-9)));
  std::vector<SampleRing> rings;
  std::size_t i = 1;
  for (std::size_t k = 0; k <= count; ++k) {
    const double want = passed.back() * static_cast<double>(k) / static_cast<double>(count);
    while (i < cells && passed[i] < want) ++i;
    const double t = (want - passed[i - 1]) / (passed[i] - passed[i - 1]);
    const double s = from + step * (static_cast<double>(i - 1) + std::clamp(t, 0.0, 1.0));
    rings.push_back({k == count ? to : s, spacing[i]});
  }
  return rings;
}

/// Angles of a ring, equally far apart on the wall; odd rings lie between even ones.
std::vector<double> angles_of(const Wall& wall, const SampleRing& ring, bool odd, int least_around) {
  std::array<double, around_table + 1> length{};
  const auto place = [&](int k) {
    const double theta = 2.0 * pi * k / around_table, r = wall.radius(ring.s, theta);
    return geometry::Vec2(r * std::cos(theta), r * std::sin(theta));
  };
  for (int k = 1; k <= around_table; ++k) length[k] = length[k - 1] + (place(k) - place(k - 1)).norm();
  const int count = std::max(least_around, static_cast<int>(std::ceil(length.back() / ring.spacing - 1e-6)));
  std::vector<double> angles;
  int k = 1;
  for (int i = 0; i < count; ++i) {
    const double want = length.back() * (i + (odd ? 0.5 : 0.0)) / count;
    while (k < around_table && length[k] < want) ++k;
    const double t = (want - length[k - 1]) / (length[k] - length[k - 1]);
    angles.push_back(2.0 * pi * (k - 1 + t) / around_table);
  }
  return angles;
}

/// Whether a place lies inside the wall of another stretch of the same vessel.
bool covered(const Wall& wall, const SurfaceSample& sample, double from, double to) {
  const double reach = (sample.position - wall.axis().point(sample.s_mm)).norm() + 1.0;
  for (const geometry::AxisFoot& foot : wall.axis().feet(sample.position, reach)) {
    if (foot.past_end || foot.s_mm < from || foot.s_mm > to) continue;
    if (foot.rho_mm < wall.radius(foot.s_mm, foot.theta) - covered_mm) return true;
  }
  return false;
}

/// Keeps what is no nearer than `least` to any of the last samples kept.
bool crowded(const std::vector<SurfaceSample>& kept, const SurfaceSample& sample, double least) {
  constexpr std::size_t looked_at = 400;
  const std::size_t first = kept.size() > looked_at ? kept.size() - looked_at : 0;
  return std::any_of(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.end(),
                     [&](const SurfaceSample& other) {
                       return (other.position - sample.position).squaredNorm() < least * least;
                     });
}

SurfaceSample cap_sample(const Wall& wall, double at, double theta, double polar, double height,
                         double sign) {
  const geometry::Frame frame = wall.axis().frame(at);
  const Vec3 d = geometry::radial_direction(frame, theta);
  const Vec3 e = geometry::radial_direction(frame, theta + 0.5 * pi);
  const double r = wall.radius(at, theta), c = std::cos(polar), h = std::sin(polar);
  SurfaceSample sample;
  sample.origin = SampleOrigin::cap;
  sample.position = wall.axis().point(at) + r * c * d + sign * height * h * frame.tangent;
  sample.normal =
      (height * c * (d - wall.around(at, theta) / r * e) + sign * r * h * frame.tangent).normalized();
  const double guess = std::clamp(at + sign * height * h, 0.0, wall.axis().length());
  const auto foot = wall.axis().foot_near(sample.position, guess, 2.0 * height);
  sample.s_mm = foot ? foot->s_mm : guess;
  return sample;
}

void check_stretch(const AxisCurve& axis, double from_mm, double to_mm) {
  if (!(from_mm >= 0.0) || !(to_mm <= axis.length() + 1e-6) || !(to_mm > from_mm))
    throw InvalidInput("a wall was asked for from " + std::to_string(from_mm) + " to " +
                       std::to_string(to_mm) + " mm of an axis of " + std::to_string(axis.length()) + " mm");
}

}  // namespace

EvenTable::EvenTable(double from, double step, std::vector<double> values)
    : from_(from), step_(step), values_(std::move(values)) {}

double EvenTable::at(double s) const {
  const auto last = static_cast<std::ptrdiff_t>(values_.size()) - 1;
  if (last < 1) return values_.front();
  const double x = std::clamp((s - from_) / step_, 0.0, static_cast<double>(last));
  const auto i = std::min(last - 1, static_cast<std::ptrdiff_t>(x));
  const double t = x - static_cast<double>(i);
  const auto value = [&](std::ptrdiff_t k) {  // beyond the ends it runs straight on
    if (k < 0) return 2.0 * values_[0] - values_[1];
    if (k > last) return 2.0 * values_[last] - values_[last - 1];
    return values_[static_cast<std::size_t>(k)];
  };
  const double a = value(i), b = value(i + 1);
  const double ma = 0.5 * (b - value(i - 1)), mb = 0.5 * (value(i + 2) - a);
  const double u = 1.0 - t;
  return u * u * (1.0 + 2.0 * t) * a + t * t * (3.0 - 2.0 * t) * b + t * u * (u * ma - t * mb);
}

double slope_of(const std::function<double(double)>& f, double s, double low, double high, double step) {
  const double h = std::min(step, (high - low) / 4.0);
  const double first = std::clamp(s - 2.0 * h, low, high - 4.0 * h);
  const double x = (s - first) / h;
  double slope = 0.0;
  for (int i = 0; i < 5; ++i) {  // derivative of Lagrange's polynomials
    double weight = 0.0, below = 1.0;
    for (int j = 0; j < 5; ++j) {
      if (j == i) continue;
      below *= i - j;
      double term = 1.0;
      for (int k = 0; k < 5; ++k) {
        if (k != i && k != j) term *= x - k;
      }
      weight += term;
    }
    slope += weight / below * f(first + h * i);
  }
  return slope / h;
}

std::vector<SurfaceSample> cap_of(const AxisCurve& axis, const RadialWall& radius, double at, CapSide side,
                                  double spacing_mm, int least_around) {
  const Wall wall(axis, radius);
  const double height = wall.mean(at), sign = side == CapSide::beyond ? 1.0 : -1.0;
  const int steps = std::max(2, static_cast<int>(std::lround(0.5 * pi * height / spacing_mm)));
  std::vector<SurfaceSample> samples;
  for (int k = 1; k < steps; ++k) {
    const double polar = 0.5 * pi * k / steps, around = 2.0 * pi * height * std::cos(polar);
    const int least = std::max(4, static_cast<int>(std::lround(least_around * std::cos(polar))));
    const int count = std::max(least, static_cast<int>(std::ceil(around / spacing_mm - 1e-6)));
    for (int i = 0; i < count; ++i)
      samples.push_back(
          cap_sample(wall, at, 2.0 * pi * (i + (k % 2 ? 0.5 : 0.0)) / count, polar, height, sign));
  }
  samples.push_back(cap_sample(wall, at, 0.0, 0.5 * pi, height, sign));
  return samples;
}

void validate(const SamplingOptions& options) {
  if (!(options.spacing_mm >= 0.1 && options.spacing_mm <= 5.0))
    throw InvalidInput("samples are " + std::to_string(options.spacing_mm) + " mm apart; choose 0.1 to 5 mm");
  if (!(options.least_spacing_mm >= 0.05 && options.least_spacing_mm <= options.spacing_mm))
    throw InvalidInput("the least spacing of samples is " + std::to_string(options.least_spacing_mm) +
                       " mm; choose 0.05 mm up to the spacing, " + std::to_string(options.spacing_mm) +
                       " mm");
  if (!(options.least_around >= 5 && options.least_around <= 128))
    throw InvalidInput("a ring has at least " + std::to_string(options.least_around) +
                       " samples; choose 5 to 128");
}

std::vector<SurfaceSample> samples_of(const AxisCurve& axis, const RadialWall& radius, double from_mm,
                                      double to_mm, std::int64_t first_id, const SamplingOptions& options) {
  validate(options);
  check_stretch(axis, from_mm, to_mm);
  to_mm = std::min(to_mm, axis.length());
  const Wall wall(axis, radius);
  const std::vector<SampleRing> rings = rings_of(wall, from_mm, to_mm, options);
  std::vector<SurfaceSample> samples;
  const auto keep = [&](const SurfaceSample& sample, double gap) {
    if (covered(wall, sample, from_mm, to_mm) || crowded(samples, sample, crowded_ring_share * gap)) return;
    samples.push_back(sample);
  };
  const auto cap = [&](double at, CapSide side, double spacing) {
    for (const SurfaceSample& sample : cap_of(axis, radius, at, side, spacing, options.least_around))
      keep(sample, spacing);
  };
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const SampleRing& ring = rings[k];
    const std::vector<double> angles = angles_of(wall, ring, k % 2 == 1, options.least_around);
    const double gap =
        std::min(ring.spacing, 2.0 * pi * wall.mean(ring.s) / static_cast<double>(angles.size()));
    if (k == 0) cap(from_mm, CapSide::before, gap);
    for (const double theta : angles) {
      const double r = wall.radius(ring.s, theta);
      if (wall.stretch(ring.s, theta, r) <= 0.05) continue;
      keep(sample_at(wall, ring.s, theta), gap);
    }
    if (k + 1 == rings.size()) cap(to_mm, CapSide::beyond, gap);
  }
  std::stable_sort(samples.begin(), samples.end(),
                   [](const SurfaceSample& a, const SurfaceSample& b) { return a.s_mm < b.s_mm; });
  for (SurfaceSample& sample : samples) sample.id = first_id++;
  return samples;
}

}  // namespace ostia::lumen
