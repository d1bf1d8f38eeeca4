// As header(5) of the WFDB Applications Guide has it.

#include "wfdb/header.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <charconv>
#include <cmath>
#include <string_view>

namespace ostia::io {
namespace {

/// What is left of a word, taken from the front.
class Word {
 public:
  explicit Word(std::string_view text) : text_(text) {}
  bool empty() const { return text_.empty(); }
  bool take(char c) {
    if (text_.empty() || text_.front() != c) return false;
    text_.remove_prefix(1);
    return true;
  }
  template <class Number>
  std::optional<Number> number() {
    Number value{};
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    if (error != std::errc()) return std::nullopt;
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return value;
  }
  std::string rest() {
    const std::string all(text_);
    text_ = {};
    return all;
  }

 private:
  std::string_view text_;
};

class HeaderReader {
 public:
  explicit HeaderReader(const std::filesystem::path& path)
      : path_(path), text_(core::read_file(path, 1 << 20)) {}

  WfdbHeader read() {
    const std::size_t signals = record_line();
    for (std::size_t i = 0; i < signals; ++i) {
      if (!next_line()) refuse("the file ends after " + std::to_string(i) + " of its signals");
      header_.signals.push_back(signal_line());
    }
    return std::move(header_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InvalidInput(path_.string() + ": line " + std::to_string(line_) + ": " + why +
                       "; it should be the header of a WFDB record (.hea)");
  }

  /// The words of the next line that is no comment.
  bool next_line() {
    while (at_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      std::string_view line(text_.data() + at_, end - at_);
      at_ = end + 1;
      ++line_;
      words_.clear();
      while (!line.empty()) {
        const std::size_t from = line.find_first_not_of(" \t\r");
        if (from == std::string_view::npos) break;
        const std::size_t to = std::min(line.find_first_of(" \t\r", from), line.size());
        words_.push_back(line.substr(from, to - from));
        line.remove_prefix(to);
      }
      if (!words_.empty() && words_.front().front() != '#') return true;
    }
    return false;
  }

  /// Number of signals.
  std::size_t record_line() {
    if (!next_line() || words_.size() < 2) refuse("has no name and number of signals");
    if (words_[0].find('/') != std::string_view::npos)
      refuse("is a record of several segments: give one of its segments");
    const auto signals = Word(words_[1]).number<int>();
    if (!signals || *signals < 1 || *signals > 1000) refuse("has no number of signals from 1 to 1000");
    if (words_.size() > 2) {
      const auto rate = Word(words_[2]).number<double>();  // the counter's rate may follow
      if (!rate || !(*rate > 0.0) || !std::isfinite(*rate)) refuse("has no positive sampling rate");
      header_.frames_per_second = *rate;
    }
    if (words_.size() > 3) {
      const auto frames = Word(words_[3]).number<long long>();
      if (!frames || *frames < 0) refuse("has no number of samples");
      header_.frames = static_cast<std::size_t>(*frames);
    }
    return static_cast<std::size_t>(*signals);
  }

  void read_format(WfdbSignal& signal) const {
    Word word(words_[1]);
    const auto format = word.number<int>();
    if (!format) refuse("has no number of a format");
    signal.format = *format;
    while (!word.empty()) {
      std::optional<int> value;
      if (word.take('x')) {
        if ((value = word.number<int>())) signal.samples_per_frame = *value;
      } else if (word.take(':')) {
        if ((value = word.number<int>())) signal.skew = *value;
      } else if (word.take('+')) {
        if ((value = word.number<int>())) signal.offset = static_cast<std::size_t>(std::max(*value, 0));
      }
      if (!value) refuse("has a format that cannot be read");
    }
    if (signal.samples_per_frame < 1 || signal.samples_per_frame > 10000 || signal.skew < 0)
      refuse("has a format that cannot be read");
  }

  /// GAIN(BASELINE)/UNIT, all but the first left out where they please.
  bool read_gain(WfdbSignal& signal) const {
    Word word(words_[2]);
    const auto gain = word.number<double>();
    if (!gain || !std::isfinite(*gain)) refuse("has no gain");
    if (*gain != 0.0) signal.gain = *gain;  // 0: not calibrated, read as the default
    bool baseline = false;
    if (word.take('(')) {
      const auto value = word.number<int>();
      if (!value || !word.take(')')) refuse("has a baseline that cannot be read");
      signal.baseline = *value;
      baseline = true;
    }
    if (word.take('/')) signal.unit = word.rest();
    return baseline;
  }

  WfdbSignal signal_line() {
    if (words_.size() < 2) refuse("has no file and format of a signal");
    WfdbSignal signal;
    signal.file = words_[0];
    if (signal.file.find_first_of("/\\") != std::string::npos || signal.file == ".." || signal.file == "-")
      refuse("has its samples in another place (" + signal.file + "): put the file beside the header");
    read_format(signal);
    const bool baseline = words_.size() > 2 && read_gain(signal);
    if (words_.size() > 4 && !baseline)
      if (const auto zero = Word(words_[4]).number<int>()) signal.baseline = *zero;
    if (words_.size() > 6) signal.checksum = Word(words_[6]).number<int>();
    for (std::size_t i = 8; i < words_.size(); ++i) {
      if (i > 8) signal.name += ' ';
      signal.name += words_[i];
    }
    return signal;
  }

  std::filesystem::path path_;
  std::string text_;
  std::size_t at_ = 0;
  int line_ = 0;
  std::vector<std::string_view> words_;
  WfdbHeader header_;
};

}  // namespace

WfdbHeader read_wfdb_header(const std::filesystem::path& path) {
  return HeaderReader(path).read();
}

}  // namespace ostia::io
