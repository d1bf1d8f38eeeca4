#include "ostia/core/log.h"

#include "ostia/core/job.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace ostia::core {
namespace {

using Aliases = std::vector<std::pair<std::string, std::string>>;  // longest secret first

struct Redactions {
  std::mutex mutex;
  Aliases in_logs, in_results;
  std::set<std::string, std::less<>> never;
};

struct Collectors {
  std::mutex mutex;
  std::map<const HeardWarnings*, std::vector<std::string>> heard;
  std::vector<const HeardWarnings*> living;  // youngest last
};

Collectors& collectors() {
  static Collectors instance;
  return instance;
}

void hear(const std::string& warning) {
  Collectors& all = collectors();
  const std::lock_guard lock(all.mutex);
  for (auto& [collector, texts] : all.heard)
    if (std::find(texts.begin(), texts.end(), warning) == texts.end()) texts.push_back(warning);
}

Redactions& redactions() {
  static Redactions instance;
  return instance;
}

std::string json_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out;
}

std::shared_ptr<spdlog::logger> make_logger() {
  auto logger =
      std::make_shared<spdlog::logger>("ostia", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_pattern("%^%l%$: %v");
  logger->set_level(spdlog::level::info);
  return logger;
}

spdlog::logger& logger() {
  static const std::shared_ptr<spdlog::logger> instance = make_logger();
  return *instance;
}

std::atomic<bool>& as_json() {
  static std::atomic<bool> json{false};
  return json;
}

spdlog::level::level_enum level_of(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      return spdlog::level::err;
    case LogLevel::off:
      break;
  }
  return spdlog::level::off;
}

void write(spdlog::level::level_enum level, std::string_view message) {
  if (!logger().should_log(level)) return;
  const std::string clean = redacted_for_log(message);
  logger().log(level, "{}", as_json() ? json_escaped(clean) : clean);
}

}  // namespace

void set_log(LogFormat format, LogLevel level) {
  as_json() = format == LogFormat::json;
  logger().set_pattern(format == LogFormat::json
                           ? R"({"time":"%Y-%m-%dT%H:%M:%S.%e%z","level":"%l","message":"%v"})"
                           : "%^%l%$: %v");
  logger().set_level(level_of(level));
}

LogFormat log_format() {
  return as_json() ? LogFormat::json : LogFormat::text;
}

namespace {

void register_in(Aliases Redactions::*list, std::string_view secret, std::string_view alias) {
  if (secret.size() < 3) return;
  Redactions& r = redactions();
  const std::lock_guard lock(r.mutex);
  if (r.never.contains(secret)) return;
  Aliases& pairs = r.*list;
  std::erase_if(pairs, [&](const auto& known) { return known.first == secret; });
  pairs.emplace_back(secret, alias);
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
}

}  // namespace

void redact_in_logs(std::string_view secret, std::string_view alias) {
  register_in(&Redactions::in_logs, secret, alias);
}
void redact_in_results(std::string_view secret, std::string_view alias) {
  register_in(&Redactions::in_results, secret, alias);
}

void never_redact(const std::set<std::string>& words) {
  Redactions& r = redactions();
  const std::lock_guard lock(r.mutex);
  r.never.insert(words.begin(), words.end());
}

HeardWarnings::HeardWarnings() {
  Collectors& all = collectors();
  const std::lock_guard lock(all.mutex);
  all.heard[this];
  all.living.push_back(this);
}

HeardWarnings::~HeardWarnings() {
  Collectors& all = collectors();
  const std::lock_guard lock(all.mutex);
  all.heard.erase(this);
  std::erase(all.living, this);
}

std::vector<std::string> heard_warnings() {
  if (const Job* job = current_job()) return job->warnings();
  Collectors& all = collectors();
  const std::lock_guard lock(all.mutex);
  return all.living.empty() ? std::vector<std::string>() : all.heard.at(all.living.back());
}

namespace {

constexpr std::size_t shortest_anywhere = 8;  ///< shorter texts ("out") are replaced as whole words alone

/// Whether `size` characters at `at` stand apart: letters that only happen to lie within a longer word name
/// nobody.
bool stands_apart(const std::string& text, std::size_t at, std::size_t size) {
  const auto letter = [&](std::size_t i) {
    return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0;
  };
  return !(at > 0 && letter(at - 1) && letter(at)) && !(letter(at + size) && letter(at + size - 1));
}

void replace_all(const Aliases& pairs, std::string& out) {
  for (const auto& [secret, alias] : pairs) {
    std::size_t at = 0;
    while ((at = out.find(secret, at)) != std::string::npos) {
      const bool names_somebody = secret.size() >= shortest_anywhere || stands_apart(out, at, secret.size());
      if (names_somebody) out.replace(at, secret.size(), alias);
      at += names_somebody ? alias.size() : secret.size();
    }
  }
}

}  // namespace

std::string redacted_for_log(std::string_view text) {
  std::string out(text);
  Redactions& r = redactions();
  const std::lock_guard lock(r.mutex);
  replace_all(r.in_logs, out);
  return out;
}

std::string redacted(std::string_view text) {
  std::string out(text);
  Redactions& r = redactions();
  const std::lock_guard lock(r.mutex);
  replace_all(r.in_logs, out);
  replace_all(r.in_results, out);
  return out;
}

void log_debug(std::string_view message) {
  write(spdlog::level::debug, message);
}
void log_info(std::string_view message) {
  write(spdlog::level::info, message);
}
void log_warning(std::string_view message) {
  hear(std::string(message));
  if (const Job* job = current_job()) job->hear(message);
  write(spdlog::level::warn, message);
}
void log_error(std::string_view message) {
  write(spdlog::level::err, message);
}

}  // namespace ostia::core
