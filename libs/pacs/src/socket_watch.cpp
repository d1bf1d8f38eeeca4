#include "socket_watch.h"

#include "ostia/pacs/archive.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <future>
#include <memory>
#include <utility>

namespace ostia::pacs {
namespace {

constexpr std::chrono::milliseconds look_again{50};
using WatchClock = std::chrono::steady_clock;

/// The host's addresses. The system's look-up cannot be cancelled, so it runs in a thread that is left alone
/// when nobody waits any more.
std::vector<sockaddr_in> addresses_of(const std::string& host, WatchClock::time_point end,
                                      const core::TaskContext& task) {
  auto promise = std::make_shared<std::promise<std::vector<sockaddr_in>>>();
  auto answer = promise->get_future();
  std::thread([promise, host] {
    std::vector<sockaddr_in> found;
    addrinfo hints{};
    hints.ai_family = AF_INET;  // DCMTK 3.6.7 knows no other
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* all = nullptr;
    if (::getaddrinfo(host.c_str(), nullptr, &hints, &all) == 0) {
      for (const addrinfo* one = all; one != nullptr; one = one->ai_next)
        found.push_back(*reinterpret_cast<const sockaddr_in*>(one->ai_addr));
      ::freeaddrinfo(all);
    }
    promise->set_value(std::move(found));
  }).detach();
  while (answer.wait_for(look_again) != std::future_status::ready) {
    task.throw_if_cancelled();
    if (WatchClock::now() > end) return {};
  }
  return answer.get();
}

bool accepts(sockaddr_in address, int port, WatchClock::time_point end, const core::TaskContext& task) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) return false;
  const std::shared_ptr<void> closing(nullptr, [socket](void*) { ::close(socket); });
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return true;
  if (errno != EINPROGRESS) return false;
  while (WatchClock::now() < end) {
    task.throw_if_cancelled();
    pollfd one{socket, POLLOUT, 0};
    if (::poll(&one, 1, static_cast<int>(look_again.count())) <= 0) continue;
    int error = 0;
    socklen_t size = sizeof error;
    return ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0;
  }
  return false;
}

}  // namespace

SocketWatch::SocketWatch(core::TaskContext task) : task_(std::move(task)), thread_([this] { run(); }) {}

SocketWatch::~SocketWatch() {
  stop_ = true;
  thread_.join();
  for (const int socket : sockets_) ::close(socket);
}

void SocketWatch::add(int socket) {
  const std::lock_guard lock(mutex_);
  const int own = ::fcntl(socket, F_DUPFD_CLOEXEC, 0);
  if (own < 0) return;
  if (ended_) ::shutdown(own, SHUT_RDWR);
  sockets_.push_back(own);
}

int SocketWatch::last() {
  const std::lock_guard lock(mutex_);
  return sockets_.empty() ? -1 : sockets_.back();
}

void SocketWatch::release(int duplicate) {
  const std::lock_guard lock(mutex_);
  const auto at = std::find(sockets_.begin(), sockets_.end(), duplicate);
  if (at == sockets_.end()) return;
  ::close(duplicate);
  sockets_.erase(at);
}

void SocketWatch::shut_down() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  for (const int socket : sockets_) ::shutdown(socket, SHUT_RDWR);
}

void SocketWatch::run() {
  while (!stop_) {
    if (task_.cancelled() && !ended_) shut_down();
    std::this_thread::sleep_for(look_again);
  }
}

std::string reachable_address(const std::string& server, const std::string& host, int port,
                              std::chrono::milliseconds time, const core::TaskContext& task) {
  const auto end = WatchClock::now() + time;
  const std::vector<sockaddr_in> addresses = addresses_of(host, end, task);
  if (addresses.empty())
    throw NetworkError("the server '" + server + "': the host's name is not known to the network");
  for (const sockaddr_in& address : addresses) {
    if (!accepts(address, port, end, task)) continue;
    char text[INET_ADDRSTRLEN] = {};
    ::inet_ntop(AF_INET, &address.sin_addr, text, sizeof text);
    return text;
  }
  throw NetworkError("the server '" + server +
                     "' does not answer; is it running, and are host and port right?");
}

}  // namespace ostia::pacs
