#include "measuring/lesion_list.h"

#include "measuring/lesion_texts.h"

#include <QClipboard>
#include <QComboBox>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QScopedValueRollback>
#include <QStyledItemDelegate>
#include <algorithm>

namespace ostia::workstation {
namespace {

constexpr int fill_lesions_after_ms = 200;  // of the last change: not with every move of the mouse
constexpr int place_role = Qt::UserRole, sort_role = Qt::UserRole + 1;
constexpr double same_place_mm = 0.05;

/// Sorts numbers as numbers.
class LesionItem final : public QTreeWidgetItem {
 public:
  using QTreeWidgetItem::QTreeWidgetItem;
  bool operator<(const QTreeWidgetItem& other) const override {
    const int column = treeWidget() ? treeWidget()->sortColumn() : 0;
    const QVariant mine = data(column, sort_role), its = other.data(column, sort_role);
    if (mine.isValid() && its.isValid() && mine != its) return mine.toDouble() < its.toDouble();
    if (const int order = text(column).localeAwareCompare(other.text(column)); order != 0) return order < 0;
    return data(0, sort_role).toDouble() < other.data(0, sort_role).toDouble();
  }
};

/// The comment alone can be typed into.
class OnlyComments final : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option,
                        const QModelIndex& index) const override {
    return index.column() == comment_column ? QStyledItemDelegate::createEditor(parent, option, index)
                                            : nullptr;
  }
};

}  // namespace

LesionList::LesionList(session::Workbench& bench, Guard guard, QWidget* parent)
    : QTreeWidget(parent), bench_(bench), guard_(std::move(guard)), turns_(bench) {
  setObjectName("lesions");
  setAccessibleName(tr("Lesions"));
  setColumnCount(lesion_columns);
  setHeaderLabels(lesion_titles());
  for (int i = 0; i < lesion_columns; ++i) headerItem()->setToolTip(i, lesion_titles_in_full().at(i));
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  setAllColumnsShowFocus(true);
  setSortingEnabled(true);
  sortByColumn(0, Qt::AscendingOrder);
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(lesion_columns - 1, QHeaderView::Fixed);  // as give_comments_room has it
  setItemDelegate(new OnlyComments(this));
  setEditTriggers(EditKeyPressed | DoubleClicked);
  setColumnHidden(ffr_column, true);
  setMinimumSize(120, 40);
  soon_.setSingleShot(true);
  connect(&soon_, &QTimer::timeout, this, [this] {
    // A hand that pulls a wall is not kept waiting for what all vessels measure by now.
    if (QGuiApplication::mouseButtons() != Qt::NoButton)
      soon_.start(fill_lesions_after_ms);
    else if (turns_.next())
      soon_.start(0);
    else
      fill();
  });
  own_.push_back(bench.vessel.observe([this](const std::int32_t&) { follow_cursor(); }));
  own_.push_back(bench.cursor_mm.observe([this](const double&) { follow_cursor(); }));
  connect(this, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    const session::LesionRow* row = item && !filling_ ? row_of(*item) : nullptr;
    if (row) go_to(session::LesionRow(*row));
  });
  connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int column) {
    if (!filling_ && column == comment_column) commented(*item);
  });
}

QWidget* LesionList::controls() {
  if (controls_) return controls_;
  controls_ = new QWidget;
  auto* line = new QHBoxLayout(controls_);
  line->setContentsMargins(0, 0, 0, 0);
  missing_ = new QLabel(controls_);
  missing_->setObjectName("lesions_missing");
  missing_->hide();
  wanted_text_ = new QLineEdit(controls_);
  wanted_text_->setObjectName("lesions_filter");
  wanted_text_->setAccessibleName(tr("Filter the lesions"));
  wanted_text_->setPlaceholderText(tr("Filter"));
  wanted_text_->setToolTip(tr("Shows the rows alone that have this text in one of their cells."));
  wanted_text_->setClearButtonEnabled(true);
  wanted_text_->setMaximumWidth(16 * fontMetrics().averageCharWidth());
  wanted_state_ = new QComboBox(controls_);
  wanted_state_->setObjectName("lesions_state");
  wanted_state_->setAccessibleName(tr("State of the lesions that are shown"));
  wanted_state_->addItem(tr("All"), -1);
  for (const session::LesionState one :
       {session::LesionState::open, session::LesionState::accepted, session::LesionState::rejected})
    wanted_state_->addItem(state_word(one), static_cast<int>(one));
  line->addWidget(missing_);
  line->addWidget(wanted_text_);
  line->addWidget(wanted_state_);
  connect(wanted_text_, &QLineEdit::textChanged, this, &LesionList::filter);
  connect(wanted_state_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &LesionList::filter);
  return controls_;
}

void LesionList::show_lesions(session::LesionBoard* board) {
  board_ = board;
  of_board_.clear();
  rows_.clear();
  if (!board) return;
  of_board_.push_back(board->changed.observe([this] {
    if (turns_.measuring()) return;
    turns_.begin();
    soon_.start(fill_lesions_after_ms);
  }));
  of_board_.push_back(bench_.case_changed.observe([this] {
    const QScopedValueRollback<bool> filling(filling_, true);
    clear();  // a comment that is being typed is not for another case's lesion
    rows_.clear();
  }));
  soon_.start(fill_lesions_after_ms);
}

void LesionList::show_pressures(session::PressureBoard* board) {
  pressures_ = board;
  of_pressures_.clear();
  if (board) {
    of_pressures_.push_back(board->shown.observe([this](const bool&) { show_ffr(); }));
    of_pressures_.push_back(board->changed.observe([this] { show_ffr(); }));
  }
  show_ffr();
}

/// In the rows that are there: these are written anew when others are found.
void LesionList::show_ffr() {
  const bool on = pressures_ && pressures_->shown.get();
  if (isColumnHidden(ffr_column) == on) {
    setColumnHidden(ffr_column, !on);
    give_comments_room();
  }
  if (!on || state() == EditingState) return;
  std::vector<analysis::Stenosis> places;
  for (const session::LesionRow& row : rows_) places.push_back(row.lesion.stenosis);
  std::vector<std::optional<session::LesionFfr>> found(places.size());
  if (pressures_->now()) guard_([&] { found = session::ffr_of_lesions(*pressures_->now(), places); });
  const QScopedValueRollback<bool> filling(filling_, true);
  for (int i = 0; i < topLevelItemCount(); ++i) {
    QTreeWidgetItem& item = *topLevelItem(i);
    const auto k = static_cast<std::size_t>(item.data(0, place_role).toInt());
    // Of plaque that narrows nothing it would be that of the next narrowing.
    const bool narrows = k < found.size() && rows_[k].lesion.narrows;
    const std::optional<session::LesionFfr> ffr = narrows ? found[k] : std::nullopt;
    item.setText(ffr_column, narrows || !pressures_->now() ? ffr_cell(ffr) : QStringLiteral("\u2013"));
    item.setToolTip(ffr_column, ffr_tip(ffr));
    item.setData(ffr_column, sort_role, ffr && !ffr->now.occluded ? QVariant(ffr->now.behind) : QVariant());
    item.setTextAlignment(ffr_column, Qt::AlignRight | Qt::AlignVCenter);
  }
}

/// Written anew, but for the row that is being typed into; the chosen one stays chosen.
void LesionList::fill() {
  if (!board_) return;
  if (state() == EditingState) return soon_.start(fill_lesions_after_ms);
  const QScopedValueRollback<bool> filling(filling_, true);
  guard_([&] { rows_ = board_->rows(); });
  setSortingEnabled(false);
  while (topLevelItemCount() > static_cast<int>(rows_.size())) delete topLevelItem(topLevelItemCount() - 1);
  while (topLevelItemCount() < static_cast<int>(rows_.size())) {
    auto* item = new LesionItem;
    item->setFlags(item->flags() | Qt::ItemIsEditable);
    addTopLevelItem(item);
  }
  for (int i = 0; i < topLevelItemCount(); ++i) {
    topLevelItem(i)->setData(0, place_role, i);
    show_row(*topLevelItem(i), rows_[static_cast<std::size_t>(i)]);
  }
  show_ffr();
  setSortingEnabled(true);
  setCurrentItem(item_at_cursor());
  filter();
  const int missing = board_->missing();
  if (missing_) {
    missing_->setText(tr("plaque: %1 to go").arg(missing));
    missing_->setToolTip(tr("Vessels whose plaque is not known yet; their lesions may become more."));
    missing_->setVisible(missing > 0 && bench_.has_case());
  }
  give_comments_room();
  viewport()->update();
}

/// The last column has what the others leave, and what is in it at least. Qt's own stretching depends on what
/// the columns were before.
void LesionList::give_comments_room() {
  constexpr int last = lesion_columns - 1;
  const int others = header()->length() - header()->sectionSize(last);
  const int needed = std::max(sizeHintForColumn(last), header()->sectionSizeHint(last));
  header()->resizeSection(last, std::max(needed, viewport()->width() - others));
}

void LesionList::resizeEvent(QResizeEvent* event) {
  QTreeWidget::resizeEvent(event);
  give_comments_room();
}

void LesionList::show_row(QTreeWidgetItem& item, const session::LesionRow& row) {
  const QStringList cells = lesion_cells(row);
  const std::vector<std::optional<double>> numbers = lesion_numbers(row);
  for (int i = 0; i < lesion_columns; ++i) {
    item.setText(i, cells[i]);
    item.setToolTip(i, i == 0 ? lesion_tip(row) : cells[i]);
    const auto& number = numbers[static_cast<std::size_t>(i)];
    item.setData(i, sort_role, number ? QVariant(*number) : QVariant());
    if (number && i > 0) item.setTextAlignment(i, Qt::AlignRight | Qt::AlignVCenter);
    QFont font = item.font(i);
    font.setStrikeOut(row.state == session::LesionState::rejected && i < state_column);
    item.setFont(i, font);
  }
}

void LesionList::filter() {
  if (!controls_) return;
  const QString text = wanted_text_->text().trimmed();
  const int state = wanted_state_->currentData().toInt();
  for (int i = 0; i < topLevelItemCount(); ++i) {
    QTreeWidgetItem& item = *topLevelItem(i);
    const session::LesionRow* row = row_of(item);
    bool wanted = row && (state < 0 || static_cast<int>(row->state) == state);
    bool has_text = text.isEmpty();
    for (int c = 0; c < lesion_columns && !has_text; ++c)
      has_text = item.text(c).contains(text, Qt::CaseInsensitive);
    item.setHidden(!wanted || !has_text);
  }
}

const session::LesionRow* LesionList::row_of(const QTreeWidgetItem& item) const {
  const auto i = static_cast<std::size_t>(item.data(0, place_role).toInt());
  return i < rows_.size() ? &rows_[i] : nullptr;
}

std::vector<QTreeWidgetItem*> LesionList::shown_items() const {
  std::vector<QTreeWidgetItem*> out;
  for (int i = 0; i < topLevelItemCount(); ++i)
    if (!topLevelItem(i)->isHidden()) out.push_back(topLevelItem(i));
  return out;
}

QTreeWidgetItem* LesionList::item_at_cursor() const {
  if (!bench_.has_case() || !bench_.axis()) return nullptr;
  const double s = bench_.own_mm(bench_.cursor_mm.get());
  const std::int32_t owner = lumen::owner_at(bench_.model()->tree, bench_.vessel.get(), s);
  QTreeWidgetItem* best = nullptr;
  double nearest = 0.0;
  for (int i = 0; i < topLevelItemCount(); ++i) {
    const session::LesionRow* row = row_of(*topLevelItem(i));
    if (!row || row->vessel != owner) continue;
    const analysis::Stenosis& place = row->lesion.stenosis;
    if (s < place.from_mm - same_place_mm || s > place.to_mm + same_place_mm) continue;
    const double off = std::abs(place.throat_mm - s);
    if (!best || off < nearest) best = topLevelItem(i), nearest = off;
  }
  return best;
}

void LesionList::follow_cursor() {
  if (filling_ || state() == EditingState) return;
  const QScopedValueRollback<bool> filling(filling_, true);
  setCurrentItem(item_at_cursor());
}

void LesionList::go_to(const session::LesionRow& row) {
  const QScopedValueRollback<bool> filling(filling_, true);  // the row is chosen already
  bench_.vessel.set(row.vessel);
  bench_.cursor_mm.set(bench_.here_mm(row.lesion.stenosis.throat_mm));
}

bool LesionList::walk(int by) {
  if (soon_.isActive()) fill();
  const std::vector<QTreeWidgetItem*> items = shown_items();
  if (items.empty()) return false;
  const auto now = std::find(items.begin(), items.end(), item_at_cursor());
  QTreeWidgetItem* next = nullptr;
  if (now != items.end()) {
    const auto place = now - items.begin() + by;
    if (place >= 0 && place < std::ssize(items)) next = items[static_cast<std::size_t>(place)];
  } else {
    // From the cursor's place on its vessel; else from the end of the table that lies in that direction.
    const double s = bench_.own_mm(bench_.cursor_mm.get());
    for (auto* item : items) {
      const session::LesionRow* row = row_of(*item);
      const double ahead =
          row->vessel == bench_.vessel.get() ? by * (row->lesion.stenosis.throat_mm - s) : -1.0;
      if (ahead <= 0.0) continue;
      if (!next || ahead < by * (row_of(*next)->lesion.stenosis.throat_mm - s)) next = item;
    }
    if (!next) next = by > 0 ? items.front() : items.back();
  }
  if (!next) return false;
  {
    const QScopedValueRollback<bool> filling(filling_, true);
    setCurrentItem(next);
  }
  go_to(session::LesionRow(*row_of(*next)));
  return true;
}

std::optional<session::LesionRow> LesionList::at_cursor() {
  if (soon_.isActive()) fill();
  const QTreeWidgetItem* item = item_at_cursor();
  const session::LesionRow* row = item ? row_of(*item) : nullptr;
  return row ? std::optional(*row) : std::nullopt;
}

bool LesionList::say(session::LesionState state) {
  const auto row = at_cursor();
  if (!row || !board_) return false;
  board_->say(*row, state, row->comment);
  return true;
}

bool LesionList::comment() {
  if (soon_.isActive()) fill();
  QTreeWidgetItem* item = item_at_cursor();
  if (!item) return false;
  setFocus();
  {
    const QScopedValueRollback<bool> filling(filling_, true);
    setCurrentItem(item, comment_column);
  }
  scrollToItem(item);
  editItem(item, comment_column);
  return true;
}

void LesionList::commented(const QTreeWidgetItem& item) {
  const session::LesionRow* row = row_of(item);
  const std::string text = item.text(comment_column).trimmed().toStdString();
  if (!row || !board_ || text == row->comment) return;
  guard_([&] { board_->say(session::LesionRow(*row), row->state, text); });
}

QString LesionList::as_text() const {
  const QStringList all = lesion_titles_in_full();
  QStringList titles;
  for (int i = 0; i < lesion_columns; ++i)
    if (!isColumnHidden(i)) titles << all[i];
  QString text = titles.join('\t') + '\n';
  for (const QTreeWidgetItem* item : shown_items()) {
    QStringList cells;
    for (int i = 0; i < lesion_columns; ++i)
      if (!isColumnHidden(i)) cells << item->text(i).simplified();
    text += cells.join('\t') + '\n';
  }
  return text;
}

void LesionList::closeEditor(QWidget* editor, QAbstractItemDelegate::EndEditHint hint) {
  QTreeWidget::closeEditor(editor, hint);
  soon_.start(fill_lesions_after_ms);  // what was not written while it was typed
}

void LesionList::keyPressEvent(QKeyEvent* event) {
  if (event->matches(QKeySequence::Copy))
    QGuiApplication::clipboard()->setText(as_text());
  else
    QTreeWidget::keyPressEvent(event);
}

}  // namespace ostia::workstation
