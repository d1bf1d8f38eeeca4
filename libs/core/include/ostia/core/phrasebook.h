#pragma once
/// \file Sentences with numbers in them, in another language.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::core {

/// A sentence in both languages. Places in it: %1 to %9 stay as they are (numbers, names), %t1 to %t9 are put
/// into the other language themselves, %l1 to %l9 are lists of what is ("; " between, or ", ", or lines).
/// "slices %1 mm apart".
struct Phrase {
  std::string from, to;
};

/// What is made in one language by many libraries, shown in another. A text without a phrase stays as it is.
class Phrasebook {
 public:
  Phrasebook() = default;  ///< of no phrases
  /// Throws InvalidInput for a phrase of which one side is empty or has other places, whose places touch each
  /// other, or that is there twice.
  explicit Phrasebook(const std::vector<Phrase>& phrases);
  /// A phrase that is the text itself goes before those with places, and of these the one with the longest
  /// words. What stands at a place has a character or more; but for %l it holds no "; ". Lines are taken one
  /// by one, and so are the parts of a list of which there is no phrase.
  std::string say(std::string_view text) const;
  bool knows(std::string_view text) const;  ///< a phrase for the whole text
  bool empty() const { return phrases_.empty(); }

 private:
  struct Part {
    std::string words;  ///< or, where `place` is not 0, one
    int place = 0;
    char kind = 0;  ///< 't', 'l', or 0
  };
  struct Known {
    std::vector<Part> from, to;
    std::size_t words = 0;
  };
  using Found = std::vector<std::string_view>;
  static std::vector<Part> parts_of(std::string_view text);
  static bool fits(const std::vector<Part>& parts, std::size_t part, std::string_view text, Found& found);
  const Known* find(std::string_view text, Found& found) const;
  std::string parts_said(std::string_view text) const;
  std::vector<Known> phrases_;  // the longest words first
};

}  // namespace ostia::core
