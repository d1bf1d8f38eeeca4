#include "phases/loader.h"

#include <QString>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int loader_poll_ms = 30;

}  // namespace

PhaseLoader::PhaseLoader(QObject* parent) : QObject(parent) {
  timer_.setInterval(loader_poll_ms);
  connect(&timer_, &QTimer::timeout, this, &PhaseLoader::poll);
}

void PhaseLoader::set(std::vector<session::PhaseSource> sources, double own_phase) {
  clear();
  images_.emplace(std::move(sources));
  own_phase_ = phase_ = own_phase;
  read_next();
}

void PhaseLoader::clear() {
  if (job_) queue_.forget(*job_);
  job_.reset();
  timer_.stop();
  images_.reset();
}

std::shared_ptr<const session::PhaseImage> PhaseLoader::image_for(double phase) {
  if (!images_) return nullptr;
  phase_ = phase;
  read_next();
  std::shared_ptr<const session::PhaseImage> best;
  double nearest = session::phase_distance(own_phase_, phase);
  for (std::size_t i = 0; i < images_->sources().size(); ++i) {
    const double away = session::phase_distance(images_->sources()[i].phase, phase);
    if (!images_->held(i) || away >= nearest) continue;
    nearest = away;
    best = images_->held(i);
  }
  return best;
}

void PhaseLoader::read_next() {
  if (job_ || !images_) return;
  const std::optional<std::size_t> wanted = images_->wanted(phase_);
  if (!wanted) return;
  job_source_ = *wanted;
  job_ = queue_.submit("phase", [source = images_->sources()[*wanted]](const core::TaskContext& task) {
    return std::any(session::read_phase_image(source, task));
  });
  timer_.start();
}

void PhaseLoader::poll() {
  const auto status = job_ ? queue_.status(*job_) : std::nullopt;
  if (status && !status->finished()) return;
  timer_.stop();
  const auto job = std::exchange(job_, std::nullopt);
  if (!job || !status || !images_) return;
  const double phase = images_->sources()[job_source_].phase;
  if (status->state == session::JobState::done) {
    if (auto image = queue_.take<session::PhaseImage>(*job))
      images_->take(job_source_, std::move(*image), phase_);
    emit arrived();
  } else {
    queue_.forget(*job);
    images_->failed(job_source_);
    emit failed(tr("The image of %1 cannot be read: %2")
                    .arg(QString::fromStdString(session::percent_of_cycle(phase)),
                         QString::fromStdString(status->message)));
  }
  read_next();
}

}  // namespace ostia::workstation
