#include "multipart.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cctype>

namespace ostia::pacs {
namespace {

constexpr std::size_t most_header_bytes = 16U << 10;
constexpr std::size_t longest_boundary = 256;

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

}  // namespace

MultipartParser::MultipartParser(const std::string& boundary, PartSink& sink)
    : delimiter_("\r\n--" + boundary), searcher_(delimiter_.begin(), delimiter_.end()), sink_(sink) {}

void MultipartParser::feed(std::string_view bytes) {
  // What was kept is joined with as little as ends it; the rest stays where it is.
  while (!held_.empty() && !bytes.empty() && !finished()) {
    const std::string_view some = bytes.substr(0, delimiter_.size() + 512);
    held_ += some;
    std::string_view rest = held_;
    consume(rest);
    if (rest.size() > some.size()) {
      bytes.remove_prefix(some.size());
      held_.erase(0, held_.size() - rest.size());
    } else {
      bytes.remove_prefix(some.size() - rest.size());
      held_.clear();
    }
  }
  if (finished()) return;  // an epilogue
  consume(bytes);
  held_ += bytes;
}

void MultipartParser::consume(std::string_view& rest) {
  bool on = true;
  while (on) {
    switch (state_) {
      case State::preamble:
      case State::body:
        on = pass_body(rest);
        break;
      case State::delimiter:
        on = pass_delimiter(rest);
        break;
      case State::headers:
        on = pass_headers(rest);
        break;
      case State::finished:
        rest = {};
        on = false;
        break;
    }
  }
}

bool MultipartParser::pass_body(std::string_view& rest) {
  const auto at = std::search(rest.begin(), rest.end(), searcher_);
  const bool found = at != rest.end();
  const std::size_t whole = found ? static_cast<std::size_t>(at - rest.begin())
                                  : rest.size() - std::min(rest.size(), delimiter_.size() - 1);
  if (state_ == State::body && whole > 0) sink_.body(rest.substr(0, whole));
  rest.remove_prefix(found ? whole + delimiter_.size() : whole);
  if (!found) return false;
  if (state_ == State::body) sink_.end_part();
  state_ = State::delimiter;
  return true;
}

bool MultipartParser::pass_delimiter(std::string_view& rest) {
  if (rest.size() < 2) return false;
  state_ = rest.substr(0, 2) == "--" ? State::finished : State::headers;
  return true;
}

bool MultipartParser::pass_headers(std::string_view& rest) {
  // The delimiter's own line end is still there, so that a part without headers has its empty line, too.
  const std::size_t end = rest.find("\r\n\r\n");
  if (end == std::string_view::npos) {
    if (rest.size() > most_header_bytes) throw InvalidInput("a part of the answer has headers without end");
    return false;
  }
  sink_.begin_part(rest.substr(0, end));
  rest.remove_prefix(end + 4);
  state_ = State::body;
  return true;
}

std::string boundary_of(std::string_view content_type) {
  const std::string small = lower(content_type);
  if (small.compare(0, 10, "multipart/") != 0) return {};
  std::size_t at = 0;
  do {
    at = small.find("boundary", at + 1);
    if (at == std::string::npos) return {};
  } while (small[at - 1] != ';' && small[at - 1] != ' ' && small[at - 1] != '\t');
  std::string_view rest = content_type.substr(at + 8);
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
  if (rest.substr(0, 1) != "=") return {};
  rest.remove_prefix(1);
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
  const bool quoted = rest.substr(0, 1) == "\"";
  if (quoted) rest.remove_prefix(1);
  const std::string boundary(rest.substr(0, rest.find_first_of(quoted ? "\"" : "; \t\r\n")));
  return boundary.size() <= longest_boundary ? boundary : std::string();
}

}  // namespace ostia::pacs
