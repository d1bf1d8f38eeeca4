#include "ostia/registration/register.h"

#include "two_scans.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/registration/transform_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::registration {
namespace {

using namespace two_scans;
using testing::HasSubstr;

std::vector<LandmarkPair> forks(const Way& way) {
  std::vector<LandmarkPair> pairs;
  for (const auto& [a, b] : vessels()) {
    pairs.push_back({"fork", a, there(way, a)});
    pairs.push_back({"end", b, there(way, b)});
  }
  return pairs;
}

std::string refusal(const imaging::ImageVolume& fixed, const imaging::ImageVolume& moving,
                    const Guidance& guidance = {}, const RegistrationOptions& options = small_options()) {
  try {
    register_scans(fixed, moving, guidance, options);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(RegisterScans, ATurnedAndShiftedScanIsFoundWithoutLandmarks) {
  const Way way{15.0, Vec3(12, -10, 12), 0.0};
  RegistrationOptions options = small_options();
  options.levels = 0;
  const Mat3 oblique = Eigen::AngleAxisd(0.3, Vec3(2, -1, 1).normalized()).toRotationMatrix();
  const Registration found =
      register_scans(first_scan(), second_scan(way, {300.0, 320.0}, way.shift_mm, oblique), {}, options);
  EXPECT_LT(mean_error_mm(way, found.rigid, landmarks_of(way)), 0.5);
  EXPECT_LT(mean_error_mm(way, found.transform, landmarks_of(way)), 0.5);
  // The turned fields overlap by 87 %.
  EXPECT_EQ(found.quality.verdict, Verdict::doubtful) << found.quality.reason;
}

TEST(RegisterScans, ABentHeartIsFoundToAMillimetre) {
  const Way way{10.0, Vec3(8, -6, 5), 3.0};
  const Guidance guidance{axis_points(), forks(way)};
  const Registration found =
      register_scans(first_scan(), second_scan(way, {420.0, 450.0}, way.shift_mm), guidance, small_options());
  EXPECT_LT(mean_error_mm(way, found.transform, landmarks_of(way)), 1.0);
  std::vector<Vec3> axes;
  for (const Vec3& p : axis_points()) axes.push_back(there(way, p));
  EXPECT_LT(mean_error_mm(way, found.transform, axes), 1.0);
  EXPECT_EQ(found.quality.verdict, Verdict::good) << found.quality.reason;
  EXPECT_GT(found.quality.jacobian_min, 0.3);
  EXPECT_LT(found.quality.landmarks_mean_mm, 1.0);
  EXPECT_LT(found.quality.inverse_consistency_mm, 1.5);
  EXPECT_GT(found.quality.correlation, found.quality.correlation_linear);
}

TEST(RegisterScans, TheThreadsDoNotMatter) {
  const Way way{5.0, Vec3(3, 2, -4), 2.0};
  RegistrationOptions options = small_options();
  options.iterations = 4;
  options.samples = 5000;
  const imaging::ImageVolume fixed = first_scan(), moving = second_scan(way);
  const Guidance guidance{axis_points(), forks(way)};
  const int threads = core::max_threads();
  const std::string several = to_json(register_scans(fixed, moving, guidance, options).transform);
  core::set_max_threads(1);
  const std::string one = to_json(register_scans(fixed, moving, guidance, options).transform);
  core::set_max_threads(threads);
  EXPECT_TRUE(one == several);
}

TEST(RegisterScans, AScanWithoutContrastIsTold) {
  const Way way{0.0, Vec3(2, 1, 0), 0.0};
  RegistrationOptions options = small_options();
  options.levels = 0;
  const Registration found =
      register_scans(first_scan(), second_scan(way, {45.0, 45.0}), {axis_points(), forks(way)}, options);
  EXPECT_EQ(found.quality.verdict, Verdict::failed);
  EXPECT_THAT(found.quality.reason, HasSubstr("without contrast"));
}

TEST(RegisterScans, AnotherPatientIsToldByTheTrees) {
  std::vector<LandmarkPair> pairs = forks({});
  for (std::size_t i = 0; i < pairs.size(); ++i)
    pairs[i].moving_mm += Vec3(18.0 * std::sin(3.0 * i), 18.0 * std::cos(5.0 * i), 12.0 * std::sin(7.0 * i));
  RegistrationOptions options = small_options();
  options.levels = 0;
  const Registration found = register_scans(first_scan(), second_scan({}), {axis_points(), pairs}, options);
  EXPECT_EQ(found.quality.verdict, Verdict::failed);
  EXPECT_THAT(found.quality.reason, HasSubstr("two patients"));
}

TEST(RegisterScans, ACutScanIsDoubtful) {
  imaging::ImageVolume cut = second_scan({});
  cut = imaging::cropped(cut, {{0, 0, 0}, {60, 60, 46}});
  RegistrationOptions options = small_options();
  options.levels = 0;
  const Registration found = register_scans(first_scan(), cut, {axis_points(), forks({})}, options);
  EXPECT_EQ(found.quality.verdict, Verdict::doubtful);
  EXPECT_LT(found.quality.overlap, 0.9);
  EXPECT_GT(found.quality.overlap, 0.6);
}

TEST(RegisterScans, BadInputIsRefusedInASentence) {
  const imaging::ImageVolume fixed = first_scan(), moving = second_scan({});
  EXPECT_THAT(refusal({}, moving), HasSubstr("fixed scan is empty"));
  imaging::ImageVolume flat = moving;
  std::fill(flat.voxels.begin(), flat.voxels.end(), std::int16_t{-700});
  EXPECT_THAT(refusal(fixed, flat), HasSubstr("shows nothing"));
  imaging::ImageVolume shifted = moving;
  for (std::int16_t& v : shifted.voxels) v = static_cast<std::int16_t>(v + 1024);
  EXPECT_THAT(refusal(fixed, shifted), HasSubstr("Hounsfield"));
  imaging::ImageVolume away = moving;
  away.geometry.origin += Vec3(500, 0, 0);
  EXPECT_THAT(refusal(fixed, away, {axis_points(), forks({})}), HasSubstr("do not overlap"));
  EXPECT_THAT(refusal(fixed, moving, {{Vec3(900, 0, 0)}, {}}), HasSubstr("do not lie in the fixed scan"));
  RegistrationOptions options = small_options();
  options.levels = 9;
  EXPECT_THAT(refusal(fixed, moving, {}, options), HasSubstr("levels"));
  std::vector<LandmarkPair> mirrored = forks({});
  for (LandmarkPair& pair : mirrored) pair.moving_mm.x() *= -1.0;
  EXPECT_THAT(refusal(fixed, moving, {axis_points(), mirrored}), HasSubstr("mirror"));
}

TEST(RegisterScans, ACancelEndsIt) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(register_scans(first_scan(), second_scan({}), {}, small_options(), task), Cancelled);
}

}  // namespace
}  // namespace ostia::registration
