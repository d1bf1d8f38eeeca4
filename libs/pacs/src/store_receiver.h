#pragma once
// Our own storage server, which is there as long as a C-MOVE goes on.

#include "socket_watch.h"

#include "ostia/core/task_context.h"
#include "ostia/pacs/server.h"

#include <atomic>
#include <cstddef>
#include <list>
#include <thread>

struct T_ASC_Association;
struct T_ASC_Network;

namespace ostia::pacs {

class Intake;

/// Listens at `receive_port` and puts what is stored there into the intake, which takes nothing but the
/// series that is fetched. At most `receive_associations` at a time; others are told to come again.
class StoreReceiver {
 public:
  /// Throws IoError where the port is taken, InvalidInput for certificates.
  StoreReceiver(const ServerDescription& server, const Secrets& secrets, Intake& intake,
                const core::TaskContext& task);
  ~StoreReceiver();
  StoreReceiver(const StoreReceiver&) = delete;
  StoreReceiver& operator=(const StoreReceiver&) = delete;
  /// Grows with whatever comes: objects and connections.
  std::size_t signs() const { return signs_; }

 private:
  struct Peer {
    std::thread thread;
    std::atomic<bool> done{false};
  };
  void run();
  void welcome(T_ASC_Association* association, int socket);
  void serve(T_ASC_Association* association);
  bool answer_commands(T_ASC_Association* association);
  void join_done(bool all);
  int timeout() const;

  const ServerDescription& server_;
  Intake& intake_;
  SocketWatch watch_;
  T_ASC_Network* network_ = nullptr;
  std::atomic<bool> stop_{false};
  std::atomic<std::size_t> signs_{0};
  std::list<Peer> peers_;  // of the listening thread, then of the destructor
  std::thread listener_;
};

}  // namespace ostia::pacs
