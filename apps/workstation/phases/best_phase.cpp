// What the strip says of each image, and which phase is proposed.
#include "phases/beating_case.h"
#include "phases/series_strip.h"
#include "phases/study_series.h"
#include "shell/desk.h"
#include "views/raster_image.h"

#include "ostia/imaging/series_preview.h"

#include <cmath>

namespace ostia::workstation {
namespace {

using evaluation::LeftOut;
using session::SharpnessPlaces;

QString strip_percent(double phase) {
  return QString::fromStdString(session::percent_of_cycle(phase));
}

/// Why a phase that was read was not compared.
QString why_left_out(LeftOut why) {
  switch (why) {
    case LeftOut::no_edges:
      return StudySeries::tr("no edges between fat and blood");
    case LeftOut::lost_edges:
      return StudySeries::tr("half of the edges are missing");
    case LeftOut::noisy:
      return StudySeries::tr("much noisier than the others");
    case LeftOut::other_voxels:
      return StudySeries::tr("other voxels than the others");
    case LeftOut::elsewhere:
      return StudySeries::tr("does not cover the arteries");
    case LeftOut::none:
    case LeftOut::not_measured:
      break;
  }
  return {};
}

}  // namespace

QString StudySeries::name_of(int n) const {
  if (n < 0) return tr("the image on the table");
  return entry(n).has_phase ? strip_percent(entry(n).source.phase) : tr("series %1").arg(n + 1);
}

StripRow StudySeries::row_of(int n) const {
  const session::StackEntry& one = entry(n);
  const auto at = static_cast<std::size_t>(n);
  StripRow row;
  const QString description = QString::fromStdString(one.description);
  row.title = one.has_phase ? strip_percent(one.source.phase) : description;
  QStringList tip{description};
  if (one.slices > 0)
    tip << tr("%1 slices, voxels of %2 x %3 x %4 mm")
               .arg(one.slices)
               .arg(one.spacing_mm.x(), 0, 'f', 2)
               .arg(one.spacing_mm.y(), 0, 'f', 2)
               .arg(one.spacing_mm.z(), 0, 'f', 2);
  QString fault = one.fault.empty() ? faults_[at] : QString::fromStdString(one.fault);
  if (fault.isEmpty() && one.uneven) fault = tr("Slices are missing or uneven: open it by File > Open.");
  row.whole = fault.isEmpty();
  QStringList notes;
  if (!row.whole) notes << tr("cannot be read");
  if (n == own()) notes << tr("on the table");
  if (choice_ && row.whole) {
    const double share = choice_->best.share[at];
    if (choice_->best.best == at)
      notes << tr("sharpest");
    else if (share > 0.0)
      notes << tr("%1 % sharp").arg(std::floor(100.0 * share), 0, 'f', 0);
    const QString why = why_left_out(choice_->best.left_out[at]);
    if (!why.isEmpty()) notes << tr("not compared"), tip << tr("Not compared: %1").arg(why);
  }
  // Of several reconstructions of a phase the description tells which.
  if (notes.isEmpty() && one.has_phase) notes << description;
  row.note = notes.join(QStringLiteral(", "));
  if (!row.whole) tip << fault;
  row.tip = tip.join(QLatin1Char('\n'));
  return row;
}

void StudySeries::refresh_rows() {
  for (int n = 0; n < static_cast<int>(stack_.entries.size()); ++n) strip_->set_row(n, row_of(n));
}

void StudySeries::next_picture(int from) {
  int n = from;
  while (n < static_cast<int>(stack_.entries.size()) && !entry(n).fault.empty()) ++n;
  if (n >= static_cast<int>(stack_.entries.size())) return;
  const session::PhaseSource source = entry(n).source;
  desk_.jobs.run(
      "series_pictures", tr("Pictures of the series"),
      [source](const core::TaskContext& task) {
        return std::any(source.series ? imaging::preview(*source.series, SeriesStrip::picture_px, task)
                                      : imaging::preview(source.file, SeriesStrip::picture_px, task));
      },
      [this, n](const std::any& result) {
        strip_->set_picture(n, preview_image(std::any_cast<const imaging::SeriesPreview&>(result)));
        next_picture(n + 1);
      },
      [this, n](const QString&) { next_picture(n + 1); });  // reading it says what is wrong
}

void StudySeries::best_pressed() {
  if (choice_ && choice_->best.best) {
    stop();
    go_to(static_cast<int>(*choice_->best.best));
  } else {
    find_best();
  }
}

void StudySeries::find_best() {
  best_pending_ = false;
  const session::Workbench& bench = desk_.bench;
  if (!has_cine() || !bench.image().volume) return;
  session::PhaseChoiceWork work;
  work.stack = stack_;
  for (const int n : cine_) work.compared.push_back(static_cast<std::size_t>(n));
  for (int n = 0; n < static_cast<int>(stack_.entries.size()); ++n)
    work.held.push_back(n == own() ? bench.image().volume : images_.whole(static_cast<std::size_t>(n)));
  if (bench.model()) work.axes_mm = session::axis_points(*bench.model());
  if (beating_.shown()) desk_.messages.guarded([&] { work.beating = beating_.carrying(); });
  choice_.reset();
  desk_.jobs.run(
      "best_phase", tr("Looking for the sharpest phase"),
      [work = std::move(work)](const core::TaskContext& task) { return std::any(work.chosen(task)); },
      [this](const std::any& result) { take_choice(std::any_cast<const session::PhaseChoice&>(result)); },
      [this](const QString& message) { desk_.messages.say(message); });
  refresh_rows();
  tell_best();
}

void StudySeries::take_choice(const session::PhaseChoice& choice) {
  if (choice.faults.size() != stack_.entries.size()) return;
  choice_ = choice;
  for (std::size_t n = 0; n < choice.faults.size(); ++n)
    if (!choice.faults[n].empty()) fail(static_cast<int>(n), QString::fromStdString(choice.faults[n]));
  refresh_rows();
  tell_best();
  emit changed();
}

QString StudySeries::how_measured() const {
  switch (choice_->places) {
    case SharpnessPlaces::carried_axes:
      return tr("By the edges about the arteries, whose axes the motion carries to each phase.");
    case SharpnessPlaces::same_axes:
      return tr(
          "By the edges within 10 mm of the axes of the case's own phase: without a motion nobody knows "
          "where the arteries are at the others.");
    case SharpnessPlaces::heart:
      break;
  }
  return tr("By the edges of the heart: there are no axes of arteries yet.");
}

void StudySeries::tell_best() {
  if (desk_.jobs.running("best_phase") && !choice_) {
    strip_->set_best(tr("Being measured\u2026"), {}, false);
    return;
  }
  if (!choice_) {
    strip_->set_best(tr("Find the sharpest"),
                     tr("Measures at which phase the arteries, or the heart, have the sharpest edges"), true);
    return;
  }
  if (!choice_->best.best) {
    strip_->set_best(tr("No sharpest phase"), tr("Fewer than two phases can be compared."), false);
    return;
  }
  QStringList tip{how_measured()};
  QStringList others;
  for (const std::size_t n : choice_->best.as_sharp) others << name_of(static_cast<int>(n));
  if (!others.isEmpty()) tip << tr("As sharp: %1").arg(others.join(QStringLiteral(", ")));
  strip_->set_best(tr("Sharpest: %1").arg(name_of(static_cast<int>(*choice_->best.best))),
                   tip.join(QLatin1Char('\n')) + QLatin1Char('\n') + tr("Shows it."), true);
}

}  // namespace ostia::workstation
