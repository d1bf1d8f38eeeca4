#pragma once
/// \file A report as a PDF of several A4 pages: text that can be selected, tables that go on over pages,
/// pictures.

#include "ostia/figure/html_report.h"
#include "ostia/figure/picture.h"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ostia::figure {

struct PdfOptions {
  std::string footer{};  ///< at the foot of every page, left of the page's number; one line, cut where longer
  DocumentWords words{};
};

/// Collects the parts in order as HtmlReport does, and sets them on pages. All text given is plain text; what
/// core::redact_in_logs has registered is replaced. A heading stays with what follows it; the header of a
/// table is repeated on each of its pages; a row is cut only where it is higher than a page. Sections are
/// bookmarks. The file holds no date: the same parts give the same bytes.
class PdfDocument {
 public:
  explicit PdfDocument(std::string title, std::string subtitle = {}, PdfOptions options = {});
  ~PdfDocument();
  PdfDocument(PdfDocument&&) noexcept;
  PdfDocument& operator=(PdfDocument&&) noexcept;

  void section(const std::string& heading);
  void subsection(const std::string& heading);
  void paragraph(const std::string& text);
  void notice(Notice kind, const std::string& text);
  void key_values(const std::vector<std::pair<std::string, std::string>>& rows);
  /// Throws InvalidInput where a row's length is not the header's, or there is no column. Columns of numbers
  /// are set flush right; letters get smaller, and cells several lines, until the columns fit the page.
  void table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows,
             const std::string& caption = {});
  /// As large as on a screen, or smaller, so that it fits one page with its caption.
  void picture(const Picture& picture, const std::string& caption);

  /// The pages as pictures of 794 x 1123 px (A4 at 96 px an inch): what `pdf` writes.
  std::vector<Picture> pages() const;
  std::string pdf() const;
  void write(const std::filesystem::path& path) const;  ///< whole or not at all

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::figure
