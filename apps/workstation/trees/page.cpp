#include "trees/page.h"

#include "commands/table.h"
#include "shell/desk.h"
#include "shell/file_dialogs.h"

#include "ostia/core/files.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMainWindow>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

constexpr int panel_width = 390;

const char* const button_commands[] = {"tree.select", "tree.straight", "tree.along",   "tree.angle",
                                       "tree.region", "tree.grid",     "tree.subtree", "tree.fit",
                                       "tree.copy",   "tree.export",   "tree.clear",   "tree.close"};

QTableWidgetItem* cell(const QString& text) {
  auto* made = new QTableWidgetItem(text);
  made->setFlags(Qt::ItemIsSelectable | Qt::ItemIsEnabled);
  return made;
}

}  // namespace

TreePage::TreePage(Desk& desk, QMainWindow& window, const CommandTable& commands, OpenTree tree)
    : OverViews(window), desk_(desk), commands_(commands), tree_(std::move(tree)), measuring_(tree_.ruler) {
  setObjectName("tree_page");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  view_ = new TreeView(tree_.blocks, tree_.rays);
  row->addWidget(view_, 1);
  row->addWidget(build_panel());
  connect(view_, &TreeView::clicked, this, &TreePage::click);
  show_facts();
  show();
  view_->setFocus();
}

TreePage::~TreePage() = default;

QWidget* TreePage::build_panel() {
  auto* panel = new QWidget;
  panel->setFixedWidth(panel_width);
  auto* rows = new QVBoxLayout(panel);
  auto* buttons = new QGridLayout;
  int number = 0;
  for (const char* id : button_commands) {
    buttons->addWidget(command_button(commands_, id), number / 2, number % 2);
    ++number;
  }
  rows->addLayout(buttons);
  auto* region = new QHBoxLayout;
  auto* label = new QLabel(tr("Radius of a region"));
  radius_ = new QDoubleSpinBox;
  radius_->setObjectName("tree_region_radius");
  radius_->setDecimals(3);
  radius_->setRange(0.001, 1000.0);
  radius_->setSuffix(tr(" mm"));
  radius_->setAccessibleName(label->text());
  radius_->setValue(measuring_.region_radius_mm);
  label->setBuddy(radius_);
  connect(radius_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this](double value) { measuring_.region_radius_mm = value; });
  region->addWidget(label);
  region->addWidget(radius_, 1);
  rows->addLayout(region);
  facts_ = new QLabel;
  facts_->setObjectName("tree_facts");
  facts_->setWordWrap(true);
  facts_->setTextFormat(Qt::PlainText);
  facts_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  facts_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  rows->addWidget(facts_, 1);
  table_ = new QTableWidget(0, 2);
  table_->setObjectName("tree_measured");
  table_->setHorizontalHeaderLabels({tr("Measured"), tr("Value")});
  table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setStretchLastSection(true);
  table_->verticalHeader()->hide();
  table_->setAccessibleName(tr("Measured values"));
  rows->addWidget(table_, 1);
  return panel;
}

void TreePage::choose(TreeTool tool) {
  measuring_.choose(tool);
  show_marks();
}

void TreePage::show_grid(bool shown) {
  view_->set_grid(shown);
}

void TreePage::show_subtree(bool only) {
  if (only && (chosen_ < 0 || !tree_.ruler->report())) {
    desk_.messages.say(chosen_ < 0 ? tr("Click a segment first: what lies behind it is then shown alone.")
                                   : QString::fromStdString(tree_.ruler->why_no_tree()));
    commands_.action("tree.subtree").setChecked(false);
    only = false;
  }
  view_->set_shown(only ? tree_.ruler->subtree(chosen_) : std::vector<std::uint8_t>());
}

void TreePage::fit() {
  view_->fit();
}

void TreePage::clear() {
  measuring_.clear();
  show_measured();
  show_marks();
}

void TreePage::copy() const {
  QApplication::clipboard()->setText(QString::fromStdString(measured_csv(measuring_.measured())));
}

void TreePage::export_csv() {
  const QString chosen = ask_save_file(&window_, tr("Save the measured values as"), tr("Tables (*.csv)"));
  if (chosen.isEmpty()) return;
  core::write_file(chosen.toStdString(), measured_csv(measuring_.measured()));
}

void TreePage::click(const QPointF& at) {
  desk_.messages.guarded([&] {
    const auto hit = view_->under(at);
    if (!hit) {
      if (measuring_.tool() == TreeTool::select) choose_segment(-1);
      return;
    }
    choose_segment(hit->place.edge);
    if (measuring_.click(*hit)) show_measured();
  });
  show_marks();
}

void TreePage::choose_segment(std::int32_t edge) {
  chosen_ = edge;
  view_->set_highlight(edge);
  show_facts();
}

void TreePage::show_measured() {
  const auto& all = measuring_.measured();
  table_->setRowCount(static_cast<int>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int row = static_cast<int>(i);
    const QAction& command =
        commands_.action(QString::fromLatin1(button_commands[static_cast<int>(all[i].tool)]));
    table_->setItem(row, 0, cell(command.text().remove('&')));
    table_->setItem(row, 1, cell(text_of(all[i])));
  }
  table_->scrollToBottom();
}

void TreePage::show_marks() {
  std::vector<TreeMark> marks;
  for (const TreeMeasured& one : measuring_.measured()) marks.push_back({one.points, text_of(one)});
  if (chosen_ >= 0)
    marks.push_back({{tree_.ruler->point({chosen_, 0.5})},
                     QString::fromStdString(tree_.reference_name) + ' ' +
                         QString::number(tree_.ruler->facts(chosen_).reference)});
  for (const analysis::TreeRayHit& hit : measuring_.clicked()) marks.push_back({{hit.surface}, {}});
  view_->set_marks(std::move(marks));
}

}  // namespace ostia::workstation
