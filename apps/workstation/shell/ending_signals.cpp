#include "shell/ending_signals.h"

#include "ostia/core/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>

namespace ostia::workstation {
namespace {

std::atomic<int> told_at{-1};

extern "C" void tell(int) {
  const int kept = errno;
  const char one = 1;
  // A full pipe has told it already.
  [[maybe_unused]] const auto written = ::write(told_at.load(), &one, 1);
  errno = kept;
}

constexpr std::array<int, 3> ending{SIGTERM, SIGINT, SIGHUP};

}  // namespace

EndingSignals::EndingSignals(QObject* parent) : QObject(parent) {
  if (told_at.load() >= 0 || ::pipe2(pipe_.data(), O_CLOEXEC | O_NONBLOCK) != 0)
    throw IoError("signals that end the program cannot be heard");
  told_at.store(pipe_[1]);
  notifier_ = new QSocketNotifier(pipe_[0], QSocketNotifier::Read, this);
  connect(notifier_, &QSocketNotifier::activated, this, [this] {
    std::array<char, 16> said{};
    while (::read(pipe_[0], said.data(), said.size()) > 0) {
    }
    emit asked();
  });
  for (const int one : ending) std::signal(one, tell);
}

EndingSignals::~EndingSignals() {
  for (const int one : ending) std::signal(one, SIG_DFL);
  told_at.store(-1);
  delete notifier_;
  ::close(pipe_[0]);
  ::close(pipe_[1]);
}

}  // namespace ostia::workstation
