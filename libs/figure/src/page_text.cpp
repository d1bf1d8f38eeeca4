#include "page_text.h"

#include "canvas.h"
#include "text.h"

#include "ostia/core/log.h"

#include <algorithm>
#include <sstream>

namespace ostia::figure {
namespace {

/// Where the characters of a valid text end.
std::vector<std::size_t> ends_of(const std::string& text) {
  std::vector<std::size_t> ends;
  for (std::size_t i = 1; i <= text.size(); ++i)
    if (i == text.size() || (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) ends.push_back(i);
  return ends;
}

/// The most characters from the start that fit, at least one. Text grows wider with each character, so that
/// the place can be found by halving.
std::size_t fitting(const std::string& text, double size_px, bool bold, double width_px) {
  const std::vector<std::size_t> ends = ends_of(text);
  std::size_t low = 0, high = ends.size();
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (Canvas::text_size(text.substr(0, ends[middle]), size_px, bold).x() <= width_px ? low : high) = middle;
  }
  return ends.empty() ? 0 : ends[low];
}

/// Lines of one paragraph.
class Breaker {
 public:
  Breaker(double size_px, bool bold, double width_px) : size_(size_px), bold_(bold), width_(width_px) {}

  std::vector<std::string> lines(const std::string& paragraph) {
    if (fits(paragraph)) return {paragraph};
    std::istringstream words(paragraph);
    for (std::string word; words >> word;) add(word);
    lines_.push_back(line_);
    return std::move(lines_);
  }

 private:
  bool fits(const std::string& text) const { return Canvas::text_size(text, size_, bold_).x() <= width_; }
  void add(std::string word) {
    const std::string longer = line_.empty() ? word : line_ + " " + word;
    if (fits(longer)) {
      line_ = longer;
      return;
    }
    if (!line_.empty()) lines_.push_back(std::move(line_));
    while (!fits(word)) {
      const std::size_t end = fitting(word, size_, bold_, width_);
      if (end >= word.size()) break;  // a single character
      lines_.push_back(word.substr(0, end));
      word.erase(0, end);
    }
    line_ = std::move(word);
  }
  double size_;
  bool bold_;
  double width_;
  std::string line_;
  std::vector<std::string> lines_;
};

std::string shown(const std::string& text) {
  std::string clean = clean_utf8(core::redacted(text));
  std::replace(clean.begin(), clean.end(), '\t', ' ');
  return clean;
}

}  // namespace

std::vector<std::string> wrapped(const std::string& text, double size_px, bool bold, double width_px) {
  std::vector<std::string> all;
  std::istringstream paragraphs(shown(text));
  for (std::string paragraph; std::getline(paragraphs, paragraph);) {
    const std::vector<std::string> lines = Breaker(size_px, bold, width_px).lines(paragraph);
    all.insert(all.end(), lines.begin(), lines.end());
  }
  if (all.empty()) all.emplace_back();
  return all;
}

double widest_word(const std::string& text, double size_px, bool bold) {
  double widest = 0.0;
  std::istringstream words(shown(text));
  for (std::string word; words >> word;)
    widest = std::max(widest, Canvas::text_size(word, size_px, bold).x());
  return widest;
}

std::string cut_to(const std::string& text, double size_px, bool bold, double width_px) {
  std::string line = shown(text);
  std::replace(line.begin(), line.end(), '\n', ' ');
  if (line.empty() || Canvas::text_size(line, size_px, bold).x() <= width_px) return line;
  const std::string ellipsis = "\xE2\x80\xA6";
  const double left = width_px - Canvas::text_size(ellipsis, size_px, bold).x();
  return line.substr(0, fitting(line, size_px, bold, left)) + ellipsis;
}

}  // namespace ostia::figure
