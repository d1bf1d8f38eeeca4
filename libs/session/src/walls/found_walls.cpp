#include "ostia/session/found_walls.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace ostia::session {
namespace {

constexpr std::chrono::milliseconds look_again_after{20};  // whether who waits was cancelled

/// Also where both are gone by now: a weak pointer knows its own.
template <class T>
bool is_same(const std::weak_ptr<const T>& a, const std::shared_ptr<const T>& b) {
  return !a.owner_before(b) && !b.owner_before(a);
}

}  // namespace

struct FoundWalls::Entry {
  std::weak_ptr<const lumen::LumenModel> model;
  std::weak_ptr<const imaging::ImageVolume> image;
  std::int32_t vessel = 0;
  enum class State { open, sought, known } state = State::open;
  std::shared_ptr<const VesselWalls> walls;

  bool is_with(const WallsWanted& wanted) const {
    return is_same(model, wanted.model) && is_same(image, wanted.image);
  }
};

std::shared_ptr<FoundWalls::Entry> FoundWalls::entry(const WallsWanted& wanted) {
  std::erase_if(entries_,
                [&](const auto& one) { return one->state != Entry::State::sought && !one->is_with(wanted); });
  for (const auto& one : entries_)
    if (one->vessel == wanted.vessel && one->is_with(wanted)) return one;
  auto made = std::make_shared<Entry>();
  made->model = wanted.model;
  made->image = wanted.image;
  made->vessel = wanted.vessel;
  entries_.push_back(made);
  return made;
}

std::shared_ptr<const VesselWalls> FoundWalls::of(const WallsWanted& wanted, const core::TaskContext& task) {
  std::unique_lock lock(mutex_);
  const std::shared_ptr<Entry> one = entry(wanted);
  while (one->state == Entry::State::sought) {
    settled_.wait_for(lock, look_again_after);
    task.throw_if_cancelled();
  }
  if (one->state == Entry::State::known) return one->walls;
  one->state = Entry::State::sought;
  ++searches_;
  lock.unlock();
  const auto settle = [&](Entry::State state) {
    lock.lock();
    one->state = state;
    lock.unlock();
    settled_.notify_all();
  };
  try {
    auto found = vessel_walls(
        *wanted.model, [&](std::int32_t id) { return wanted.walls.at(id); }, wanted.vessel, *wanted.image, {},
        task);
    if (found) one->walls = std::make_shared<const VesselWalls>(std::move(*found));
  } catch (...) {
    settle(Entry::State::open);
    throw;
  }
  settle(Entry::State::known);
  return one->walls;
}

int FoundWalls::searches() const {
  const std::lock_guard lock(mutex_);
  return searches_;
}

}  // namespace ostia::session
