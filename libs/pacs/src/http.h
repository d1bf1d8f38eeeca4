#pragma once
// Requests over HTTP, by libcurl.

#include "ostia/core/task_context.h"
#include "ostia/pacs/server.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::pacs {

struct HttpRequest {
  std::string path;                  ///< behind the server's url, with its query; never told to anybody
  std::vector<std::string> headers;  ///< "Accept: ..."
  bool post = false;
  std::uint64_t body_bytes = 0;  ///< of a POST
  /// Fills the buffer with some of the body and returns how much; may throw.
  std::function<std::size_t(char* buffer, std::size_t size)> body{};
};

struct HttpAnswer {
  long status = 0;
  std::string body;  ///< what no sink took
};

/// One connection, which is kept for the next request.
class HttpClient {
 public:
  HttpClient(const ServerDescription& server, const Secrets& secrets);
  ~HttpClient();
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  /// `sink` gets the body of an answer of status 200 to 299 as it comes, with its content type, and may
  /// throw; without one it is gathered. Throws NetworkError, InvalidInput (certificates, no HTTP, an answer
  /// without end), Cancelled. Any status is an answer.
  using Sink = std::function<void(const std::string& content_type, std::string_view bytes)>;
  HttpAnswer request(const HttpRequest& request, const core::TaskContext& task, const Sink& sink = {});

 private:
  struct Curl;
  struct Exchange;
  void perform(Exchange& exchange, const core::TaskContext& task);
  [[noreturn]] void refuse(int code) const;
  const ServerDescription& server_;
  const Secrets& secrets_;
  std::unique_ptr<Curl> curl_;
};

/// Throws NetworkError or InvalidInput, in words, for a status that is not 200 to 299. `what` was asked for:
/// "the search". The body is not told: it may name a patient.
void require_success(const ServerDescription& server, const HttpAnswer& answer, const char* what);

}  // namespace ostia::pacs
