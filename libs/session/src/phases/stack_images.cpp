// Which images of a stack are held in memory.
#include "ostia/core/error.h"
#include "ostia/session/series_stack.h"

#include <unistd.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace ostia::session {
namespace {

std::size_t bytes_held(const StackImages::Image& image) {
  return image ? image->voxels.size() * sizeof(std::int16_t) : 0;
}

}  // namespace

std::size_t StackImages::usual_budget() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0) return default_budget;
  return std::min(default_budget, static_cast<std::size_t>(pages) * static_cast<std::size_t>(page) / 4);
}

StackImages::StackImages(const std::vector<std::size_t>& bytes, std::size_t budget)
    : whole_(bytes.size()),
      frame_(bytes.size()),
      last_(bytes.size(), 0),
      budget_(budget),
      needed_(std::accumulate(bytes.begin(), bytes.end(), std::size_t{0})) {}

void StackImages::learn(const Image& image) {
  if (needed_ == 0) needed_ = whole_.size() * bytes_held(image);
}

std::int64_t StackImages::frame_voxels() const {
  if (all_fit() || whole_.empty()) return std::numeric_limits<std::int64_t>::max();
  return std::max<std::int64_t>(
      8, static_cast<std::int64_t>(budget_ / 2 / whole_.size() / sizeof(std::int16_t)));
}

StackImages::Image StackImages::frame(std::size_t n) const {
  return whole_.at(n) ? whole_[n] : frame_[n];
}

void StackImages::take(std::size_t n, Image image) {
  if (!image) throw InvalidInput("there is no image to hold");
  learn(image);
  whole_.at(n) = std::move(image);
  shown(n);
  make_room(n);
}

void StackImages::take_frame(std::size_t n, Image image) {
  if (!image) throw InvalidInput("there is no image to hold");
  learn(image);
  const bool coarse = static_cast<std::int64_t>(image->voxels.size()) <= frame_voxels();
  if (!all_fit() && coarse) {
    frame_.at(n) = std::move(image);
    return;
  }
  whole_.at(n) = std::move(image);
  make_room(n);
}

void StackImages::shown(std::size_t n) {
  last_.at(n) = ++clock_;
}

/// Where the cine has coarser ones of its own, these have one half and whole ones the other.
void StackImages::make_room(std::size_t keep) {
  const std::size_t most = all_fit() ? budget_ : budget_ / 2;
  const auto used = [&] {
    return std::accumulate(whole_.begin(), whole_.end(), std::size_t{0},
                           [](std::size_t sum, const Image& one) { return sum + bytes_held(one); });
  };
  while (used() > most) {
    std::size_t oldest = whole_.size();
    for (std::size_t n = 0; n < whole_.size(); ++n)
      if (whole_[n] && n != keep && (oldest == whole_.size() || last_[n] < last_[oldest])) oldest = n;
    if (oldest == whole_.size()) return;
    whole_[oldest] = {};
  }
}

std::size_t StackImages::held() const {
  std::size_t sum = 0;
  for (std::size_t n = 0; n < whole_.size(); ++n) sum += bytes_held(whole_[n]) + bytes_held(frame_[n]);
  return sum;
}

}  // namespace ostia::session
