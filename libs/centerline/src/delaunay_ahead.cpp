#include "ostia/centerline/delaunay.h"
#include "ostia/core/background_task.h"

#include <mutex>
#include <utility>

namespace ostia::centerline {

struct DelaunayAhead::Work {
  explicit Work(std::vector<geometry::Vec3> sites)
      : points(std::move(sites)),
        result([this](const core::TaskContext& task) { return delaunay(points, task); }) {}

  const std::vector<geometry::Vec3> points;
  std::mutex mutex;
  bool taken = false;
  core::BackgroundTask<Delaunay> result;  // the last: it begins when all else is there
};

DelaunayAhead::DelaunayAhead(std::vector<geometry::Vec3> points)
    : work_(std::make_unique<Work>(std::move(points))) {}
DelaunayAhead::~DelaunayAhead() = default;

std::optional<Delaunay> DelaunayAhead::take(const std::vector<geometry::Vec3>& points,
                                            const core::TaskContext& task) {
  if (points != work_->points) return std::nullopt;
  {
    const std::lock_guard lock(work_->mutex);
    if (std::exchange(work_->taken, true)) return std::nullopt;
  }
  return work_->result.get(task);
}

}  // namespace ostia::centerline
