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
    : delimiter_("\r\n--" + boundary), sink_(sink) {}

void MultipartParser::feed(std::string_view bytes) {
  if (finished()) return;  // an epilogue
  held_ += bytes;
  while (step()) {
  }
}

bool MultipartParser::step() {
  switch (state_) {
    case State::preamble:
    case State::body:
      return pass_body();
    case State::delimiter:
      return pass_delimiter();
    case State::headers:
      return pass_headers();
    case State::finished:
      break;
  }
  return false;
}

bool MultipartParser::pass_body() {
  const std::size_t at = held_.find(delimiter_);
  const bool found = at != std::string::npos;
  const std::size_t whole = found ? at : held_.size() - std::min(held_.size(), delimiter_.size() - 1);
  if (state_ == State::body && whole > 0) sink_.body({held_.data(), whole});
  held_.erase(0, found ? at + delimiter_.size() : whole);
  if (!found) return false;
  if (state_ == State::body) sink_.end_part();
  state_ = State::delimiter;
  return true;
}

bool MultipartParser::pass_delimiter() {
  if (held_.size() < 2) return false;
  const bool last = held_.compare(0, 2, "--") == 0;
  state_ = last ? State::finished : State::headers;
  if (last) held_.clear();
  return !last;
}

bool MultipartParser::pass_headers() {
  // The delimiter's own line end is still there, so that a part without headers has its empty line, too.
  const std::size_t end = held_.find("\r\n\r\n");
  if (end == std::string::npos) {
    if (held_.size() > most_header_bytes) throw InvalidInput("a part of the answer has headers without end");
    return false;
  }
  sink_.begin_part({held_.data(), end});
  held_.erase(0, end + 4);
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
