#include "ostia/session/active_time.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <chrono>

namespace ostia::session {

ActiveTime::ActiveTime(double idle_s, Clock clock) : idle_s_(idle_s), clock_(std::move(clock)) {
  if (!(idle_s > 0.0)) throw InvalidInput("the time after which a person is idle must be positive");
}

double ActiveTime::now() const {
  if (clock_) return clock_();
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double ActiveTime::open_s() const {
  return running_ ? std::clamp(now() - last_s_, 0.0, idle_s_) : 0.0;
}

void ActiveTime::start() {
  if (running_) return;
  running_ = true;
  last_s_ = now();
}
void ActiveTime::pause() {
  counted_s_ += open_s();
  running_ = false;
}
void ActiveTime::reset() {
  counted_s_ = 0.0;
  last_s_ = now();
}
void ActiveTime::touch() {
  if (!running_) return;
  counted_s_ += open_s();
  last_s_ = now();
}
double ActiveTime::seconds() const {
  return counted_s_ + open_s();
}
bool ActiveTime::idle() const {
  return running_ && now() - last_s_ > idle_s_;
}

}  // namespace ostia::session
