#pragma once
/// \file The images of the phases, read beside the window as they are looked at.

#include "ostia/session/phase_images.h"
#include "ostia/session/worker_queue.h"

#include <QObject>
#include <QTimer>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::workstation {

/// Reads one image at a time, the nearest to the phase that is shown first, and holds as many as
/// session::PhaseImages says. The window never waits: until the nearest has come, the nearest of those that
/// are there is shown.
class PhaseLoader final : public QObject {
  Q_OBJECT
 public:
  explicit PhaseLoader(QObject* parent = nullptr);
  void set(std::vector<session::PhaseSource> sources, double own_phase);
  void clear();
  bool any() const { return images_.has_value(); }
  std::size_t count() const { return images_ ? images_->sources().size() : 0; }
  bool reading() const { return job_.has_value(); }
  /// The nearest image that is there, and begins to read what is wanted. Null: the case's own is nearer, or
  /// there is none.
  std::shared_ptr<const session::PhaseImage> image_for(double phase);

 signals:
  void arrived();  ///< another image is there
  void failed(const QString& message);

 private:
  void read_next();
  void poll();
  session::WorkerQueue queue_{1};
  std::optional<session::PhaseImages> images_;
  double own_phase_ = 0.0, phase_ = 0.0;
  std::optional<session::WorkerQueue::JobId> job_;
  std::size_t job_source_ = 0;
  QTimer timer_;
};

}  // namespace ostia::workstation
