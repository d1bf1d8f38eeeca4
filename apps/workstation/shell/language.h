#pragma once
/// \file The interface's language.

#include <QString>
#include <optional>
#include <string>
#include <vector>

namespace ostia::workstation {

struct Language {
  QString code;  ///< "de"
  QString name;  ///< in itself: "Deutsch"
};
const std::vector<Language>& languages();

/// Of the machine's settings: a code; empty or missing for the system's language.
constexpr const char* language_setting = "language";
/// English where the wish, or else the system's wishes in their order, are none of `languages`.
QString chosen_language(const std::optional<std::string>& setting, const QStringList& system);

/// Before any widget is made. Words of the views are set, too. Numbers keep the decimal point everywhere.
/// Returns the code of the language that is used.
QString use_language(const std::optional<std::string>& setting);
/// Its code; "en" before.
QString language_in_use();

/// Kinds of measurement and what is measured, as the lists show them.
QString measure_word(const std::string& name);
/// What a job is at ("decoding DICOM").
QString stage_word(const std::string& stage);

}  // namespace ostia::workstation
