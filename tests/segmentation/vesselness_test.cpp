#include "ostia/segmentation/vesselness.h"

#include "tube_images.h"
#include "vesselness/tube_loops.h"
#include "vesselness/tube_scales.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <thread>

namespace ostia::segmentation {
namespace {

using imaging::ImageVolume;
using imaging::Vec3;
using testing::Tube;

constexpr double kBlur = 0.3;  // of the images' edges
const Vec3 kVesselnessSpacing(0.4, 0.4, 0.5);

VesselnessOptions with(TubeMethod method, TubeAxes axes = TubeAxes::none) {
  VesselnessOptions options;
  options.method = method;
  options.axes = axes;
  return options;
}

Vec3 place_of(const imaging::Geometry& g, std::int64_t i, std::int64_t j, std::int64_t k) {
  return g.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
}

template <class Body>
void for_inner(const imaging::Geometry& g, std::int64_t border, const Body& body) {
  for (std::int64_t k = border; k < g.size[2] - border; ++k)
    for (std::int64_t j = border; j < g.size[1] - border; ++j)
      for (std::int64_t i = border; i < g.size[0] - border; ++i) body(i, j, k);
}

bool same_bits(const imaging::FloatVolume& a, const imaging::FloatVolume& b) {
  return a.voxels.size() == b.voxels.size() &&
         std::memcmp(a.voxels.data(), b.voxels.data(), a.voxels.size() * sizeof(float)) == 0;
}

float largest(const imaging::FloatVolume& v, std::int64_t border = 0) {
  float most = 0.0F;
  for_inner(v.geometry, border, [&](auto i, auto j, auto k) { most = std::max(most, v(i, j, k)); });
  return most;
}

/// An image of part(p) x 300 HU over 50 HU.
template <class Part>
ImageVolume painted(const std::array<std::int64_t, 3>& size, const Vec3& spacing, const Part& part) {
  ImageVolume image;
  image.geometry.size = size;
  image.geometry.spacing = spacing;
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  for_inner(image.geometry, 0, [&](auto i, auto j, auto k) {
    image(i, j, k) =
        static_cast<std::int16_t>(std::lround(50.0 + 300.0 * part(place_of(image.geometry, i, j, k))));
  });
  return image;
}

double edge(double inside_mm) {
  return 0.5 * std::erfc(-inside_mm / (std::sqrt(2.0) * kBlur));
}

Tube tube_through(const Vec3& centre, const Vec3& direction, double radius) {
  const Vec3 d = direction.normalized();
  return {centre - d, centre + d, radius};
}

class BothMethods : public ::testing::TestWithParam<TubeMethod> {};
INSTANTIATE_TEST_SUITE_P(vesselness, BothMethods, ::testing::Values(TubeMethod::flux, TubeMethod::hessian),
                         [](const auto& p) { return p.param == TubeMethod::flux ? "flux" : "hessian"; });

struct OnAxis {
  double radius_error = 0.0;  // largest, mm
  double angle = 0.0;         // largest, degrees
  double least = 1e9, most = 0.0;
  double highest_at = 0.0;  // distance of the slices' highest voxels from the axis, mm
};

OnAxis on_axis(const Vesselness& v, const Tube& tube) {
  OnAxis result;
  const Vec3 along = (tube.to - tube.from).normalized();
  const auto& g = v.response_hu.geometry;
  for (std::int64_t k = 14; k < g.size[2] - 14; ++k) {
    float most = 0.0F;
    double at = 0.0;
    for (std::int64_t j = 14; j < g.size[1] - 14; ++j) {
      for (std::int64_t i = 14; i < g.size[0] - 14; ++i) {
        const double distance = testing::distance_to_axis(tube, place_of(g, i, j, k));
        const float response = v.response_hu(i, j, k);
        if (response > most) {
          most = response;
          at = distance;
        }
        if (distance > 0.25) continue;
        const auto& a = v.axis[static_cast<std::size_t>(g.offset(i, j, k))];
        const double cosine = std::abs(Vec3(a[0], a[1], a[2]).dot(along));
        result.angle = std::max(result.angle, std::acos(std::min(cosine, 1.0)) * 180.0 / M_PI);
        result.radius_error =
            std::max(result.radius_error, std::abs(static_cast<double>(v.radius_mm(i, j, k)) - tube.radius));
        result.least = std::min<double>(result.least, response);
        result.most = std::max<double>(result.most, response);
      }
    }
    result.highest_at = std::max(result.highest_at, at);
  }
  return result;
}

TEST_P(BothMethods, a_tube_answers_with_its_contrast_radius_and_axis) {
  for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(1, 1, 3), Vec3(1, -0.7, 1.2)}) {
    for (const double radius : {0.8, 1.2, 1.8, 2.5}) {
      SCOPED_TRACE(std::to_string(radius) + " mm, dz " + std::to_string(direction[2]));
      const Tube tube = tube_through(Vec3(11.9, 12.2, 11.3), direction, radius);
      const ImageVolume image = testing::tube_image({tube}, {60, 61, 46}, kVesselnessSpacing, kBlur);
      const OnAxis found = on_axis(vesselness(image, {}, with(GetParam(), TubeAxes::computed)), tube);
      EXPECT_LT(found.radius_error, 0.08);
      EXPECT_LT(found.angle, 2.0);
      EXPECT_GT(found.least, 0.82 * 300.0);
      EXPECT_LT(found.most, 1.08 * 300.0);
      EXPECT_LT(found.highest_at, 0.36);  // half a voxel's diagonal across, and a bit
    }
  }
}

TEST_P(BothMethods, noise_leaves_radius_and_axis) {
  const Tube tube = tube_through(Vec3(11.9, 12.2, 11.3), Vec3(1, -0.7, 1.2), 1.2);
  const ImageVolume image = testing::tube_image({tube}, {60, 61, 46}, kVesselnessSpacing, kBlur, 25.0);
  const OnAxis found = on_axis(vesselness(image, {}, with(GetParam(), TubeAxes::computed)), tube);
  EXPECT_LT(found.radius_error, 0.15);
  EXPECT_LT(found.angle, 5.0);
  EXPECT_GT(found.least, 240.0);
}

TEST_P(BothMethods, directions_are_of_the_world) {
  const Tube tube = tube_through(Vec3(11.9, 12.2, 11.3), Vec3(1, 0.5, 1.2), 1.2);
  ImageVolume image = testing::tube_image({tube}, {60, 61, 46}, kVesselnessSpacing, kBlur);
  image.geometry.direction = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  image.geometry.origin = Vec3(-40, 100, 7);
  const Vesselness v = vesselness(image, {}, with(GetParam(), TubeAxes::computed));
  const Vec3 world = image.geometry.direction * Vec3(1, 0.5, 1.2).normalized();
  const auto& a = v.axis[static_cast<std::size_t>(image.geometry.offset(30, 30, 23))];
  EXPECT_GT(v.response_hu(30, 30, 23), 200.0F);
  EXPECT_GT(std::abs(Vec3(a[0], a[1], a[2]).dot(world)), std::cos(2.0 * M_PI / 180.0));
}

TEST_P(BothMethods, plates_and_blobs_answer_far_less) {
  const std::array<std::int64_t, 3> size{60, 60, 48};
  const Vec3 centre(12.0, 11.9, 11.7), normal = Vec3(1, 2, 2).normalized();
  for (const double half : {0.8, 1.5}) {
    const ImageVolume plate = painted(size, kVesselnessSpacing, [&](const Vec3& p) {
      const double at = (p - centre).dot(normal);
      return edge(half - at) * edge(half + at);
    });
    const ImageVolume ball =
        painted(size, kVesselnessSpacing, [&](const Vec3& p) { return edge(half - (p - centre).norm()); });
    const ImageVolume step =
        painted(size, kVesselnessSpacing, [&](const Vec3& p) { return edge((p - centre).dot(normal)); });
    // A tube answers 300. Away from a ball's centre its three eigenvalues are no longer alike.
    EXPECT_LT(largest(vesselness(plate, {}, with(GetParam())).response_hu, 12), 0.05F * 300.0F);
    EXPECT_LT(largest(vesselness(step, {}, with(GetParam())).response_hu, 12), 0.05F * 300.0F);
    const Vesselness of_ball = vesselness(ball, {}, with(GetParam()));
    EXPECT_LT(of_ball.response_hu(30, 30, 23), 0.1F * 300.0F);
    EXPECT_LT(largest(of_ball.response_hu, 12), 0.6F * 300.0F);
  }
}

/// The response half-way between two tubes over that on their axes.
double between(const Vesselness& v) {
  return static_cast<double>(v.response_hu(30, 30, 20)) / static_cast<double>(v.response_hu(26, 30, 20));
}

TEST(vesselness, flux_separates_neighbours_a_voxel_apart) {
  // Axes 8 voxels apart, walls 0.4 mm: one voxel.
  const Tube left{Vec3(10.4, 12, 0), Vec3(10.4, 12, 1), 1.4},
      right{Vec3(13.6, 12, 0), Vec3(13.6, 12, 1), 1.4};
  const ImageVolume image = testing::tube_image({left, right}, {61, 61, 40}, kVesselnessSpacing, kBlur);
  const auto at_scale = [&](TubeMethod method, std::vector<double> radii) {
    VesselnessOptions options = with(method);
    options.radii_mm = std::move(radii);
    return vesselness(image, {}, options);
  };
  // At the tubes' own scale the gap is a gap for the flux; at a larger one the Hessian sees one tube alone.
  EXPECT_LT(between(at_scale(TubeMethod::flux, {1.4})), 0.05);
  EXPECT_GT(between(at_scale(TubeMethod::hessian, {3.0})), 1.1);
  const Vesselness flux = vesselness(image, {}, with(TubeMethod::flux));
  const Vesselness hessian = vesselness(image, {}, with(TubeMethod::hessian));
  EXPECT_LT(between(flux), 0.45);
  EXPECT_LT(between(hessian), 0.55);
  EXPECT_NEAR(flux.radius_mm(26, 30, 20), 1.4, 0.1);
  // The neighbour takes little of the flux's answer.
  EXPECT_GT(flux.response_hu(26, 30, 20), 0.92F * 300.0F);
  EXPECT_LT(hessian.response_hu(26, 30, 20), 0.85F * 300.0F);
}

/// BackgroundTask a chamber: a half-space of the same contrast whose wall is 0.4 mm from the tube's.
TEST(vesselness, flux_stays_on_the_axis_beside_a_chamber) {
  const ImageVolume image = painted({61, 61, 40}, kVesselnessSpacing, [&](const Vec3& p) {
    return std::max(edge(1.6 - std::hypot(p[0] - 12.0, p[1] - 12.0)), edge(p[0] - 12.0 - 2.0));
  });
  const Vesselness flux = vesselness(image), hessian = vesselness(image, {}, with(TubeMethod::hessian));
  const auto highest = [](const Vesselness& v) {
    std::int64_t best = 20;
    for (std::int64_t i = 20; i < 36; ++i)
      if (v.response_hu(i, 30, 20) > v.response_hu(best, 30, 20)) best = i;
    return best;
  };
  EXPECT_EQ(highest(flux), 30);
  EXPECT_LT(highest(hessian), 30);
  EXPECT_GT(flux.response_hu(30, 30, 20), hessian.response_hu(30, 30, 20) + 30.0F);
  EXPECT_NEAR(flux.radius_mm(30, 30, 20), 1.6, 0.2);
}

TEST_P(BothMethods, an_offset_and_shading_change_nothing) {
  const Tube tube = tube_through(Vec3(11.9, 12.2, 11.3), Vec3(1, 0.5, 1.2), 1.2);
  const ImageVolume image = testing::tube_image({tube}, {60, 61, 46}, kVesselnessSpacing, kBlur);
  ImageVolume shaded = image;
  for_inner(image.geometry, 0, [&](auto i, auto j, auto k) {
    shaded(i, j, k) = static_cast<std::int16_t>(shaded(i, j, k) - 900 + 3 * i - 2 * j + 4 * k);
  });
  const Vesselness a = vesselness(image, {}, with(GetParam())), b = vesselness(shaded, {}, with(GetParam()));
  // Far enough from the border, whose values are repeated beyond it.
  double off = 0.0;
  for (std::int64_t k = 20; k < 26; ++k)
    for (std::int64_t j = 26; j < 35; ++j)
      for (std::int64_t i = 26; i < 34; ++i)
        off = std::max(off, std::abs(static_cast<double>(a.response_hu(i, j, k)) -
                                     static_cast<double>(b.response_hu(i, j, k))));
  EXPECT_LT(off, 0.5);
}

TEST(vesselness, a_constant_image_has_no_vessels) {
  ImageVolume image;
  image.geometry.size = {70, 20, 20};
  image.voxels.assign(70 * 20 * 20, 1234);
  for (const TubeMethod method : {TubeMethod::flux, TubeMethod::hessian})
    EXPECT_LT(largest(vesselness(image, {}, with(method)).response_hu), 0.05F);
}

ImageVolume noise_image(const std::array<std::int64_t, 3>& size) {
  ImageVolume image;
  image.geometry.size = size;
  image.geometry.spacing = kVesselnessSpacing;
  std::mt19937 generator(5);
  for (std::int64_t n = 0; n < image.geometry.voxels(); ++n)
    image.voxels.push_back(static_cast<std::int16_t>(generator() % 400));
  return image;
}

TEST_P(BothMethods, threads_change_no_bit) {
  const ImageVolume image = noise_image({100, 70, 60});
  const VesselnessOptions options = with(GetParam(), TubeAxes::computed);
  const Vesselness many = vesselness(image, {}, options);
  core::set_max_threads(1);
  const Vesselness one = vesselness(image, {}, options);
  core::set_max_threads(0);
  EXPECT_TRUE(same_bits(many.response_hu, one.response_hu));
  EXPECT_TRUE(same_bits(many.radius_mm, one.radius_mm));
  EXPECT_EQ(many.axis, one.axis);
  EXPECT_GT(largest(many.response_hu), 10.0F);
}

TEST_P(BothMethods, a_region_and_a_mask_get_the_dense_answer) {
  const ImageVolume image = noise_image({100, 70, 60});
  const VesselnessOptions options = with(GetParam(), TubeAxes::computed);
  const Vesselness dense = vesselness(image, {}, options);
  const imaging::Region region{{37, 11, 20}, {90, 66, 58}};
  imaging::MaskVolume mask;
  mask.geometry = image.geometry;
  std::mt19937 generator(8);
  for (std::size_t n = 0; n < image.voxels.size(); ++n)
    mask.voxels.push_back(generator() % 97 == 0 && n % 100 < 80 ? 1 : 0);
  const Vesselness part = vesselness(image, {region, nullptr}, options);
  const Vesselness masked = vesselness(image, {region, &mask}, options);
  const imaging::MaskVolume own = imaging::cropped(mask, region);
  const Vesselness masked_by_own = vesselness(image, {region, &own}, options);
  EXPECT_EQ(part.response_hu.geometry.size, (std::array<std::int64_t, 3>{53, 55, 38}));
  EXPECT_TRUE(part.response_hu.geometry.origin.isApprox(image.geometry.world(Vec3(37, 11, 20))));
  EXPECT_TRUE(same_bits(part.response_hu, imaging::cropped(dense.response_hu, region)));
  EXPECT_TRUE(same_bits(part.radius_mm, imaging::cropped(dense.radius_mm, region)));
  EXPECT_TRUE(same_bits(masked.response_hu, masked_by_own.response_hu));
  std::size_t answers = 0;
  for (std::size_t n = 0; n < part.axis.size(); ++n) {
    const bool in = own.voxels[n] != 0;
    ASSERT_EQ(masked.response_hu.voxels[n], in ? part.response_hu.voxels[n] : 0.0F);
    ASSERT_EQ(masked.radius_mm.voxels[n], in ? part.radius_mm.voxels[n] : 0.0F);
    ASSERT_EQ(masked.axis[n], in ? part.axis[n] : (std::array<float, 3>{0.0F, 0.0F, 0.0F}));
    answers += masked.response_hu.voxels[n] > 0.0F ? 1 : 0;
  }
  EXPECT_GT(answers, 100U);
}

TEST(vesselness, a_mask_of_nothing_gives_nothing) {
  const ImageVolume image = noise_image({20, 20, 20});
  imaging::MaskVolume mask;
  mask.geometry = image.geometry;
  mask.voxels.assign(image.voxels.size(), 0);
  EXPECT_EQ(largest(vesselness(image, {std::nullopt, &mask}).response_hu), 0.0F);
}

TEST(vesselness, radii_below_the_resolution_become_one) {
  ImageVolume image = noise_image({20, 20, 20});
  image.geometry.spacing = Vec3(1.5, 1.5, 1.5);
  for (const TubeMethod method : {TubeMethod::flux, TubeMethod::hessian}) {
    const Vesselness v = vesselness(image, {}, with(method));
    ASSERT_GE(v.radii_mm.size(), 2U);
    ASSERT_LT(v.radii_mm.size(), 5U);
    EXPECT_GT(v.radii_mm.front(), 1.2);
    EXPECT_LT(v.radii_mm.front(), 2.3);
    EXPECT_EQ(v.radii_mm.back(), 3.0);
    for (std::size_t s = 1; s < v.radii_mm.size(); ++s) EXPECT_GT(v.radii_mm[s], v.radii_mm[s - 1]);
  }
}

TEST(vesselness, a_ceiling_dims_calcium) {
  const Vec3 centre(12.0, 12.0, 11.5);
  const Tube tube = tube_through(centre, Vec3(0, 0, 1), 1.2);
  ImageVolume image = testing::tube_image({tube}, {61, 61, 46}, kVesselnessSpacing, kBlur);
  for_inner(image.geometry, 0, [&](auto i, auto j, auto k) {
    const double inside = 0.7 - (place_of(image.geometry, i, j, k) - centre).norm();
    image(i, j, k) = static_cast<std::int16_t>(image(i, j, k) + 1000.0 * edge(inside));
  });
  VesselnessOptions options;
  options.most_hu = 360.0;
  const Vesselness cut = vesselness(image, {}, options), as_is = vesselness(image);
  EXPECT_NEAR(cut.response_hu(30, 30, 23), 300.0, 45.0);
  EXPECT_LT(largest(cut.response_hu, 12), 345.0F);
  EXPECT_GT(largest(as_is.response_hu, 12), 450.0F);
}

/// The answers of the closed form against matrices made of known eigenvalues and vectors.
TEST(tube_loops, eigenvalues_and_vectors_are_right_in_both_sets_of_loops) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> random(-1.0, 1.0);
  for (int n = 0; n < 300; ++n) {
    Vec3 values(-2.0 - random(generator), -1.0, 0.5 * random(generator));
    if (n % 3 == 0) values = Vec3(-1.0, -1.0, 0.2 * random(generator));  // a round tube
    const Eigen::Quaterniond turn(random(generator), random(generator), random(generator), random(generator));
    const imaging::Mat3 q = turn.normalized().toRotationMatrix();
    const imaging::Mat3 m = q * values.asDiagonal() * q.transpose();
    // A quadratic function with these second derivatives: fourth-order differences of it are exact.
    constexpr std::ptrdiff_t kRow = 16, kPlane = kRow * 5;
    std::vector<float> field(kPlane * 5 + 16, 0.0F);
    for (int k = -2; k <= 2; ++k)
      for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
          const Vec3 p(i, j, k);
          field[static_cast<std::size_t>(i + 2 + kRow * (j + 2) + kPlane * (k + 2))] =
              static_cast<float>(50.0 * p.dot(m * p));
        }
    std::vector<std::array<float, 4>> results;
    for (const detail::TubeLoops& loops : {detail::tube_loops_plain(), detail::tube_loops()}) {
      detail::TubeRow row;
      row.values = field.data() + 2 + 2 * kRow + 2 * kPlane;
      row.y = kRow;
      row.z = kPlane;
      for (int d = 0; d < 3; ++d) {
        row.pure[d] = 1.0F / 12.0F;
        row.mixed[d] = 1.0F / 144.0F;
      }
      row.gap_weight = 0.25F;
      float answer[8] = {}, best[8] = {}, x[8] = {}, y[8] = {}, z[8] = {};
      row.answer = answer;
      row.best = best;
      row.axis[0] = x;
      row.axis[1] = y;
      row.axis[2] = z;
      loops.tube(row, 1);
      const double truth = 100.0 * (1.0 + std::min(values[2], -0.25 * values[2]));
      EXPECT_NEAR(answer[0], truth, 0.1) << n;
      EXPECT_GT(std::abs(Vec3(x[0], y[0], z[0]).dot(q.col(2))), 0.9999) << n;
      results.push_back({answer[0], x[0], y[0], z[0]});
    }
    EXPECT_EQ(results[0], results[1]);
  }
}

TEST(tube_loops, sums_have_the_same_bits_in_both_sets_of_loops) {
  std::mt19937 generator(4);
  std::vector<float> in;
  for (int n = 0; n < 4000; ++n) in.push_back(static_cast<float>(generator() % 10007) / 7.0F);
  const float weights[3] = {0.5F, 0.2F, 0.05F};
  const detail::RunTap taps[3] = {{3, -2, 0.3F}, {104, 99, 0.1F}, {-96, -101, 0.7F}};
  std::vector<std::vector<float>> results;
  for (const detail::TubeLoops& loops : {detail::tube_loops_plain(), detail::tube_loops()}) {
    std::vector<float> out(120, 0.0F);
    loops.blur(in.data() + 1000, 100, weights, 2, out.data(), 40);
    loops.runs(in.data() + 1500, taps, 3, out.data(), 40);
    loops.add(in.data() + 2003, in.data() + 2500, out.data() + 48, 56);
    results.push_back(out);
  }
  EXPECT_EQ(results[0], results[1]);
  for (const std::size_t x : {0U, 5U, 39U}) {
    const auto at = [&](std::size_t n) { return static_cast<double>(in[n + x]); };
    const double blurred = 0.5 * at(1000) + 0.2 * (at(900) + at(1100)) + 0.05 * (at(800) + at(1200));
    const double runs =
        0.3 * (at(1503) - at(1498)) + 0.1 * (at(1604) - at(1599)) + 0.7 * (at(1404) - at(1399));
    EXPECT_NEAR(results[0][x], blurred + runs, 1e-2);
    EXPECT_NEAR(results[0][48 + x], at(2003) + at(2500), 1e-2);
  }
}

TEST(tube_scales, flux_of_a_tube_agrees_with_the_surface_integral) {
  // The outward gradient of a finely made blurred disc, over a sphere.
  constexpr double kRadius = 1.3, kBall = 1.5, kSigma = 0.42;
  const testing::BlurredDisc disc(kRadius, kSigma);
  double sum = 0.0;
  constexpr int kSteps = 400;
  for (int n = 0; n < kSteps; ++n) {
    const double sine = std::sin(M_PI * (n + 0.5) / kSteps), rho = kBall * sine;
    const double fall =
        (disc(std::max(rho - 0.1, 0.0)) - disc(rho + 0.1)) / (rho + 0.1 - std::max(rho - 0.1, 0.0));
    sum += fall * sine * sine * M_PI / kSteps;
  }
  EXPECT_NEAR(detail::flux_of_tube(kBall, kRadius, kSigma), 0.25 * sum, 0.02 * 0.25 * sum);
}

TEST(tube_scales, each_scale_answers_most_to_its_own_tube) {
  VesselnessOptions options;
  const detail::TubeScales scales(options, kVesselnessSpacing);
  const double blur =
      std::hypot(options.image_blur_mm, options.flux_blur_voxels * std::cbrt(kVesselnessSpacing.prod()));
  ASSERT_EQ(scales.list().size(), 5U);
  for (const detail::TubeScale& s : scales.list()) {
    const double own = detail::flux_of_tube(s.ball_mm, s.radius_mm, blur);
    EXPECT_NEAR(3.0 * s.factor / s.ball_mm * own, 1.0, 1e-6);
    EXPECT_LT(detail::flux_of_tube(s.ball_mm, 1.03 * s.radius_mm, blur), own);
    EXPECT_LT(detail::flux_of_tube(s.ball_mm, 0.97 * s.radius_mm, blur), own);
  }
}

TEST(vesselness, bad_input_is_refused) {
  const ImageVolume image = noise_image({12, 12, 12});
  const auto refused = [&](const auto& change) {
    VesselnessOptions options;
    change(options);
    EXPECT_THROW(vesselness(image, {}, options), InvalidInput);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](auto& o) { o.radii_mm.clear(); });
  refused([](auto& o) { o.radii_mm = {1.0, 1.0}; });
  refused([](auto& o) { o.radii_mm = {2.0, 1.0}; });
  refused([](auto& o) { o.radii_mm = {0.1}; });
  refused([](auto& o) { o.radii_mm = {11.0}; });
  refused([&](auto& o) { o.radii_mm = {nan}; });
  refused([](auto& o) { o.radii_mm.assign(17, 1.0); });
  refused([](auto& o) { o.image_blur_mm = -0.1; });
  refused([&](auto& o) { o.image_blur_mm = nan; });
  refused([](auto& o) { o.flux_blur_voxels = 0.2; });
  refused([](auto& o) { o.gap_weight = 1.1; });
  refused([](auto& o) { o.least_hu = 100.0, o.most_hu = 100.0; });
  EXPECT_THROW(vesselness(ImageVolume{}), InvalidInput);
  ImageVolume short_of_voxels = image;
  short_of_voxels.voxels.pop_back();
  EXPECT_THROW(vesselness(short_of_voxels), InvalidInput);
  ImageVolume flat = image;
  flat.geometry.spacing[2] = 0.0;
  EXPECT_THROW(vesselness(flat), InvalidInput);
  ImageVolume fine = image;
  fine.geometry.spacing = Vec3(0.02, 0.4, 0.4);
  for (const TubeMethod method : {TubeMethod::flux, TubeMethod::hessian})
    EXPECT_THROW(vesselness(fine, {}, with(method)), InvalidInput);
  EXPECT_THROW(vesselness(image, {imaging::Region{{0, 0, 0}, {12, 12, 13}}, nullptr}), InvalidInput);
  EXPECT_THROW(vesselness(image, {imaging::Region{{3, 3, 3}, {3, 5, 5}}, nullptr}), InvalidInput);
  EXPECT_THROW(vesselness(image, {imaging::Region{{-1, 0, 0}, {5, 5, 5}}, nullptr}), InvalidInput);
  imaging::MaskVolume mask;
  mask.geometry = image.geometry;
  mask.geometry.size[0] = 11;
  mask.voxels.assign(11 * 12 * 12, 1);
  EXPECT_THROW(vesselness(image, {std::nullopt, &mask}), InvalidInput);
}

TEST(vesselness, cancels_and_tells_how_far_it_is) {
  const ImageVolume image = noise_image({200, 150, 100});
  core::TaskContext before;
  before.cancel();
  EXPECT_THROW(vesselness(image, {}, {}, before), Cancelled);
  core::TaskContext during;
  std::thread other([&] {
    while (during.progress() <= 0.0) std::this_thread::yield();
    during.cancel();
  });
  EXPECT_THROW(vesselness(image, {}, {}, during), Cancelled);
  other.join();
  EXPECT_LT(during.progress(), 1.0);
  core::TaskContext whole;
  static_cast<void>(vesselness(noise_image({20, 20, 20}), {}, {}, whole));
  EXPECT_EQ(whole.progress(), 1.0);
}

TEST(vesselness, one_voxel_will_do) {
  ImageVolume image;
  image.geometry.size = {1, 1, 1};
  image.voxels = {7};
  for (const TubeMethod method : {TubeMethod::flux, TubeMethod::hessian})
    EXPECT_LT(vesselness(image, {}, with(method)).response_hu.voxels.at(0), 0.01F);
}

}  // namespace
}  // namespace ostia::segmentation
