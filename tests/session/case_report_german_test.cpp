// The report in German: nothing of it that a person reads is left in English.

#include "report/case_report_words.h"
#include "report_cases.h"

#include "ostia/core/error.h"
#include "ostia/session/case_report.h"
#include "ostia/session/edit_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string>
#include <vector>

namespace ostia::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string own_words = "the reader's own words of this vessel, not found";

/// Words that no German text has; those that German has, too ("was", "die", "an"), are not among them.
const std::set<std::string>& english_words() {
  static const std::set<std::string> words{
      "the",      "of",        "and",     "not",      "is",      "are",    "were",     "with",  "without",
      "by",       "from",      "to",      "or",       "its",     "that",   "which",    "where", "this",
      "than",     "one",       "each",    "vessel",   "vessels", "wall",   "image",    "found", "least",
      "checked",  "no",        "none",    "yes",      "mean",    "length", "drawn",    "case",  "measured",
      "below",    "narrowing", "lesions", "stenosis", "table",   "figure", "note",     "page",  "edge",
      "noise",    "said",      "says",    "reader",   "graded",  "judged", "contents", "known", "limited",
      "rejected", "accepted",  "usual",   "deleted",  "added"};
  return words;
}

/// What stands between the tags of a page, a line each, without pictures and styles.
std::vector<std::string> texts_of(const std::string& html) {
  std::vector<std::string> texts;
  std::string text;
  const std::size_t body = html.find("</style>");
  for (std::size_t i = body; i < html.size(); ++i) {
    if (html[i] != '<' && html[i] != '\n') {
      text += html[i];
      continue;
    }
    if (!text.empty()) texts.push_back(text);
    text.clear();
    if (html[i] == '<') i = html.find('>', i);
  }
  return texts;
}

std::vector<std::string> english_in(const std::string& text) {
  std::vector<std::string> found;
  std::string word;
  for (const char c : text + " ") {
    if (std::isalpha(static_cast<unsigned char>(c)) || static_cast<unsigned char>(c) > 127) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      continue;
    }
    if (english_words().count(word) > 0) found.push_back(word);
    word.clear();
  }
  return found;
}

void expect_german(const std::string& html) {
  const std::vector<std::string> texts = texts_of(html);
  EXPECT_FALSE(texts.empty());
  for (const std::string& text : texts) {
    if (text.find("reader&#39;s own words") != std::string::npos) continue;
    EXPECT_THAT(english_in(text), IsEmpty()) << text;
  }
}

ReportOptions in_german() {
  ReportOptions options;
  options.language = ReportLanguage::german;
  options.date = "2026-03-01";
  options.image = ImageReference{std::string(64, 'a'), "img-1"};
  return options;
}

std::vector<JournalEntry> every_step() {
  std::vector<JournalEntry> journal{{1, "case.begin", "{}", false, false, StepKind::begin, {}}};
  const auto add = [&](const std::string& op, const std::string& parameters, StepKind kind) {
    journal.push_back(
        {static_cast<std::int64_t>(journal.size()) + 1, op, parameters, false, false, kind, {}});
  };
  for (const lumen::Edit& edit : one_of_each()) add(lumen::op_name(edit), to_json(edit), StepKind::edit);
  for (const analysis::MeasureKind kind : analysis::measure_kinds)
    for (const AnnotationCommand& command :
         {AnnotationCommand(added(kind)), AnnotationCommand(MeasureChange{measurement(kind)}),
          AnnotationCommand(MeasureDelete{3}), AnnotationCommand(marked(own_words)),
          AnnotationCommand(told_inputs()), AnnotationCommand(opened()), AnnotationCommand(written()),
          AnnotationCommand(told_modifiers()), AnnotationCommand(told_features()),
          AnnotationCommand(signing())})
      add(op_name(command), to_json(command), StepKind::annotation);
  return journal;
}

/// Everything that a person can have said.
Annotations all_said(const lumen::LumenModel& model) {
  Annotations notes;
  VesselMark mark;
  mark.vessel = model.tree.vessels[0].id;
  mark.note = own_words;
  mark.evaluable = {{2.0, 8.0, analysis::Evaluability::not_evaluable, {}, true}};
  mark.lesions = {{18.0, 22.0, LesionState::rejected, own_words}};
  notes.marks = {mark};
  std::int64_t id = 1;
  for (const analysis::MeasureKind kind : analysis::measure_kinds) {
    analysis::Measurement one = measurement(kind);
    one.id = id++;
    one.name = own_words;
    if (needs_vessel(one)) one.vessel = mark.vessel;
    notes.measurements.push_back(one);
  }
  return notes;
}

/// What a report can be told, in own words where these are free.
ReportNotes all_told(std::int32_t vessel) {
  ReportNotes notes;
  notes.modifiers = told_modifiers().modifiers;
  notes.modifiers.exception = own_words;
  for (const analysis::PlaqueFeature feature : analysis::plaque_features)
    notes.features.push_back({vessel, 10.0, 30.0, feature, LesionState::accepted});
  notes.versions = {{"2026-03-01", own_words, "", std::string(64, 'a')},
                    {"2026-03-02", own_words, own_words, std::string(64, 'b')}};
  return notes;
}

/// As in test data of the report: noise from 15 mm on, so that nothing can be judged there.
imaging::ImageVolume half_drowned() {
  imaging::ImageVolume image = walled_image(1.5, 2.6, 60.0);
  for (std::int64_t k = 53; k < image.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < image.geometry.size[1]; ++j)
      for (std::int64_t i = 0; i < image.geometry.size[0]; ++i) image(i, j, k) = 400;
  return image;
}

TEST(GermanReport, OfABadScanHasNoEnglishWord) {
  const imaging::ImageVolume image = half_drowned();
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 26.0, 0.6);
  const CaseReport report = report_of(model, all_said(model), every_step(), &image, in_german());
  EXPECT_FALSE(report.not_judged.empty());
  EXPECT_FALSE(report.steps.empty());
  const std::string html = report_html(report, {});
  expect_german(html);
  EXPECT_THAT(html, HasSubstr("<html lang=\"de\">"));
  EXPECT_THAT(html, HasSubstr("Koronararterien in der CT-Angiographie"));
  EXPECT_THAT(html, HasSubstr("nicht beurteilbar"));
  EXPECT_THAT(html, HasSubstr("linke Koronararterie (LM, LAD, LCX): nicht gefunden"));
  EXPECT_THAT(html, HasSubstr("Befunder"));
  EXPECT_THAT(report_html(report_of(model, all_said(model), every_step(), &image), {}),
              HasSubstr("<html lang=\"en\">"));
}

TEST(GermanReport, OfABifurcationWithoutAnImageHasNoEnglishWord) {
  const lumen::LumenModel model = narrowed_y(0, 12.0, 0.6);
  Annotations notes;
  notes.marks = {{model.tree.vessels[0].id, true, true, std::nullopt, ""}};
  expect_german(report_html(report_of(model, notes, {}, nullptr, in_german()), {}));
  ReportOptions unknown = in_german();
  unknown.image.reset();
  expect_german(
      report_html(report_of(narrowed_tube("x7", 40.0, 1.5, 20.0, 0.6), {}, {}, nullptr, unknown), {}));
  expect_german(report_html(checked_report(named_y(), nullptr, in_german()), {}));
  const lumen::LumenModel doubtful = narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6);
  ReportOptions hardly = in_german();
  hardly.certainty = hardly_an_artery(doubtful, 0.01);
  const std::string doubted = report_html(report_of(doubtful, {}, {}, nullptr, hardly), {});
  expect_german(doubted);
  EXPECT_THAT(doubted, HasSubstr("wohl keine Arterie (Wahrscheinlichkeit: RCA 0.01)"));
  expect_german(report_html(report_of(shut_tube(), {}, {}, nullptr, in_german()), {}));
}

TEST(GermanReport, OfWhatAReaderSignsHasNoEnglishWord) {
  const imaging::ImageVolume image = walled_image(1.5, 2.6, 10.0);
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6);
  const std::int32_t vessel = model.tree.vessels[0].id;
  Annotations notes;
  notes.marks = {{vessel, true, true, std::nullopt, ""}};
  notes.report = all_told(vessel);
  for (const ReportTemplate form : {ReportTemplate::full, ReportTemplate::brief}) {
    ReportOptions options = in_german();
    options.form = form;
    options.technique = imaging::ScanTechnique{100.0, 0.75, 40.0, "Qr36"};
    const CaseReport report = report_of(model, notes, {}, &image, options);
    EXPECT_TRUE(report.statement.high_risk_plaque);
    expect_german(report_html(report, {}));
    for (const std::string& line : texts_of("</style>" + drafted_impression(report) + "\n"))
      EXPECT_THAT(english_in(line), IsEmpty()) << line;
  }
  notes.report.impression = own_words;
  EXPECT_THAT(report_html(report_of(model, notes, {}, &image, in_german()), {}),
              HasSubstr("reader&#39;s own words"));
}

TEST(GermanReport, KeepsWhatAPersonWrote) {
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6);
  const std::string html = report_html(report_of(model, all_said(model), {}, nullptr, in_german()), {});
  EXPECT_THAT(html, HasSubstr("the reader&#39;s own words of this vessel, not found"));
  imaging::ShownIdentity named;
  named.patient_name = "none";
  EXPECT_THAT(report_html(report_of(model, {}, {}, nullptr, in_german()), {}, named),
              HasSubstr("<td>none</td>"));
}

TEST(GermanReport, FilesForScriptsAreTheEnglishOnes) {
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6);
  ReportOptions english = in_german();
  english.language = ReportLanguage::english;
  const CaseReport one = report_of(model, all_said(model), every_step(), nullptr, in_german());
  const CaseReport other = report_of(model, all_said(model), every_step(), nullptr, english);
  EXPECT_EQ(report_json(one, {}), report_json(other, {}));
  EXPECT_EQ(stenoses_csv(one), stenoses_csv(other));
  EXPECT_EQ(measurements_csv(one), measurements_csv(other));
  EXPECT_NE(report_html(one, {}), report_html(other, {}));
  EXPECT_NE(report_pdf(one, {}), report_pdf(other, {}));
}

TEST(GermanReport, CaptionsOfPicturesAreGerman) {
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6);
  const analysis::SurfaceOfVessel surfaces = solved_surfaces(model);
  const CaseReport report = make_case_report(model, surfaces, {}, {}, nullptr, in_german());
  const std::vector<KeyImage> images = key_images(report, model, surfaces, nullptr);
  ASSERT_EQ(images.size(), 2U);
  for (const KeyImage& image : images) EXPECT_THAT(english_in(image.caption), IsEmpty()) << image.caption;
  expect_german(report_html(report, images));
}

TEST(GermanReport, KnowsAllWordsThatTheLibrariesHave) {
  const core::Phrasebook& german = report_words::of(ReportLanguage::german);
  using analysis::CadRads;
  for (const CadRads one : {CadRads::zero, CadRads::one, CadRads::two, CadRads::three, CadRads::four_a,
                            CadRads::four_b, CadRads::five})
    EXPECT_TRUE(german.knows(analysis::description(one))) << analysis::description(one);
  for (const auto grade : {analysis::Evaluability::evaluable, analysis::Evaluability::limited,
                           analysis::Evaluability::not_evaluable})
    EXPECT_TRUE(german.knows(analysis::to_string(grade)));
  for (const analysis::MeasureKind kind : analysis::measure_kinds)
    EXPECT_TRUE(german.knows(analysis::traits_of(kind).label)) << analysis::traits_of(kind).label;
  for (const analysis::PlaqueFeature one : analysis::plaque_features)
    EXPECT_TRUE(german.knows(analysis::to_string(one))) << analysis::to_string(one);
  for (const auto one : {analysis::Dominance::unknown, analysis::Dominance::right, analysis::Dominance::left,
                         analysis::Dominance::codominant})
    EXPECT_TRUE(german.knows(analysis::to_string(one))) << analysis::to_string(one);
  for (const auto one : {analysis::Ischaemia::not_tested, analysis::Ischaemia::negative,
                         analysis::Ischaemia::borderline, analysis::Ischaemia::positive})
    EXPECT_TRUE(german.knows(analysis::to_string(one))) << analysis::to_string(one);
  for (const CadRads one : {CadRads::zero, CadRads::three, CadRads::four_a, CadRads::four_b, CadRads::five})
    EXPECT_TRUE(german.knows(analysis::further_investigation({one, false})));
  EXPECT_TRUE(german.knows(analysis::further_investigation({std::nullopt, true})));
  for (const auto one : {analysis::PlaqueBurden::none, analysis::PlaqueBurden::p1, analysis::PlaqueBurden::p2,
                         analysis::PlaqueBurden::p3, analysis::PlaqueBurden::p4})
    EXPECT_TRUE(german.knows(analysis::description(one))) << analysis::description(one);
  for (const ScanGrade grade : {ScanGrade::good, ScanGrade::fair, ScanGrade::poor})
    EXPECT_TRUE(german.knows(to_string(grade)));
}

TEST(GermanReport, TheLanguageIsPartOfTheJobAndHasACode) {
  EXPECT_EQ(report_language("de"), ReportLanguage::german);
  EXPECT_EQ(report_language(to_string(ReportLanguage::english)), ReportLanguage::english);
  EXPECT_THROW(report_language("fr"), InvalidInput);
  const TempFolder folder;
  const CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  ReportOptions english, german;
  german.language = ReportLanguage::german;
  EXPECT_NE(report_job(file, false, english).parameters, report_job(file, false, german).parameters);
}

}  // namespace
}  // namespace ostia::session
