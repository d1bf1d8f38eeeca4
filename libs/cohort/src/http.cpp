#include "http.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>

namespace ostia::cohort {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_head_bytes = 16 << 10, most_body_bytes = 1 << 20;
constexpr std::chrono::seconds longest_request{10}, longest_answer{600};

bool ready_before(int socket, short what, Clock::time_point end) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
  pollfd one{socket, what, 0};
  return left > 0 && ::poll(&one, 1, static_cast<int>(left)) > 0;
}

/// False: the other side is gone, or too slow.
bool receive_more(int socket, std::string& text, Clock::time_point end) {
  std::array<char, 8192> bytes{};
  if (!ready_before(socket, POLLIN, end)) return false;
  const ssize_t got = ::recv(socket, bytes.data(), bytes.size(), 0);
  if (got <= 0) return false;
  text.append(bytes.data(), static_cast<std::size_t>(got));
  return true;
}

bool send_all(int socket, std::string_view bytes, Clock::time_point end) {
  while (!bytes.empty()) {
    if (!ready_before(socket, POLLOUT, end)) return false;
    const ssize_t sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

std::string_view without_blanks(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return out;
}

bool take_request_line(std::string_view line, HttpRequest& out) {
  const std::size_t first = line.find(' '), last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) return false;
  out.method = line.substr(0, first);
  out.target = line.substr(first + 1, last - first - 1);
  const std::string_view version = line.substr(last + 1);
  const auto is_plain = [](char c) { return c > 32 && c < 127; };
  return (version == "HTTP/1.1" || version == "HTTP/1.0") && std::ranges::all_of(out.target, is_plain);
}

bool take_header(std::string_view line, HttpRequest& out) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || colon == 0 ||
      line.substr(0, colon).find_first_of(" \t") != line.npos)
    return false;
  return out.headers.emplace(lower_case(line.substr(0, colon)), without_blanks(line.substr(colon + 1)))
      .second;
}

std::optional<std::size_t> body_size(const HttpRequest& request) {
  const std::string text = request.header("content-length");
  if (!request.header("transfer-encoding").empty()) return std::nullopt;
  std::size_t size = 0;
  if (text.empty()) return size;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
  if (error != std::errc() || end != text.data() + text.size() || size > most_body_bytes) return std::nullopt;
  return size;
}

const char* phrase_of(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 400:
      return "Bad Request";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 409:
      return "Conflict";
    case 413:
      return "Content Too Large";
    default:
      return "Service Unavailable";
  }
}

const char* type_of(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".html") return "text/html; charset=utf-8";
  if (extension == ".js") return "text/javascript; charset=utf-8";
  if (extension == ".png") return "image/png";
  return extension == ".pdf" ? "application/pdf" : "application/octet-stream";
}

std::string head_of(int status, const char* type, std::uint64_t size) {
  return "HTTP/1.1 " + std::to_string(status) + " " + phrase_of(status) + "\r\nContent-Type: " + type +
         "\r\nContent-Length: " + std::to_string(size) +
         "\r\nConnection: close\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
         "Referrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: same-origin\r\n"
         "Content-Security-Policy: default-src 'self' 'unsafe-inline' data:; frame-ancestors 'none'\r\n\r\n";
}

void send_text(int socket, int status, const std::string& text) {
  const auto end = Clock::now() + longest_request;
  if (send_all(socket, head_of(status, "text/plain; charset=utf-8", text.size()), end))
    send_all(socket, text, end);
}

void send_open_file(int socket, int file, const std::filesystem::path& name) {
  struct stat known {};
  if (::fstat(file, &known) != 0 || !S_ISREG(known.st_mode))
    return send_text(socket, 404, "there is no such file\n");
  const auto end = Clock::now() + longest_answer;
  auto left = static_cast<std::uint64_t>(known.st_size);
  if (!send_all(socket, head_of(200, type_of(name), left), end)) return;
  std::string bytes(1 << 16, '\0');
  while (left > 0) {
    const ssize_t got = ::read(file, bytes.data(), std::min<std::uint64_t>(left, bytes.size()));
    if (got <= 0 || !send_all(socket, {bytes.data(), static_cast<std::size_t>(got)}, end)) return;
    left -= static_cast<std::uint64_t>(got);
  }
}

}  // namespace

std::string HttpRequest::header(const std::string& name) const {
  const auto at = headers.find(name);
  return at == headers.end() ? "" : at->second;
}

std::optional<HttpRequest> parse_http_head(std::string_view head) {
  HttpRequest out;
  bool first = true;
  while (!head.empty()) {
    const std::size_t end = std::min(head.find("\r\n"), head.size());
    const std::string_view line = head.substr(0, end);
    head.remove_prefix(std::min(end + 2, head.size()));
    if (!(first ? take_request_line(line, out) : take_header(line, out))) return std::nullopt;
    first = false;
  }
  return first ? std::nullopt : std::optional(std::move(out));
}

std::optional<HttpRequest> read_http_request(int socket, int& status) {
  const auto end = Clock::now() + longest_request;
  std::string text;
  std::size_t head = std::string::npos;
  status = 0;
  while ((head = text.find("\r\n\r\n")) == std::string::npos) {
    if (text.size() > most_head_bytes) {
      status = 413;
      return std::nullopt;
    }
    if (!receive_more(socket, text, end)) return std::nullopt;
  }
  status = 400;
  std::optional<HttpRequest> out = parse_http_head(std::string_view(text).substr(0, head));
  if (!out) return std::nullopt;
  const std::optional<std::size_t> size = body_size(*out);
  if (!size) {
    status = 413;
    return std::nullopt;
  }
  out->body = text.substr(head + 4);
  while (out->body.size() < *size)
    if (!receive_more(socket, out->body, end)) return std::nullopt;
  out->body.resize(*size);
  return out;
}

void send_http_answer(int socket, const HttpAnswer& answer) {
  if (answer.file.empty()) return send_text(socket, answer.status, answer.text);
  const int file = ::open(answer.file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0) return send_text(socket, 404, "there is no such file\n");
  send_open_file(socket, file, answer.file);
  ::close(file);
}

}  // namespace ostia::cohort
