#include "shell/jobs.h"

#include "shell/language.h"
#include "shell/library_texts.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>
#include <memory>

namespace ostia::workstation {
namespace {

constexpr int poll_ms = 50;
constexpr double estimate_from = 0.05;
constexpr qint64 estimate_from_ms = 2000;
constexpr qint64 shown_after_ms = 150;  // what is done by then needs no line
constexpr int bar_width = 220, bar_height = 14;
constexpr int spared_px = 1;  // of a button's frame: the status bar is to stay low

QString time_left(double progress, qint64 elapsed_ms) {
  const auto left = seconds_left(progress, elapsed_ms);
  if (!left) return {};
  return *left < 90.0 ? Jobs::tr("%1 s left").arg(std::ceil(*left), 0, 'f', 0)
                      : Jobs::tr("%1 min left").arg(*left / 60.0, 0, 'f', 0);
}

QToolButton* cross(QWidget* parent, const QString& tip, const QString& name) {
  auto* button = new QToolButton(parent);
  button->setText(QStringLiteral("\u2715"));
  button->setAutoRaise(true);
  button->setToolTip(tip);
  button->setAccessibleName(name);
  button->setFixedHeight(button->sizeHint().height() - spared_px);
  return button;
}

}  // namespace

std::optional<double> seconds_left(double progress, qint64 elapsed_ms) {
  if (progress < estimate_from || elapsed_ms < estimate_from_ms) return std::nullopt;
  return static_cast<double>(elapsed_ms) / 1000.0 * (1.0 - progress) / progress;
}

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
  take_away(kind);
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
  job->bar->setMaximumHeight(bar_height);
  job->bar->setMaximumWidth(bar_width);
  auto* stop = cross(job->line, tr("Cancel"), tr("Cancel %1").arg(title));
  stop->setObjectName("cancel." + kind);
  row->addWidget(job->label);
  row->addWidget(job->bar);
  row->addWidget(stop);
  connect(stop, &QToolButton::clicked, this, [this, kind] { cancel(kind); });
  lines_->addWidget(job->line);
  job->line->hide();
  const auto id = queue_.submit(kind.toStdString(), std::move(work));
  running_.emplace(id, std::move(job));
  timer_.start();
  emit changed();
}

int Jobs::line_height() const {
  const std::unique_ptr<QToolButton> one(cross(nullptr, {}, {}));
  return one->maximumHeight();
}

bool Jobs::running(const QString& kind) const {
  for (const auto& [id, job] : running_)
    if (job->kind == kind) return true;
  return false;
}

void Jobs::cancel(const QString& kind) {
  for (const auto& [id, job] : running_)
    if (job->kind == kind) queue_.forget(id);  // also where it is done and nobody has looked yet
}

void Jobs::take_away(const QString& kind) {
  const auto found = left_.find(kind);
  if (found == left_.end()) return;
  found->second->hide();
  found->second->deleteLater();
  left_.erase(found);
  if (left_.empty() && running_.empty()) hide();
}

void Jobs::leave(const QString& kind, const QString& text, const QString& tip, const QString& button,
                 std::function<void()> act) {
  take_away(kind);
  auto* line = new QWidget(this);
  line->setObjectName("left." + kind);
  auto* row = new QHBoxLayout(line);
  row->setContentsMargins(0, 0, 0, 0);
  auto* label = new QLabel(text, line);
  label->setToolTip(tip);
  auto* open = new QToolButton(line);
  open->setObjectName("left." + kind + ".act");
  open->setText(button);
  open->setMaximumHeight(line_height());
  auto* close = cross(line, tr("Close"), tr("Close %1").arg(text));
  connect(open, &QToolButton::clicked, this, std::move(act));
  connect(close, &QToolButton::clicked, this, [this, kind] { take_away(kind); });
  row->addWidget(label);
  row->addWidget(open);
  row->addWidget(close);
  lines_->addWidget(line);
  left_[kind] = line;
  show();
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
      if (auto result = queue_.take_any(id)) job->done(std::move(*result));
    } else {
      if (status && status->state == session::JobState::failed) job->failed(library_text(status->message));
      queue_.forget(id);
    }
    emit changed();
    at = running_.begin();  // what was told may have started or ended jobs
  }
  setVisible(line_shown || !left_.empty());
  if (running_.empty()) timer_.stop();
}

}  // namespace ostia::workstation
