#pragma once
// What ends a connection that blocks, when its task is cancelled.

#include "ostia/core/task_context.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace ostia::pacs {

/// Looks every 50 ms whether the task is cancelled; then all sockets that it was given are shut down, so that
/// whoever reads or writes there returns with an error. Safe from several threads.
class SocketWatch {
 public:
  explicit SocketWatch(core::TaskContext task);
  ~SocketWatch();
  SocketWatch(const SocketWatch&) = delete;
  SocketWatch& operator=(const SocketWatch&) = delete;

  /// Keeps a duplicate of the descriptor, so that a number that is used again harms nobody.
  void add(int socket);
  /// The duplicate that was made last; -1: none.
  int last();
  /// Lets a duplicate go, so that the connection can end.
  void release(int duplicate);
  /// Ends all connections now and those to come at once.
  void shut_down();

 private:
  void run();
  const core::TaskContext task_;
  std::mutex mutex_;
  std::vector<int> sockets_;
  std::atomic<bool> stop_{false}, ended_{false};
  std::thread thread_;
};

/// The numeric address of a host that accepts a connection at the port within the time. Throws NetworkError
/// naming `server`, and Cancelled, also while a name is looked up.
std::string reachable_address(const std::string& server, const std::string& host, int port,
                              std::chrono::milliseconds time, const core::TaskContext& task);

}  // namespace ostia::pacs
