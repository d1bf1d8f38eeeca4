#pragma once
/// \file The log, on stderr. Nothing of a patient's identity goes into it.

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::core {

enum class LogFormat { text, json };
enum class LogLevel { debug, info, warning, error, off };

/// Where and how the process logs. Process-wide; the default is text, from `info` up.
void set_log(LogFormat format, LogLevel level);
LogFormat log_format();

/// Registers a text that identifies a patient or may do so (a name, an identifier, a path the user gave).
/// From now on it is replaced by `alias` in everything that is logged; a text that is known gets the new
/// alias. Texts shorter than three characters are ignored, and those of `never_redact`.
void redact_in_logs(std::string_view secret, std::string_view alias);
/// The same for what is kept (manifests, reports, pictures), but not for the log, where the user who gave a
/// path may read it.
void redact_in_results(std::string_view secret, std::string_view alias);
/// Words that messages are made of and that name nobody: a folder may be called "out" without "left out"
/// becoming something else.
void never_redact(const std::set<std::string>& words);
/// The text with everything registered replaced: for writers of files.
std::string redacted(std::string_view text);
/// What log_* applies: without what is registered for results alone.
std::string redacted_for_log(std::string_view text);

/// Gathers what is logged as a warning while it lives, whether it is shown or not, for what is written down
/// at the end of a job. Those of all threads; of several collectors each one hears all.
class HeardWarnings {
 public:
  HeardWarnings();
  ~HeardWarnings();
  HeardWarnings(const HeardWarnings&) = delete;
  HeardWarnings& operator=(const HeardWarnings&) = delete;
};
/// What the calling thread's job (job.h) has heard or, without one, the youngest living collector, each once;
/// nothing without either.
std::vector<std::string> heard_warnings();

void log_debug(std::string_view message);
void log_info(std::string_view message);
void log_warning(std::string_view message);
void log_error(std::string_view message);

}  // namespace ostia::core
