#pragma once
/// \file Property models: a value with a domain that can be watched, without any toolkit. A window binds a
/// widget to each in one line. None of this is for several threads.

#include "ostia/core/error.h"
#include "ostia/session/signal.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace ostia::session {

/// low <= value <= high; with a step > 0, low plus a whole number of steps.
template <class T>
struct Range {
  T low{}, high{};
  T step{};
};

template <class T>
struct Choice {
  T value{};
  std::string name;  ///< as the interface shows it
};

/// A value, where it may lie, and who wants to know. T can be copied and compared.
template <class T>
class Property {
 public:
  using Choices = std::vector<Choice<T>>;
  using Domain = std::variant<std::monostate, Range<T>, Choices>;

  /// Throws InvalidInput for a domain without a place for any value, or a value that it refuses.
  explicit Property(T value = {}, Domain domain = {}) : state_(std::make_shared<State>()) {
    check(domain);
    state_->domain = std::move(domain);
    if (!fit(state_->domain, value)) throw InvalidInput("a property's first value is not in its domain");
    state_->value = std::move(value);
  }
  ~Property() { state_->gone = true; }
  Property(const Property&) = delete;
  Property& operator=(const Property&) = delete;

  const T& get() const { return state_->value; }
  const Domain& domain() const { return state_->domain; }
  const Range<T>* range() const { return std::get_if<Range<T>>(&state_->domain); }
  const Choices* choices() const { return std::get_if<Choices>(&state_->domain); }

  /// A range clamps the value and takes it to the nearest step; NaN and a value that is no choice are
  /// refused. Returns whether the value changed, and with it whether observers are told. An observer may set
  /// the property again: the round ends there, and all are told the newest value, each of them at the end and
  /// none an older one. Throws std::logic_error where observers do so without end.
  bool set(T value) {
    if (!fit(state_->domain, value) || value == state_->value) return false;
    state_->value = std::move(value);
    tell();
    return true;
  }
  /// A new domain. A value outside is clamped to a range or becomes the first choice. Observers of the domain
  /// are told first, then those of the value if it changed (the return). Throws as the constructor does.
  bool set_domain(Domain domain) {
    check(domain);
    const std::shared_ptr<State> state = state_;
    T value = state->value;
    if (!fit(domain, value)) value = first_of(domain);
    const bool changed = !(value == state->value);
    state->domain = std::move(domain);
    state->value = std::move(value);
    state->domain_changed.tell_while([&] { return !state->gone; });
    if (changed && !state->gone) tell();
    return changed;
  }

  Subscription observe(std::function<void(const T&)> observer) {
    return state_->changed.observe(std::move(observer));
  }
  Subscription observe_domain(std::function<void()> observer) {
    return state_->domain_changed.observe(std::move(observer));
  }

 private:
  struct State {
    T value{};
    Domain domain;
    Signal<const T&> changed;
    Signal<> domain_changed;
    bool telling = false, again = false, gone = false;
  };
  static constexpr bool kNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;
  static constexpr int kMostRounds = 100;

  void tell() {
    const std::shared_ptr<State> state = state_;  // an observer may take the property away
    state->again = true;
    if (state->telling) return;  // the round in progress begins anew
    state->telling = true;
    const std::shared_ptr<void> guard(nullptr, [&](void*) { state->telling = false; });
    for (int round = 0; state->again && !state->gone; ++round) {
      if (round == kMostRounds) throw std::logic_error("a property's observers set it without end");
      state->again = false;
      const T told = state->value;
      state->changed.tell_while([&] { return !state->again && !state->gone; }, told);
    }
  }

  static void check(const Domain& domain) {
    if (const auto* choices = std::get_if<Choices>(&domain); choices && choices->empty())
      throw InvalidInput("a property has no choices");
    if (const auto* range = std::get_if<Range<T>>(&domain)) {
      if constexpr (kNumber) {
        if (!(range->low <= range->high) || !(range->step >= T{}))
          throw InvalidInput("a property's range needs low <= high and a step >= 0");
      } else {
        throw InvalidInput("a property that is no number has no range");
      }
    }
  }
  /// Takes the value to its place in the domain; false where it has none.
  static bool fit(const Domain& domain, T& value) {
    if (const auto* choices = std::get_if<Choices>(&domain))
      return std::any_of(choices->begin(), choices->end(),
                         [&](const Choice<T>& choice) { return choice.value == value; });
    if constexpr (std::is_floating_point_v<T>)
      if (std::isnan(value)) return false;
    if constexpr (kNumber)
      if (const auto* range = std::get_if<Range<T>>(&domain)) value = placed(*range, value);
    return true;
  }
  static T placed(const Range<T>& range, T value) {
    value = std::clamp(value, range.low, range.high);
    if (!(range.step > T{})) return value;
    const auto low = static_cast<long double>(range.low), step = static_cast<long double>(range.step);
    // A hundredth of a step above `high` is still `high` reached by sums of rounded steps.
    const long double most = std::floor((static_cast<long double>(range.high) - low) / step + 0.01L);
    const long double steps = std::min(most, std::round((static_cast<long double>(value) - low) / step));
    return std::min(static_cast<T>(low + steps * step), range.high);
  }
  static T first_of(const Domain& domain) {
    if (const auto* choices = std::get_if<Choices>(&domain)) return choices->front().value;
    if (const auto* range = std::get_if<Range<T>>(&domain)) return range->low;
    return T{};
  }

  std::shared_ptr<State> state_;
};

}  // namespace ostia::session
