// The list of filters, and steps read from text.

#include "ostia/core/error.h"
#include "ostia/filtering/filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace ostia::filtering {
namespace {

using ::testing::HasSubstr;

std::string refusal_of(const std::string& text) {
  try {
    step_of_text(text);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(FilterList, EveryFilterSaysWhatItIsAndTakesItsOwnDefaults) {
  std::set<std::string> names;
  for (const FilterFacts& one : filters()) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    EXPECT_FALSE(one.text.empty()) << one.name;
    EXPECT_THAT(one.itk, HasSubstr("ImageFilter")) << one.name;
    EXPECT_EQ(one.unit.empty(), one.result != Result::own) << one.name;
    EXPECT_GE(one.bytes_per_voxel, 4.0) << one.name;
    for (const ParameterFacts& parameter : one.parameters) {
      EXPECT_LT(parameter.least, parameter.most) << one.name << " " << parameter.name;
      EXPECT_EQ(parameter.name.ends_with("_mm"), parameter.unit == "mm") << one.name << " " << parameter.name;
    }
    EXPECT_NO_THROW(validate({one.name, {}})) << one.name;
  }
  EXPECT_GE(names.size(), 20u);
}

TEST(FilterStep, ReadsWhatItWrites) {
  for (const FilterFacts& one : filters()) {
    const FilterStep step = step_of_text(one.name);
    const std::string text = text_of(step);
    EXPECT_EQ(text_of(step_of_text(text)), text);
    for (const ParameterFacts& parameter : one.parameters)
      EXPECT_EQ(value_of(step_of_text(text), parameter.name), parameter.value) << text;
  }
  const FilterStep step = step_of_text("objectness:bright=no,sigma_least_mm=1,sigma_most_mm=1,scales=1");
  EXPECT_EQ(value_of(step, "bright"), 1.0);
  EXPECT_EQ(value_of(step, "alpha"), 0.5);
  EXPECT_THAT(text_of(step), HasSubstr("object=tube,bright=no,sigma_least_mm=1,"));
}

TEST(FilterStep, RefusesInASentenceThatNamesTheNearest) {
  EXPECT_THAT(refusal_of("gausian:sigma_mm=1"), HasSubstr("the nearest name is \"gaussian\""));
  EXPECT_THAT(refusal_of("N4"), HasSubstr("the nearest name is \"n4\""));
  EXPECT_THAT(refusal_of(""), HasSubstr("there is no filter \"\""));
  EXPECT_THAT(refusal_of("median:radius=1"), HasSubstr("the nearest is \"radius_mm\""));
  EXPECT_THAT(refusal_of("resample:by=liner"), HasSubstr("the nearest is linear"));
  EXPECT_THAT(refusal_of("gaussian:sigma_mm=-1"), HasSubstr("a number from 0.05 to 50 (mm)"));
  EXPECT_THAT(refusal_of("gaussian:sigma_mm=1e999"), HasSubstr("sigma_mm must be"));
  EXPECT_THAT(refusal_of("gaussian:sigma_mm=nan"), HasSubstr("sigma_mm must be"));
  EXPECT_THAT(refusal_of("gaussian:sigma_mm=0,5"), HasSubstr("sigma_mm must be"));
  EXPECT_THAT(refusal_of("gaussian:sigma_mm"), HasSubstr("write sigma_mm=0.5"));
  EXPECT_THAT(refusal_of("gaussian:sigma_mm=1,sigma_mm=2"), HasSubstr("given twice"));
  EXPECT_THAT(refusal_of("curvature-flow:steps=1.5"), HasSubstr("a whole number from 1 to 1000"));
  EXPECT_THAT(refusal_of("threshold:lower=2,upper=1"), HasSubstr("lower (2) is above upper (1)"));
  EXPECT_THAT(refusal_of("objectness:sigma_least_mm=3"), HasSubstr("is above sigma_most_mm"));
  EXPECT_THAT(refusal_of("distance:a=1"), HasSubstr("nor any other"));
  EXPECT_THAT(refusal_of(std::string(100000, 'x')), HasSubstr("there is no filter"));
}

TEST(FilterMemory, IsToldForTheLargestStepAndGrid) {
  imaging::Geometry grid;
  grid.size = {100, 100, 10};
  const auto of = [&](const std::vector<std::string>& texts) {
    std::vector<FilterStep> steps;
    for (const std::string& text : texts) steps.push_back(step_of_text(text));
    return memory_needed(grid, steps);
  };
  EXPECT_EQ(of({"median"}), 1200000u);  // 4 bytes of the image and 8 of the filter
  EXPECT_EQ(of({"median", "objectness"}), 5200000u);
  EXPECT_GT(of({"resample:spacing_mm=0.5", "median"}), 8 * of({"median"}) - 1);
  EXPECT_THROW(of({}), InvalidInput);
  grid.spacing = {2.0, 2.0, 2.0};
  EXPECT_THROW(of({"resample:spacing_mm=0.05"}), InvalidInput) << "6.4e9 voxels";
}

TEST(FilterGrid, AResampledImageKeepsItsOuterFaces) {
  imaging::Geometry grid;
  grid.size = {10, 20, 30};
  grid.spacing = {1.0, 0.5, 2.0};
  grid.origin = {5.0, 6.0, 7.0};
  grid.direction << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const imaging::Geometry to = grid_after(grid, {step_of_text("resample:spacing_mm=0.5")});
  EXPECT_EQ(to.size, (std::array<std::int64_t, 3>{20, 20, 120}));
  EXPECT_LT((to.world({-0.5, -0.5, -0.5}) - grid.world({-0.5, -0.5, -0.5})).norm(), 1e-12);
  EXPECT_LT((to.world({19.5, 19.5, 119.5}) - grid.world({9.5, 19.5, 29.5})).norm(), 1e-12);
}

}  // namespace
}  // namespace ostia::filtering
