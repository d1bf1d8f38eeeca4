#include "phases/study_series.h"

#include "phases/beating_case.h"
#include "phases/series_strip.h"
#include "shell/desk.h"
#include "shell/docks.h"

#include <QAction>
#include <QMainWindow>
#include <algorithm>

namespace ostia::workstation {
namespace {

constexpr const char* strip_setting = "series.strip";

bool same_stacks(const session::SeriesStack& a, const session::SeriesStack& b) {
  return std::equal(a.entries.begin(), a.entries.end(), b.entries.begin(), b.entries.end(),
                    [](const session::StackEntry& x, const session::StackEntry& y) {
                      const auto &one = x.source.series, &other = y.source.series;
                      if (!one || !other) return !one && !other && x.source.file == y.source.file;
                      return one->uid == other->uid && one->files == other->files;
                    });
}

}  // namespace

StudySeries::StudySeries(Desk& desk, QMainWindow& window, BeatingCase& beating)
    : QObject(&window), desk_(desk), window_(window), beating_(beating), strip_(new SeriesStrip(&window)) {
  window.addDockWidget(Qt::BottomDockWidgetArea, strip_);
  strip_->setFeatures(QDockWidget::DockWidgetMovable | QDockWidget::DockWidgetFloatable);
  strip_->toggleViewAction()->setVisible(false);  // it comes and goes with the study
  strip_->hide();
  connect(strip_, &SeriesStrip::chosen, this, &StudySeries::chosen);
  connect(strip_, &SeriesStrip::pressed, this, [this](int n) {
    if (playing_) chosen(n);  // that of the picture just shown: none other is chosen
  });
  connect(strip_, &SeriesStrip::open_wanted, this, &StudySeries::open);
  connect(strip_, &SeriesStrip::play_wanted, this, &StudySeries::toggle_cine);
  connect(strip_, &SeriesStrip::best_wanted, this, &StudySeries::best_pressed);
  connect(strip_, &SeriesStrip::back_wanted, this, &StudySeries::go_to_own);
  connect(&desk.jobs, &Jobs::changed, this, &StudySeries::on_jobs);
  connect(&beating, &BeatingCase::shown_changed, this, &StudySeries::give_images);
  frame_.setSingleShot(true);
  connect(&frame_, &QTimer::timeout, this, &StudySeries::next_frame);
  session::Workbench& bench = desk.bench;
  own_.push_back(bench.image_changed.observe([this] {
    desk_.jobs.cancel("series_folder");  // it was chosen for the former image
    put_away();                          // until it is known what lies beside the new one
    if (!desk_.bench.image().volume) clear();
  }));
  own_.push_back(bench.other_image_changed.observe([this] {
    if (desk_.bench.other_image()) return;
    shown_ = wanted_ = own();
    strip_->set_current(shown_);
    strip_->set_away(false);
  }));
  own_.push_back(bench.phase_refused.observe([this] {
    if (!desk_.bench.other_image()) return;
    stop();
    strip_->offer_way_back();
  }));
  own_.push_back(beating.clock().percent.observe([this](const double&) { follow_motion(); }));
}

StudySeries::~StudySeries() = default;

void StudySeries::take(const std::shared_ptr<const imaging::DicomFolder>& folder, const std::string& uid,
                       const std::filesystem::path& path) {
  session::SeriesStack stack;
  if (!desk_.messages.guarded([&] { stack = session::stack_beside(*folder, uid); })) return clear();
  folder_ = folder;
  uid_ = uid;
  for (const imaging::DicomSeries& one : folder->series)
    if (!path.empty() && !one.files.empty()) found_in_.try_emplace(one.files.front(), path);
  start(std::move(stack));
}

void StudySeries::start(session::SeriesStack stack) {
  stop();
  desk_.bench.show_other_image(nullptr);
  for (const char* job : {"series_image", "series_cine", "best_phase"}) desk_.jobs.cancel(job);
  const bool same = same_stacks(stack_, stack);
  stack_ = std::move(stack);
  if (!same) {
    std::vector<std::size_t> bytes;
    for (const session::StackEntry& one : stack_.entries) bytes.push_back(one.bytes);
    images_ = session::StackImages(std::move(bytes), budget_);
    faults_.assign(stack_.entries.size(), {});
    bound_told_ = false;
  }
  if (!same) choice_.reset();
  cine_.clear();
  for (const std::size_t n : session::cine_of(stack_))
    if (faults_[n].isEmpty()) cine_.push_back(static_cast<int>(n));
  if (own() >= 0) images_.forget(*stack_.own);
  shown_ = wanted_ = own();
  if (!same) {
    std::vector<StripRow> rows;
    for (int n = 0; n < static_cast<int>(stack_.entries.size()); ++n) rows.push_back(row_of(n));
    strip_->set_rows(rows);
    next_picture(0);
  }
  refresh_rows();
  strip_->set_cine(cine_);
  strip_->set_current(shown_);
  strip_->set_away(false);
  strip_->setWindowTitle(
      stack_.of_others == 0 ? tr("Series of the study")
                            : tr("Series of the study \u2013 %n series of other patients or studies left out",
                                 nullptr, static_cast<int>(stack_.of_others)));
  tell_best();
  // By itself only where it is soon done; else by its button.
  best_pending_ = !choice_ && has_cine() && images_.all_fit();
  if (any() && desk_.machine.setting(strip_setting).value_or("on") != "off") {
    strip_->show();
    size_at_first(window_, *strip_, strip_->wanted_height(), Qt::Vertical);
  }
  give_images();
  emit changed();
}

void StudySeries::clear() {
  if (stack_.entries.empty()) return;
  start({});
  folder_.reset();
  uid_.clear();
  found_in_.clear();
  desk_.jobs.cancel("series_pictures");
  put_away();
}

void StudySeries::put_away() {
  strip_->hide();
}

void StudySeries::show_or_hide() {
  const bool shown = strip_->isHidden() && any();
  strip_->setVisible(shown);
  if (shown) size_at_first(window_, *strip_, strip_->wanted_height(), Qt::Vertical);
  desk_.machine.set_setting(strip_setting, shown ? "on" : "off");
}

void StudySeries::set_budget(std::size_t bytes) {
  budget_ = bytes;
  session::SeriesStack stack = std::move(stack_);
  stack_ = {};
  start(std::move(stack));
}

/// The line of a job has a cross: what was cancelled is not shown, and not loaded.
void StudySeries::on_jobs() {
  if (wanted_ != shown_ && !desk_.jobs.running("series_image")) {
    wanted_ = shown_;
    strip_->set_current(shown_);
  }
  if (loading_ && !desk_.jobs.running("series_cine")) loading_ = false;
  if (!desk_.jobs.running("best_phase")) tell_best();
  // When the search for vessels and all else has ended: it has the processors first.
  if (best_pending_ && !desk_.jobs.any())
    QTimer::singleShot(0, this, [this] {
      if (best_pending_ && !desk_.jobs.any()) find_best();
    });
}

void StudySeries::chosen(int n) {
  stop();
  go_to(n);
}

void StudySeries::open(int n) {
  if (n < 0 || n >= static_cast<int>(stack_.entries.size()) || n == own()) return;
  if (!row_of(n).whole) return;
  stop();
  if (const auto& series = entry(n).source.series)
    emit series_wanted(*series, folder_, folder_of(*series));
  else
    emit file_wanted(QString::fromStdString(entry(n).source.file.string()));
}

std::filesystem::path StudySeries::folder_of(const imaging::DicomSeries& series) const {
  if (series.files.empty()) return {};
  const auto found = found_in_.find(series.files.front());
  return found == found_in_.end() ? std::filesystem::path() : found->second;
}

void StudySeries::go_to_own() {
  stop();
  wanted_ = own();
  desk_.jobs.cancel("series_image");
  desk_.bench.show_other_image(nullptr);
  if (beating_.shown()) beating_.go_to_own();
}

void StudySeries::go_to(int n) {
  if (n < 0 || n >= static_cast<int>(stack_.entries.size())) return;
  if (n == own()) return go_to_own();
  wanted_ = n;
  if (beating_.shown() && entry(n).has_phase && std::count(cine_.begin(), cine_.end(), n) > 0) {
    desk_.bench.show_other_image(nullptr);
    beating_.clock().playing.set(false);
    beating_.clock().percent.set(100.0 * entry(n).source.phase);
    return;
  }
  if (beating_.shown()) beating_.go_to_own();
  wanted_ = n;
  const auto at = static_cast<std::size_t>(n);
  if (const auto there = images_.frame(at)) put(n, there);
  if (!images_.whole(at)) read(n);
}

void StudySeries::read(int n) {
  desk_.jobs.run(
      "series_image", tr("Reading %1").arg(name_of(n)),
      [source = entry(n).source](const core::TaskContext& task) {
        return std::any(session::read_phase_image(source, task));
      },
      [this, n](const std::any& result) {
        images_.take(static_cast<std::size_t>(n), std::any_cast<const session::PhaseImage&>(result).volume);
        if (wanted_ == n) put(n, images_.whole(static_cast<std::size_t>(n)));
      },
      [this, n](const QString& why) { fail(n, why); });
}

void StudySeries::put(int n, const session::StackImages::Image& image) {
  const bool shown = desk_.messages.guarded([&] {
    desk_.bench.show_other_image(std::make_shared<const session::OtherImage>(described(n, image)));
  });
  if (!shown) wanted_ = shown_;
  if (shown) {
    shown_ = wanted_ = n;
    images_.shown(static_cast<std::size_t>(n));
  }
  strip_->set_current(shown_);
  strip_->set_away(shown_ != own());
}

void StudySeries::fail(int n, const QString& why) {
  faults_[static_cast<std::size_t>(n)] = why;
  strip_->set_row(n, row_of(n));
  cine_.erase(std::remove(cine_.begin(), cine_.end(), n), cine_.end());
  strip_->set_cine(cine_);
  if (wanted_ == n) wanted_ = shown_;
  strip_->set_current(shown_);
  desk_.messages.say(tr("%1 cannot be read and is left out: %2").arg(name_of(n), why));
  emit changed();
}

session::OtherImage StudySeries::described(int n, const session::StackImages::Image& image) const {
  session::OtherImage other{image, name_of(n).toStdString()};
  const bool known = own() >= 0 && entry(own()).has_phase && entry(n).has_phase;
  const bool same = known && session::phase_distance(entry(own()).source.phase, entry(n).source.phase) < 1e-6;
  other.warns = desk_.bench.has_case() && !same;
  QString caption = tr("image %1").arg(name_of(n));
  if (other.warns) {
    const QString axes = known ? name_of(own()) : tr("the case's image");
    caption = tr("image %1, axes of %2").arg(name_of(n), axes);
  }
  other.caption = caption.toStdString();
  return other;
}

}  // namespace ostia::workstation
