// Phases one after the other: of the images alone, or of the motion that carries the tree.
#include "phases/beating_case.h"
#include "phases/series_strip.h"
#include "phases/study_series.h"
#include "shell/desk.h"
#include "views/paint_queue.h"

#include "ostia/imaging/reduced_volume.h"

#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

using session::StackImages;

/// Whole where it may be, else of fewer voxels.
std::any read_frame(const session::PhaseSource& source, std::int64_t most_voxels,
                    const core::TaskContext& task) {
  StackImages::Image image = session::read_phase_image(source, task.sub(0.0, 0.9)).volume;
  if (image->geometry.voxels() > most_voxels) {
    imaging::ReducedVolumeOptions options;
    options.most_voxels = most_voxels;
    image = std::make_shared<const imaging::ImageVolume>(
        imaging::reduced_volume(*image, options, task.sub(0.9, 1.0)));
  }
  return {image};
}

}  // namespace

StackImages::Image StudySeries::image_of(int n) const {
  return n == own() ? desk_.bench.image().volume : images_.frame(static_cast<std::size_t>(n));
}

void StudySeries::toggle_cine() {
  if (playing_) {
    stop();
    if (shown_ != own() && shown_ >= 0) go_to(shown_);  // the whole image of what it stopped at
    return;
  }
  if (beating_.shown()) return beating_.toggle();
  if (!has_cine()) return;
  playing_ = true;
  strip_->set_playing(true);
  if (!images_.all_fit() && !bound_told_) {
    bound_told_ = true;
    const auto gigabytes = [](std::size_t bytes) {
      return QString::number(static_cast<double>(bytes) / (std::size_t{1} << 30U), 'f', 1);
    };
    desk_.messages.say(
        tr("All phases together need %1 GB, more than the %2 GB that they may take: while they play "
           "they are shown more coarsely.")
            .arg(gigabytes(images_.needed()), gigabytes(images_.budget())));
  }
  load_frames();
  since_frame_.start();
  frame_.start(0);
}

void StudySeries::stop() {
  frame_.stop();
  if (!playing_) return;
  playing_ = false;
  strip_->set_playing(false);
}

/// The next of those that are there; when all views have been painted, so that they show the same.
void StudySeries::next_frame() {
  if (!playing_) return;
  const auto at = std::find(cine_.begin(), cine_.end(), shown_);
  const std::size_t from =
      at == cine_.end() ? cine_.size() - 1 : static_cast<std::size_t>(at - cine_.begin());
  for (std::size_t step = 1; step < cine_.size(); ++step) {
    const int n = cine_[(from + step) % cine_.size()];
    const StackImages::Image image = image_of(n);
    if (!image) continue;
    if (n == own())
      desk_.bench.show_other_image(nullptr);
    else
      put(n, image);
    break;
  }
  if (!playing_) return;
  const int every_ms = static_cast<int>(std::lround(1000.0 / strip_->pictures_a_second()));
  PaintQueue::instance().add_last(this, [this, every_ms] {
    if (!playing_) return;
    frame_.start(static_cast<int>(std::max<qint64>(1, every_ms - since_frame_.elapsed())));
    since_frame_.restart();
  });
}

/// One after the other; the line of the job says how far it is, and its cross ends it.
void StudySeries::load_frames() {
  int missing = -1, there = 0;
  for (const int n : cine_) {
    if (image_of(n))
      ++there;
    else if (missing < 0)
      missing = n;
  }
  loading_ = missing >= 0;
  if (!loading_) return;
  desk_.jobs.run(
      "series_cine", tr("Reading the phases, %1 of %2").arg(there + 1).arg(static_cast<int>(cine_.size())),
      [source = entry(missing).source, most = images_.frame_voxels()](const core::TaskContext& task) {
        return read_frame(source, most, task);
      },
      [this, missing](const std::any& result) {
        images_.take_frame(static_cast<std::size_t>(missing),
                           std::any_cast<const StackImages::Image&>(result));
        load_frames();
      },
      [this, missing](const QString& why) {
        fail(missing, why);
        load_frames();
      });
}

/// The motion shows the phases of its own cycle: it is given the images, which it reads as it needs them.
void StudySeries::give_images() {
  if (!beating_.shown()) {
    if (desk_.bench.other_image()) return;
    shown_ = wanted_ = own();
    strip_->set_current(shown_);
    strip_->set_away(false);
    return;
  }
  stop();
  desk_.jobs.cancel("series_image");
  desk_.jobs.cancel("series_cine");
  desk_.bench.show_other_image(nullptr);
  if (has_cine() && !beating_.images().any()) {
    std::vector<session::PhaseSource> sources;
    for (const int n : cine_) sources.push_back(entry(n).source);
    for (std::size_t n = 0; n < images_.count(); ++n) images_.forget(n);
    beating_.take_images(std::move(sources));
  }
  follow_motion();
}

void StudySeries::follow_motion() {
  if (!beating_.shown() || cine_.empty()) return;
  const double phase = beating_.clock().phase();
  const int nearest = *std::min_element(cine_.begin(), cine_.end(), [&](int a, int b) {
    return session::phase_distance(entry(a).source.phase, phase) <
           session::phase_distance(entry(b).source.phase, phase);
  });
  shown_ = wanted_ = nearest;
  strip_->set_current(nearest);
  strip_->set_away(nearest != own());
}

}  // namespace ostia::workstation
