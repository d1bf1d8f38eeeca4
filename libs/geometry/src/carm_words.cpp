#include "ostia/geometry/carm_words.h"

#include "ostia/core/error.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace ostia::geometry {
namespace {

/// Reads "LAO30CRA20" from the left.
class CarmReader {
 public:
  explicit CarmReader(std::string_view text) {
    for (const char c : text)
      if (c != ' ' && c != ',') rest_ += static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  }
  bool ended() const { return at_ == rest_.size(); }
  bool word(std::string_view wanted) {
    if (rest_.compare(at_, wanted.size(), wanted) != 0) return false;
    at_ += wanted.size();
    return true;
  }
  std::optional<double> number() {
    double value = 0.0;
    const char* end = rest_.data() + rest_.size();
    const auto [stop, error] = std::from_chars(rest_.data() + at_, end, value, std::chars_format::fixed);
    if (error != std::errc() || !(value >= 0.0)) return {};
    at_ = static_cast<std::size_t>(stop - rest_.data());
    return value;
  }

 private:
  std::string rest_;
  std::size_t at_ = 0;
};

std::optional<CarmAngles> read_angles(std::string_view text) {
  CarmReader reader(text);
  CarmAngles angles;
  if (reader.ended()) return {};
  if (reader.word("AP")) {
  } else if (reader.word("LAT")) {
    angles.lao_deg = 90.0;
  } else if (const double sign = reader.word("LAO") ? 1.0 : reader.word("RAO") ? -1.0 : 0.0; sign != 0.0) {
    const auto value = reader.number();
    if (!value || *value > 180.0) return {};
    angles.lao_deg = sign * *value;
  }
  if (const double sign = reader.word("CRA") ? 1.0 : reader.word("CAU") ? -1.0 : 0.0; sign != 0.0) {
    const auto value = reader.number();
    if (!value || *value > 90.0) return {};
    angles.cranial_deg = sign * *value;
  }
  return reader.ended() ? std::optional(angles) : std::nullopt;
}

}  // namespace

CarmAngles carm_angles(std::string_view text) {
  if (const auto angles = read_angles(text)) return *angles;
  throw UsageError("the view \"" + std::string(text) +
                   "\" is not understood: write AP, LAT, or angles such as LAO30CRA20, RAO30, CAU25 (LAO and "
                   "RAO up to 180, CRA and CAU up to 90 degrees)");
}

std::string text_of(const CarmAngles& angles) {
  const auto lao = std::lround(angles.lao_deg), cranial = std::lround(angles.cranial_deg);
  std::string text;
  if (lao != 0) text = (lao > 0 ? "LAO " : "RAO ") + std::to_string(std::abs(lao));
  if (cranial != 0)
    text += (text.empty() ? "" : " ") + std::string(cranial > 0 ? "CRA " : "CAU ") +
            std::to_string(std::abs(cranial));
  return text.empty() ? "AP" : text;
}

}  // namespace ostia::geometry
