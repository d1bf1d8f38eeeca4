#include "fake_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <utility>

namespace ostia::testing {
namespace {

bool readable(int socket, int most_ms) {
  pollfd one{socket, POLLIN, 0};
  return ::poll(&one, 1, most_ms) > 0;
}

}  // namespace

FakeServer::FakeServer(Answer answer) : answer_(std::move(answer)) {
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), size);
  ::listen(socket_, 16);
  ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
  port_ = ntohs(address.sin_port);
  thread_ = std::thread([this] { run(); });
}

FakeServer::~FakeServer() {
  stop_ = true;
  thread_.join();
  ::close(socket_);
}

std::vector<std::string> FakeServer::requests() const {
  const std::lock_guard lock(mutex_);
  return requests_;
}

void FakeServer::run() {
  std::vector<int> silent;
  while (!stop_) {
    if (!readable(socket_, 20)) continue;
    const int connection = ::accept(socket_, nullptr, nullptr);
    if (connection < 0) continue;
    if (!answer_) {
      silent.push_back(connection);
      continue;
    }
    serve(connection);
    ::shutdown(connection, SHUT_WR);
    char rest[4096];
    while (!stop_ && readable(connection, 1000) && ::read(connection, rest, sizeof rest) > 0) {
    }
    ::close(connection);
  }
  for (const int connection : silent) ::close(connection);
}

void FakeServer::serve(int connection) {
  std::string request;
  char buffer[4096];
  while (!stop_ && request.find("\r\n\r\n") == std::string::npos) {
    if (!readable(connection, 20)) {
      if (request.empty()) continue;
      break;  // no HTTP
    }
    const ssize_t count = ::read(connection, buffer, sizeof buffer);
    if (count <= 0) break;
    request.append(buffer, static_cast<std::size_t>(count));
  }
  if (request.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    requests_.push_back(request.substr(0, request.find("\r\n\r\n")));
  }
  const std::string answer = answer_(request);
  for (std::size_t sent = 0; sent < answer.size();) {
    const ssize_t count = ::send(connection, answer.data() + sent, answer.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return;
    sent += static_cast<std::size_t>(count);
  }
}

std::string http_answer(int status, const std::string& content_type, const std::string& body) {
  return "HTTP/1.1 " + std::to_string(status) + " Said\r\nContent-Type: " + content_type +
         "\r\nContent-Length: " + std::to_string(body.size()) + "\r\nConnection: close\r\n\r\n" + body;
}

std::string multipart_body(const std::vector<std::string>& files) {
  std::string body;
  for (const std::string& file : files) body += "\r\n--b\r\nContent-Type: application/dicom\r\n\r\n" + file;
  return body + "\r\n--b--\r\n";
}

}  // namespace ostia::testing
