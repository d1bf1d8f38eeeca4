#include "options.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

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
                                                    {"--demo", "--nonsense"}};
  for (const auto& arguments : wrong)
    EXPECT_THROW(options_of(arguments), UsageError) << (arguments.empty() ? "" : arguments.back());
}

}  // namespace
}  // namespace ostia::live
