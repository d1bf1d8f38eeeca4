#include "layout_faults.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractScrollArea>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMenuBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QSizeGrip>
#include <QSplitterHandle>
#include <QStyleOptionButton>
#include <QStyleOptionComboBox>
#include <QTabBar>
#include <QTextDocument>
#include <QToolButton>
#include <QTreeView>
#include <algorithm>

namespace ostia::workstation::testing {
namespace {

QString plain(QString text) {
  if (Qt::mightBeRichText(text)) {
    QTextDocument document;
    document.setHtml(text);
    text = document.toPlainText();
  }
  return text.remove(QRegularExpression(QStringLiteral("&(?=\\w)")));
}

QString called(const QWidget& widget) {
  QString name = widget.metaObject()->className();
  if (!widget.objectName().isEmpty()) name += ' ' + widget.objectName();
  const QVariant text = widget.property("text");
  if (text.isValid() && !text.toString().isEmpty()) name += " \"" + text.toString().left(40) + '"';
  for (const QWidget* at = widget.parentWidget(); at && !at->isWindow(); at = at->parentWidget())
    if (!at->objectName().isEmpty()) return name + " in " + at->objectName();
  return name;
}

class Look {
 public:
  explicit Look(const QWidget& window) : window_(window) {}

  void at(const QWidget& widget) {
    texts(widget);
    place(widget);
    neighbours(widget);
  }
  QStringList faults;

 private:
  static int wide(const QWidget& widget, const QString& text) {
    return widget.fontMetrics().size(Qt::TextShowMnemonic, text).width();
  }
  void fits(const QWidget& widget, const QString& text, int room, const QString& tip = {}) {
    const int needed = wide(widget, text);
    if (needed <= room || (!tip.isEmpty() && tip.contains(plain(text)))) return;
    faults
        << QStringLiteral("%1: \"%2\" needs %3 and has %4").arg(called(widget), text).arg(needed).arg(room);
  }

  void texts(const QWidget& widget) {
    if (const auto* label = qobject_cast<const QLabel*>(&widget)) of_label(*label);
    if (const auto* button = qobject_cast<const QAbstractButton*>(&widget)) of_button(*button);
    if (const auto* box = qobject_cast<const QComboBox*>(&widget)) of_combo(*box);
    if (const auto* bar = qobject_cast<const QTabBar*>(&widget)) of_tabs(*bar);
    if (const auto* spin = qobject_cast<const QAbstractSpinBox*>(&widget)) of_spin(*spin);
    if (const auto* header = qobject_cast<const QHeaderView*>(&widget)) of_header(*header);
    if (const auto* tree = qobject_cast<const QTreeView*>(&widget)) of_items(*tree);
    if (const auto* list = qobject_cast<const QListView*>(&widget)) of_items(*list);
    if (const auto* menus = qobject_cast<const QMenuBar*>(&widget)) of_menus(*menus);
  }

  void of_label(const QLabel& label) {
    if (label.text().isEmpty()) return;
    const QRect room = label.contentsRect();
    const int needed_height =
        label.hasHeightForWidth() ? label.heightForWidth(label.width()) : label.sizeHint().height();
    if (needed_height > label.height())
      faults << QStringLiteral("%1 needs a height of %2 and has %3")
                    .arg(called(label))
                    .arg(needed_height)
                    .arg(label.height());
    if (!label.wordWrap()) {
      int longest = 0;
      for (const QString& line : plain(label.text()).split('\n'))
        longest = std::max(longest, wide(label, line));
      if (longest > room.width() && label.toolTip().isEmpty())
        faults << QStringLiteral("%1 needs %2 and has %3").arg(called(label)).arg(longest).arg(room.width());
      return;
    }
    for (const QString& word : plain(label.text()).split(QRegularExpression("\\s")))
      fits(label, word, room.width());
  }

  void of_button(const QAbstractButton& button) {
    if (button.text().isEmpty()) return;
    if (const auto* tool = qobject_cast<const QToolButton*>(&button)) {
      if (tool->toolButtonStyle() == Qt::ToolButtonIconOnly && !tool->icon().isNull()) return;
      fits(button, button.text(), button.width());
      return;
    }
    QStyleOptionButton option;
    option.initFrom(&button);
    option.text = button.text();
    QStyle::SubElement where = QStyle::SE_PushButtonContents;
    if (button.inherits("QCheckBox")) where = QStyle::SE_CheckBoxContents;
    if (button.inherits("QRadioButton")) where = QStyle::SE_RadioButtonContents;
    fits(button, button.text(), button.style()->subElementRect(where, &option, &button).width());
    if (button.fontMetrics().height() > button.height())
      faults << QStringLiteral("%1 is lower than its text").arg(called(button));
  }

  void of_combo(const QComboBox& box) {
    QStyleOptionComboBox option;
    option.initFrom(&box);
    option.editable = box.isEditable();
    const int room =
        box.style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, &box).width();
    for (int i = 0; i < box.count(); ++i) fits(box, box.itemText(i), room);
  }

  void of_tabs(const QTabBar& bar) {
    for (int i = 0; i < bar.count(); ++i) {
      if (!bar.isTabVisible(i)) continue;
      fits(bar, bar.tabText(i), bar.tabRect(i).width() - 8);
      if (!bar.rect().contains(bar.tabRect(i)))
        faults << QStringLiteral("%1: the tab \"%2\" is outside").arg(called(bar), bar.tabText(i));
    }
  }

  void of_spin(const QAbstractSpinBox& spin) {
    const auto* line = spin.findChild<const QLineEdit*>();
    if (line) fits(spin, line->text(), line->width());
  }

  void of_header(const QHeaderView& header) {
    const QAbstractItemModel* model = header.model();
    if (!model || header.orientation() != Qt::Horizontal) return;
    for (int i = 0; i < header.count(); ++i) {
      if (header.isSectionHidden(i)) continue;
      const QString title = model->headerData(i, Qt::Horizontal).toString();
      fits(header, title, header.sectionSize(i) - 4,
           model->headerData(i, Qt::Horizontal, Qt::ToolTipRole).toString());
    }
  }

  void of_items(const QTreeView& view) {
    const QAbstractItemModel* model = view.model();
    if (!model) return;
    for (QModelIndex row = view.indexAt(QPoint(2, 2)); row.isValid(); row = view.indexBelow(row))
      for (int column = 0; column < model->columnCount(); ++column)
        of_entry(view, row.sibling(row.row(), column), view.wordWrap());
  }
  void of_items(const QListView& view) {
    const QAbstractItemModel* model = view.model();
    for (int row = 0; model && row < model->rowCount(); ++row)
      of_entry(view, model->index(row, 0), view.wordWrap());
  }
  void of_entry(const QAbstractItemView& view, const QModelIndex& at, bool wraps) {
    const QString text = at.data().toString();
    const QRect cell = view.visualRect(at);
    if (text.isEmpty() || wraps || !view.viewport()->rect().intersects(cell)) return;
    const auto* tree = qobject_cast<const QTreeView*>(&view);
    if (tree && tree->isFirstColumnSpanned(at.row(), at.parent())) return;
    const int needed = view.itemDelegate(at)->sizeHint(option_of(view), at).width();
    if (needed <= cell.width() || at.data(Qt::ToolTipRole).toString().contains(text)) return;
    faults << QStringLiteral("%1: the entry \"%2\" needs %3 and has %4")
                  .arg(called(view), text)
                  .arg(needed)
                  .arg(cell.width());
  }
  static QStyleOptionViewItem option_of(const QAbstractItemView& view) {
    QStyleOptionViewItem option;
    option.initFrom(&view);
    option.font = view.font();
    option.fontMetrics = view.fontMetrics();
    option.decorationSize = view.iconSize().isValid() ? view.iconSize() : QSize(16, 16);
    return option;
  }

  void of_menus(const QMenuBar& menus) {
    for (QAction* action : menus.actions())
      if (action->isVisible() && !menus.rect().contains(menus.actionGeometry(action)))
        faults << QStringLiteral("the menu \"%1\" is outside of its bar").arg(action->text());
  }

  /// Nothing of it may be cut off by its window, except where one can scroll there.
  void place(const QWidget& widget) {
    for (const QWidget* at = widget.parentWidget(); at; at = at->parentWidget()) {
      if (qobject_cast<const QAbstractScrollArea*>(at)) return;
      if (at == &window_) break;
    }
    const QRect where(widget.mapTo(&window_, QPoint(0, 0)), widget.size());
    if (!window_.rect().contains(where))
      faults << QStringLiteral("%1 is cut off by the window").arg(called(widget));
    else if (widget.parentWidget() && !widget.parentWidget()->rect().contains(widget.geometry()) &&
             !of_the_style(widget))
      faults << QStringLiteral("%1 is cut off by what it stands in").arg(called(widget));
  }

  static bool of_the_style(const QWidget& widget) {
    return qobject_cast<const QSplitterHandle*>(&widget) || qobject_cast<const QSizeGrip*>(&widget);
  }
  /// Lies over the window on purpose.
  static bool floats(const QWidget& widget) {
    return of_the_style(widget) || widget.inherits("ostia::workstation::Tour") ||
           widget.inherits("ostia::workstation::TourRing") || widget.inherits("ostia::workstation::Card") ||
           widget.inherits("QRubberBand") || widget.inherits("QFocusFrame");
  }
  void neighbours(const QWidget& widget) {
    if (qobject_cast<const QAbstractScrollArea*>(&widget) || qobject_cast<const QAbstractSpinBox*>(&widget) ||
        qobject_cast<const QComboBox*>(&widget) || qobject_cast<const QLineEdit*>(&widget))
      return;  // the style puts their parts together
    QList<const QWidget*> shown;
    for (const QObject* one : widget.children())
      if (const auto* part = qobject_cast<const QWidget*>(one);
          part && part->isVisible() && !part->isWindow() && !floats(*part))
        shown << part;
    for (int i = 0; i < shown.size(); ++i)
      for (int j = i + 1; j < shown.size(); ++j)
        if (shown[i]->geometry().intersects(shown[j]->geometry()))
          faults << QStringLiteral("%1 lies over %2").arg(called(*shown[j]), called(*shown[i]));
  }

  const QWidget& window_;
};

}  // namespace

QStringList layout_faults(const QWidget& window) {
  Look look(window);
  look.at(window);
  for (const QWidget* widget : window.findChildren<const QWidget*>())
    if (widget->isVisible() && widget->window() == &window) look.at(*widget);
  look.faults.removeDuplicates();
  return look.faults;
}

}  // namespace ostia::workstation::testing
