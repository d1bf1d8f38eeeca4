#include "ostia/analysis/plaque.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace ostia::analysis {
namespace {

using std::numbers::pi;
// How far tissue may be from the ray's mean against the image's noise: what a piece that the blur leaves
// little of is drawn to the mean by.
constexpr double ridge = 0.0625;  // (25 HU / 100 HU)^2

void require(bool fine, const char* name, double value, const char* range) {
  if (fine && std::isfinite(value)) return;
  char text[200];
  std::snprintf(text, sizeof text, "plaque: %s is %g; it has to be in %s", name, value, range);
  throw InvalidInput(text);
}

/// Share of a disc of radius R in a Gaussian blur, to first order in the edge's bend.
double blurred_share(double radius_mm, double rho_mm, double sigma_mm) {
  const double edge = radius_mm - 0.5 * sigma_mm * sigma_mm / std::max(radius_mm, sigma_mm);
  return 0.5 * std::erfc((rho_mm - edge) / (sigma_mm * std::numbers::sqrt2));
}

/// A ray through the wall: pieces from the lumen outwards.
struct WallRay {
  double lumen_mm = 0.0, outer_mm = 0.0;
  std::vector<double> rho_mm, hu;
};

/// Takes away what a blur mixes in from lumen and fat. The ray's mean tissue is the least-squares one; each
/// piece departs from it as far as what is left of it tells.
void unmix(WallRay& ray, double lumen_hu, double fat_hu, double sigma_mm) {
  double up = 0.0, down = 1e-9;
  std::vector<double> share(ray.hu.size());
  for (std::size_t i = 0; i < ray.hu.size(); ++i) {
    const double lumen = blurred_share(ray.lumen_mm, ray.rho_mm[i], sigma_mm);
    const double outer = blurred_share(ray.outer_mm, ray.rho_mm[i], sigma_mm);
    share[i] = std::max(0.0, outer - lumen);
    ray.hu[i] -= lumen * lumen_hu + (1.0 - outer) * fat_hu;
    up += share[i] * ray.hu[i];
    down += share[i] * share[i];
  }
  const double mean = up / down;
  for (std::size_t i = 0; i < ray.hu.size(); ++i)
    ray.hu[i] = mean + share[i] * (ray.hu[i] - share[i] * mean) / (share[i] * share[i] + ridge);
}

class Measuring {
 public:
  Measuring(const geometry::AxisCurve& axis, const WallRadii& walls,
            const std::function<double(const Vec3&)>& hu_at, const PlaqueOptions& options)
      : axis_(axis), walls_(walls), hu_at_(hu_at), options_(options) {}
  PlaqueSlab slab(double s_mm, double length_mm) const;
  PlaqueMap map(double s_mm) const;

 private:
  PlaqueClass class_of(double hu) const {
    return hu < options_.low_attenuation_hu ? PlaqueClass::low_attenuation
           : hu <= options_.fibrofatty_hu   ? PlaqueClass::fibrofatty
           : hu <= options_.fibrous_hu      ? PlaqueClass::fibrous
                                            : PlaqueClass::calcified;
  }
  WallRay ray_of(double s_mm, double theta) const;
  void read(WallRay& ray, double s_mm, double theta) const;
  /// A wall as thick as this is no plaque.
  double wall_alone_mm(double s_mm) const {
    if (!walls_.calibre_mm) return options_.thin_wall_mm;
    return std::max(options_.thin_wall_mm,
                    healthy_wall_mm(walls_.calibre_mm(s_mm)) + options_.healthy_margin_mm);
  }

  const geometry::AxisCurve& axis_;
  const WallRadii& walls_;
  const std::function<double(const Vec3&)>& hu_at_;
  PlaqueOptions options_;
};

WallRay Measuring::ray_of(double s_mm, double theta) const {
  WallRay ray{walls_.lumen_mm(s_mm, theta), walls_.outer_mm(s_mm, theta), {}, {}};
  if (!std::isfinite(ray.lumen_mm) || !std::isfinite(ray.outer_mm) || ray.lumen_mm < 0.0)
    throw InvalidInput("plaque: a radius at " + std::to_string(s_mm) + " mm is no finite length");
  ray.outer_mm = std::max(ray.outer_mm, ray.lumen_mm);
  return ray;
}

void Measuring::read(WallRay& ray, double s_mm, double theta) const {
  const double piece = (ray.outer_mm - ray.lumen_mm) / options_.deep;
  for (int i = 0; i < options_.deep; ++i) {
    ray.rho_mm.push_back(ray.lumen_mm + (i + 0.5) * piece);
    ray.hu.push_back(hu_at_(axis_.place(s_mm, theta, ray.rho_mm.back())));
  }
  if (options_.blur_sigma_mm > 0.0)
    unmix(ray, walls_.lumen_hu(s_mm), walls_.fat_hu(s_mm), options_.blur_sigma_mm);
}

PlaqueSlab Measuring::slab(double s_mm, double length_mm) const {
  PlaqueSlab out;
  out.s_mm = s_mm;
  out.volumes.length_mm = length_mm;
  const Vec3 bend = axis_.curvature_vector(s_mm);
  const geometry::Frame frame = axis_.frame(s_mm);
  const double turn = 2.0 * pi / options_.around, wall_alone = wall_alone_mm(s_mm);
  for (int a = 0; a < options_.around; ++a) {
    const double theta = (a + 0.5) * turn;
    WallRay ray = ray_of(s_mm, theta);
    const double towards = bend.dot(geometry::radial_direction(frame, theta));
    // From the axis to rho, per angle and length: the pieces on the inside of a bend are shorter.
    const auto within = [&](double rho) { return rho * rho * (0.5 - towards * rho / 3.0); };
    const double part = turn * length_mm;
    out.volumes.lumen_mm3 += part * within(ray.lumen_mm);
    out.volumes.vessel_mm3 += part * within(ray.outer_mm);
    out.lumen_mm2 += 0.5 * turn * ray.lumen_mm * ray.lumen_mm;
    out.vessel_mm2 += 0.5 * turn * ray.outer_mm * ray.outer_mm;
    const double thick = ray.outer_mm - ray.lumen_mm;
    if (thick < wall_alone) {
      out.volumes.thin_wall_mm3 += part * (within(ray.outer_mm) - within(ray.lumen_mm));
      continue;
    }
    out.plaque_mm2 += 0.5 * turn * (ray.outer_mm * ray.outer_mm - ray.lumen_mm * ray.lumen_mm);
    read(ray, s_mm, theta);
    const double half = 0.5 * thick / options_.deep;
    for (std::size_t i = 0; i < ray.hu.size(); ++i)
      out.volumes.class_mm3[static_cast<std::size_t>(class_of(ray.hu[i]))] +=
          part * (within(ray.rho_mm[i] + half) - within(ray.rho_mm[i] - half));
  }
  return out;
}

PlaqueMap Measuring::map(double s_mm) const {
  PlaqueMap out;
  out.around = options_.around;
  out.deep = options_.deep;
  const double wall_alone = wall_alone_mm(s_mm);
  for (int a = 0; a < options_.around; ++a) {
    const double theta = (a + 0.5) * 2.0 * pi / options_.around;
    WallRay ray = ray_of(s_mm, theta);
    out.lumen_mm.push_back(ray.lumen_mm);
    out.outer_mm.push_back(ray.outer_mm);
    const bool thin = ray.outer_mm - ray.lumen_mm < wall_alone;
    if (!thin) read(ray, s_mm, theta);
    for (int i = 0; i < options_.deep; ++i)
      out.pieces.push_back(thin ? std::nullopt
                                : std::optional<PlaqueClass>(class_of(ray.hu[static_cast<std::size_t>(i)])));
  }
  return out;
}

double share_percent(double part, double whole) {
  return whole > 0.0 ? 100.0 * part / whole : 0.0;
}

}  // namespace

void add(PlaqueVolumes& sum, const PlaqueVolumes& one, double share) {
  sum.length_mm += share * one.length_mm;
  sum.lumen_mm3 += share * one.lumen_mm3;
  sum.vessel_mm3 += share * one.vessel_mm3;
  sum.thin_wall_mm3 += share * one.thin_wall_mm3;
  for (std::size_t i = 0; i < plaque_classes; ++i) sum.class_mm3[i] += share * one.class_mm3[i];
}

std::string to_string(PlaqueClass one) {
  switch (one) {
    case PlaqueClass::low_attenuation:
      return "low attenuation";
    case PlaqueClass::fibrofatty:
      return "fibrofatty";
    case PlaqueClass::fibrous:
      return "fibrous";
    case PlaqueClass::calcified:
      break;
  }
  return "calcified";
}

// The straight line's ends (Podesser et al. 1998), mm: outer radius, wall.
constexpr double narrow_outer_mm = 0.1, narrow_wall_mm = 0.08, wide_outer_mm = 3.0, wide_wall_mm = 0.8;
constexpr double calcified_share = 0.5, no_calcium_share = 0.05;

double healthy_wall_mm(double lumen_diameter_mm) {
  if (!(lumen_diameter_mm >= 0.0) || !std::isfinite(lumen_diameter_mm))
    throw InvalidInput("a healthy wall is asked of a lumen of " + std::to_string(lumen_diameter_mm) +
                       " mm; a diameter is 0 or more");
  // wall = a + b outer, outer = lumen + wall.
  const double b = (wide_wall_mm - narrow_wall_mm) / (wide_outer_mm - narrow_outer_mm);
  const double a = narrow_wall_mm - b * narrow_outer_mm;
  return (a + b * 0.5 * lumen_diameter_mm) / (1.0 - b);
}

PlaqueType plaque_type(const PlaqueVolumes& volumes) {
  const double all = volumes.plaque_mm3(), calcium = volumes.of(PlaqueClass::calcified);
  if (!(all > 0.0)) return PlaqueType::none;
  if (calcium >= calcified_share * all) return PlaqueType::calcified;
  return calcium < no_calcium_share * all ? PlaqueType::non_calcified : PlaqueType::mixed;
}

std::string to_string(PlaqueType type) {
  switch (type) {
    case PlaqueType::none:
      return "none";
    case PlaqueType::non_calcified:
      return "non-calcified";
    case PlaqueType::mixed:
      return "mixed";
    case PlaqueType::calcified:
      break;
  }
  return "calcified";
}

void validate(const PlaqueOptions& o) {
  const auto within = [](double x, double low, double high) { return x >= low && x <= high; };
  require(within(o.low_attenuation_hu, -200.0, 400.0), "low_attenuation_hu", o.low_attenuation_hu,
          "[-200, 400] HU");
  require(within(o.fibrofatty_hu, o.low_attenuation_hu, 1000.0), "fibrofatty_hu", o.fibrofatty_hu,
          "[low_attenuation_hu, 1000] HU");
  require(within(o.fibrous_hu, o.fibrofatty_hu, 3000.0), "fibrous_hu", o.fibrous_hu,
          "[fibrofatty_hu, 3000] HU");
  require(within(o.thin_wall_mm, 0.0, 3.0), "thin_wall_mm", o.thin_wall_mm, "[0, 3] mm");
  require(within(o.healthy_margin_mm, 0.0, 1.0), "healthy_margin_mm", o.healthy_margin_mm, "[0, 1] mm");
  require(within(o.step_mm, 0.02, 2.0), "step_mm", o.step_mm, "[0.02, 2] mm");
  require(within(o.around, 8, 1024), "around", o.around, "[8, 1024]");
  require(within(o.deep, 1, 256), "deep", o.deep, "[1, 256]");
  require(within(o.blur_sigma_mm, 0.0, 1.5), "blur_sigma_mm", o.blur_sigma_mm, "[0, 1.5] mm");
}

double PlaqueVolumes::plaque_mm3() const {
  double sum = 0.0;
  for (const double one : class_mm3) sum += one;
  return sum;
}
double PlaqueVolumes::burden_percent() const {
  return share_percent(plaque_mm3(), vessel_mm3);
}
double PlaqueVolumes::wall_percent() const {
  return share_percent(wall_mm3(), vessel_mm3);
}
double PlaqueSlab::area_burden_percent() const {
  return share_percent(plaque_mm2, vessel_mm2);
}

namespace {

/// Throws InvalidInput where the walls cannot be measured.
void check(const geometry::AxisCurve& axis, const WallRadii& walls,
           const std::function<double(const Vec3&)>& hu_at, const PlaqueOptions& options) {
  validate(options);
  if (!walls.lumen_mm || !walls.outer_mm || !hu_at ||
      (options.blur_sigma_mm > 0.0 && (!walls.lumen_hu || !walls.fat_hu)))
    throw InvalidInput(
        "plaque: walls, CT numbers and, with a blur, the brightness of lumen and fat are needed");
  if (!(walls.from_mm >= -1e-6 && walls.from_mm < walls.to_mm && walls.to_mm <= axis.length() + 1e-6))
    throw InvalidInput("plaque: from " + std::to_string(walls.from_mm) + " to " +
                       std::to_string(walls.to_mm) + " mm is no stretch of an axis of " +
                       std::to_string(axis.length()) + " mm");
}

}  // namespace

std::optional<PlaqueClass> PlaqueMap::at(double theta, double rho_mm) const {
  const double turns = theta / (2.0 * pi);
  const int a = std::min(around - 1, static_cast<int>((turns - std::floor(turns)) * around));
  const double inner = lumen_mm[static_cast<std::size_t>(a)], outer = outer_mm[static_cast<std::size_t>(a)];
  if (!(rho_mm >= inner && rho_mm < outer)) return std::nullopt;
  const int i = std::min(deep - 1, static_cast<int>((rho_mm - inner) / (outer - inner) * deep));
  return pieces[static_cast<std::size_t>(a) * deep + i];
}

PlaqueMap plaque_map(const geometry::AxisCurve& axis, const WallRadii& walls, double s_mm,
                     const std::function<double(const Vec3& place)>& hu_at, const PlaqueOptions& options) {
  check(axis, walls, hu_at, options);
  return Measuring(axis, walls, hu_at, options).map(s_mm);
}

PlaqueProfile plaque_profile(const geometry::AxisCurve& axis, const WallRadii& walls,
                             const std::function<double(const Vec3& place)>& hu_at,
                             const PlaqueOptions& options, const core::TaskContext& task) {
  check(axis, walls, hu_at, options);
  task.set_stage("plaque");
  PlaqueProfile out{walls.from_mm, walls.to_mm, options, {}};
  const double length = walls.to_mm - walls.from_mm;
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(length / options.step_mm - 1e-9)));
  const double step = length / static_cast<double>(count);
  out.slabs.resize(count);
  const Measuring measuring(axis, walls, hu_at, options);
  core::parallel_for(count, 8, [&](std::size_t i) {
    task.throw_if_cancelled();
    out.slabs[i] = measuring.slab(walls.from_mm + (static_cast<double>(i) + 0.5) * step, step);
  });
  return out;
}

PlaqueVolumes plaque_between(const PlaqueProfile& profile, double from_mm, double to_mm) {
  PlaqueVolumes sum;
  for (const PlaqueSlab& slab : profile.slabs) {
    const double half = 0.5 * slab.volumes.length_mm;
    const double covered = std::min(to_mm, slab.s_mm + half) - std::max(from_mm, slab.s_mm - half);
    if (covered > 0.0) add(sum, slab.volumes, std::min(1.0, covered / slab.volumes.length_mm));
  }
  return sum;
}

std::optional<double> vessel_area_mm2(const PlaqueProfile& profile, double s_mm) {
  if (profile.slabs.empty() || s_mm < profile.from_mm - 1e-6 || s_mm > profile.to_mm + 1e-6)
    return std::nullopt;
  const double step = profile.slabs.front().volumes.length_mm;
  const double last = static_cast<double>(profile.slabs.size() - 1);
  const double x = std::clamp((s_mm - profile.slabs.front().s_mm) / step, 0.0, last);
  const auto i = static_cast<std::size_t>(x);
  const std::size_t j = std::min(i + 1, profile.slabs.size() - 1);
  const double t = x - static_cast<double>(i);
  return (1.0 - t) * profile.slabs[i].vessel_mm2 + t * profile.slabs[j].vessel_mm2;
}

std::optional<double> remodelling_index(const PlaqueProfile& profile, const Stenosis& stenosis) {
  const auto lesion = vessel_area_mm2(profile, stenosis.throat_mm);
  const auto proximal = vessel_area_mm2(profile, stenosis.proximal_mm);
  const auto distal = vessel_area_mm2(profile, stenosis.distal_mm);
  if (!lesion || !proximal || !distal || !(*proximal + *distal > 0.0)) return std::nullopt;
  return 2.0 * *lesion / (*proximal + *distal);
}

}  // namespace ostia::analysis
