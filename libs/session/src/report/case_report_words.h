#pragma once
/// \file A report's words in its language. What the report holds is made in English, as its files for scripts
/// have it; what a person reads is put into another language where it is written or drawn.

#include "ostia/core/phrasebook.h"
#include "ostia/figure/html_report.h"
#include "ostia/session/case_report.h"

#include <string>
#include <utility>
#include <vector>

namespace ostia::session::report_words {

const core::Phrasebook& of(ReportLanguage language);  ///< English: without phrases
figure::DocumentWords document(ReportLanguage language);
std::vector<core::Phrase> german();
std::vector<core::Phrase> german_of_tables();  ///< part of them
std::vector<core::Phrase> german_of_parts();   ///< and these

/// A person's own text: it is written as it is.
std::string own(const std::string& text);
std::string said(const core::Phrasebook& words, const std::string& text);

/// A document whose texts are put into the report's language, but for captions of pictures, which have come
/// to it in that language.
template <class Document>
class Said {
 public:
  Said(Document& document, const core::Phrasebook& words) : document_(document), words_(words) {}
  void section(const std::string& heading) { document_.section(said(words_, heading)); }
  void paragraph(const std::string& text) { document_.paragraph(said(words_, text)); }
  void notice(figure::Notice kind, const std::string& text) { document_.notice(kind, said(words_, text)); }
  void key_values(std::vector<std::pair<std::string, std::string>> rows) {
    for (auto& [key, value] : rows) key = said(words_, key), value = said(words_, value);
    document_.key_values(rows);
  }
  void table(std::vector<std::string> header, std::vector<std::vector<std::string>> rows,
             const std::string& caption) {
    for (std::string& one : header) one = said(words_, one);
    for (auto& row : rows)
      for (std::string& cell : row) cell = said(words_, cell);
    document_.table(header, rows, said(words_, caption));
  }
  void picture(const figure::Picture& picture, const std::string& caption) {
    document_.picture(picture, caption);
  }

 private:
  Document& document_;
  const core::Phrasebook& words_;
};

}  // namespace ostia::session::report_words
