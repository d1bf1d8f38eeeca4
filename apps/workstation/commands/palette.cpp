#include "commands/palette.h"

#include "commands/palette_rows.h"
#include "commands/table.h"
#include "commands/texts.h"

#include <QAbstractListModel>
#include <QApplication>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QPalette>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int wide = 620, rows_shown = 9, from_top_share = 8, gap = 8;  // units of the interface
constexpr const char* own_id = "help.find_command";

}  // namespace

std::vector<PaletteLine> palette_lines(const CommandTable& commands, const QString& typed) {
  std::vector<PaletteLine> lines;
  for (const Command& one : commands.all()) {
    if (one.id == own_id) continue;
    if (auto found = match(typed, plain_text(one.text), menus_of(*one.action)))
      lines.push_back({&one, std::move(*found)});
  }
  // Scattered characters fit much; they are of use where nothing else fits.
  const auto scattered = [](const PaletteLine& line) { return line.match.scattered; };
  if (!std::all_of(lines.begin(), lines.end(), scattered)) std::erase_if(lines, scattered);
  const auto place = [](const PaletteLine& line) {
    return std::pair(line.match.rank, line.command->action->isEnabled() ? 0 : 1);
  };
  // The whole list is in the order of the menus.
  if (!typed.trimmed().isEmpty())
    std::stable_sort(lines.begin(), lines.end(),
                     [&](const PaletteLine& a, const PaletteLine& b) { return place(a) < place(b); });
  return lines;
}

class PaletteModel final : public QAbstractListModel {
 public:
  using QAbstractListModel::QAbstractListModel;
  void show(std::vector<PaletteLine> lines) {
    beginResetModel();
    lines_ = std::move(lines);
    endResetModel();
  }
  const PaletteLine& line(int row) const { return lines_[static_cast<std::size_t>(row)]; }
  int rowCount(const QModelIndex& parent = {}) const override {
    return parent.isValid() ? 0 : static_cast<int>(lines_.size());
  }
  QVariant data(const QModelIndex& index, int role) const override {
    if (!index.isValid()) return {};
    const PaletteLine& one = line(index.row());
    const QAction& action = *one.command->action;
    switch (role) {
      case palette_text:
        return plain_text(one.command->text);
      case palette_below:
        return below(*one.command);
      case palette_keys:
        return keys(action);
      case palette_marks:
        return QVariantList(one.match.marks.begin(), one.match.marks.end());
      case palette_checked:
        return action.isCheckable() && action.isChecked();
      case palette_usable:
        return action.isEnabled();
      case Qt::ToolTipRole:
        return one.command->tip;
      case Qt::AccessibleTextRole:
        return QStringList({plain_text(one.command->text), below(*one.command), keys(action).join(", ")})
            .join(". ");
      default:
        return {};
    }
  }

 private:
  static QString below(const Command& command) {
    const QString menus = menus_of(*command.action).join(QStringLiteral(" \u203a "));
    const QString why = CommandTable::why_not(command);
    const QString more = why.isEmpty() ? command.tip : why;
    return more.isEmpty() ? menus : menus + QStringLiteral("  \u2013  ") + more;
  }
  static QStringList keys(const QAction& action) {
    QStringList texts;
    for (const QKeySequence& one : action.shortcuts()) texts << one.toString(QKeySequence::NativeText);
    return texts;
  }
  std::vector<PaletteLine> lines_;
};

Palette::Palette(const CommandTable& commands, QWidget& window)
    : QFrame(&window, Qt::Popup),
      commands_(commands),
      window_(window),
      line_(new QLineEdit(this)),
      list_(new QListView(this)),
      hint_(new QLabel(this)),
      model_(new PaletteModel(this)) {
  setObjectName("palette");
  setAccessibleName(tr("Find a command"));
  setAttribute(Qt::WA_DeleteOnClose);
  setFrameShape(QFrame::Box);
  setFrameShadow(QFrame::Plain);
  QPalette edge = palette();  // seen on what is below in both themes
  edge.setColor(QPalette::WindowText, edge.color(QPalette::Disabled, QPalette::WindowText));
  setPalette(edge);
  line_->setObjectName("palette_line");
  line_->setPlaceholderText(tr("Type what you want to do"));
  line_->setAccessibleName(tr("What you want to do"));
  line_->setClearButtonEnabled(true);
  QFont larger = line_->font();
  larger.setPointSizeF(1.2 * larger.pointSizeF());
  line_->setFont(larger);
  line_->setTextMargins(6, 3, 6, 3);
  line_->installEventFilter(this);
  list_->setObjectName("palette_list");
  list_->setAccessibleName(tr("Commands that fit"));
  list_->setModel(model_);
  list_->setItemDelegate(new PaletteRows(list_));
  list_->setUniformItemSizes(true);
  list_->setFrameShape(QFrame::NoFrame);
  list_->setFocusPolicy(Qt::NoFocus);  // what is typed goes into the line
  list_->setMouseTracking(true);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setVerticalScrollMode(QAbstractItemView::ScrollPerItem);
  hint_->setObjectName("palette_hint");
  hint_->setEnabled(false);
  hint_->setContentsMargins(gap, 2, gap, 2);
  hint_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);  // a narrow window shows its beginning
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(gap, gap, gap, 4);
  rows->setSpacing(gap / 2);
  rows->addWidget(line_);
  rows->addWidget(list_);
  rows->addWidget(hint_);
  connect(line_, &QLineEdit::textChanged, this, &Palette::fill);
  connect(list_, &QListView::entered, list_, &QListView::setCurrentIndex);
  connect(list_, &QListView::clicked, this, [this](const QModelIndex& index) { run(index.row()); });
  fill({});
}

void Palette::begin() {
  place();
  show();
  line_->setFocus(Qt::PopupFocusReason);
}

/// As high as its lines need, up to some.
void Palette::place() {
  const int width = std::min(wide, window_.width() - 2 * gap);
  const int top = std::max(gap, window_.height() / from_top_share);
  const int row = std::max(1, list_->sizeHintForRow(0));
  list_->setFixedHeight(row);
  const int others = layout()->minimumSize().height() - row;
  const int room = std::max(1, (window_.height() - top - others - gap) / row);
  const int lines = std::min({model_->rowCount(), rows_shown, room});
  list_->setFixedHeight(lines * row);
  layout()->activate();  // else the least height is still that of more lines
  setGeometry(QRect(window_.mapToGlobal(QPoint((window_.width() - width) / 2, top)),
                    QSize(width, others + lines * row)));
}

void Palette::fill(const QString& typed) {
  model_->show(palette_lines(commands_, typed));
  if (model_->rowCount() > 0) list_->setCurrentIndex(model_->index(0, 0));
  list_->scrollToTop();
  show_hint();
  if (isVisible()) place();
}

void Palette::show_hint() {
  if (model_->rowCount() == 0)
    hint_->setText(tr("No command fits."));
  else
    hint_->setText(
        tr("%n command(s)   \u00b7   \u2191 \u2193 choose   \u00b7   Enter runs it   \u00b7   Esc closes",
           nullptr, model_->rowCount()));
}

void Palette::move(int rows) {
  const int count = model_->rowCount();
  if (count == 0) return;
  const int now = list_->currentIndex().row();
  // One step goes round; a page stops at the ends.
  const int next = std::abs(rows) == 1 ? (now + rows + count) % count : std::clamp(now + rows, 0, count - 1);
  list_->setCurrentIndex(model_->index(next, 0));
}

void Palette::run(int row) {
  if (row < 0 || row >= model_->rowCount()) return;
  QAction* action = model_->line(row).command->action;
  if (!action->isEnabled()) return;  // the line says why
  close();
  // Once the keyboard is where it was, and outside of this event: the command may show a dialog.
  QMetaObject::invokeMethod(action, &QAction::trigger, Qt::QueuedConnection);
}

bool Palette::take_key(int key) {
  switch (key) {
    case Qt::Key_Escape:
      close();
      return true;
    case Qt::Key_Up:
      move(-1);
      return true;
    case Qt::Key_Down:
      move(1);
      return true;
    case Qt::Key_PageUp:
      move(-rows_shown);
      return true;
    case Qt::Key_PageDown:
      move(rows_shown);
      return true;
    case Qt::Key_Return:
    case Qt::Key_Enter:
      run(list_->currentIndex().row());
      return true;
    case Qt::Key_Tab:
    case Qt::Key_Backtab:
      return true;  // there is one place for the keyboard
    default:
      return false;
  }
}

bool Palette::eventFilter(QObject* object, QEvent* event) {
  if (object == line_ && event->type() == QEvent::KeyPress)
    return take_key(static_cast<QKeyEvent*>(event)->key());
  return QFrame::eventFilter(object, event);
}

}  // namespace ostia::workstation
