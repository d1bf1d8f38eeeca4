#include "options.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <fstream>

namespace ostia::live {
namespace {

TEST(LiveOptions, AsTheyAreWritten) {
  const auto o = options_of({"motion.json", "--template", "t.vtp", "--ecg", "100.hea", "--lead", "V5",
                             "--view", "RAO30CAU25", "--x-ray", "--color", "curvature", "--phase", "38",
                             "--seconds", "2.5", "--speed", "0.5", "--measure"});
  ASSERT_TRUE(o);
  EXPECT_EQ(o->motion, "motion.json");
  EXPECT_EQ(o->surface, "t.vtp");
  EXPECT_EQ(o->lead, "V5");
  EXPECT_DOUBLE_EQ(o->view.lao_deg, -30.0);
  EXPECT_DOUBLE_EQ(o->view.cranial_deg, -25.0);
  EXPECT_TRUE(o->x_ray);
  EXPECT_EQ(o->value, glview::SurfaceValue::bending);
  EXPECT_DOUBLE_EQ(*o->phase, 0.38);
  EXPECT_DOUBLE_EQ(*o->seconds, 2.5);
  EXPECT_FALSE(o->vsync) << "measuring draws as fast as it can";
}

TEST(LiveOptions, RefusesWhatMakesNoSense) {
  const std::vector<std::vector<std::string>> wrong{{},
                                                    {"m.json", "--demo"},
                                                    {"--demo", "--template", "t.vtp"},
                                                    {"--demo", "--view", "LAO"},
                                                    {"--demo", "--phase", "101"},
                                                    {"--demo", "--speed", "0"},
                                                    {"--demo", "--color", "pink"},
                                                    {"--demo", "--screenshot", "a.png", "--video", "v"},
                                                    {"--demo", "--frames", "0"},
                                                    {"--demo", "--width", "10"},
                                                    {"--demo", "--start", "nan"},
                                                    {"--demo", "--speed", "nan"},
                                                    {"--demo", "--phase", "nan"},
                                                    {"--demo", "--fps", "nan"},
                                                    {"--demo", "--seconds", "nan"},
                                                    {"--demo", "--turn"},
                                                    {"--demo", "--nonsense"}};
  for (const auto& arguments : wrong)
    EXPECT_THROW(options_of(arguments), UsageError) << (arguments.empty() ? "" : arguments.back());
}

TEST(LiveOptions, OfATreeRefuseWhatIsOfHearts) {
  const std::string tree = ::testing::TempDir() + "live_options_tree.swc";
  std::ofstream(tree) << "1 0 0 0 0 1 -1\n2 0 0 0 5 1 1\n";
  EXPECT_TRUE(options_of({tree})->tree);
  EXPECT_TRUE(options_of({tree, "--view", "AP", "--screenshot", "a.png"})->tree);
  EXPECT_FALSE(options_of({"--demo"})->tree);
  const std::vector<std::vector<std::string>> wrong{
      {"--ecg", "100.hea"}, {"--lead", "2"},        {"--phase", "0"}, {"--speed", "2"},
      {"--start", "3"},     {"--color", "stretch"}, {"--x-ray"},      {"--template", "t.vtp"}};
  for (std::vector<std::string> one : wrong) {
    const std::string name = one.front();
    one.insert(one.begin(), tree);
    try {
      options_of(one);
      ADD_FAILURE() << name << " was taken";
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(name + " is of hearts"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace ostia::live
