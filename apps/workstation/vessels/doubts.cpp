#include "vessels/doubts.h"

#include "commands/kinds.h"
#include "commands/table.h"
#include "shell/desk.h"
#include "shell/quantities.h"

#include <QHeaderView>
#include <QScopedValueRollback>
#include <algorithm>

namespace ostia::workstation {
namespace {

enum DoubtColumn { vessel_column, place_column, probability_column, doubt_columns };
constexpr int fill_doubts_after_ms = 150;  // of the last change: not with every move of the mouse

QString stretch_text(const session::DoubtfulPlace& place) {
  return DoubtList::tr("%1 to %2 mm").arg(quantity::length(place.from_mm), quantity::length(place.to_mm));
}

void walk_doubts(Desk& desk, DoubtList& doubts, int by) {
  if (!doubts.knows()) {
    desk.messages.say(
        Command::tr("This case has no probabilities: its vessels were not found by the program."));
    return;
  }
  const auto place = doubts.walk(by);
  if (!place) {
    desk.messages.say(doubts.places().empty() ? Command::tr("No place of this case is doubtful.")
                                              : Command::tr("No other doubtful place in this direction."));
    return;
  }
  desk.messages.say(Command::tr("Doubtful place %1 of %2: %3, %4, probability %5")
                        .arg(doubts.indexOfTopLevelItem(doubts.currentItem()) + 1)
                        .arg(doubts.places().size())
                        .arg(QString::fromStdString(desk.bench.vessel_name(place->vessel)),
                             stretch_text(*place), quantity::ratio(place->probability)));
}

}  // namespace

DoubtList::DoubtList(session::Workbench& bench, QWidget* parent) : QTreeWidget(parent), bench_(bench) {
  setObjectName("doubts");
  setAccessibleName(tr("Doubts"));
  setColumnCount(doubt_columns);
  setHeaderLabels({tr("Vessel"), tr("Place"), tr("Probability")});
  headerItem()->setToolTip(probability_column,
                           tr("That a coronary artery is there and its axis lies in it, by the program"));
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  setAllColumnsShowFocus(true);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setSectionResizeMode(place_column, QHeaderView::Stretch);
  soon_.setSingleShot(true);
  soon_.setInterval(fill_doubts_after_ms);
  connect(&soon_, &QTimer::timeout, this, &DoubtList::fill);
  own_.push_back(bench.case_changed.observe([this] { read_case(); }));
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent&) { soon_.start(); }));
  own_.push_back(bench.annotations_changed.observe([this] { soon_.start(); }));
  connect(this, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (item && !filling_) go_to(indexOfTopLevelItem(item));
  });
}

void DoubtList::read_case() {
  certainty_.clear();
  if (bench_.has_case()) certainty_ = session::kept_certainty(bench_.session().file());
  last_ = -1;
  places_.clear();
  fill();
  emit known(knows());
}

const std::vector<session::DoubtfulPlace>& DoubtList::places() {
  if (soon_.isActive()) fill();
  return places_;
}

/// Written anew; the walk goes on behind what was surer doubted than what was walked to last.
void DoubtList::fill() {
  soon_.stop();
  const QScopedValueRollback<bool> filling(filling_, true);
  const bool walked = last_ >= 0 && last_ < std::ssize(places_);
  const session::DoubtfulPlace before =
      walked ? places_[static_cast<std::size_t>(last_)] : session::DoubtfulPlace{};
  places_.clear();
  if (bench_.has_case() && knows())
    places_ = session::doubtful_places(certainty_, *bench_.model(), *bench_.session().file().annotations());
  if (walked) {
    const auto next = std::find_if(places_.begin(), places_.end(),
                                   [&](const auto& one) { return one.probability >= before.probability; });
    const bool same =
        next != places_.end() && next->vessel == before.vessel && next->probability == before.probability;
    last_ = static_cast<int>(next - places_.begin()) - (same ? 0 : 1);
  }
  while (topLevelItemCount() > std::ssize(places_)) delete topLevelItem(topLevelItemCount() - 1);
  while (topLevelItemCount() < std::ssize(places_)) addTopLevelItem(new QTreeWidgetItem);
  for (int row = 0; row < topLevelItemCount(); ++row) {
    QTreeWidgetItem& item = *topLevelItem(row);
    const session::DoubtfulPlace& place = places_[static_cast<std::size_t>(row)];
    item.setText(vessel_column, QString::fromStdString(bench_.vessel_name(place.vessel)));
    item.setText(place_column, stretch_text(place));
    item.setText(probability_column, quantity::ratio(place.probability));
    item.setTextAlignment(probability_column, Qt::AlignRight | Qt::AlignVCenter);
    for (int column = 0; column < doubt_columns; ++column) item.setToolTip(column, item.text(column));
  }
  viewport()->update();  // an emptied tree leaves rows on the screen else
}

void DoubtList::go_to(int row) {
  if (row < 0 || row >= std::ssize(places_)) return;
  const session::DoubtfulPlace place = places_[static_cast<std::size_t>(row)];
  last_ = row;
  bench_.vessel.set(place.vessel);
  bench_.cursor_mm.set(bench_.here_mm(place.s_mm));
}

std::optional<session::DoubtfulPlace> DoubtList::walk(int by) {
  const int row = places().empty() ? -1 : last_ + by;
  if (row < 0 || row >= std::ssize(places_)) return std::nullopt;
  {
    const QScopedValueRollback<bool> filling(filling_, true);
    setCurrentItem(topLevelItem(row));
  }
  go_to(row);
  return places_[static_cast<std::size_t>(row)];
}

void add_doubt_commands(CommandTable& table, Desk& desk, DoubtList& doubts) {
  table.add(
      needs_case({.id = "view.next_doubt",
                  .text = Command::tr("Next doubtful place"),
                  .tip = Command::tr("All views go to the place that the program is least sure of, then "
                                     "to the next in the order of doubt."),
                  .keys = {"O"},
                  .run = [&desk, &doubts] { walk_doubts(desk, doubts, 1); }},
                 desk));
  table.add(needs_case({.id = "view.previous_doubt",
                        .text = Command::tr("Previous doubtful place"),
                        .tip = Command::tr("All views go back to the doubtful place before it."),
                        .keys = {"Shift+O"},
                        .run = [&desk, &doubts] { walk_doubts(desk, doubts, -1); }},
                       desk));
}

}  // namespace ostia::workstation
