#pragma once
/// \file A report as one HTML file: text, tables and pictures, no script, nothing loaded from elsewhere.

#include "ostia/figure/picture.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ostia::figure {

/// The text with & < > " ' replaced by entities, bytes that are not UTF-8 by U+FFFD, and control characters
/// left out.
std::string html_escaped(std::string_view text);
std::string base64(std::string_view bytes);

enum class Notice { good, warning, bad, note };

/// What a document says by itself, in its language.
struct DocumentWords {
  std::string language = "en";  ///< as HTML names it
  std::string contents = "Contents", table = "Table", figure = "Figure";
  std::string page = "Page %1 of %2";
  std::string passed = "Passed", warning = "Warning", failed = "Failed", note = "Note";
  const std::string& heading(Notice kind) const;
};

/// Collects the parts in order; `html` puts them together. All text given is plain text and is escaped; what
/// core::redact_in_logs has registered is replaced. Follows the reader's light or dark setting; prints well.
class HtmlReport {
 public:
  explicit HtmlReport(std::string title, std::string subtitle = {}, DocumentWords words = {});

  void section(const std::string& heading);  ///< listed in the contents when there are three or more
  void subsection(const std::string& heading);
  void paragraph(const std::string& text);
  void notice(Notice kind, const std::string& text);
  void key_values(const std::vector<std::pair<std::string, std::string>>& rows);
  /// Throws InvalidInput where a row's length is not the header's. Columns of numbers are set flush right.
  void table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows,
             const std::string& caption = {});
  /// Embedded as PNG. `alternative` is what a reader who cannot see it is told; the caption unless given.
  void picture(const Picture& picture, const std::string& caption, const std::string& alternative = {},
               double density = 2.0);

  std::string html() const;
  void write(const std::filesystem::path& path) const;  ///< whole or not at all

 private:
  std::string title_, subtitle_, body_;
  DocumentWords words_;
  std::vector<std::pair<std::string, std::string>> contents_;  // anchor and heading
  int pictures_ = 0, tables_ = 0;
};

}  // namespace ostia::figure
