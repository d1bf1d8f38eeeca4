#include "part_names.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <mutex>
#include <set>

namespace ostia::core {
namespace {

constexpr std::string_view part_prefix = ".part-";

struct NumbersInWork {
  std::mutex mutex;
  unsigned next = 0;
  std::set<unsigned> numbers;
};

NumbersInWork& numbers_in_work() {
  static NumbersInWork instance;
  return instance;
}

struct PartName {
  pid_t process = 0;
  unsigned number = 0;
  std::string target;
};

/// Takes a number and the dash behind it off `rest`.
template <class Number>
bool take_number(std::string_view& rest, Number& number) {
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error != std::errc() || end == rest.data() + rest.size() || *end != '-') return false;
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()) + 1);
  return true;
}

std::optional<PartName> parsed(std::string_view name) {
  if (!name.starts_with(part_prefix)) return std::nullopt;
  name.remove_prefix(part_prefix.size());
  PartName part;
  if (!take_number(name, part.process) || !take_number(name, part.number)) return std::nullopt;
  if (part.process <= 0 || name.empty()) return std::nullopt;
  part.target = name;
  return part;
}

bool in_work(unsigned number) {
  NumbersInWork& all = numbers_in_work();
  const std::lock_guard lock(all.mutex);
  return all.numbers.count(number) != 0;
}

}  // namespace

PartNumber::PartNumber() {
  NumbersInWork& all = numbers_in_work();
  const std::lock_guard lock(all.mutex);
  number_ = all.next++;
  all.numbers.insert(number_);
}

PartNumber::~PartNumber() {
  NumbersInWork& all = numbers_in_work();
  const std::lock_guard lock(all.mutex);
  all.numbers.erase(number_);
}

std::string shortened(const std::string& target) {
  constexpr std::size_t longest = 180;
  return target.size() > longest ? target.substr(target.size() - longest) : target;
}

std::string PartNumber::name(const std::string& target) const {
  return std::string(part_prefix) + std::to_string(::getpid()) + "-" + std::to_string(number_) + "-" +
         shortened(target);
}

bool of_dead_process(const std::string& name) {
  const std::optional<PartName> part = parsed(name);
  if (!part) return false;
  if (part->process == ::getpid()) return !in_work(part->number);
  return ::kill(part->process, 0) != 0 && errno == ESRCH;
}

std::string target_in(const std::string& part_name) {
  const std::optional<PartName> part = parsed(part_name);
  return part ? part->target : std::string();
}

}  // namespace ostia::core
