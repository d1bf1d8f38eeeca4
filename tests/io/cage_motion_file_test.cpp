#include "ostia/io/cage_motion_file.h"

#include "io_test_support.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <functional>

namespace ostia::io {
namespace {

using geometry::PhaseOrigin;
using geometry::Vec3;
using ::testing::HasSubstr;
using Json = nlohmann::json;

CageMotionFile some_motion() {
  CageMotionFile file;
  file.surface = "template.vtp";
  file.motion.grid = geometry::cage_around({Vec3(-10.0, -1.0 / 3.0, 5.0), Vec3(20.0, 8.1, 40.7)}, 1);
  file.motion.template_phase = 0.75;
  for (int k = 0; k < 20; ++k) {
    geometry::CagePhase phase;
    phase.phase = k / 20.0;
    phase.origin = k == 15 ? PhaseOrigin::at_rest : k == 3 ? PhaseOrigin::bridged : PhaseOrigin::fitted;
    for (const Vec3& p : geometry::rest_points(file.motion.grid))
      phase.control_points.push_back(p + Vec3(1e-7 / 3.0, std::sin(k), 1234.5678901234567 * k));
    file.motion.phases.push_back(std::move(phase));
  }
  return file;
}

TEST(CageMotionFile, ReadsBackWhatWasWritten) {
  const auto path = testing::temporary_folder("motion") / "motion.json";
  const CageMotionFile file = some_motion();
  write_cage_motion(path, file);
  const CageMotionFile back = read_cage_motion(path);
  EXPECT_EQ(back.surface, file.surface);
  EXPECT_EQ(back.motion.grid.origin, file.motion.grid.origin);
  EXPECT_EQ(back.motion.grid.cell_mm, file.motion.grid.cell_mm);
  EXPECT_EQ(back.motion.grid.cells, file.motion.grid.cells);
  EXPECT_EQ(back.motion.template_phase, 0.75);
  ASSERT_EQ(back.motion.phases.size(), 20U);
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_EQ(back.motion.phases[k].phase, file.motion.phases[k].phase);
    EXPECT_EQ(back.motion.phases[k].origin, file.motion.phases[k].origin);
    EXPECT_EQ(back.motion.phases[k].control_points, file.motion.phases[k].control_points);
  }
}

TEST(CageMotionFile, PhasesThatAreNoWholePercentStayWhereTheyAre) {
  const auto path = testing::temporary_folder("motion") / "motion.json";
  CageMotionFile file = some_motion();
  file.motion.phases.resize(3);
  file.motion.phases[1].phase = 1.0 / 7.0;
  file.motion.phases[2].phase = 1.0 - 1e-10;
  file.surface.clear();
  write_cage_motion(path, file);
  const CageMotionFile back = read_cage_motion(path);
  EXPECT_TRUE(back.surface.empty());
  EXPECT_NEAR(back.motion.phases[1].phase, 1.0 / 7.0, 1e-11);
  EXPECT_NEAR(back.motion.phases[2].phase, 1.0 - 1e-10, 1e-11);
  EXPECT_LT(back.motion.phases[2].phase, 1.0);
}

std::string refusal(const std::filesystem::path& path) {
  try {
    read_cage_motion(path);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "read, and not refused";
}

TEST(CageMotionFile, RefusesByFileAndField) {
  const auto folder = testing::temporary_folder("motion");
  write_cage_motion(folder / "good.json", some_motion());
  const Json good = Json::parse(core::read_file(folder / "good.json"));
  const auto told = [&](const std::function<void(Json&)>& change) {
    Json broken = good;
    change(broken);
    core::write_file(folder / "broken.json", broken.dump());
    const std::string message = refusal(folder / "broken.json");
    EXPECT_THAT(message, HasSubstr("broken.json"));
    return message;
  };
  EXPECT_THAT(told([](Json& j) { j["v"] = 2; }), HasSubstr("v is not 1"));
  EXPECT_THAT(told([](Json& j) { j["unit"] = "m"; }), HasSubstr("unit is not mm"));
  EXPECT_THAT(told([](Json& j) { j["axes"] = "RAS"; }), HasSubstr("axes is not LPS"));
  EXPECT_THAT(told([](Json& j) { j.erase("grid"); }), HasSubstr("grid is missing"));
  EXPECT_THAT(told([](Json& j) { j["grid"]["cells"] = 2.5; }), HasSubstr("grid.cells"));
  EXPECT_THAT(told([](Json& j) { j["grid"]["cells"] = 3; }), HasSubstr("control points"));
  EXPECT_THAT(told([](Json& j) { j["grid"]["cell_mm"] = {1, 2}; }), HasSubstr("grid.cell_mm"));
  EXPECT_THAT(told([](Json& j) { j["grid"]["cell_mm"] = {1, 2, 0}; }), HasSubstr("grid"));
  EXPECT_THAT(told([](Json& j) { j["template"]["percent"] = "75"; }), HasSubstr("template.percent"));
  EXPECT_THAT(told([](Json& j) { j["template"]["percent"] = 100; }), HasSubstr("template"));
  EXPECT_THAT(told([](Json& j) { j["template"]["surface"] = "../a.vtp"; }), HasSubstr("template.surface"));
  EXPECT_THAT(told([](Json& j) { j["phases"] = 3; }), HasSubstr("phases is no list"));
  EXPECT_THAT(told([](Json& j) { j["phases"].erase(j["phases"].begin() + 2, j["phases"].end()); }),
              HasSubstr("phases are 2; a cycle has three at least"));
  EXPECT_THAT(told([](Json& j) { j["phases"] = Json(1001, 0); }), HasSubstr("phases are 1001"));
  EXPECT_THAT(told([](Json& j) { j["phases"][4]["origin"] = "guessed"; }), HasSubstr("phases[4].origin"));
  EXPECT_THAT(told([](Json& j) { j["phases"][4]["percent"] = 10; }), HasSubstr("rise"));
  EXPECT_THAT(told([](Json& j) {
                j["phases"][2]["control_points"][5] = {1, nullptr, 2};
              }),
              HasSubstr("phases[2].control_points[5]"));
  EXPECT_THAT(told([](Json& j) { j["phases"][2]["control_points"].erase(0); }), HasSubstr("10 %"));
  EXPECT_THAT(told([](Json& j) { j = Json::array(); }), HasSubstr("no object"));
  core::write_file(folder / "half.json", core::read_file(folder / "good.json").substr(0, 2000));
  EXPECT_THAT(refusal(folder / "half.json"), HasSubstr("is no JSON"));
  EXPECT_THROW(read_cage_motion(folder / "missing.json"), IoError);
}

TEST(CageMotionFile, NoPhaseIsWrittenAsTheNextCycles) {
  EXPECT_EQ(percent_of(0.35), 35.0);
  EXPECT_EQ(percent_of(1.0 / 3.0), 33.333333333);
  EXPECT_EQ(percent_of(1.0 - 0x1p-53), 99.999999999);
  const auto path = testing::temporary_folder("motion") / "motion.json";
  CageMotionFile file = some_motion();
  file.motion.phases.back().phase = 1.0 - 0x1p-53;
  write_cage_motion(path, file);
  EXPECT_NEAR(read_cage_motion(path).motion.phases.back().phase, 1.0, 1e-10);
}

TEST(CageMotionFile, WritesNothingThatCouldNotBeRead) {
  const auto path = testing::temporary_folder("motion") / "motion.json";
  CageMotionFile file = some_motion();
  file.surface = "a/b.vtp";
  EXPECT_THROW(write_cage_motion(path, file), InvalidInput);
  file = some_motion();
  file.motion.phases[7].control_points.pop_back();
  EXPECT_THROW(write_cage_motion(path, file), InvalidInput);
  file = some_motion();
  file.motion.phases.resize(2);
  EXPECT_THROW(write_cage_motion(path, file), InvalidInput);
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace ostia::io
