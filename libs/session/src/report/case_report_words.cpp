#include "report/case_report_words.h"

#include "ostia/core/error.h"

namespace ostia::session {
namespace report_words {
namespace {

constexpr char own_mark = '\x01';  // no text has it: documents leave control characters out

}  // namespace

const core::Phrasebook& of(ReportLanguage language) {
  static const core::Phrasebook english, in_german(german());
  return language == ReportLanguage::german ? in_german : english;
}

figure::DocumentWords document(ReportLanguage language) {
  figure::DocumentWords words;
  if (language == ReportLanguage::english) return words;
  words.language = "de";
  words.contents = "Inhalt";
  words.table = "Tabelle";
  words.figure = "Abbildung";
  words.page = "Seite %1 von %2";
  words.passed = "Geprüft";
  words.warning = "Warnung";
  words.failed = "Fehler";
  words.note = "Hinweis";
  return words;
}

std::string own(const std::string& text) {
  return text.empty() ? text : own_mark + text;
}

std::string said(const core::Phrasebook& words, const std::string& text) {
  return !text.empty() && text.front() == own_mark ? text.substr(1) : words.say(text);
}

}  // namespace report_words

ReportLanguage report_language(const std::string& code) {
  if (code == "en") return ReportLanguage::english;
  if (code == "de") return ReportLanguage::german;
  throw InvalidInput("there is no report in the language \"" + code + "\"; known are en and de");
}

ReportTemplate report_template(const std::string& word) {
  if (word == "full") return ReportTemplate::full;
  if (word == "short") return ReportTemplate::brief;
  throw InvalidInput("there is no template \"" + word + "\" of a report; known are full and short");
}

std::string to_string(ReportTemplate form) {
  return form == ReportTemplate::brief ? "short" : "full";
}

std::string to_string(ReportLanguage language) {
  return language == ReportLanguage::german ? "de" : "en";
}

}  // namespace ostia::session
