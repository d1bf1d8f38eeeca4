#include "commands/search.h"

#include <algorithm>

namespace ostia::workstation {
namespace {

enum Rank { begins, word_begins, within, in_menus, single_characters };

bool begins_word(const QString& text, int at) {
  return at == 0 || !text[at - 1].isLetterOrNumber();
}

/// Where the word stands in the text, at a word's beginning if it can; -1: nowhere.
int place_of(const QString& word, const QString& text) {
  int within_word = -1;
  for (int at = text.indexOf(word, 0, Qt::CaseInsensitive); at >= 0;
       at = text.indexOf(word, at + 1, Qt::CaseInsensitive)) {
    if (begins_word(text, at)) return at;
    if (within_word < 0) within_word = at;
  }
  return within_word;
}

std::optional<Match> words_in(const QStringList& words, const QString& text, const QString& menus) {
  Match found;
  for (const QString& word : words) {
    const int at = place_of(word, text);
    if (at < 0) {
      if (place_of(word, menus) < 0) return std::nullopt;
      found.rank = std::max<int>(found.rank, in_menus);
      continue;
    }
    found.rank = std::max<int>(found.rank, begins_word(text, at) ? word_begins : within);
    for (int i = 0; i < word.size(); ++i) found.marks.push_back(at + i);
  }
  std::sort(found.marks.begin(), found.marks.end());
  found.marks.erase(std::unique(found.marks.begin(), found.marks.end()), found.marks.end());
  return found;
}

std::optional<Match> characters_in(const QString& characters, const QString& text) {
  Match found{single_characters, true, {}};
  int at = 0;
  for (const QChar one : characters) {
    at = text.indexOf(one, at, Qt::CaseInsensitive);
    if (at < 0) return std::nullopt;
    found.marks.push_back(at++);
  }
  return found;
}

}  // namespace

std::optional<Match> match(const QString& typed, const QString& text, const QStringList& menus) {
  const QStringList words = typed.split(' ', Qt::SkipEmptyParts);
  if (words.isEmpty()) return Match{};
  auto found = words_in(words, text, menus.join(' '));
  if (!found) return characters_in(words.join(QString()), text);
  if (text.startsWith(typed.simplified(), Qt::CaseInsensitive)) found->rank = begins;
  return found;
}

}  // namespace ostia::workstation
