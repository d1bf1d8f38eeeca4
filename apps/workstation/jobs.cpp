#include "jobs.h"

#include "language.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

constexpr int poll_ms = 50;
constexpr double estimate_from = 0.03;  // before that share a time left would be a guess
constexpr qint64 shown_after_ms = 150;  // what is done by then needs no line

QString time_left(double progress, qint64 elapsed_ms) {
  if (progress < estimate_from) return {};
  const double left_s = static_cast<double>(elapsed_ms) / 1000.0 * (1.0 - progress) / progress;
  return left_s < 90.0 ? Jobs::tr("%1 s left").arg(left_s, 0, 'f', 0)
                       : Jobs::tr("%1 min left").arg(left_s / 60.0, 0, 'f', 0);
}

}  // namespace

struct Jobs::Job {
  QString kind, title;
  Done done;
  Failed failed;
  QElapsedTimer clock;
  QWidget* line = nullptr;
  QLabel* label = nullptr;
  QProgressBar* bar = nullptr;
  ~Job() {
    if (line) line->deleteLater();
  }
};

Jobs::Jobs(QWidget* parent) : QWidget(parent), lines_(new QVBoxLayout(this)) {
  setObjectName("jobs");
  lines_->setContentsMargins(4, 0, 4, 0);
  lines_->setSpacing(2);
  timer_.setInterval(poll_ms);
  connect(&timer_, &QTimer::timeout, this, &Jobs::poll);
  hide();
}

void Jobs::run(const QString& kind, const QString& title, Work work, Done done, Failed failed) {
  cancel(kind);
  auto job = std::make_shared<Job>();
  job->kind = kind;
  job->title = title;
  job->done = std::move(done);
  job->failed = std::move(failed);
  job->clock.start();
  job->line = new QWidget(this);
  auto* row = new QHBoxLayout(job->line);
  row->setContentsMargins(0, 0, 0, 0);
  job->label = new QLabel(title, job->line);
  job->bar = new QProgressBar(job->line);
  job->bar->setRange(0, 1000);
  job->bar->setMaximumHeight(14);
  job->bar->setMaximumWidth(220);
  auto* cross = new QToolButton(job->line);
  cross->setText(QStringLiteral("\u2715"));
  cross->setAutoRaise(true);
  cross->setToolTip(tr("Cancel"));
  cross->setAccessibleName(tr("Cancel %1").arg(title));
  row->addWidget(job->label);
  row->addWidget(job->bar);
  row->addWidget(cross);
  connect(cross, &QToolButton::clicked, this, [this, kind] { cancel(kind); });
  lines_->addWidget(job->line);
  job->line->hide();
  // The queue hands a model to its work; what runs here has what it needs with it.
  static const auto no_model = std::make_shared<const lumen::LumenModel>();
  const auto id =
      queue_.submit(kind.toStdString(), no_model,
                    [work = std::move(work)](const lumen::LumenModel&, const core::TaskContext& task) {
                      return std::any(std::make_shared<std::any>(work(task)));
                    });
  running_.emplace(id, std::move(job));
  timer_.start();
  emit changed();
}

bool Jobs::running(const QString& kind) const {
  for (const auto& [id, job] : running_)
    if (job->kind == kind) return true;
  return false;
}

void Jobs::cancel(const QString& kind) {
  for (const auto& [id, job] : running_)
    if (job->kind == kind) queue_.cancel(id);
}

void Jobs::poll() {
  bool line_shown = false;
  for (auto at = running_.begin(); at != running_.end();) {
    const auto id = at->first;
    const std::shared_ptr<Job> job = at->second;
    const std::optional<session::JobStatus> status = queue_.status(id);
    if (status && !status->finished()) {
      if (job->clock.elapsed() > shown_after_ms) {
        job->bar->setValue(static_cast<int>(1000.0 * status->progress));
        const QString stage = stage_word(status->stage);
        const QString left = time_left(status->progress, job->clock.elapsed());
        job->label->setText(job->title + (stage.isEmpty() ? QString() : ": " + stage) +
                            (left.isEmpty() ? QString() : ", " + left));
        job->line->show();
        line_shown = true;
      }
      ++at;
      continue;
    }
    at = running_.erase(at);
    if (status && status->state == session::JobState::done) {
      if (const auto result = queue_.take<std::shared_ptr<std::any>>(id)) job->done(std::move(**result));
    } else {
      if (status && status->state == session::JobState::failed)
        job->failed(QString::fromStdString(status->message));
      queue_.forget(id);
    }
    emit changed();
    at = running_.begin();  // what was told may have started or ended jobs
  }
  setVisible(line_shown);
  if (running_.empty()) timer_.stop();
}

}  // namespace ostia::workstation
