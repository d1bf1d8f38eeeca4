#include "live_input.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/glview/sample_motion.h"
#include "ostia/io/cage_motion_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/wfdb_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace ostia::live {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct LiveInputFiles : ::testing::Test {
  fs::path folder =
      fs::path(::testing::TempDir()) /
      (std::string("live_input_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
  glview::SampleHeart heart = glview::sample_heart(2.0, 2);
  Options options;

  LiveInputFiles() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    io::write_surface(folder / "template.vtp", heart.surface);
    io::write_cage_motion(folder / "motion.json", {heart.motion, "template.vtp"});
    options.motion = folder;
  }
  ~LiveInputFiles() override { fs::remove_all(folder); }
  void write_ecg(double rate = 360.0) const {
    geometry::EcgRecord record;
    record.samples_per_second = rate;
    for (const char* name : {"I", "V5"}) {
      geometry::EcgLead lead;
      lead.name = name;
      for (int i = 0; i < 3600; ++i) lead.values.push_back(std::sin(i * (name[0] == 'I' ? 0.01 : 0.02)));
      record.leads.push_back(lead);
    }
    io::write_wfdb(folder / "ecg.hea", record);
  }
  std::string refusal() const {
    try {
      read_input(options);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(LiveInputFiles, ReadsAFolderAndTheSurfaceThatItNames) {
  const LiveInput input = read_input(options);
  EXPECT_EQ(input.surface.points.size(), heart.surface.points.size());
  EXPECT_EQ(input.motion.phases.size(), 20U);
  EXPECT_FALSE(input.ecg);
  EXPECT_FALSE(input.ecg_failed);
  io::write_surface(folder / "other.stl", heart.surface);
  options.motion = folder / "motion.json";
  options.surface = folder / "other.stl";
  EXPECT_EQ(read_input(options).surface.triangles.size(), heart.surface.triangles.size());
}

TEST_F(LiveInputFiles, RefusesWhatIsNoMotion) {
  options.motion = folder / "nothing.json";
  EXPECT_THROW(read_input(options), IoError);
  core::write_file(folder / "wrong.json", "{}");
  options.motion = folder / "wrong.json";
  EXPECT_THAT(refusal(), HasSubstr("wrong.json"));
  io::write_cage_motion(folder / "alone.json", {heart.motion, ""});
  options.motion = folder / "alone.json";
  EXPECT_THAT(refusal(), HasSubstr("--template"));
}

TEST_F(LiveInputFiles, TakesTheLeadThatIsAskedFor) {
  write_ecg();
  options.ecg = folder / "ecg.hea";
  for (const char* wanted : {"V5", "2"}) {
    options.lead = wanted;
    EXPECT_EQ(read_input(options).ecg->lead.name, "V5");
  }
  options.lead = "";
  EXPECT_TRUE(read_input(options).ecg);
  for (const char* wrong : {"aVR", "0", "3", "1.5"}) {
    options.lead = wrong;
    EXPECT_THROW(read_input(options), UsageError) << wrong;
  }
  EXPECT_THAT(refusal(), HasSubstr("1 (I), 2 (V5)"));
}

TEST_F(LiveInputFiles, BeatsWithoutAnEcgThatCannotBeUsedAndSaysSo) {
  options.ecg = folder / "ecg.hea";
  const auto expect_warning = [&](const char* what) {
    const LiveInput input = read_input(options);
    EXPECT_TRUE(input.ecg_failed) << what;
    EXPECT_FALSE(input.ecg);
    ASSERT_FALSE(input.warnings.empty());
    EXPECT_THAT(input.warnings.back(), HasSubstr("without an electrocardiogram"));
    EXPECT_THAT(input.warnings.back(), HasSubstr(what));
  };
  expect_warning("ecg.hea");  // not there
  core::write_file(options.ecg, "ecg 1 360 100\necg.dat 999 200 12 0 0 0 0 I\n");
  core::write_file(folder / "ecg.dat", std::string(200, 'x'));
  expect_warning("999");
  write_ecg(50.0);  // too slow to find beats in
  expect_warning("samples a second");
}

TEST_F(LiveInputFiles, GoesOnWithARecordThatEndsEarly) {
  write_ecg();
  options.ecg = folder / "ecg.hea";
  fs::resize_file(folder / "ecg.dat", fs::file_size(folder / "ecg.dat") / 2);
  const LiveInput input = read_input(options);
  ASSERT_TRUE(input.ecg);
  EXPECT_FALSE(input.ecg_failed);
  EXPECT_FALSE(input.warnings.empty());
}

TEST(LiveInput, PicturesBeginWhereBeatsAreKnown) {
  LiveInput input;
  Options options;
  EXPECT_DOUBLE_EQ(first_picture_s(input, options), 0.0) << "without an ECG";
  input.ecg = LiveEcg{{}, 100.0};
  input.ecg->lead.values.assign(6000, 0.0);
  EXPECT_DOUBLE_EQ(first_picture_s(input, options), 10.0);
  input.ecg->lead.values.resize(800);
  EXPECT_DOUBLE_EQ(first_picture_s(input, options), 4.0) << "within the record";
  options.start_s = 3.0;
  EXPECT_DOUBLE_EQ(first_picture_s(input, options), 3.0);
  options.start_s = 0.0;
  options.phase = 0.4;
  EXPECT_DOUBLE_EQ(first_picture_s(input, options), 0.0);
}

}  // namespace
}  // namespace ostia::live
