#pragma once
/// \file A server on this machine that says whatever a test wants.

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace ostia::testing {

/// Takes one connection after the other. `answer` gets what has come until then (of HTTP: a request's head)
/// and gives what is sent back; the connection is closed after it. Without `answer` it keeps connections open
/// and says nothing.
class FakeServer {
 public:
  using Answer = std::function<std::string(const std::string& request)>;
  explicit FakeServer(Answer answer = {});
  ~FakeServer();
  FakeServer(const FakeServer&) = delete;
  FakeServer& operator=(const FakeServer&) = delete;
  int port() const { return port_; }
  std::vector<std::string> requests() const;  ///< heads

 private:
  void run();
  void serve(int connection);
  Answer answer_;
  int socket_ = -1, port_ = 0;
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;
  std::vector<std::string> requests_;
  std::thread thread_;
};

/// "HTTP/1.1 200 OK", ...
std::string http_answer(int status, const std::string& content_type, const std::string& body);
/// DICOM files as the body of multipart/related with the boundary "b".
std::string multipart_body(const std::vector<std::string>& files);

}  // namespace ostia::testing
