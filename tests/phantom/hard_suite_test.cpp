#include "ostia/phantom/hard_suite.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/phantom/case_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace ostia::phantom {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr std::uint64_t many = 4000;

std::size_t row_named(const std::string& name) {
  const std::vector<HardQuantity> rows = hard_quantities();
  const auto at = std::ranges::find(rows, name, &HardQuantity::name);
  if (at == rows.end()) throw InvalidInput("no " + name);
  return static_cast<std::size_t>(at - rows.begin());
}

std::vector<double> drawn_values(const std::string& name, const HardStrength& strength = {}) {
  const std::size_t row = row_named(name);
  std::vector<double> values;
  for (std::uint64_t seed = 1; seed <= many; ++seed)
    values.push_back(values_of(draw_hard(seed, strength))[row]);
  return values;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

TEST(HardSuite, EveryQuantityLiesInItsRangeAndIsHadByItsShareOfCases) {
  for (const HardQuantity& row : hard_quantities()) {
    EXPECT_LT(row.least, row.most) << row.name;
    const std::vector<double> values = drawn_values(row.name);
    std::size_t with = 0;
    for (const double value : values) {
      if (row.share < 1.0 && value == row.without) continue;
      ++with;
      EXPECT_GE(value, row.least) << row.name;
      EXPECT_LE(value, row.most) << row.name;
    }
    EXPECT_NEAR(static_cast<double>(with) / many, row.share, 0.025) << row.name;
  }
}

TEST(HardSuite, SpreadsAreThoseOfTheTable) {
  const HardQuantity noise = hard_quantities()[row_named("noise")];
  EXPECT_EQ(noise.spread, Spread::log_normal);
  EXPECT_NEAR(median(drawn_values("noise")), noise.middle, 0.03 * noise.middle);
  const HardQuantity slice = hard_quantities()[row_named("slice")];
  EXPECT_EQ(slice.spread, Spread::uniform);
  EXPECT_NEAR(median(drawn_values("slice")), 0.5 * (slice.least + slice.most), 0.02);
  const HardQuantity contrast = hard_quantities()[row_named("contrast")];
  EXPECT_EQ(contrast.spread, Spread::normal);
  EXPECT_NEAR(median(drawn_values("contrast")), contrast.middle, 6.0);
}

TEST(HardSuite, IsStrongerWhereItIsAskedToBe) {
  const double usual = median(drawn_values("motion during the exposure"));
  EXPECT_NEAR(median(drawn_values("motion during the exposure", {.motion = 1.5})), 1.5 * usual, 1e-9);
  EXPECT_EQ(draw_hard(3, {.noise = 0.0}).noise_hu, 0.0);
  EXPECT_EQ(draw_hard(3, {.motion = 2.0}).noise_hu, draw_hard(3).noise_hu);
  EXPECT_THAT([] { draw_hard(1, {.venous = -1.0}); },
              ThrowsMessage<InvalidInput>(HasSubstr("the strength of venous contrast must be 0 to 5")));
}

TEST(HardSuite, ObstaclesAreDrawnStrongerWhereAskedAndGoIntoTheCase) {
  const double usual = median(drawn_values("nearness of veins"));
  EXPECT_LT(median(drawn_values("nearness of veins", {.contact = 0.5})), usual);
  EXPECT_EQ(draw_hard(3, {.contact = 0.0}).obstacles.lobes, 0.0);
  EXPECT_EQ(draw_hard(3, {.fall = 0.5}).obstacles.vein_closeness, draw_hard(3).obstacles.vein_closeness);
  CaseOptions patient;
  while (draw_hard(patient.seed).obstacles.calcified_mm <= 0.0 || draw_hard(patient.seed).calcium > 0.0)
    ++patient.seed;
  EXPECT_EQ(hard_case(patient).obstacles, draw_hard(patient.seed).obstacles);
  EXPECT_EQ(hard_case(patient).variant.calcium, 1.0) << "plaques are calcified, too";
  EXPECT_EQ(CaseOptions{}.obstacles, Obstacles{}) << "of the other suites";
}

TEST(HardSuite, RareAnatomiesAreRareAndGraftsComeWithWires) {
  std::map<Anatomy, int> counts;
  for (std::uint64_t seed = 1; seed <= many; ++seed) {
    const HardDraw draw = draw_hard(seed);
    ++counts[draw.anatomy];
    if (draw.anatomy == Anatomy::bypass) {
      EXPECT_GT(draw.realism.sternal_wires, 0);
    }
  }
  EXPECT_EQ(counts.size(), anatomy_words().size());
  EXPECT_NEAR(counts[Anatomy::usual], 0.945 * many, 0.015 * many);
  EXPECT_NEAR(counts[Anatomy::bypass], 0.03 * many, 0.01 * many);
}

TEST(HardSuite, CasesAreSoundForEveryPresetAndKeepWhatIsNotDrawn) {
  for (const Preset preset : {Preset::tiny, Preset::small, Preset::full})
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      CaseOptions usual;
      usual.seed = seed;
      usual.preset = preset;
      usual.contours.points = 16;
      CaseOptions made = hard_case(usual);
      EXPECT_EQ(made.seed, seed);
      EXPECT_EQ(made.contours.points, 16);
      EXPECT_NO_THROW(validate(made)) << seed;
      made.scan.grid.size = {8, 8, 8};
      const double voxel = preset == Preset::full ? 0.35 : preset == Preset::small ? 0.7 : 0.5;
      made.scan.grid.spacing = {voxel, voxel, voxel};
      EXPECT_NO_THROW(validate(made.scan)) << seed;
    }
  CaseOptions grafted;
  while (draw_hard(grafted.seed).anatomy != Anatomy::bypass) ++grafted.seed;
  EXPECT_EQ(hard_case(grafted).variant.anatomy, Anatomy::bypass);
  grafted.patient = std::make_shared<PatientTree>();
  EXPECT_EQ(hard_case(grafted).variant.anatomy, Anatomy::usual);
}

TEST(HardSuite, ASuiteOfItSaysSoAndEachOfItsCasesSaysWhatWasDrawn) {
  SuiteOptions options;
  options.first.preset = Preset::tiny;
  options.first.surface_spacing_mm = 1.0;
  options.first.seed = 21;
  options.truth_only = true;
  options.report = false;
  options.hard = true;
  const auto folder = testing::temporary_folder("hard-suite") / "suite";
  write_suite(folder, options, {});
  const auto facts = nlohmann::json::parse(core::read_file(folder / "dataset00" / "case.json"));
  EXPECT_DOUBLE_EQ(facts["parameters"]["scan"]["noise_hu"], draw_hard(21).noise_hu);
  EXPECT_DOUBLE_EQ(facts["parameters"]["variant"]["contrast_hu"], draw_hard(21).contrast_hu);
  EXPECT_EQ(nlohmann::json::parse(core::read_file(folder / "suite.json"))["parameters"]["suite"], "hard");
  EXPECT_NE(parameters_json(options), parameters_json([&] {
              SuiteOptions plain = options;
              plain.hard = false;
              return plain;
            }()));
}

}  // namespace
}  // namespace ostia::phantom
