#include "ostia/phantom/builtin_case.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/spline.h"
#include "ostia/imaging/filters.h"
#include "ostia/phantom/noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace ostia::phantom {
namespace {

using geometry::AnalyticTube;
using geometry::Vec3;
using imaging::FloatVolume;

constexpr double axis_step_mm = 0.05;
constexpr double margin_mm = 8.0;
constexpr double builtin_fwhm_per_sigma = 2.354820045;
// Diameters of left main, LAD and LCX, mm (Dodge et al., Circulation 1992, 86:232), as radii.
constexpr double main_start_radius = 2.2, main_end_radius = 1.5;
constexpr double branch_start_radius = 1.7, branch_end_radius = 1.4;

void require_builtin(bool good, const char* what) {
  if (!good) throw InvalidInput(std::string("built-in case: ") + what);
}

/// A smooth curve through control points with a radius given along it.
template <class Radius>
AnalyticTube tube_through(std::string name, const std::vector<Vec3>& controls, const Radius& radius) {
  const geometry::ArcLengthSpline spline(controls);
  const auto steps = static_cast<std::size_t>(std::ceil(spline.length() / axis_step_mm));
  AnalyticTube tube;
  tube.name = std::move(name);
  for (std::size_t i = 0; i <= steps; ++i) {
    const double s = spline.length() * static_cast<double>(i) / static_cast<double>(steps);
    tube.axis.points.push_back(spline.point(s));
    tube.axis.radius.push_back(radius(s / spline.length(), s));
  }
  geometry::complete(tube.axis);
  return tube;
}

/// Control points of the main vessel, moved a little by the seed.
std::vector<Vec3> main_controls(std::uint64_t seed) {
  std::vector<Vec3> controls{{0, 0, 0},      {5, -6, -3},    {13, -12, -8},
                             {22, -16, -17}, {29, -17, -28}, {34, -15, -40}};
  for (std::size_t i = 1; i < controls.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      controls[i][axis] += 1.2 * (uniform(seed, 100 + 3 * i + static_cast<std::size_t>(axis)) - 0.5);
    }
  }
  return controls;
}

/// The branch leaves the main axis at `start` and turns away towards the patient's left and back.
std::vector<Vec3> branch_controls(const geometry::Centerline& main, double start_mm) {
  const auto at =
      std::lower_bound(main.abscissa.begin(), main.abscissa.end(), start_mm) - main.abscissa.begin();
  const auto i = static_cast<std::size_t>(at);
  const Vec3 from = main.points[i];
  const Vec3 ahead = main.frames[i].tangent;
  const Vec3 aside = (Vec3(0.75, 0.65, 0.1) - ahead * ahead.dot(Vec3(0.75, 0.65, 0.1))).normalized();
  return {from, from + 3.0 * ahead * 0.75 + 3.0 * aside * 0.66, from + 7.0 * ahead * 0.6 + 8.0 * aside * 0.8,
          from + 8.0 * ahead + 17.0 * aside + Vec3(0, 0, -2),
          from + 9.0 * ahead + 26.0 * aside + Vec3(0, 0, -7)};
}

struct Vessels {
  geometry::AnalyticShape shape;
  BuiltinStenosis stenosis;
};

Vessels make_vessels(std::uint64_t seed) {
  Vessels out;
  BuiltinStenosis& stenosis = out.stenosis;
  stenosis.centre_mm = 32.0 + 2.0 * (uniform(seed, 1) - 0.5);
  stenosis.length_mm = 12.0;
  stenosis.diameter_stenosis = 0.5 + 0.04 * (uniform(seed, 2) - 0.5);
  const auto radius = [&](double part, double s) {
    const double healthy = main_start_radius + (main_end_radius - main_start_radius) * part;
    const double x = (s - stenosis.centre_mm) / stenosis.length_mm;
    if (std::abs(x) >= 0.5) return healthy;
    return healthy * (1.0 - stenosis.diameter_stenosis * 0.5 * (1.0 + std::cos(2.0 * std::numbers::pi * x)));
  };
  out.shape.tubes.push_back(tube_through("main", main_controls(seed), radius));
  const geometry::Centerline& main = out.shape.tubes[0].axis;
  const auto throat = std::lower_bound(main.abscissa.begin(), main.abscissa.end(), stenosis.centre_mm) -
                      main.abscissa.begin();
  stenosis.throat_radius_mm = main.radius[static_cast<std::size_t>(throat)];
  out.shape.tubes.push_back(tube_through("branch", branch_controls(main, 11.0), [](double part, double) {
    return branch_start_radius + (branch_end_radius - branch_start_radius) * part;
  }));
  for (const AnalyticTube& tube : out.shape.tubes) {
    for (std::size_t i = 0; i < tube.axis.size(); ++i) {
      const Vec3 reach = Vec3::Constant(tube.axis.radius[i] + 2.0);
      out.shape.box.extend(tube.axis.points[i] - reach);
      out.shape.box.extend(tube.axis.points[i] + reach);
    }
  }
  return out;
}

imaging::Geometry grid_around(const geometry::AnalyticShape& shape, double spacing_mm) {
  imaging::Geometry grid;
  grid.spacing = Vec3::Constant(spacing_mm);
  grid.origin = shape.box.min() - Vec3::Constant(margin_mm);
  const Vec3 extent = shape.box.max() + Vec3::Constant(margin_mm) - grid.origin;
  for (int axis = 0; axis < 3; ++axis) {
    grid.size[static_cast<std::size_t>(axis)] =
        static_cast<std::int64_t>(std::ceil(extent[axis] / spacing_mm)) + 1;
  }
  return grid;
}

/// The part of a voxel that lies in the lumen: exact at a distance, supersampled at the wall.
double lumen_part(const geometry::TubeDistance& distance, const Vec3& centre, double spacing_mm) {
  constexpr int parts = 5;
  const double d = distance(centre);
  // The distance to a chain of cone-spheres changes by at most a little over the way travelled.
  const double reach = 0.9 * spacing_mm;
  if (d > reach) return 0.0;
  if (d < -1.2 * reach) return 1.0;
  const auto part = [&](int a, int b, int c) {
    return distance(centre + spacing_mm * ((Vec3(a, b, c).array() + 0.5) / parts - 0.5).matrix());
  };
  int inside = 0;
  for (int n = 0; n < parts * parts; ++n) {
    const int b = n % parts, c = n / parts;
    // Of a row whose ends (0.4 voxels away) the wall cannot come to, its middle says all.
    const double middle = part(parts / 2, b, c);
    if (std::abs(middle) > 0.5 * spacing_mm) {
      inside += middle < 0.0 ? parts : 0;
      continue;
    }
    for (int a = 0; a < parts; ++a) inside += part(a, b, c) < 0.0 ? 1 : 0;
  }
  return static_cast<double>(inside) / (parts * parts * parts);
}

/// What the neighbourhood of a block of voxels holds, so that most voxels need no distance of their own.
enum class Holds { background, lumen, wall };

/// The distance to a chain of cone-spheres grows by little more than the way travelled (the tubes' taper is
/// below one in two).
Holds block_holds(const geometry::TubeDistance& distance, const Vec3& centre, double half_diagonal_mm) {
  const double d = distance(centre);
  const double reach = 1.5 * half_diagonal_mm;
  return d > reach ? Holds::background : d < -reach ? Holds::lumen : Holds::wall;
}

/// Myocardium below, fat above a smooth surface that keeps clear of the lumen.
double background(const Vec3& point, const BuiltinOptions& options, const Vec3& heart,
                  double heart_radius_mm) {
  const double outside_mm = (point - heart).norm() - heart_radius_mm;
  const double share = std::clamp(0.5 - outside_mm / options.spacing_mm, 0.0, 1.0);
  return options.fat_hu + share * (options.myocardium_hu - options.fat_hu);
}

FloatVolume paint(const geometry::AnalyticShape& shape, const BuiltinOptions& options,
                  const core::TaskContext& task) {
  FloatVolume image;
  image.geometry = grid_around(shape, options.spacing_mm);
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  const geometry::TubeDistance distance(shape);
  // A ball under the vessels, 5 mm clear of their axes.
  const Vec3 heart = shape.box.center() + Vec3(-45.0, 45.0, -40.0);
  double heart_radius = std::numeric_limits<double>::max();
  for (const AnalyticTube& tube : shape.tubes) {
    for (const Vec3& p : tube.axis.points) heart_radius = std::min(heart_radius, (p - heart).norm() - 5.0);
  }
  constexpr std::int64_t block = 8;
  const auto& size = image.geometry.size;
  const auto paint_block = [&](std::int64_t i0, std::int64_t j0, std::int64_t k0) {
    const Vec3 middle =
        image.geometry.world(Vec3(static_cast<double>(i0), static_cast<double>(j0), static_cast<double>(k0)) +
                             Vec3::Constant(0.5 * (block - 1)));
    const Holds holds = block_holds(distance, middle, 0.5 * block * options.spacing_mm * std::numbers::sqrt3);
    for (std::int64_t k = k0; k < std::min(k0 + block, size[2]); ++k) {
      for (std::int64_t j = j0; j < std::min(j0 + block, size[1]); ++j) {
        for (std::int64_t i = i0; i < std::min(i0 + block, size[0]); ++i) {
          const Vec3 p = image.geometry.world(
              Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
          const double lumen = holds == Holds::wall    ? lumen_part(distance, p, options.spacing_mm)
                               : holds == Holds::lumen ? 1.0
                                                       : 0.0;
          const double around = background(p, options, heart, heart_radius);
          image(i, j, k) = static_cast<float>(around + lumen * (options.lumen_hu - around));
        }
      }
    }
  };
  core::parallel_for(static_cast<std::size_t>((size[2] + block - 1) / block), 1, [&](std::size_t slab) {
    task.throw_if_cancelled();
    for (std::int64_t j = 0; j < size[1]; j += block) {
      for (std::int64_t i = 0; i < size[0]; i += block)
        paint_block(i, j, block * static_cast<std::int64_t>(slab));
    }
  });
  return image;
}

/// White noise, correlated and scaled back to its deviation.
FloatVolume noise(const imaging::Geometry& grid, const BuiltinOptions& options,
                  const core::TaskContext& task) {
  FloatVolume field{grid, std::vector<float>(static_cast<std::size_t>(grid.voxels()))};
  core::parallel_for(field.voxels.size(), 1 << 14, [&](std::size_t i) {
    field.voxels[i] = static_cast<float>(normal(options.seed, 1000 + i));
  });
  if (options.noise_grain_mm > 0.0) field = imaging::gaussian_blurred(field, options.noise_grain_mm, task);
  const double square = core::parallel_reduce(
      field.voxels.size(), std::size_t{1} << 14, 0.0,
      [&](std::size_t first, std::size_t last) {
        double sum = 0.0;
        for (std::size_t i = first; i < last; ++i)
          sum += static_cast<double>(field.voxels[i]) * field.voxels[i];
        return sum;
      },
      [](double a, double b) { return a + b; });
  const double deviation = std::sqrt(square / static_cast<double>(field.voxels.size()));
  const auto scale = static_cast<float>(options.noise_hu / deviation);
  for (float& value : field.voxels) value *= scale;
  return field;
}

}  // namespace

void validate(const BuiltinOptions& options) {
  require_builtin(options.spacing_mm >= 0.1 && options.spacing_mm <= 2.0, "spacing_mm must lie in [0.1, 2]");
  require_builtin(options.blur_fwhm_mm >= 0.0 && options.blur_fwhm_mm <= 5.0,
                  "blur_fwhm_mm must lie in [0, 5]");
  require_builtin(options.noise_hu >= 0.0 && options.noise_hu <= 500.0, "noise_hu must lie in [0, 500]");
  require_builtin(options.noise_grain_mm >= 0.0 && options.noise_grain_mm <= 5.0,
                  "noise_grain_mm must lie in [0, 5]");
}

BuiltinCase make_builtin_case(const BuiltinOptions& options, const core::TaskContext& task) {
  validate(options);
  task.set_stage("built-in image");
  BuiltinCase out;
  Vessels vessels = make_vessels(options.seed);
  FloatVolume image = paint(vessels.shape, options, task.sub(0.0, 0.6));
  task.set_progress(0.6);
  if (options.blur_fwhm_mm > 0.0)
    image = imaging::gaussian_blurred(image, options.blur_fwhm_mm / builtin_fwhm_per_sigma, task);
  task.set_progress(0.8);
  const FloatVolume grain = noise(image.geometry, options, task);
  out.image.geometry = image.geometry;
  out.image.voxels.resize(image.voxels.size());
  for (std::size_t i = 0; i < image.voxels.size(); ++i) {
    out.image.voxels[i] = static_cast<std::int16_t>(
        std::lround(std::clamp(image.voxels[i] + grain.voxels[i], -1024.0f, 3071.0f)));
  }
  const auto inset = [](const geometry::Centerline& axis, double mm) {
    const auto at = std::lower_bound(axis.abscissa.begin(), axis.abscissa.end(), mm) - axis.abscissa.begin();
    return axis.points[static_cast<std::size_t>(at)];
  };
  const geometry::Centerline& main = vessels.shape.tubes[0].axis;
  const geometry::Centerline& branch = vessels.shape.tubes[1].axis;
  const Vec3 ostium = inset(main, 0.5);
  out.branches = {{ostium, inset(main, main.abscissa.back() - 0.5)},
                  {ostium, inset(branch, branch.abscissa.back() - 0.5)}};
  out.truth = std::move(vessels.shape);
  out.stenosis = vessels.stenosis;
  task.set_progress(1.0);
  return out;
}

}  // namespace ostia::phantom
