#include "ostia/centerline/skeleton_radius.h"

#include "graph_editor.h"
#include "section_fit.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/frame.h"
#include "ostia/geometry/polyline.h"
#include "ostia/imaging/filters.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace ostia::centerline {
namespace {

using geometry::Vec2;
using imaging::FloatVolume;

constexpr int rounds = 3;
constexpr double least_support = 0.5;
constexpr double agrees = 0.2;                    // of the radius
constexpr double agrees_voxels = 0.6;             // or this part of the voxels' mean spacing
constexpr int table_reach = 6, table_steps = 40;  // standard deviations, and entries for each
constexpr double blurs_of_reach = 4.0;
constexpr double rounding = 1e-5;  // of the values: a smaller fall is none

// Vessels that the image cuts off end on the faces of its last voxels, half a voxel beyond their middles.
bool is_beyond(const imaging::Geometry& grid, const Vec3& point) {
  const Vec3 at = grid.index(point);
  for (std::size_t d = 0; d < 3; ++d) {
    const double i = at[static_cast<Eigen::Index>(d)];
    if (!(i >= -1.0 && i <= static_cast<double>(grid.size[d]))) return true;
  }
  return false;
}

// The part of the image about the graph, as floats, blurred.
template <class T, class Value>
FloatVolume surroundings(const SkeletonGraph& graph, const imaging::Volume<T>& image,
                         const SectionOptions& options, const Value& value, const core::TaskContext& task) {
  const imaging::Geometry& grid = image.geometry;
  imaging::Region region{grid.size, {0, 0, 0}};
  const double margin = options.largest_radius_mm + blurs_of_reach * options.sigma_mm;
  for (const SkeletonEdge& e : graph.edges)
    for (const Vec3& p : e.points) {
      if (is_beyond(grid, p))
        throw InvalidInput("sections: edge " + std::to_string(e.id) + " leaves the image at " +
                           detail::text(p) + "; is it another image's?");
      const Vec3 at = grid.index(p);
      for (std::size_t d = 0; d < 3; ++d) {
        const auto axis = static_cast<Eigen::Index>(d);
        const auto reach = static_cast<std::int64_t>(std::ceil(margin / grid.spacing[axis])) + 2;
        const std::int64_t centre = std::llround(at[axis]);
        region.lower[d] = std::clamp<std::int64_t>(centre - reach, 0, region.lower[d]);
        region.upper[d] = std::clamp<std::int64_t>(centre + reach + 1, region.upper[d], grid.size[d]);
      }
    }
  const imaging::Volume<T> part = imaging::cropped(image, region);
  FloatVolume result{part.geometry, std::vector<float>(part.voxels.size())};
  std::transform(part.voxels.begin(), part.voxels.end(), result.voxels.begin(), value);
  return imaging::gaussian_blurred(result, options.sigma_mm, task);
}

// Where values at equal steps fall most steeply, by a parabola through three differences.
double refined(double before, double at, double after) {
  const double bend = before - 2.0 * at + after;
  return bend < 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
}

class Prober {
 public:
  Prober(const FloatVolume& image, const SectionOptions& options) : image_(image), options_(options) {
    step_ = 0.25 * image.geometry.spacing.minCoeff();
    blur_ = options.correct_blur ? std::hypot(options.sigma_mm, options.image_blur_mm) : 0.0;
    slack_ = agrees_voxels * image.geometry.spacing.mean();
    if (blur_ > 0.0)
      for (int i = 0; i <= table_reach * table_steps; ++i)
        table_.push_back(unblurred_radius(blur_ * i / table_steps, blur_));
    for (int k = 0; k < options.rays; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / options.rays;
      directions_.emplace_back(std::cos(angle), std::sin(angle));
    }
  }

  SkeletonSection section(const Vec3& point, const Vec3& normal, double guess_mm) const {
    SkeletonSection result;
    result.centre = result.ellipse_centre = point;
    result.normal = normal;
    result.radius_mm = result.semi_major_mm = result.semi_minor_mm = guess_mm;
    const Vec3 u = geometry::initial_normal(normal), v = normal.cross(u);
    result.major_axis = u;
    Vec3 centre = point;
    std::vector<Vec2> wall;
    for (int round = 0; round < rounds; ++round) {
      const std::vector<double> profile = sampled(centre, u, v, guess_mm);
      const double circle = steepest(mean_over_rays(profile));
      if (circle <= 0.0) return result;
      wall = wall_points(profile, circle);
      const double radius = unblurred(circle);
      if (round + 1 == rounds) {
        finish(centre, u, v, radius, wall, result);
        break;
      }
      if (!options_.recentre) continue;
      const auto fit = robust_circle(wall, radius);
      if (!fit || fit->centre.norm() > radius) continue;
      const Vec3 moved = centre + fit->centre.x() * u + fit->centre.y() * v;
      if ((moved - point).norm() <= std::max(guess_mm, radius)) centre = moved;
    }
    return result;
  }

 private:
  std::size_t ray_count() const { return directions_.size(); }

  // Values on the rays, ray after ray.
  std::vector<double> sampled(const Vec3& centre, const Vec3& u, const Vec3& v, double guess_mm) const {
    const double reach =
        std::min(options_.largest_radius_mm, 2.0 * guess_mm + 6.0 * step_ + 3.0 * blur_ + slack_);
    const auto count = static_cast<std::size_t>(reach / step_) + 2;
    std::vector<double> values;
    values.reserve(count * ray_count());
    for (const Vec2& d : directions_) {
      const Vec3 ray = (d.x() * u + d.y() * v) * step_;
      for (std::size_t j = 0; j < count; ++j)
        values.push_back(
            imaging::sample(image_, centre + static_cast<double>(j) * ray, imaging::Interpolation::cubic));
    }
    return values;
  }

  std::vector<double> mean_over_rays(const std::vector<double>& values) const {
    const std::size_t count = values.size() / ray_count();
    std::vector<double> mean(count, 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) mean[i % count] += values[i];
    for (double& m : mean) m /= static_cast<double>(ray_count());
    return mean;
  }

  // The first relevant local maximum of the gradient towards the inside; 0 where there is none.
  double steepest(const std::vector<double>& mean) const {
    std::vector<double> fall(mean.size(), 0.0);
    for (std::size_t j = 1; j + 1 < mean.size(); ++j) fall[j] = mean[j - 1] - mean[j + 1];
    const double highest = *std::max_element(fall.begin(), fall.end());
    const double largest = std::abs(*std::max_element(
        mean.begin(), mean.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    if (!(highest > rounding * largest)) return 0.0;
    for (std::size_t j = 1; j + 2 < fall.size(); ++j) {
      if (fall[j] < options_.relevant * highest || fall[j] < fall[j - 1] || fall[j] < fall[j + 1]) continue;
      return step_ * (static_cast<double>(j) + refined(fall[j - 1], fall[j], fall[j + 1]));
    }
    return 0.0;
  }

  // On each ray the steepest place about the circle, if the ray falls there at all.
  std::vector<Vec2> wall_points(const std::vector<double>& values, double circle) const {
    const std::size_t count = values.size() / ray_count();
    const auto first = std::max<std::size_t>(1, static_cast<std::size_t>(0.4 * circle / step_));
    const std::size_t last =
        std::min(count - 2, static_cast<std::size_t>((1.8 * circle + slack_) / step_) + 1);
    std::vector<Vec2> points;
    for (std::size_t k = 0; k < ray_count(); ++k) {
      const double* ray = values.data() + k * count;
      std::size_t best = 0;
      double most = 0.0;
      for (std::size_t j = first; j <= last; ++j) {
        const double fall = ray[j - 1] - ray[j + 1];
        if (fall > most) {
          most = fall;
          best = j;
        }
      }
      if (best <= first || best >= last) continue;
      const double offset = refined(ray[best - 2] - ray[best], most, ray[best] - ray[best + 2]);
      points.push_back(unblurred(step_ * (static_cast<double>(best) + offset)) * directions_[k]);
    }
    return points;
  }

  // unblurred_radius by table, and where the disc is wide by its expansion; a part of the place at least.
  double unblurred(double steepest_mm) const {
    if (blur_ <= 0.0) return steepest_mm;
    const double at = steepest_mm / blur_, least = 0.25 * steepest_mm;
    if (at >= table_reach) return steepest_mm + blur_ * (0.5 / at - 0.375 / (at * at * at));
    const double entry = at * table_steps;
    const auto i = static_cast<std::size_t>(entry);
    const double t = entry - static_cast<double>(i);
    return std::max(least, (1.0 - t) * table_[i] + t * table_[i + 1]);
  }

  double allowed(double radius) const { return std::max(agrees * radius, slack_); }

  std::optional<detail::Circle> robust_circle(const std::vector<Vec2>& wall, double radius) const {
    const std::optional<detail::Circle> all = detail::fit_circle(wall);
    if (!all) return all;
    std::vector<Vec2> near;
    for (const Vec2& p : wall)
      if (std::abs((p - all->centre).norm() - radius) <= allowed(radius)) near.push_back(p);
    return near.size() * 2 >= ray_count() ? detail::fit_circle(near) : all;
  }

  void finish(const Vec3& centre, const Vec3& u, const Vec3& v, double radius, const std::vector<Vec2>& wall,
              SkeletonSection& result) const {
    result.centre = result.ellipse_centre = centre;
    result.radius_mm = result.semi_major_mm = result.semi_minor_mm = radius;
    std::size_t on_circle = 0, on_ellipse = 0;
    for (const Vec2& p : wall) on_circle += std::abs(p.norm() - radius) <= allowed(radius) ? 1U : 0U;
    if (const auto e = detail::fit_ellipse(wall)) {
      for (const Vec2& p : wall)
        on_ellipse += detail::relative_miss(*e, p) * (p - e->centre).norm() <= allowed(radius) ? 1U : 0U;
      result.ellipse_centre = centre + e->centre.x() * u + e->centre.y() * v;
      result.major_axis = e->major.x() * u + e->major.y() * v;
      result.semi_major_mm = e->semi_major;
      result.semi_minor_mm = e->semi_minor;
    }
    result.support = static_cast<double>(std::max(on_circle, on_ellipse)) / static_cast<double>(ray_count());
    result.measured = result.support >= least_support;
  }

  const FloatVolume& image_;
  const SectionOptions& options_;
  double step_ = 0.1, blur_ = 0.0, slack_ = 0.0;
  std::vector<Vec2> directions_;
  std::vector<double> table_;
};

// The direction of the line about each point, by the chord over `half_mm` (or the radius) to either side.
Vec3 direction_at(const std::vector<Vec3>& points, double s, double whole, double half_mm) {
  const Vec3 a = geometry::at_abscissa(points, std::max(0.0, s - half_mm)).point;
  const Vec3 b = geometry::at_abscissa(points, std::min(whole, s + half_mm)).point;
  const double norm = (b - a).norm();
  return norm > 1e-9 ? Vec3((b - a) / norm) : Vec3(Vec3::UnitZ());
}

// Radii where nothing was measured from the measured ones before and after; how many.
std::int64_t interpolate(const std::vector<Vec3>& points, std::vector<SkeletonSection>& sections) {
  const std::vector<double> s = geometry::abscissas(points);
  std::int64_t count = 0;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    SkeletonSection& here = sections[i];
    if (here.measured) continue;
    ++count;
    std::size_t before = i, after = i;
    while (before > 0 && !sections[before].measured) --before;
    while (after + 1 < sections.size() && !sections[after].measured) ++after;
    const bool has_before = sections[before].measured, has_after = sections[after].measured;
    if (!has_before && !has_after) continue;
    if (!has_before) before = after;
    if (!has_after) after = before;
    const double t = before == after ? 0.0 : (s[i] - s[before]) / (s[after] - s[before]);
    const auto between = [&](double a, double b) { return (1.0 - t) * a + t * b; };
    here.centre = here.ellipse_centre = points[i];
    here.radius_mm = between(sections[before].radius_mm, sections[after].radius_mm);
    here.semi_major_mm = between(sections[before].semi_major_mm, sections[after].semi_major_mm);
    here.semi_minor_mm = between(sections[before].semi_minor_mm, sections[after].semi_minor_mm);
    const Vec3& axis = sections[t < 0.5 ? before : after].major_axis;
    const Vec3 in_plane = axis - axis.dot(here.normal) * here.normal;
    if (in_plane.norm() > 1e-6) here.major_axis = in_plane.normalized();
  }
  return count;
}

// Points to the middles of their sections, the ends excepted; not where the line would stand still.
void recentre(SkeletonEdge& e, const std::vector<SkeletonSection>& sections) {
  for (std::size_t i = 1; i + 1 < e.points.size(); ++i) {
    if (!sections[i].measured) continue;
    const Vec3& to = sections[i].centre;
    if ((to - e.points[i - 1]).norm() > 1e-6 && (to - e.points[i + 1]).norm() > 1e-6) e.points[i] = to;
  }
}

MeasuredSkeleton measured_in(const SkeletonGraph& graph, const FloatVolume& image,
                             const SectionOptions& options, const core::TaskContext& task) {
  MeasuredSkeleton result;
  result.graph = graph;
  const Prober prober(image, options);
  std::size_t done = 0;
  for (SkeletonEdge& e : result.graph.edges) {
    const std::vector<double> s = geometry::abscissas(e.points);
    std::vector<SkeletonSection> sections(e.points.size());
    core::parallel_chunks(e.points.size(), 8, [&](std::size_t first, std::size_t last) {
      task.throw_if_cancelled();
      for (std::size_t i = first; i < last; ++i) {
        const double half = std::max(options.direction_mm, e.radius_mm[i]);
        sections[i] =
            prober.section(e.points[i], direction_at(e.points, s[i], s.back(), half), e.radius_mm[i]);
      }
    });
    result.interpolated += interpolate(e.points, sections);
    for (std::size_t i = 0; i < sections.size(); ++i) e.radius_mm[i] = sections[i].radius_mm;
    if (options.recentre && options.move_points) recentre(e, sections);
    result.sections.push_back(std::move(sections));
    task.set_progress(static_cast<double>(++done) / static_cast<double>(graph.edges.size()));
  }
  for (SkeletonNode& n : result.graph.nodes) {
    double widest = 0.0;
    for (const SkeletonEdge& e : result.graph.edges) {
      if (e.from == n.id) widest = std::max(widest, e.radius_mm.front());
      if (e.to == n.id) widest = std::max(widest, e.radius_mm.back());
    }
    if (widest > 0.0) n.radius_mm = widest;
  }
  return result;
}

template <class T, class Value>
MeasuredSkeleton measured_on(const SkeletonGraph& graph, const imaging::Volume<T>& image,
                             const SectionOptions& options, const Value& value,
                             const core::TaskContext& task) {
  validate(options);
  detail::require_sound(graph, "sections");
  if (image.voxels.empty() || static_cast<std::int64_t>(image.voxels.size()) != image.geometry.voxels())
    throw InvalidInput("sections: the image's geometry does not fit its " +
                       std::to_string(image.voxels.size()) + " voxels");
  task.set_stage("sections");
  task.throw_if_cancelled();
  if (graph.edges.empty()) return {graph, {}, 0};
  const FloatVolume blurred = surroundings(graph, image, options, value, task.sub(0.0, 0.3));
  return measured_in(graph, blurred, options, task.sub(0.3, 1.0));
}

}  // namespace

double unblurred_radius(double steepest_mm, double sigma_mm) {
  const double s = steepest_mm, variance = sigma_mm * sigma_mm;
  if (!(s > sigma_mm)) return 0.0;
  // d/dr of r0 / sigma^2 exp(-(r^2 + r0^2) / (2 sigma^2)) I1(r r0 / sigma^2) is zero at s.
  const auto outside = [&](double r0) {
    const double z = s * r0 / variance;
    const double ratio =
        z > 50.0 ? 1.0 + 0.5 / z + 0.375 / (z * z) : std::cyl_bessel_i(0.0, z) / std::cyl_bessel_i(1.0, z);
    return r0 * ratio > s + variance / s;
  };
  double low = 1e-6 * s, high = 2.0 * s;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (outside(middle) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

void validate(const SectionOptions& o) {
  const char* what = "sections";
  detail::require(o.sigma_mm > 0.0 && o.sigma_mm <= 5.0, what, "sigma_mm", o.sigma_mm, "(0, 5] mm");
  detail::require(o.rays >= 8 && o.rays <= 256, what, "rays", o.rays, "[8, 256]");
  detail::require(o.largest_radius_mm > 0.0 && o.largest_radius_mm <= 100.0, what, "largest_radius_mm",
                  o.largest_radius_mm, "(0, 100] mm");
  detail::require(o.direction_mm > 0.0 && o.direction_mm <= 20.0, what, "direction_mm", o.direction_mm,
                  "(0, 20] mm");
  detail::require(o.relevant > 0.0 && o.relevant <= 1.0, what, "relevant", o.relevant, "(0, 1]");
  detail::require(o.image_blur_mm >= 0.0 && o.image_blur_mm <= 5.0, what, "image_blur_mm", o.image_blur_mm,
                  "[0, 5] mm");
}

MeasuredSkeleton measured(const SkeletonGraph& graph, const imaging::MaskVolume& mask,
                          const SectionOptions& options, const core::TaskContext& task) {
  return measured_on(
      graph, mask, options, [](std::uint8_t v) { return v != 0 ? 1.0F : 0.0F; }, task);
}

MeasuredSkeleton measured(const SkeletonGraph& graph, const imaging::ImageVolume& image,
                          const SectionOptions& options, const core::TaskContext& task) {
  return measured_on(
      graph, image, options, [](std::int16_t v) { return static_cast<float>(v); }, task);
}

MeasuredSkeleton measured(const SkeletonGraph& graph, const FloatVolume& image, const SectionOptions& options,
                          const core::TaskContext& task) {
  return measured_on(
      graph, image, options, [](float v) { return v; }, task);
}

}  // namespace ostia::centerline
