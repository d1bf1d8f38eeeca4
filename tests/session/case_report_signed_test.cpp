// The report that a reader signs: CAD-RADS as it is written, plaque burden, standard segments, high-risk
// plaque, impression, template, versions.

#include "report_cases.h"
#include "schema_rules.h"

#include "ostia/core/error.h"
#include "ostia/session/case_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::session {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// A vessel that is narrowed by 0.6, all of it checked, with what a person says of the report.
CaseReport told_report(const ReportNotes& notes, const ReportOptions& options = {},
                       const imaging::ImageVolume* image = nullptr) {
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6);
  Annotations annotations;
  annotations.marks.push_back({model.tree.vessels[0].id, true, true, std::nullopt, ""});
  annotations.report = notes;
  return report_of(model, annotations, {}, image, options);
}

const ReportStandardSegment& standard(const CaseReport& report, int number) {
  return report.standard_segments.at(static_cast<std::size_t>(number - 1));
}

TEST(SignedReport, HasAll18SegmentsWhetherTheTreeHasThemOrNot) {
  const CaseReport report = told_report({});
  ASSERT_THAT(report.standard_segments, SizeIs(18));
  int with_plaque = 0;
  for (int number = 1; number <= 18; ++number) {
    const ReportStandardSegment& row = standard(report, number);
    EXPECT_EQ(row.number, number);
    EXPECT_EQ(row.vessels.empty(), number > 3) << row.code;
    EXPECT_EQ(row.category.has_value(), number <= 3) << row.code;
    with_plaque += row.has_plaque ? 1 : 0;
  }
  ASSERT_THAT(report.stenoses, SizeIs(1));
  EXPECT_EQ(with_plaque, report.burden.segments);
  const ReportSegment* of_throat = nullptr;
  for (const ReportSegment& one : report.segments)
    if (one.label == report.stenoses[0].segment) of_throat = &one;
  ASSERT_TRUE(of_throat);
  const ReportStandardSegment& row = standard(report, of_throat->number);
  EXPECT_EQ(row.category, analysis::CadRads::three);
  EXPECT_EQ(row.worst_stenosis, 1);
  EXPECT_TRUE(row.has_plaque);
  EXPECT_NEAR(row.least_diameter_mm.value(), 1.2, 0.1);
}

TEST(SignedReport, StatesThePlaqueBurdenByEachWayAndTheHighest) {
  const CaseReport by_segments = told_report({});
  EXPECT_EQ(by_segments.burden.by_segments, analysis::PlaqueBurden::p1);
  EXPECT_EQ(by_segments.burden.stated, analysis::PlaqueBurden::p1);
  EXPECT_TRUE(by_segments.burden.at_least) << "the left arteries were not found";
  EXPECT_EQ(analysis::to_string(by_segments.statement), "3/P1/N");
  ReportNotes notes;
  notes.modifiers.agatston = 250.0;
  EXPECT_EQ(analysis::to_string(told_report(notes).statement), "3/P2/N");
  ReportOptions options;
  options.agatston = 1200.0;  // in place of the case's
  const CaseReport by_calcium = told_report(notes, options);
  EXPECT_EQ(by_calcium.burden.by_calcium, analysis::PlaqueBurden::p4);
  EXPECT_EQ(by_calcium.burden.by_segments, analysis::PlaqueBurden::p1) << "both are told";
  EXPECT_EQ(analysis::to_string(by_calcium.statement), "3/P4/N");
  notes.modifiers.stent = true;  // whose metal is no calcium
  EXPECT_EQ(analysis::to_string(told_report(notes, options).statement), "3/P1/N/S");
  notes.modifiers.seen = SeenPlaque{analysis::PlaqueAmount::severe, {}, {}};
  EXPECT_EQ(analysis::to_string(told_report(notes, options).statement), "3/P3/N/S");
  notes.modifiers.burden = analysis::PlaqueBurden::p2;
  const CaseReport chosen = told_report(notes, options);
  EXPECT_EQ(analysis::to_string(chosen.statement), "3/P2/N/S");
  EXPECT_TRUE(chosen.burden.by_reader);
}

TEST(SignedReport, HasTheReadersModifiers) {
  ReportNotes notes;
  notes.modifiers = told_modifiers().modifiers;
  notes.modifiers.graft = true;
  const CaseReport report = told_report(notes);
  EXPECT_EQ(analysis::to_string(report.statement), "3/P4/N/I\u00b1/S/G/E");
  EXPECT_EQ(report.dominance, analysis::Dominance::left);
  EXPECT_TRUE(report.dominance_by_reader);
  EXPECT_THAT(report_html(report, {}), HasSubstr("anomalous origin of the LCX"));
}

TEST(SignedReport, OfNoDiseaseHasNoPlaqueBurden) {
  ReportOptions options;
  options.agatston = 5.0;
  const lumen::LumenModel model = named_y();
  CaseReport report = checked_report(model, nullptr, options);
  EXPECT_THAT(report.stenoses, IsEmpty());
  EXPECT_EQ(report.burden.segments, 0);
  EXPECT_EQ(to_string(report.category), "N") << "there is no RCA";
  EXPECT_EQ(analysis::to_string(report.statement), "N/P1");
}

/// Plaque of 100 HU about the narrow part of a vessel, with a rim of 20 HU at the lumen on one side.
imaging::ImageVolume dark_plaque_image() {
  imaging::ImageVolume image = walled_image(1.5, 2.6, 100.0);
  const imaging::Geometry& grid = image.geometry;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        const geometry::Vec3 p =
            grid.world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
        const double rho = std::hypot(p.x(), p.y());
        if (p.x() > 0.3 && p.z() > 6.0 && p.z() < 32.0 && rho > 1.75 && rho < 2.35) image(i, j, k) = -20;
      }
  return image;
}

TEST(SignedReport, TellsFeaturesOfPlaqueWithTheReadersWordOnEach) {
  const imaging::ImageVolume image = dark_plaque_image();
  const CaseReport report = told_report({}, {}, &image);
  const ReportStenosis* dark = nullptr;
  for (const ReportStenosis& one : report.stenoses)
    if (one.features.size() == 4 && one.features[0].finding.present) dark = &one;
  ASSERT_TRUE(dark) << "no piece of low attenuation was found";
  EXPECT_GT(dark->features[0].finding.value, report.options.high_risk.least_low_mm3);
  EXPECT_EQ(dark->features[0].counts,
            dark->features[0].finding.confidence > analysis::FeatureConfidence::low);
  const auto word = [&](analysis::PlaqueFeature feature, LesionState state) {
    return FeatureWord{dark->stenosis.vessel, dark->stenosis.from_mm, dark->stenosis.to_mm, feature, state};
  };
  ReportNotes notes;
  for (const analysis::PlaqueFeature feature : analysis::plaque_features)
    notes.features.push_back(word(feature, LesionState::rejected));
  const CaseReport rejected = told_report(notes, {}, &image);
  const ReportStenosis& none = rejected.stenoses.at(static_cast<std::size_t>(dark->number - 1));
  EXPECT_FALSE(none.high_risk);
  notes.features = {word(analysis::PlaqueFeature::low_attenuation, LesionState::accepted),
                    word(analysis::PlaqueFeature::napkin_ring, LesionState::accepted),
                    word(analysis::PlaqueFeature::positive_remodelling, LesionState::rejected)};
  const CaseReport accepted = told_report(notes, {}, &image);
  const ReportStenosis& two = accepted.stenoses.at(static_cast<std::size_t>(dark->number - 1));
  EXPECT_TRUE(two.features[0].counts && two.features[3].counts);
  EXPECT_FALSE(two.features[1].counts);
  EXPECT_TRUE(two.high_risk);
  EXPECT_TRUE(accepted.statement.high_risk_plaque);
  EXPECT_THAT(analysis::to_string(accepted.statement), HasSubstr("/HRP"));
  EXPECT_THAT(accepted.impression, HasSubstr("High-risk plaque, S" + std::to_string(two.number)));
  const std::string html = report_html(accepted, {});
  EXPECT_THAT(html, HasSubstr("Features of high-risk plaque"));
  const Json json = Json::parse(report_json(accepted, {}));
  const Schema schema("case-report.schema.json");
  const Json& feature = json["stenoses"][static_cast<std::size_t>(two.number - 1)]["features"][0];
  EXPECT_EQ(names_in(schema.definition("feature")["properties"]), names_in(feature));
  EXPECT_THAT(stenoses_csv(accepted), HasSubstr(",yes,"));
}

TEST(SignedReport, DraftsAnImpressionAndKeepsTheReaders) {
  const CaseReport draft = told_report({});
  EXPECT_FALSE(draft.impression_by_person);
  EXPECT_EQ(draft.impression, draft.impression_draft);
  EXPECT_THAT(draft.impression, HasSubstr("CAD-RADS 3/P1/N: Moderate stenosis"));
  EXPECT_THAT(draft.impression, HasSubstr("S1, RCA, "));
  EXPECT_THAT(report_html(draft, {}), HasSubstr("Drafted by the program"));
  ReportNotes notes;
  notes.impression = "Mine <alone>.\n\nSecond line";
  const CaseReport own = told_report(notes);
  EXPECT_TRUE(own.impression_by_person);
  EXPECT_EQ(own.impression, notes.impression);
  EXPECT_EQ(own.impression_draft, draft.impression_draft) << "offered beside it";
  const std::string html = report_html(own, {});
  EXPECT_THAT(html, HasSubstr("Mine &lt;alone&gt;."));
  EXPECT_THAT(html, Not(HasSubstr("Drafted by the program")));
  ReportOptions options;
  options.impression = "For this one";
  EXPECT_EQ(told_report(notes, options).impression, "For this one");
  options.impression = std::string(20001, 'x');
  EXPECT_THROW(validate(options), InvalidInput);
}

TEST(SignedReport, SaysWhetherItIsAsItWasSigned) {
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6);
  Annotations annotations;
  EXPECT_FALSE(report_of(model, annotations).is_signed);
  EXPECT_THAT(report_html(report_of(model, annotations), {}), HasSubstr("Nobody has signed"));
  annotations.report.versions = {{"2026-03-01", "Dr. A", "", report_content_digest(model, annotations)}};
  const CaseReport as_signed = report_of(model, annotations);
  EXPECT_TRUE(as_signed.is_signed);
  EXPECT_THAT(report_html(as_signed, {}), HasSubstr("This is version 1, as it was signed."));
  ReportOptions other_text;
  other_text.impression = "another one";
  EXPECT_FALSE(report_of(model, annotations, {}, nullptr, other_text).is_signed);
  ReportOptions other_score;
  other_score.agatston = 10.0;
  EXPECT_FALSE(report_of(model, annotations, {}, nullptr, other_score).is_signed);
  annotations.report.modifiers.graft = true;
  const CaseReport changed = report_of(model, annotations);
  EXPECT_FALSE(changed.is_signed);
  EXPECT_THAT(report_html(changed, {}), HasSubstr("Something has changed since version 1"));
  const Json json = Json::parse(report_json(changed, {}));
  EXPECT_EQ(json["versions"][0]["signer"], "Dr. A");
  EXPECT_EQ(json["signed"], false);
  const Schema schema("case-report.schema.json");
  EXPECT_EQ(names_in(schema.definition("version")["properties"]), names_in(json["versions"][0]));
  EXPECT_EQ(names_in(schema.definition("standard_segment")["properties"]),
            names_in(json["standard_segments"][0]));
}

TEST(SignedReport, ShortOneLeavesOutTablesAndNothingOfTheData) {
  ReportOptions brief;
  brief.form = report_template("short");
  const CaseReport full = told_report({}), less = told_report({}, brief);
  const std::string html = report_html(less, {});
  for (const char* part : {"Impression", "CAD-RADS 2.0", "Stenoses", "Standard segments", "Versions"})
    EXPECT_THAT(html, HasSubstr(part)) << part;
  for (const char* part : {"Edit log", "None were placed", "What was checked"}) {
    EXPECT_THAT(html, Not(HasSubstr(part))) << part;
    EXPECT_THAT(report_html(full, {}), HasSubstr(part)) << part;
  }
  EXPECT_EQ(report_json(full, {}), report_json(less, {}));
  EXPECT_EQ(to_string(ReportTemplate::full), "full");
  EXPECT_THROW(report_template("long"), InvalidInput);
}

TEST(SignedReport, SaysHowTheScanWasTaken) {
  ReportOptions options;
  options.technique = imaging::ScanTechnique{120.0, 0.6, 75.0, "B26f"};
  const CaseReport report = told_report({}, options);
  const std::string html = report_html(report, {});
  for (const char* part : {"120 kV", "slices of 0.60 mm", "kernel B26f", "at 75 % of the cardiac cycle"})
    EXPECT_THAT(html, HasSubstr(part)) << part;
  EXPECT_EQ(Json::parse(report_json(report, {}))["technique"]["tube_kv"], 120.0);
  EXPECT_TRUE(Json::parse(report_json(told_report({}), {}))["technique"].is_null());
}

}  // namespace
}  // namespace ostia::session
