#pragma once
/// \file The page of a cohort on this machine's loopback, where it writes reviews itself.

#include "ostia/core/task_context.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace ostia::cohort {

/// A small HTTP/1.1 server (RFC 9112) on 127.0.0.1. Its address has a random key of 256 bits in it: another
/// page in the same browser, or another user of the machine, does not know it and gets nothing. It hands out
/// the page with its data, pictures, reports and cases of the cohort, no other file, and takes reviews.
class PageServer {
 public:
  /// Port 0: any that is free. Throws InvalidInput (no cohort, or one without a page), ResourceError where
  /// the port is taken.
  explicit PageServer(std::filesystem::path cohort, std::uint16_t port = 0);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  /// http://127.0.0.1:PORT/KEY/page/index.html
  std::string url() const;
  /// Serves until the task is cancelled, and returns then.
  void run(const core::TaskContext& task);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ostia::cohort
