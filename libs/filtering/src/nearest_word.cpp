#include "nearest_word.h"

#include <algorithm>
#include <numeric>

namespace ostia::filtering::detail {
namespace {

std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_word(std::string_view given, const std::vector<std::string>& words) {
  const std::string_view start = given.substr(0, 64);  // more is no slip of a finger
  std::string nearest;
  std::size_t fewest = static_cast<std::size_t>(-1);
  for (const std::string& word : words) {
    const std::size_t edits = edits_between(start, word);
    if (edits >= fewest) continue;
    fewest = edits;
    nearest = word;
  }
  return nearest;
}

}  // namespace ostia::filtering::detail
