#include "ostia/figure/pdf_document.h"

#include "page_flow.h"
#include "page_text.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace ostia::figure {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Picture grey_picture(int width, int height) {
  return drawn(width, height, [=](Canvas& canvas) { canvas.fill(0, 0, width, height, {0.35, 0.35, 0.35}); });
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

std::size_t pages_in(const std::string& pdf) {
  return count(pdf, "/Type /Page") - count(pdf, "/Type /Pages");
}

/// Dark pixels of a stretch of a page, by column: what is written there.
std::vector<int> ink(const Raster& page, double from_y, double to_y) {
  std::vector<int> columns(static_cast<std::size_t>(page.width), 0);
  for (int y = static_cast<int>(from_y); y < static_cast<int>(to_y); ++y)
    for (int x = 0; x < page.width; ++x) columns[static_cast<std::size_t>(x)] += page.pixel(x, y)[0] < 128;
  return columns;
}

PdfDocument long_table(std::size_t rows) {
  PdfDocument document("Report");
  std::vector<std::vector<std::string>> cells;
  for (std::size_t i = 0; i < rows; ++i) cells.push_back({std::to_string(i), "wall dragged", "LAD"});
  document.table({"Step", "What was done", "Vessel"}, cells, "Edits");
  return document;
}

TEST(PdfDocument, HasThePagesThatItsPartsNeed) {
  PdfDocument document("Report", "of a case", {"foot"});
  EXPECT_EQ(document.pages().size(), 1U);
  document.paragraph("text");
  EXPECT_EQ(pages_in(document.pdf()), 1U);
  EXPECT_EQ(document.pages().front().width(), 794);
  EXPECT_EQ(document.pages().front().height(), 1123);
  const PdfDocument table = long_table(200);
  const std::size_t pages = table.pages().size();
  EXPECT_GT(pages, 3U);
  EXPECT_LT(pages, 12U);
  EXPECT_EQ(pages_in(table.pdf()), pages);
}

TEST(PdfDocument, TextStaysText) {
  PdfDocument document("Report");
  document.paragraph("proximal LAD");
  const std::string pdf = document.pdf();
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_THAT(pdf, HasSubstr("/ToUnicode"));
  EXPECT_THAT(pdf, HasSubstr("/FontFile2"));
  EXPECT_THAT(pdf, Not(HasSubstr("/Subtype /Image")));
  EXPECT_THAT(pdf, Not(HasSubstr("CreationDate")));
}

TEST(PdfDocument, RepeatsATablesHeaderOnEachPage) {
  const std::vector<Picture> pages = long_table(150).pages();
  ASSERT_GE(pages.size(), 3U);
  const Raster second = pages[1].raster(), third = pages[2].raster();
  const double header = page_top_px + 24.0;
  EXPECT_EQ(ink(second, page_top_px, header), ink(third, page_top_px, header));
  const std::vector<int> drawn = ink(second, page_top_px, header);
  EXPECT_GT(std::accumulate(drawn.begin(), drawn.end(), 0), 100);
  // The rows below differ in their numbers.
  EXPECT_NE(ink(second, header + 4.0, header + 200.0), ink(third, header + 4.0, header + 200.0));
}

TEST(PdfDocument, NothingLeavesThePage) {
  PdfDocument document(std::string(300, 'W'), std::string(300, 'w'), {std::string(400, 'f')});
  const std::string word(3000, 'x');
  document.section(word);
  document.paragraph(word + " " + word);
  document.notice(Notice::bad, word);
  document.key_values({{word, word}});
  document.table({"a", "b"}, {{word, "1"}, {"y", word}}, word);
  document.table(std::vector<std::string>(20, "Diameter"),
                 {std::vector<std::string>(20, "123456.789"), std::vector<std::string>(20, "1")});
  document.picture(grey_picture(3000, 400), "wide");
  document.picture(grey_picture(300, 4000), "high");
  for (const Picture& page : document.pages()) {
    const Raster raster = page.raster();
    const std::vector<int> columns = ink(raster, 0.0, raster.height);
    for (int x = 0; x < raster.width; ++x) {
      const bool margin = x < page_left_px - 8.0 || x > page_width_px - page_left_px + 8.0;
      ASSERT_TRUE(!margin || columns[static_cast<std::size_t>(x)] == 0) << x;
    }
    const std::vector<int> above = ink(raster, 0.0, page_top_px - 8.0);
    const std::vector<int> below = ink(raster, page_bottom_px + 48.0, raster.height);
    EXPECT_EQ(std::accumulate(above.begin(), above.end(), 0), 0);
    EXPECT_EQ(std::accumulate(below.begin(), below.end(), 0), 0);
  }
}

TEST(PdfDocument, ACellHigherThanAPageGoesOn) {
  PdfDocument document("Report");
  std::string note;
  for (int i = 0; i < 4000; ++i) note += "word ";
  document.table({"Vessel", "Note"}, {{"LAD", note}, {"RCA", "short"}});
  EXPECT_GE(document.pages().size(), 3U);
}

TEST(PdfDocument, SamePartsSameBytes) {
  const auto made = [] {
    PdfDocument document = long_table(60);
    document.section("Images");
    document.picture(grey_picture(200, 100), "grey");
    return document.pdf();
  };
  EXPECT_EQ(made(), made());
}

TEST(PdfDocument, SectionsAreBookmarks) {
  PdfDocument document("Report");
  document.section("Stenoses");
  document.paragraph("none");
  const std::string pdf = document.pdf();
  EXPECT_THAT(pdf, HasSubstr("/Outlines"));
  EXPECT_THAT(pdf, HasSubstr("(Stenoses)"));
}

TEST(PdfDocument, ReplacesWhatIsToBeKeptOut) {
  core::redact_in_logs("POE^EDGAR", "patient");
  PdfDocument document("POE^EDGAR");
  document.section("POE^EDGAR");
  document.paragraph("POE^EDGAR");
  EXPECT_THAT(document.pdf(), Not(HasSubstr("POE^EDGAR")));
  EXPECT_EQ(wrapped("of POE^EDGAR", 12.0, false, 500.0), std::vector<std::string>{"of patient"});
}

TEST(PdfDocument, RefusesRowsThatDoNotFitTheirHeader) {
  PdfDocument document("Report");
  EXPECT_THROW(document.table({"a", "b"}, {{"1"}}), InvalidInput);
  EXPECT_THROW(document.table({}, {}), InvalidInput);
}

TEST(PdfDocument, IsWrittenWholeOrNotAtAll) {
  const auto folder = ostia::testing::temporary_folder("pdf");
  const PdfDocument document = long_table(3);
  document.write(folder / "a.pdf");
  EXPECT_EQ(core::read_file(folder / "a.pdf"), document.pdf());
  EXPECT_THROW(document.write(folder / "a.pdf" / "a.pdf"), IoError) << "a file is no folder";
}

TEST(PageFlow, AHeadingStaysWithWhatFollows) {
  PageFlow flow;
  const auto nothing = [](Canvas&, double) {};
  flow.put(flow.room() - 70.0, nothing);
  flow.heading(40.0, nothing, "Segments");
  flow.put(60.0, nothing);  // heading and part together need 100 px, 70 are left
  flow.finish();
  ASSERT_EQ(flow.bookmarks().size(), 1U);
  EXPECT_EQ(flow.bookmarks()[0].page, 1U);
  EXPECT_EQ(flow.bookmarks()[0].y_px, page_top_px);
  EXPECT_EQ(flow.pages().size(), 2U);

  PageFlow fits;
  fits.put(fits.room() - 110.0, nothing);
  fits.heading(40.0, nothing, "Segments");
  fits.put(60.0, nothing);
  EXPECT_EQ(fits.bookmarks()[0].page, 0U);
}

TEST(PageText, LinesAreNoWiderThanAsked) {
  const std::string text = "The calibre that the vessel would have without disease, at every place of it.";
  const std::vector<std::string> lines = wrapped(text, 13.0, false, 150.0);
  EXPECT_GT(lines.size(), 2U);
  std::string joined;
  for (const std::string& line : lines) {
    EXPECT_LE(Canvas::text_size(line, 13.0).x(), 150.0);
    joined += (joined.empty() ? "" : " ") + line;
  }
  EXPECT_EQ(joined, text);
}

TEST(PageText, BreaksWordsThatAreWiderThanALineBetweenCharacters) {
  std::string word;
  for (int i = 0; i < 40; ++i) word += "\xC3\xA9";  // two bytes each
  std::string joined;
  for (const std::string& line : wrapped(word, 13.0, false, 60.0)) {
    EXPECT_LE(Canvas::text_size(line, 13.0).x(), 60.0);
    EXPECT_EQ(line.size() % 2, 0U);
    joined += line;
  }
  EXPECT_EQ(joined, word);
  EXPECT_EQ(wrapped("", 13.0, false, 60.0), std::vector<std::string>{""});
  EXPECT_EQ(wrapped("a\nb", 13.0, false, 60.0), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(wrapped("W", 13.0, false, 1.0), std::vector<std::string>{"W"});
}

TEST(PageText, CutsWithAnEllipsis) {
  const std::string text(200, 'm');
  const std::string cut = cut_to(text, 12.0, false, 100.0);
  EXPECT_LE(Canvas::text_size(cut, 12.0).x(), 100.0);
  EXPECT_THAT(cut, ::testing::EndsWith("\xE2\x80\xA6"));
  EXPECT_EQ(cut_to("short", 12.0, false, 100.0), "short");
}

}  // namespace
}  // namespace ostia::figure
