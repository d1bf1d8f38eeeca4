// Pressures as if a stretch were opened or narrowed: against trees that are so.

#include "ostia/session/pressure_what_if.h"

#include "report_cases.h"

#include "ostia/core/error.h"
#include "ostia/core/quantity_text.h"
#include "ostia/session/pressure_document.h"
#include "ostia/session/pressure_readout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::session::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

PressureReport pressures_of(const geometry::VesselTree& tree, std::vector<WhatIf> what_ifs = {}) {
  PressureReportOptions options;
  options.what_ifs = std::move(what_ifs);
  return make_pressure_report(pressure_tree(tree), options);
}

double ffr_at_end(const PressureReport& report, std::size_t outlet = 0) {
  return report.under_hyperaemia.pullbacks.at(outlet).points.back().ratio;
}

double ffr_at_end_if(const PressureReport& report, std::size_t outlet = 0) {
  return report.after->under_hyperaemia.pullbacks.at(outlet).points.back().ratio;
}

TEST(PressureWhatIf, AnOpenedNarrowingIsAVesselWithoutOne) {
  const lumen::LumenModel narrowed = narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.45);
  const lumen::LumenModel healthy = narrowed_tube("LAD", 60.0, 1.6, 25.0, 1.6);
  const std::int32_t vessel = narrowed.tree.vessels[0].id;
  const PressureReport report = pressures_of(narrowed.tree, {{vessel, 18.0, 32.0, WhatIfKind::open, 0.0}});
  ASSERT_TRUE(report.after);
  EXPECT_LT(ffr_at_end(report), 0.75);
  EXPECT_NEAR(ffr_at_end_if(report), ffr_at_end(pressures_of(healthy.tree)), 0.005);
  ASSERT_THAT(report.tree.lesions, SizeIs(1)) << "the lumen is as it was";
  EXPECT_GT(report.after->under_hyperaemia.lesions[0].behind, 0.9);
  EXPECT_GT(report.after->hyperaemia.solution.flow_ml_s[0], report.hyperaemia.solution.flow_ml_s[0]);
}

TEST(PressureWhatIf, WhatIsLeftIsANarrowingOfThatPercent) {
  const lumen::LumenModel narrowed = narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.5);
  const std::int32_t vessel = narrowed.tree.vessels[0].id;
  const PressureTree tree = pressure_tree(narrowed.tree);
  const auto changed = branches_if(tree, {{vessel, 15.0, 35.0, WhatIfKind::open, 40.0}});
  ASSERT_THAT(changed, SizeIs(1));
  double least = HUGE_VAL;
  for (const auto& station : changed.at(0).stations) least = std::min(least, station.diameter_mm());
  EXPECT_NEAR(least, 0.6 * 3.2, 0.03);
  EXPECT_EQ(changed.at(0).stations.size(), tree.network.branches[0].stations.size());
}

TEST(PressureWhatIf, ANarrowedStretchIsAVesselThatHasIt) {
  const lumen::LumenModel healthy = narrowed_tube("LAD", 60.0, 1.6, 25.0, 1.6);
  const lumen::LumenModel narrowed = narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.64);  // 60 %, over 8 mm
  const std::int32_t vessel = healthy.tree.vessels[0].id;
  const PressureReport report = pressures_of(healthy.tree, {{vessel, 21.0, 29.0, WhatIfKind::narrow, 60.0}});
  EXPECT_NEAR(ffr_at_end_if(report), ffr_at_end(pressures_of(narrowed.tree)), 0.01);
  EXPECT_GT(ffr_at_end(report), 0.95);
}

TEST(PressureWhatIf, TheRestOfTheTreeFollowsAndItsBedsStay) {
  const lumen::LumenModel model = narrowed_y(0, 8.0, 0.7);  // in the trunk
  const std::int32_t side = model.tree.vessels[1].id;       // its way begins on the trunk
  const PressureReport report = pressures_of(model.tree, {{side, 2.0, 14.0, WhatIfKind::open, 0.0}});
  for (std::size_t k = 0; k < 2; ++k) EXPECT_GT(ffr_at_end_if(report, k), ffr_at_end(report, k) + 0.05) << k;
  ASSERT_EQ(report.after->hyperaemia.boundary.outlets.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_EQ(report.after->hyperaemia.boundary.outlets[k].resistance_pa_s_ml,
              report.hyperaemia.boundary.outlets[k].resistance_pa_s_ml);
}

TEST(PressureWhatIf, AnOcclusionThatIsOpenedLetsBloodThrough) {
  const lumen::LumenModel model = shut_tube();
  PressureReportOptions options;
  options.what_ifs = {{model.tree.vessels[0].id, 14.0, 26.0, WhatIfKind::open, 0.0}};
  const PressureReport report =
      make_pressure_report(pressure_tree(model, solved_surfaces(model, core::no_task())), options);
  EXPECT_EQ(report.hyperaemia.solution.flow_ml_s[0], 0.0);
  EXPECT_GT(report.after->hyperaemia.solution.flow_ml_s[0], 0.5);
  EXPECT_FALSE(ffr_at(report, 4, 30.0));
  ASSERT_TRUE(ffr_after_at(report, 4, 30.0));
  EXPECT_GT(*ffr_after_at(report, 4, 30.0), 0.8);
  EXPECT_THAT(pressure_json(report), Not(HasSubstr("nan")));
}

TEST(PressureWhatIf, WhatChangesNothingIsTold) {
  const lumen::LumenModel model = narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.8);
  const std::int32_t vessel = model.tree.vessels[0].id;
  const PressureReport report = pressures_of(model.tree, {{vessel, 45.0, 55.0, WhatIfKind::open, 10.0}});
  EXPECT_THAT(report.warnings, ::testing::Contains(HasSubstr("nothing is changed")));
  EXPECT_NEAR(ffr_at_end_if(report), ffr_at_end(report), 1e-9);
}

TEST(PressureWhatIf, BothResultsAreInTheFile) {
  const lumen::LumenModel model = narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.45);
  const auto json = nlohmann::json::parse(pressure_json(
      pressures_of(model.tree, {{model.tree.vessels[0].id, 18.0, 32.0, WhatIfKind::open, 0.0}})));
  EXPECT_LT(json["lesions"][0]["ffr"].get<double>(), 0.8);
  EXPECT_GT(json["what_if"]["lesions"][0]["ffr"].get<double>(), 0.8);
  EXPECT_EQ(json["what_if"]["stretches"][0]["kind"], "open");
  EXPECT_FALSE(nlohmann::json::parse(pressure_json(pressures_of(model.tree))).contains("what_if"));
}

TEST(PressureWhatIf, StretchesAreReadFromText) {
  const geometry::VesselTree tree = named_y().tree;
  const WhatIf one = what_if_of_text("LCX:12.5-30:20", WhatIfKind::open, tree);
  EXPECT_EQ(one, (WhatIf{tree.vessels[1].id, 12.5, 30.0, WhatIfKind::open, 20.0}));
  EXPECT_EQ(what_if_of_text(std::to_string(tree.vessels[0].id) + ":1-2", WhatIfKind::open, tree).vessel,
            tree.vessels[0].id);
  const auto refused = [&](const std::string& text, WhatIfKind kind, const std::string& says) {
    try {
      what_if_of_text(text, kind, tree);
      ADD_FAILURE() << text;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(std::string(error.what()), HasSubstr(says)) << text;
    }
  };
  refused("LAD", WhatIfKind::open, "VESSEL:FROM-TO");
  refused("LAD:3", WhatIfKind::open, "VESSEL:FROM-TO");
  refused("LAD:3-x", WhatIfKind::open, "where a number belongs");
  refused("LAD:3-9:1:2", WhatIfKind::open, "VESSEL:FROM-TO");
  refused("LAD:9-3", WhatIfKind::open, "is none");
  refused("LAD:3-9", WhatIfKind::narrow, "VESSEL:FROM-TO:PERCENT");
  refused("LAD:3-9:120", WhatIfKind::narrow, "1 to 99");
  refused("OM1:3-9", WhatIfKind::open, "it has LAD, LCX");
}

TEST(PressureReadout, FollowsAVesselsWayThroughItsParents) {
  const lumen::LumenModel model = narrowed_y(0, 8.0, 0.7);
  const PressureReport report = pressures_of(model.tree);
  const std::int32_t main = model.tree.vessels[0].id, side = model.tree.vessels[1].id;
  EXPECT_THAT(branches_on_way(report.network->network(), side), SizeIs(2));
  EXPECT_THAT(branches_on_way(report.network->network(), 99), IsEmpty());
  EXPECT_FALSE(ffr_at(report, 99, 1.0));
  EXPECT_NEAR(*ffr_at(report, main, 5.0), *ffr_at(report, side, 5.0), 1e-9) << "the trunk is of both";
  const std::vector<FfrPoint> along = ffr_along(report, side);
  for (std::size_t i = 1; i < along.size(); ++i) EXPECT_GE(along[i].s_mm, along[i - 1].s_mm - 1e-6);
  EXPECT_TRUE(std::isnan(along.front().after));
  const auto falls = falls_to_threshold_mm(along, 0.9);
  ASSERT_TRUE(falls);
  EXPECT_NEAR(*ffr_at(report, side, *falls), 0.9, 1e-3);
  EXPECT_FALSE(falls_to_threshold_mm(along, 0.0));
}

TEST(PressureReadout, OfALesionIsThatOfTheReport) {
  const lumen::LumenModel model = narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.7);
  const PressureReport report = pressures_of(model.tree);
  analysis::Stenosis place;
  place.vessel = model.tree.vessels[0].id;
  place.from_mm = report.tree.lesions[0].from.s_mm;
  place.throat_mm = report.tree.lesions[0].throat.s_mm;
  place.to_mm = report.tree.lesions[0].to.s_mm;
  analysis::Stenosis elsewhere = place;
  elsewhere.vessel = 99;
  const auto found = ffr_of_lesions(report, {elsewhere, place});
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_FALSE(found[0]);
  ASSERT_TRUE(found[1]);
  EXPECT_NEAR(found[1]->now.behind, report.under_hyperaemia.lesions[0].behind, 1e-12);
  EXPECT_FALSE(found[1]->after);
}

TEST(PressureDocument, SaysHowSureItIs) {
  const lumen::LumenModel model = narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.45);
  hemodynamics::UncertaintyOptions drawn;
  drawn.samples = 64;
  const PressureReport report = with_uncertainty(pressures_of(model.tree), drawn);
  const auto& lesion = report.uncertainty->lesions.at(0).ratio;
  const std::string english = pressure_html(report, {});
  EXPECT_THAT(english, HasSubstr("How sure"));
  EXPECT_THAT(english, HasSubstr(core::ratio_text(lesion.low) + " - " + core::ratio_text(lesion.high)));
  EXPECT_THAT(english, HasSubstr("Of 64 trees drawn"));
  EXPECT_THAT(english, HasSubstr("wall "));
  PressureDocumentOptions german;
  german.language = ReportLanguage::german;
  const std::string other = pressure_html(report, german);
  EXPECT_THAT(other, HasSubstr("Wie sicher"));
  EXPECT_THAT(other, HasSubstr("Wand "));
  for (const char* left : {"How sure", "lie in", "Varies", "wall ", "trees drawn"})
    EXPECT_THAT(other, Not(HasSubstr(left)));
  EXPECT_THAT(pressure_html(pressures_of(model.tree), {}), Not(HasSubstr("How sure")));
}

TEST(PressureDocument, HasInputsCurvesTableAndTheSentenceInBothLanguages) {
  const lumen::LumenModel model = narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.45);
  const PressureReport report =
      pressures_of(model.tree, {{model.tree.vessels[0].id, 18.0, 32.0, WhatIfKind::open, 10.0}});
  PressureDocumentOptions options;
  options.date = "2026-03-01";
  const std::string english = pressure_html(report, options);
  EXPECT_THAT(english, HasSubstr("no decision on a patient may rest on them"));
  EXPECT_THAT(english, HasSubstr("systolic pressure by cuff"));
  EXPECT_THAT(english, HasSubstr("Bos et al. 2007"));
  EXPECT_THAT(english, HasSubstr("FFR along its way from the aorta, as it is and what if"));
  EXPECT_THAT(english, HasSubstr("opened to the reference, 10 % left"));
  EXPECT_THAT(pressure_curves(report, options), SizeIs(1));
  options.language = ReportLanguage::german;
  const std::string german = pressure_html(report, options);
  EXPECT_THAT(german, HasSubstr("keine Entscheidung"));
  EXPECT_THAT(german, HasSubstr("systolischer Druck nach Manschette"));
  for (const char* left : {"Narrowings", "by cuff", "What if", "Inputs", "usual value", "at rest"})
    EXPECT_THAT(german, Not(HasSubstr(left)));
  options.language = ReportLanguage::english;
  const std::vector<figure::Picture> pages = pressure_pages(report, options);
  EXPECT_GE(pages.size(), 2u);
  if (const char* pictures = std::getenv("OSTIA_PICTURES"))
    for (std::size_t i = 0; i < pages.size(); ++i)
      pages[i].write_png(fs::path(pictures) / ("pressure-report-" + std::to_string(i + 1) + ".png"));
  const std::string pdf = pressure_pdf(report, options);
  EXPECT_THAT(pdf, ::testing::StartsWith("%PDF"));
  EXPECT_EQ(pdf, pressure_pdf(report, options)) << "the same bytes";
}

TEST(PressureDocument, SaysEveryInputInGerman) {
  const core::Phrasebook& german = pressure_words(ReportLanguage::german);
  for (const auto& input : hemodynamics::condition_inputs())
    EXPECT_NE(german.say(input.meaning), input.meaning) << input.key;
}

}  // namespace
}  // namespace ostia::session::testing
