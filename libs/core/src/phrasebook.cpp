#include "ostia/core/phrasebook.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace ostia::core {
namespace {

constexpr std::size_t most_places = 9;
constexpr std::array<std::string_view, 3> between{"\n", "; ", ", "};  // the parts of a list

bool is_digit(char c) {
  return c >= '1' && c <= '9';
}

/// May a place hold it?
bool is_one(std::string_view text, char kind) {
  if (text.empty()) return false;
  return kind == 'l' || text.find("; ") == text.npos;
}

}  // namespace

std::vector<Phrasebook::Part> Phrasebook::parts_of(std::string_view text) {
  std::vector<Part> parts;
  std::string words;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = text.substr(i);
    const bool kept = rest.size() > 1 && rest[0] == '%' && is_digit(rest[1]);
    const bool said =
        rest.size() > 2 && rest[0] == '%' && (rest[1] == 't' || rest[1] == 'l') && is_digit(rest[2]);
    if (!kept && !said) {
      words += text[i];
      continue;
    }
    if (!words.empty()) parts.push_back({std::exchange(words, {}), 0, 0});
    parts.push_back(kept ? Part{{}, rest[1] - '0', 0} : Part{{}, rest[2] - '0', rest[1]});
    i += kept ? 1 : 2;
  }
  if (!words.empty()) parts.push_back({words, 0, 0});
  return parts;
}

Phrasebook::Phrasebook(const std::vector<Phrase>& phrases) {
  std::set<std::string> seen;
  for (const Phrase& one : phrases) {
    Known known{parts_of(one.from), parts_of(one.to), 0};
    std::set<std::pair<int, char>> there, wanted;
    bool touching = false, any_words = false;
    for (std::size_t i = 0; i < known.from.size(); ++i) {
      const Part& part = known.from[i];
      known.words += part.words.size();
      any_words = any_words || !part.words.empty();
      if (part.place == 0) continue;
      touching = touching || (i > 0 && known.from[i - 1].place != 0) ||
                 !there.insert({part.place, part.kind}).second;
    }
    for (const Part& part : known.to)
      if (part.place != 0) wanted.insert({part.place, part.kind});
    if (!any_words || one.to.empty() || touching || there != wanted)
      throw InvalidInput("the phrase \"" + one.from + "\" has not the places of \"" + one.to +
                         "\", or has some without words between them");
    if (!seen.insert(one.from).second) throw InvalidInput("two phrases are \"" + one.from + "\"");
    phrases_.push_back(std::move(known));
  }
  std::stable_sort(phrases_.begin(), phrases_.end(),
                   [](const Known& a, const Known& b) { return a.words > b.words; });
}

bool Phrasebook::fits(const std::vector<Part>& parts, std::size_t at, std::string_view text, Found& found) {
  if (at == parts.size()) return text.empty();
  const Part& part = parts[at];
  if (part.place == 0)
    return text.substr(0, part.words.size()) == part.words &&
           fits(parts, at + 1, text.substr(part.words.size()), found);
  const auto take = [&](std::size_t length) {
    if (!is_one(text.substr(0, length), part.kind)) return false;
    found[static_cast<std::size_t>(part.place)] = text.substr(0, length);
    return fits(parts, at + 1, text.substr(length), found);
  };
  if (at + 1 == parts.size()) return take(text.size());
  const std::string& next = parts[at + 1].words;
  for (std::size_t end = text.find(next, 1); end != text.npos; end = text.find(next, end + 1))
    if (take(end)) return true;
  return false;
}

const Phrasebook::Known* Phrasebook::find(std::string_view text, Found& found) const {
  for (const bool plain : {true, false})
    for (const Known& one : phrases_) {
      const bool is_plain = one.from.size() == 1;
      if (plain == is_plain && fits(one.from, 0, text, found)) return &one;
    }
  return nullptr;
}

bool Phrasebook::knows(std::string_view text) const {
  Found found(most_places + 1);
  return find(text, found) != nullptr;
}

std::string Phrasebook::parts_said(std::string_view text) const {
  for (const std::string_view mark : between) {
    if (text.find(mark) == text.npos) continue;
    std::string all;
    for (std::size_t from = 0; from <= text.size();) {
      const std::size_t to = std::min(text.find(mark, from), text.size());
      if (from > 0) all += mark;
      all += say(text.substr(from, to - from));
      from = to + mark.size();
    }
    return all;
  }
  return std::string(text);
}

std::string Phrasebook::say(std::string_view text) const {
  if (text.empty() || phrases_.empty()) return std::string(text);
  Found found(most_places + 1);
  const Known* known = text.find('\n') == text.npos ? find(text, found) : nullptr;
  if (!known) return parts_said(text);
  std::string said;
  for (const Part& part : known->to) {
    const std::string_view there = found[static_cast<std::size_t>(part.place)];
    said += part.place == 0 ? part.words : part.kind == 0 ? std::string(there) : say(there);
  }
  return said;
}

}  // namespace ostia::core
