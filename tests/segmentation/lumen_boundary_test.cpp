#include "ostia/segmentation/lumen_boundary.h"

#include "boundary/boundary_rows.h"
#include "boundary/edge_profile.h"
#include "boundary/star_surface.h"
#include "scanned_scene.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

namespace ostia::segmentation {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using testing::scan;
using testing::Scene;
using testing::Shot;

using std::numbers::pi;
constexpr double lumen_hu = 380.0, wall_hu = 45.0, fat_hu = -90.0;

/// Lumen inside a signed distance, a thin wall, fat.
double vessel(double distance, double wall_mm = 0.4) {
  return distance < 0.0 ? lumen_hu : distance < wall_mm ? wall_hu : fat_hu;
}
Scene tube(double radius) {
  return [=](const Vec3& p) { return vessel(std::hypot(p.x(), p.y()) - radius); };
}

struct Deviation {
  double mean = 0.0, absolute = 0.0, largest = 0.0;
};
/// Of the found radii from r(z along the axis, local angle), away from the ends.
Deviation deviation(const LumenBoundary& found, const std::function<double(double, double)>& radius,
                    double from = 1.5, double to = 13.5) {
  Deviation out;
  int count = 0;
  for (int row = 0; row < found.rows(); ++row) {
    const double s = found.from_mm + row * found.step_mm;
    if (s < from || s > to) continue;
    for (int a = 0; a < found.around; ++a) {
      // The frame's normal is the grid's first axis; theta runs clockwise against the right-handed grid.
      const double theta = -2.0 * pi * a / found.around;
      const double off =
          found.radius_mm[static_cast<std::size_t>(row) * found.around + a] - radius(s + 0.45, theta);
      out.mean += off;
      out.absolute += std::abs(off);
      out.largest = std::max(out.largest, std::abs(off));
      ++count;
    }
  }
  out.mean /= count;
  out.absolute /= count;
  return out;
}

LumenBoundary find(const Shot& shot, const LumenBoundaryOptions& options = {}) {
  const geometry::AxisCurve axis(shot.line);
  return lumen_boundary(shot.image, axis, 0.0, axis.length(), options);
}

class RoundTube : public ::testing::TestWithParam<double> {};

TEST_P(RoundTube, RadiusHasLittleBias) {
  const double radius = GetParam();
  const auto truth = [=](double, double) { return radius; };
  const Deviation clean = deviation(find(scan(tube(radius))), truth);
  EXPECT_LT(std::abs(clean.mean), 0.03);
  EXPECT_LT(clean.largest, 0.08);
  const LumenBoundary noisy = find(scan(tube(radius), 25.0));
  EXPECT_LT(std::abs(deviation(noisy, truth).mean), 0.05);
  EXPECT_LT(deviation(noisy, truth).absolute, 0.07);
  EXPECT_NEAR(noisy.lumen_hu, lumen_hu, 15.0);
  EXPECT_TRUE(noisy.warnings.empty());
}
INSTANTIATE_TEST_SUITE_P(Radii, RoundTube, ::testing::Values(0.6, 0.8, 1.0, 1.5, 2.0));

TEST(LumenBoundary, NoiseIsMeasured) {
  EXPECT_NEAR(find(scan(tube(1.8), 25.0)).lumen_sigma_hu, 25.0, 6.0);
  EXPECT_NEAR(find(scan(tube(1.8), 45.0)).lumen_sigma_hu, 45.0, 12.0);
}

TEST(LumenBoundary, AxisBesideTheMiddle) {
  const Vec2 middle(0.5, -0.3);
  const double radius = 1.4;
  const Scene scene = [=](const Vec3& p) { return vessel((p.head<2>() - middle).norm() - radius); };
  const auto truth = [=](double, double theta) {
    const Vec2 direction(std::cos(theta), std::sin(theta));
    const double along = direction.dot(middle);
    return along + std::sqrt(radius * radius - middle.squaredNorm() + along * along);
  };
  const Deviation off = deviation(find(scan(scene, 25.0)), truth);
  EXPECT_LT(off.absolute, 0.07);
  EXPECT_LT(std::abs(off.mean), 0.05);
}

TEST(LumenBoundary, OvalLumen) {
  const double a = 1.7, b = 1.1;
  const auto truth = [=](double, double theta) {
    return 1.0 / std::hypot(std::cos(theta) / a, std::sin(theta) / b);
  };
  const Scene scene = [=](const Vec3& p) {
    return vessel(p.head<2>().norm() - truth(0.0, std::atan2(p.y(), p.x())));
  };
  const Deviation off = deviation(find(scan(scene, 25.0)), truth);
  EXPECT_LT(off.absolute, 0.08);
  EXPECT_LT(std::abs(off.mean), 0.05);
}

struct Lesion {
  double half_length_mm = 0.0, throat_mm = 0.0;
};
class Stenosis : public ::testing::TestWithParam<Lesion> {};

TEST_P(Stenosis, KeepsItsDepth) {
  const Lesion lesion = GetParam();
  const auto radius = [&](double s) {
    const double x = std::clamp((s - 7.95) / lesion.half_length_mm, -1.0, 1.0);
    return 1.5 - 0.5 * (1.5 - lesion.throat_mm) * (1.0 + std::cos(pi * x));
  };
  const Scene scene = [&](const Vec3& p) {  // plaque fills what the lumen lost
    const double rho = p.head<2>().norm();
    return rho < radius(p.z()) ? lumen_hu : rho < 1.9 ? 60.0 : fat_hu;
  };
  const LumenBoundary found = find(scan(scene, 25.0));
  const Deviation off = deviation(found, [&](double s, double) { return radius(s); });
  EXPECT_LT(off.absolute, 0.10);
  double throat = 0.0;
  for (int n = 0; n < 32; ++n) throat += found.at(7.5, n * pi / 16.0) / 32.0;
  EXPECT_NEAR(throat, lesion.throat_mm, 0.12);  // the blur along the axis is not modelled
}
INSTANTIATE_TEST_SUITE_P(LongAndShort, Stenosis,
                         ::testing::Values(Lesion{4.0, 0.7}, Lesion{2.0, 0.7}, Lesion{2.0, 0.45}));

TEST(LumenBoundary, CalciumBesideTheLumenIsLeftOut) {
  for (const double gap : {0.0, 0.2}) {
    const Scene scene = [=](const Vec3& p) {
      const double rho = p.head<2>().norm(), angle = std::atan2(p.y(), p.x());
      const bool calcified = std::abs(angle) < 0.8 && std::abs(p.z() - 7.5) < 2.0;
      if (calcified && rho > 1.3 + gap && rho < 2.2) return 900.0;
      return vessel(rho - 1.3, 0.9);
    };
    const LumenBoundary found = find(scan(scene, 25.0));
    const auto truth = [](double, double) { return 1.3; };
    EXPECT_LT(deviation(found, truth, 5.5, 8.5).absolute, 0.12) << gap;
    EXPECT_LT(deviation(found, truth, 5.5, 8.5).largest, 0.4) << gap;
    EXPECT_LT(deviation(found, truth).absolute, 0.08) << gap;
  }
}

TEST(LumenBoundary, NeighbourVesselIsLeftOut) {
  const Scene scene = [](const Vec3& p) {
    const double beside = std::hypot(p.x() - 3.8, p.y()) - 1.8;
    return beside < 0.0 ? 350.0 : vessel(std::hypot(p.x(), p.y()) - 1.3);
  };
  const Deviation off = deviation(find(scan(scene, 25.0)), [](double, double) { return 1.3; });
  EXPECT_LT(off.absolute, 0.08);
  EXPECT_LT(off.largest, 0.4);
}

TEST(LumenBoundary, SideBranchIsNotFollowedAndIsUnclear) {
  const Scene scene = [](const Vec3& p) {
    const double trunk = std::hypot(p.x(), p.y()) - 1.4;
    const double branch = p.x() > 0.0 ? std::hypot(p.y(), p.z() - 7.5) - 1.0 : 9.0;
    return vessel(std::min(trunk, branch));
  };
  const LumenBoundary found = find(scan(scene, 25.0));
  EXPECT_LT(found.at(7.05, 0.0), 2.3);
  EXPECT_GT(found.at(7.05, 0.0), 1.2);
  EXPECT_NEAR(found.at(7.05, pi), 1.4, 0.2);
  const auto confidence = [&](int a) { return found.confidence[14U * found.around + a]; };  // at 7 mm
  EXPECT_LT(confidence(0) + 0.2, confidence(16));
}

TEST(LumenBoundary, SlopeLimitsHoldExactly) {
  const Scene scene = [](const Vec3& p) {
    const double rho = p.head<2>().norm(), radius = p.z() > 7.5 && p.z() < 9.5 ? 0.7 : 1.8;
    return vessel(rho - (p.x() > 0.0 ? radius : 1.4));
  };
  const Shot shot = scan(scene, 25.0);
  for (const double limit : {0.1, 0.3, 1.0}) {
    LumenBoundaryOptions options;
    options.largest_slope_along = limit;
    options.largest_slope_around = 1.5 * limit;
    const LumenBoundary found = find(shot, options);
    const double turn = 2.0 * pi / found.around;
    for (int row = 0; row < found.rows(); ++row) {
      for (int a = 0; a < found.around; ++a) {
        const auto at = [&](int i, int j) {
          return found.radius_mm[static_cast<std::size_t>(i) * found.around + j % found.around];
        };
        const double here = at(row, a), beside = at(row, a + 1);
        ASSERT_GT(here, 0.0);
        EXPECT_LE(std::abs(here - beside), 1.5 * limit * turn * std::min(here, beside) * (1.0 + 1e-12));
        if (row + 1 < found.rows()) {
          EXPECT_LE(std::abs(here - at(row + 1, a)), limit * found.step_mm * (1.0 + 1e-12));
        }
      }
    }
  }
}

TEST(LumenBoundary, SameForAnyNumberOfThreads) {
  const Shot shot = scan(tube(1.2), 25.0);
  const int threads = core::max_threads();
  core::set_max_threads(1);
  const LumenBoundary one = find(shot);
  core::set_max_threads(4);
  const LumenBoundary four = find(shot);
  core::set_max_threads(threads);
  EXPECT_EQ(one.radius_mm, four.radius_mm);
  EXPECT_EQ(one.confidence, four.confidence);
}

TEST(LumenBoundary, BetweenItsRowsAndBeyondItsEnds) {
  LumenBoundary found;
  found.from_mm = 5.0;
  found.step_mm = 0.5;
  found.around = 8;
  for (int row = 0; row < 6; ++row)
    for (int a = 0; a < 8; ++a) found.radius_mm.push_back(1.0 + 0.1 * row + 0.05 * std::cos(a * pi / 4.0));
  EXPECT_NEAR(found.at(6.0, pi / 4.0), 1.2 + 0.05 * std::cos(pi / 4.0), 1e-12);
  EXPECT_NEAR(found.at(6.0, pi / 4.0 - 4.0 * pi), found.at(6.0, pi / 4.0), 1e-12);
  EXPECT_DOUBLE_EQ(found.at(2.0, 0.3), found.at(5.0, 0.3));
  EXPECT_DOUBLE_EQ(found.at(99.0, -2.0), found.at(7.5, -2.0));
  for (const double s : {4.999, 5.5, 6.0, 7.499})  // no jump in value or slope
    for (const double theta : {0.0, pi / 4.0, pi, -1e-9}) {
      const double h = 1e-4;
      const double before = found.at(s, theta) - found.at(s - h, theta);
      const double after = found.at(s + h, theta) - found.at(s, theta);
      EXPECT_NEAR(before, after, 4e-3 * h);
      const double left = found.at(s, theta) - found.at(s, theta - h);
      EXPECT_NEAR(left, found.at(s, theta + h) - found.at(s, theta), 4e-3 * h);
    }
}

TEST(LumenBoundary, SaysWhatIsWrong) {
  const Shot shot = scan(tube(1.2));
  const geometry::AxisCurve axis(shot.line);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(lumen_boundary(shot.image, axis, 5.0, 5.0), InvalidInput);
  EXPECT_THROW(lumen_boundary(shot.image, axis, 8.0, 5.0), InvalidInput);
  EXPECT_THROW(lumen_boundary(shot.image, axis, nan, 5.0), InvalidInput);
  EXPECT_THROW(lumen_boundary(shot.image, axis, 0.0, axis.length() + 1.0), InvalidInput);
  EXPECT_THROW(lumen_boundary({}, axis, 0.0, 5.0), InvalidInput);
  geometry::Centerline far = shot.line;
  for (Vec3& p : far.points) p += Vec3(8.0, 0.0, 0.0);
  EXPECT_THROW(lumen_boundary(shot.image, geometry::AxisCurve(far), 0.0, 5.0), InvalidInput);
  LumenBoundaryOptions huge;  // 10 rows a mm of 128 rays with 1,000 radii
  huge.around = 128;
  huge.radial_step_mm = 0.02;
  huge.largest_radius_mm = 20.0;
  huge.step_mm = 0.1;
  EXPECT_THROW(lumen_boundary(shot.image, axis, 0.0, axis.length(), huge), InvalidInput);
  const auto refused = [&](auto change) {
    LumenBoundaryOptions options;
    change(options);
    EXPECT_THROW(validate(options), InvalidInput);
  };
  refused([](auto& o) { o.step_mm = 0.0; });
  refused([&](auto& o) { o.step_mm = nan; });
  refused([](auto& o) { o.around = 7; });
  refused([](auto& o) { o.radial_step_mm = 1.0; });
  refused([](auto& o) { o.largest_radius_mm = 0.1; });
  refused([](auto& o) { o.blur_sigma_mm = -0.1; });
  refused([](auto& o) { o.wall_hu = 900.0; });
  refused([](auto& o) { o.calcium_hu = -1.0; });
  refused([](auto& o) { o.largest_slope_along = 0.0; });
  refused([&](auto& o) { o.largest_slope_around = nan; });
  EXPECT_NO_THROW(validate(LumenBoundaryOptions{}));
}

TEST(LumenBoundary, WarnsWhereThereIsNoVessel) {
  const LumenBoundary found = find(scan([](const Vec3&) { return 60.0; }, 25.0));
  EXPECT_FALSE(found.warnings.empty());
}

TEST(LumenBoundary, Cancelled) {
  const Shot shot = scan(tube(1.2));
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(lumen_boundary(shot.image, geometry::AxisCurve(shot.line), 0.0, 10.0, {}, task), Cancelled);
}

TEST(BlurredDisc, KnownValues) {
  for (const double radius : {0.3, 0.8, 2.0}) {
    EXPECT_NEAR(blurred_disc(radius, 0.0, 0.3), 1.0 - std::exp(-radius * radius / 0.18), 2e-4);
  }
  EXPECT_NEAR(blurred_disc(60.0, 60.0, 0.3), 0.5, 2e-3);
  EXPECT_NEAR(blurred_disc(60.0, 60.3, 0.3), 0.158655, 2e-3);
  EXPECT_DOUBLE_EQ(blurred_disc(0.0, 0.1, 0.3), 0.0);
  double volume = 0.0;  // the blur moves, but loses nothing
  for (double rho = 0.005; rho < 4.0; rho += 0.01)
    volume += 2.0 * pi * rho * 0.01 * blurred_disc(0.9, rho, 0.3);
  EXPECT_NEAR(volume, pi * 0.81, 2e-3);
}

TEST(EdgeLoops, HaveTheSameBitsOnEveryProcessor) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(-1.0F, 1.0F);
  std::vector<detail::EdgeNormals> normals(2);
  for (detail::EdgeNormals& one : normals) {
    for (auto& row : one.mean)
      for (float& x : row) x = value(random);
    for (auto& row : one.whitening)
      for (float& x : row) x = value(random);
    for (float& x : one.offset) x = value(random);
  }
  float samples[detail::edge_samples], lumen[detail::edge_samples];
  for (float& x : samples) x = value(random);
  for (float& x : lumen) x = value(random);
  float found[2][2 * detail::edge_lanes] = {};
  detail::edge_loop_plain()(normals.data(), 2, samples, lumen, found[0]);
  detail::edge_loop()(normals.data(), 2, samples, lumen, found[1]);
  for (int n = 0; n < 2 * detail::edge_lanes; ++n) {
    const detail::EdgeNormals& of = normals[static_cast<std::size_t>(n / detail::edge_lanes)];
    const int lane = n % detail::edge_lanes;
    double square = 0.0;
    for (int i = 0, at = 0; i < detail::edge_samples; ++i) {
      double white = 0.0;
      for (int j = 0; j <= i; ++j, ++at)
        white += of.whitening[at][lane] * (samples[j] - of.mean[j][lane] - lumen[j]);
      square += white * white;
    }
    EXPECT_NEAR(found[0][n], 0.5 * square + of.offset[lane], 1e-4);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(found[0][n]), std::bit_cast<std::uint32_t>(found[1][n]));
  }
}

/// The best of all surfaces by trying them all: 2 rows of 3 rays with 4 radii.
TEST(LeastCostSurface, IsTheBestOfAll) {
  const RadiusGrid grid{0.5, 0.2, 4};
  const int rows = 2, around = 3, rays = 6;
  const double step = 0.5, variation = 0.3;
  std::mt19937 generator(4);
  for (const double along : {0.4, 0.8, 5.0}) {
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<float> cost(static_cast<std::size_t>(rays) * 4);
      for (float& c : cost) c = static_cast<float>(generator() % 1000) / 1000.0F;
      const auto total = [&](const std::vector<int>& k) {
        double sum = 0.0;
        const auto pair = [&](int p, int q, double limit) {
          const double d = std::abs(k[p] - k[q]) * grid.step_mm;
          sum += variation * d;
          if (std::abs(k[p] - k[q]) > 1 && d > limit + 1e-9) sum += 1e6;
        };
        for (int n = 0; n < rays; ++n) {
          sum += cost[static_cast<std::size_t>(n) * 4 + k[n]];
          const int next = n / around * around + (n + 1) % around;
          pair(n, next, 5.0 * 2.0 * pi / around * grid.at(std::min(k[n], k[next])));
          if (n < around) pair(n, n + around, along * step);
        }
        return sum;
      };
      double best = 1e9;
      std::vector<int> k(6);
      for (int code = 0; code < 4096; ++code) {
        for (int n = 0; n < rays; ++n) k[n] = code >> (2 * n) & 3;
        best = std::min(best, total(k));
      }
      const auto found =
          least_cost_surface(cost, rows, around, grid, step, {along, 5.0}, variation, core::no_task());
      EXPECT_NEAR(total(found), best, 1e-5);
    }
  }
}

TEST(HoldLimits, LargestSurfaceBelow) {
  std::vector<double> radius(5 * 8, 2.0);
  radius[2 * 8 + 3] = 0.5;
  hold_limits(radius, 5, 8, 0.25, 0.4);
  EXPECT_DOUBLE_EQ(radius[2 * 8 + 3], 0.5);
  EXPECT_DOUBLE_EQ(radius[2 * 8 + 4], 0.5 * 1.4);
  EXPECT_DOUBLE_EQ(radius[3 * 8 + 3], 0.75);
  EXPECT_DOUBLE_EQ(radius[0 * 8 + 3], 1.0);
  std::vector<double> again = radius;
  hold_limits(again, 5, 8, 0.25, 0.4);
  EXPECT_EQ(again, radius);
}

TEST(SeenFrom, CircleFromAnotherCentre) {
  const std::vector<double> circle(32, 1.5);
  const Vec2 centre(0.4, 0.2);
  const SeenLine seen = seen_from(circle.data(), 32, centre, 0.1);
  ASSERT_TRUE(seen.inside);
  for (int a = 0; a < 32; ++a) {
    const double theta = a * pi / 16.0;
    const Vec2 place = centre + seen.radius_mm[a] * Vec2(std::cos(theta), std::sin(theta));
    EXPECT_NEAR(place.norm(), 1.5, 0.005);
  }
  EXPECT_NEAR((centroid_of(seen.radius_mm.data(), 32) + centre).norm(), 0.0, 0.01);
  EXPECT_FALSE(seen_from(circle.data(), 32, Vec2(2.0, 0.0), 0.1).inside);
}

}  // namespace
}  // namespace ostia::segmentation
