#pragma once
/// \file As much of HTTP/1.1 as a page on the loopback needs: one request a connection, all of it bounded.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace ostia::cohort {

struct HttpRequest {
  std::string method, target;
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
  /// Empty: there is none.
  std::string header(const std::string& name) const;
};

/// The lines before the empty one. Nothing for what is no HTTP/1.0 or 1.1, a name twice, or a folded line.
std::optional<HttpRequest> parse_http_head(std::string_view head);

struct HttpAnswer {
  int status = 200;
  std::string text{};            ///< for a person, where there is no file
  std::filesystem::path file{};  ///< sent as it is
};

/// Reads a request of at most 16 KB of head and 1 MB of body within ten seconds; nothing where the other side
/// does not keep to that. `status` is what to answer then; 0: nothing came.
std::optional<HttpRequest> read_http_request(int socket, int& status);
void send_http_answer(int socket, const HttpAnswer& answer);

}  // namespace ostia::cohort
