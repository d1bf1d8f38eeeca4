#pragma once
/// \file The log, on stderr. Nothing of a patient's identity goes into it.

#include <string>
#include <string_view>

namespace ostia::core {

enum class LogFormat { text, json };
enum class LogLevel { debug, info, warning, error, off };

/// Where and how the process logs. Process-wide; the default is text, from `info` up.
void set_log(LogFormat format, LogLevel level);
LogFormat log_format();

/// Registers a text that identifies a patient or may do so (a name, an identifier, a path the user gave).
/// From now on it is replaced by `alias` in everything that is logged; a text that is known gets the new
/// alias. Texts shorter than three characters are ignored.
void redact_in_logs(std::string_view secret, std::string_view alias);
/// The text with everything registered replaced; what log_* applies. For other writers of files, too.
std::string redacted(std::string_view text);

void log_debug(std::string_view message);
void log_info(std::string_view message);
void log_warning(std::string_view message);
void log_error(std::string_view message);

}  // namespace ostia::core
