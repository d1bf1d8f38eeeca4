#include "ostia/figure/html_report.h"

#include "text.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace ostia::figure {
namespace {

constexpr std::string_view kStyle = R"css(
:root { color-scheme: light dark; --paper: #ffffff; --ink: #1b2027; --soft: #5c6570; --line: #dde2e8;
  --panel: #f5f7f9;
  --accent: #0b62a6; --good: #0a7f59; --warn: #a85b00; --bad: #b3261e; }
@media (prefers-color-scheme: dark) { :root { --paper: #14171c; --ink: #e6e9ee; --soft: #9aa4b0;
  --line: #2d333c;
  --panel: #1c2128; --accent: #6bb4ec; --good: #4cc79b; --warn: #f0a848; --bad: #ff8a80; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink);
  font: 16px/1.55 system-ui, "Segoe UI", "DejaVu Sans", Roboto, Arial, sans-serif; }
main, header { max-width: 68rem; margin: 0 auto; padding: 0 1.5rem; }
header { padding-top: 2.5rem; padding-bottom: 1rem; border-bottom: 1px solid var(--line); }
main { padding-bottom: 4rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0; }
h2 { font-size: 1.35rem; margin: 2.4rem 0 .6rem; padding-bottom: .25rem;
  border-bottom: 1px solid var(--line); }
h3 { font-size: 1.08rem; margin: 1.6rem 0 .4rem; }
p { margin: .6rem 0; max-width: 46rem; white-space: pre-line; }
.subtitle { color: var(--soft); margin: .35rem 0 0; }
nav ol { columns: 2; padding-left: 1.4rem; margin: 1.2rem 0 0; }
a { color: var(--accent); }
.wide { overflow-x: auto; margin: .9rem 0; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .94rem; }
caption { text-align: left; color: var(--soft); padding-bottom: .4rem; }
th, td { padding: .35rem .9rem; border-bottom: 1px solid var(--line); text-align: left;
  vertical-align: top; }
thead th { border-bottom: 2px solid var(--soft); white-space: nowrap; }
tbody tr:nth-child(even) { background: var(--panel); }
td.number, th.number { text-align: right; white-space: nowrap; }
table.facts th { font-weight: 600; color: var(--soft); white-space: nowrap; }
figure { margin: 1.2rem 0; }
figure img { max-width: 100%; height: auto; border: 1px solid var(--line); border-radius: 6px;
  display: block; }
figcaption { color: var(--soft); font-size: .92rem; margin-top: .4rem; }
.notice { max-width: 46rem; margin: .8rem 0; padding: .6rem 1rem; border-left: 4px solid var(--accent);
  background: var(--panel); border-radius: 0 6px 6px 0; white-space: pre-line; }
.notice.good { border-color: var(--good); } .notice.warning { border-color: var(--warn); }
  .notice.bad { border-color: var(--bad); }
.notice b { display: block; }
.notice.good b { color: var(--good); } .notice.warning b { color: var(--warn); }
  .notice.bad b { color: var(--bad); }
@media print { body { font-size: 11pt; } figure, tr, .notice { break-inside: avoid; }
  h2, h3 { break-after: avoid; } }
)css";

std::string shown(std::string_view text) {
  return html_escaped(core::redacted(text));
}

std::string cell(std::string_view tag, const std::string& text, bool number, std::string_view scope) {
  std::string result = "<";
  result += tag;
  if (!scope.empty()) result += " scope=\"" + std::string(scope) + "\"";
  if (number) result += " class=\"number\"";
  return result + ">" + shown(text) + "</" + std::string(tag) + ">";
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string result;
  for (const char c : clean_utf8(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string base64(std::string_view bytes) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = (group << 8) | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      result += k <= count ? kDigits[(group >> (18 - 6 * k)) & 63U] : '=';
    }
  }
  return result;
}

const std::string& DocumentWords::heading(Notice kind) const {
  return kind == Notice::good      ? passed
         : kind == Notice::warning ? warning
         : kind == Notice::bad     ? failed
                                   : note;
}

HtmlReport::HtmlReport(std::string title, std::string subtitle, DocumentWords words)
    : title_(std::move(title)), subtitle_(std::move(subtitle)), words_(std::move(words)) {}

void HtmlReport::section(const std::string& heading) {
  const std::string anchor = "s" + std::to_string(contents_.size() + 1);
  contents_.emplace_back(anchor, shown(heading));
  body_ += "<h2 id=\"" + anchor + "\">" + shown(heading) + "</h2>\n";
}

void HtmlReport::subsection(const std::string& heading) {
  body_ += "<h3>" + shown(heading) + "</h3>\n";
}

void HtmlReport::paragraph(const std::string& text) {
  body_ += "<p>" + shown(text) + "</p>\n";
}

void HtmlReport::notice(Notice kind, const std::string& text) {
  static constexpr std::array<const char*, 4> kClasses{"good", "warning", "bad", "note"};
  body_ += std::string("<div class=\"notice ") + kClasses[static_cast<std::size_t>(kind)] + "\"><b>" +
           shown(words_.heading(kind)) + "</b>" + shown(text) + "</div>\n";
}

void HtmlReport::key_values(const std::vector<std::pair<std::string, std::string>>& rows) {
  body_ += "<div class=\"wide\"><table class=\"facts\"><tbody>\n";
  for (const auto& [key, value] : rows) {
    body_ += "<tr>" + cell("th", key, false, "row") + cell("td", value, false, {}) + "</tr>\n";
  }
  body_ += "</tbody></table></div>\n";
}

void HtmlReport::table(const std::vector<std::string>& header,
                       const std::vector<std::vector<std::string>>& rows, const std::string& caption) {
  for (const auto& row : rows) {
    if (row.size() != header.size()) {
      throw InvalidInput("a report's table has a row of " + std::to_string(row.size()) +
                         " cells under a header of " + std::to_string(header.size()));
    }
  }
  const std::vector<bool> numeric = numeric_columns(header.size(), rows);
  body_ += "<div class=\"wide\"><table>\n";
  ++tables_;
  if (!caption.empty())
    body_ += "<caption>" + shown(words_.table) + " " + std::to_string(tables_) + ". " + shown(caption) +
             "</caption>\n";
  body_ += "<thead><tr>";
  for (std::size_t c = 0; c < header.size(); ++c) body_ += cell("th", header[c], numeric[c], "col");
  body_ += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    body_ += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) body_ += cell("td", row[c], numeric[c], {});
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table></div>\n";
}

void HtmlReport::picture(const Picture& picture, const std::string& caption, const std::string& alternative,
                         double density) {
  ++pictures_;
  body_ += "<figure><img width=\"" + std::to_string(picture.width()) + "\" height=\"" +
           std::to_string(picture.height()) + "\" alt=\"" +
           shown(alternative.empty() ? caption : alternative) + "\" src=\"data:image/png;base64," +
           base64(picture.png(density)) + "\"><figcaption>" + shown(words_.figure) + " " +
           std::to_string(pictures_) + ". " + shown(caption) + "</figcaption></figure>\n";
}

std::string HtmlReport::html() const {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"" + html_escaped(words_.language) +
      "\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'\">\n<title>";
  page += shown(title_) + "</title>\n<style>" + std::string(kStyle) +
          "</style>\n</head>\n<body>\n<header>\n<h1>" + shown(title_) + "</h1>\n";
  if (!subtitle_.empty()) page += "<p class=\"subtitle\">" + shown(subtitle_) + "</p>\n";
  if (contents_.size() >= 3) {
    page += "<nav aria-label=\"" + shown(words_.contents) + "\"><ol>\n";
    for (const auto& [anchor, heading] : contents_)
      page += "<li><a href=\"#" + anchor + "\">" + heading + "</a></li>\n";
    page += "</ol></nav>\n";
  }
  return page + "</header>\n<main>\n" + body_ + "</main>\n</body>\n</html>\n";
}

void HtmlReport::write(const std::filesystem::path& path) const {
  core::write_file(path, html());
}

}  // namespace ostia::figure
