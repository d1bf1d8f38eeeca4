#pragma once
/// \file What the libraries say, in the window's language.

#include <QString>
#include <string>
#include <vector>

namespace ostia::workstation {

/// A message or note of a library as the person reads it. What has no translation stays English.
QString library_text(const std::string& text);
/// After the translations were installed.
void use_library_language();
/// The sentences that are translated, with their places (core/phrasebook.h).
std::vector<std::string> library_sentences();

}  // namespace ostia::workstation
