#include "shell/tool_bars.h"

#include "commands/table.h"
#include "shell/bind.h"
#include "shell/desk.h"
#include "shell/tool_bar_fit.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLayout>
#include <QMainWindow>
#include <QToolBar>

namespace ostia::workstation {
namespace {

class SizesBar {
  Q_DECLARE_TR_FUNCTIONS(ostia::workstation::ToolBars)
 public:
  SizesBar(QToolBar& bar, session::Workbench& bench) : bar_(bar) {
    add(tr("Reach"), tr("How far along the vessel a pull reaches"), "reach", bench.reach_mm);
    add(tr("Ball"), tr("Radius of the brush"), "ball", bench.brush_mm);
    add(tr("Slab"), tr("Thickness of the slab in 2D views, where one is shown"), "slab", bench.slab_mm);
  }
  static QString title() { return tr("Options"); }
  static QString title_of_tools() { return tr("Tools"); }

 private:
  void add(const QString& text, const QString& tip, const QString& name,
           session::Property<double>& property) {
    auto* pair = new QWidget;  // where there is no room for the box its name goes with it
    auto* row = new QHBoxLayout(pair);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(bar_.layout()->spacing());
    auto* label = new QLabel(" " + text + " ");
    auto* box = new QDoubleSpinBox;
    box->setObjectName(name);
    box->setAccessibleName(text);
    box->setToolTip(tip);
    box->setDecimals(1);
    box->setSuffix(tr(" mm"));
    box->setFocusPolicy(Qt::ClickFocus);
    label->setBuddy(box);
    bind(box, property);
    row->addWidget(label);
    row->addWidget(box);
    bar_.addWidget(pair);
  }
  QToolBar& bar_;
};

QToolBar* fixed_bar(QMainWindow& window, const QString& title, const QString& name) {
  QToolBar* bar = window.addToolBar(title);
  bar->setObjectName(name);
  bar->setMovable(false);
  return bar;
}

}  // namespace

void build_tool_bars(QMainWindow& window, const CommandTable& commands, Desk& desk) {
  QToolBar* tools = fixed_bar(window, SizesBar::title_of_tools(), "tools");
  for (const char* id : {"edit.undo",
                         "edit.redo",
                         "",
                         "tool.browse",
                         "",
                         "tool.drag",
                         "tool.draw",
                         "tool.brush",
                         "tool.axis",
                         "tool.add_vessel",
                         "tool.add_artery",
                         "",
                         "tool.distance",
                         "tool.angle",
                         "tool.area",
                         "tool.diameter",
                         "tool.stenosis",
                         "tool.volume",
                         "tool.ring_hu",
                         "tool.arrow",
                         "tool.note"}) {
    if (*id)
      tools->addAction(&commands.action(id));
    else
      tools->addSeparator();
  }
  QToolBar* options = fixed_bar(window, SizesBar::title(), "options");
  SizesBar(*options, desk.bench);
  new ToolBarFit(&window, tools, options);
}

}  // namespace ostia::workstation
