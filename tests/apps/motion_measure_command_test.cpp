// `ostia motion measure`: how a tree's branches move.

#include "moving_shapes.h"
#include "program.h"

#include "ostia/core/files.h"
#include "ostia/io/cage_motion_file.h"
#include "ostia/io/centerline_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
namespace shapes = analysis::testing;
using ::testing::Contains;
using ::testing::HasSubstr;
using Json = nlohmann::json;

const shapes::Helix helix;
const shapes::HeartBeat beat;

/// `lines.vtp`, a helix, and `motion.json`, a cage that thins, shortens and turns it.
fs::path beating_helix(int phases = 20) {
  const fs::path folder = temporary_folder("motion-measure");
  geometry::VesselTree tree = shapes::apart({helix.points(80.0)});
  tree.vessels[0].name = "LAD";
  io::write_centerlines(folder / "lines.vtp", tree);
  io::write_cage_motion(folder / "motion.json",
                        {shapes::cage_of(tree, beat, shapes::heart_box, 4, phases), ""});
  return folder;
}

std::string motion_measure_refusal(const std::vector<std::string>& arguments, const fs::path& folder,
                                   int code = 3) {
  const Outcome done = ostia(arguments, {folder, ""});
  EXPECT_EQ(done.code, code) << done.err;
  return done.err;
}

TEST(MotionMeasureCommand, ExplainsItselfWithAnExample) {
  const Outcome done = ostia({"motion", "measure", "--help"});
  EXPECT_EQ(done.code, 0);
  EXPECT_THAT(done.out, HasSubstr("Example:\n  ostia motion measure "));
}

TEST(MotionMeasureCommand, StretchAndTorsionAreTheMotionsWithinFivePercent) {
  const fs::path folder = beating_helix();
  const std::vector<std::string> command{"motion", "measure", "motion.json", "lines.vtp", "-o",
                                         "out",    "--times", "10",          "--json"};
  const Outcome made = ostia(command, {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  const Json all = Json::parse(made.out);
  EXPECT_EQ(all, Json::parse(core::read_file(folder / "out" / "measures.json")));
  EXPECT_EQ(all["branches"][0]["name"], "LAD");
  const Json& measures = all["branches"][0]["measures"];
  const double change = std::abs(beat.stretch(helix, 0.5) - 1.0);
  for (std::size_t k = 0; k < 10; ++k) {
    const double phase = all["percents"][k].get<double>() / 100.0;
    EXPECT_NEAR(measures["stretch"]["values"][k].get<double>(), beat.stretch(helix, phase), 0.05 * change);
    const double torsion = beat(helix, phase).torsion();
    EXPECT_NEAR(measures["torsion_mean"]["values"][k].get<double>(), torsion, 0.05 * torsion);
    const double curvature = beat(helix, phase).curvature();
    EXPECT_NEAR(measures["curvature_mean"]["values"][k].get<double>(), curvature, 0.05 * curvature);
  }
  const auto names = names_in(folder / "out");
  for (const char* name : {"along.csv", "manifest.json", "measures.csv", "measures.json", "report.html",
                           "pictures/stretch.png", "pictures/stretch.svg", "pictures/torsion_mean.svg"})
    EXPECT_THAT(names, Contains(name));
  const Outcome again = ostia(command, {folder, ""});
  EXPECT_EQ(again.out, made.out);
  EXPECT_THAT(again.err, HasSubstr("nothing to do"));
}

TEST(MotionMeasureCommand, TakesACaseAndSaysInWordsWhatItFound) {
  const fs::path folder = beating_helix();
  ASSERT_EQ(ostia({"lumen", "lines.vtp", "-o", "lumen.stl", "--case", "heart.ostia"}, {folder, ""}).code, 0);
  const Outcome made =
      ostia({"motion", "measure", "motion.json", "heart.ostia", "-o", "out", "--times", "20"}, {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("LAD: 80.0 mm long, moves up to "));
  EXPECT_THAT(made.out, HasSubstr("at rest from "));
}

TEST(MotionMeasureCommand, RefusesInOneMessage) {
  const fs::path folder = beating_helix(4);
  Json two = Json::parse(core::read_file(folder / "motion.json"));
  two["phases"].erase(3);
  two["phases"].erase(2);
  core::write_file(folder / "motion.json", two.dump());
  EXPECT_THAT(motion_measure_refusal({"motion", "measure", "motion.json", "lines.vtp", "-o", "out"}, folder),
              HasSubstr("three at least"));
  const fs::path sound = beating_helix(4);
  EXPECT_THAT(motion_measure_refusal({"motion", "measure", "none.json", "lines.vtp", "-o", "out"}, sound),
              HasSubstr("none.json"));
  core::write_file(sound / "far.csv", "x,y,z,radius\n500,0,0,1\n500,0,10,1\n500,0,20,1\n");
  EXPECT_THAT(motion_measure_refusal({"motion", "measure", "motion.json", "far.csv", "-o", "out"}, sound),
              HasSubstr("far.csv: 100.0 % of the axes lie outside of the motion's cage"));
  EXPECT_FALSE(fs::exists(sound / "out"));
  motion_measure_refusal({"motion", "measure", "motion.json", "lines.vtp", "-o", "out", "--times", "2"},
                         sound, 2);
  motion_measure_refusal({"motion", "measure", "motion.json", "lines.vtp", "-o", "out", "--rr", "0"}, sound,
                         2);
}

}  // namespace
}  // namespace ostia::testing
