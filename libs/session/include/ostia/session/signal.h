#pragma once
/// \file Who is told when something changes. None of this is for several threads.

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace ostia::session {

/// Ends an observation when it goes. May be dropped at any time, by the observer itself too, and may outlive
/// what it observes.
class [[nodiscard]] Subscription {
 public:
  Subscription() = default;
  explicit Subscription(std::shared_ptr<void> hold) : hold_(std::move(hold)) {}
  void drop() { hold_.reset(); }
  bool active() const { return hold_ != nullptr; }

 private:
  std::shared_ptr<void> hold_;
};

/// Tells observers, in the order in which they came. One that comes while they are told is told the next
/// time, one that was dropped meanwhile is not; the signal itself may go meanwhile. What an observer throws
/// ends the round and reaches the teller.
template <class... Args>
class Signal {
 public:
  using Observer = std::function<void(Args...)>;
  Signal() = default;
  Signal(const Signal&) = delete;
  Signal& operator=(const Signal&) = delete;

  Subscription observe(Observer observer) {
    auto held = std::make_shared<Observer>(std::move(observer));
    std::erase_if(observers_, [](const auto& one) { return one.expired(); });
    observers_.push_back(held);
    return Subscription(std::move(held));
  }
  /// `going_on` is asked before each observer.
  template <class GoingOn>
  void tell_while(const GoingOn& going_on, Args... args) const {
    const std::vector<std::weak_ptr<Observer>> round = observers_;
    for (const std::weak_ptr<Observer>& one : round) {
      if (!going_on()) return;
      if (const std::shared_ptr<Observer> held = one.lock()) (*held)(args...);
    }
  }
  void tell(Args... args) const {
    tell_while([] { return true; }, args...);
  }

 private:
  std::vector<std::weak_ptr<Observer>> observers_;
};

}  // namespace ostia::session
