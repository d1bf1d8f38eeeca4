#include "ostia/figure/html_report.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

namespace ostia::figure {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(HtmlEscaped, LeavesNoMarkupBehind) {
  EXPECT_EQ(html_escaped("<a href=\"x\">'&'</a>"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
  EXPECT_EQ(html_escaped("&amp;"), "&amp;amp;");
  EXPECT_EQ(html_escaped("\xFF\x01ok"), "\xEF\xBF\xBDok");
}

TEST(Base64, AgreesWithTheTestVectorsOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xFF\xFE\xFD"), "//79");
}

HtmlReport full_report(const std::string& text) {
  HtmlReport report(text, text);
  for (int i = 0; i < 3; ++i) report.section(text);
  report.subsection(text);
  report.paragraph(text);
  for (const Notice kind : {Notice::good, Notice::warning, Notice::bad, Notice::note})
    report.notice(kind, text);
  report.key_values({{text, text}});
  report.table({text, "n"}, {{text, "1"}, {text, "2.5"}}, text);
  report.picture(picture_of(Raster{1, 1, {1, 2, 3, 255}}), text, text, 1.0);
  return report;
}

TEST(HtmlReport, EscapesTextWhereverItStands) {
  const std::string html = full_report("<script>alert(1)</script>\" onload='x'").html();
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("\" onload=")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;"));
}

TEST(HtmlReport, IsOneFileThatLoadsNothingAndRunsNothing) {
  const std::string html = full_report("Aorta").html();
  EXPECT_EQ(html.rfind("<!DOCTYPE html>", 0), 0U);
  for (const char* word : {"http://", "https://", "<script", "@import", "url("})
    EXPECT_THAT(html, Not(HasSubstr(word)));
  const std::regex source("src=\"([^\"]{0,22})");
  int images = 0;
  for (std::sregex_iterator it(html.begin(), html.end(), source), end; it != end; ++it) {
    EXPECT_EQ((*it)[1].str(), "data:image/png;base64,");
    ++images;
  }
  EXPECT_EQ(images, 1);
}

TEST(HtmlReport, OpensAndClosesItsElementsInOrder) {
  const std::string html = full_report("Aorta & <b>").html();
  const std::regex tag("<(/?)([a-z0-9]+)([^>]*)>");
  std::vector<std::string> open;
  for (std::sregex_iterator it(html.begin(), html.end(), tag), end; it != end; ++it) {
    const std::string name = (*it)[2].str();
    if (name == "meta" || name == "img") continue;
    if ((*it)[1].str().empty()) {
      open.push_back(name);
    } else {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ(open.back(), name);
      open.pop_back();
    }
  }
  EXPECT_TRUE(open.empty());
}

TEST(HtmlReport, EmbedsThePictureItself) {
  const Picture picture = picture_of(Raster{2, 1, {1, 2, 3, 255, 9, 9, 9, 255}});
  HtmlReport report("t");
  report.picture(picture, "caption", "what is seen", 3.0);
  EXPECT_THAT(report.html(), HasSubstr(base64(picture.png(3.0))));
  EXPECT_THAT(report.html(), HasSubstr("alt=\"what is seen\""));
  EXPECT_THAT(report.html(), HasSubstr("width=\"2\" height=\"1\""));
  EXPECT_THAT(report.html(), HasSubstr("Figure 1. caption"));
}

TEST(HtmlReport, ListsItsSectionsOnceThereAreThree) {
  HtmlReport report("t");
  report.section("One");
  report.section("Two");
  EXPECT_THAT(report.html(), Not(HasSubstr("<nav")));
  report.section("Three");
  EXPECT_THAT(report.html(), HasSubstr("<a href=\"#s3\">Three</a>"));
  EXPECT_THAT(report.html(), HasSubstr("<h2 id=\"s3\">Three</h2>"));
}

TEST(HtmlReport, SetsNumbersFlushRight) {
  HtmlReport report("t");
  report.table({"Vessel", "mm"}, {{"LAD", "3.1"}, {"RCA", "2.9"}});
  EXPECT_THAT(report.html(), HasSubstr("<td>LAD</td><td class=\"number\">3.1</td>"));
  EXPECT_THROW(report.table({"a"}, {{"1", "2"}}), InvalidInput);
}

TEST(HtmlReport, HoldsNothingThatWasRedacted) {
  core::redact_in_logs("ROE^RICHARD", "pseudonym-7");
  const std::string html = full_report("Name: ROE^RICHARD").html();
  EXPECT_THAT(html, Not(HasSubstr("RICHARD")));
  EXPECT_THAT(html, HasSubstr("pseudonym-7"));
}

TEST(HtmlReport, IsWrittenWhole) {
  const auto folder = testing::temporary_folder("report");
  const HtmlReport report = full_report("Aorta");
  report.write(folder / "report.html");
  EXPECT_EQ(core::read_file(folder / "report.html"), report.html());
  EXPECT_THROW(report.write(folder / "report.html" / "report.html"), IoError) << "a file is no folder";
}

}  // namespace
}  // namespace ostia::figure
