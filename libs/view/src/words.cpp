#include "ostia/view/words.h"

#include <utility>

namespace ostia::view {
namespace {

Words& current() {
  static Words words;
  return words;
}

}  // namespace

const Words& words() {
  return current();
}

void set_words(Words words) {
  current() = std::move(words);
}

}  // namespace ostia::view
