#include "trees/opening.h"

#include "commands/table.h"
#include "shell/desk.h"

#include "ostia/core/error.h"
#include "ostia/geometry/graph_repair.h"
#include "ostia/geometry/graph_units.h"

#include <QMessageBox>
#include <QPushButton>

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

struct ReadTree {
  std::shared_ptr<const io::LoadedGraph> loaded;
  std::string faults;  ///< empty: none that a tree, or several, must not have
  bool usable = true;  ///< even without repair
};

ReadTree read(const fs::path& path, const core::TaskContext& task) {
  const auto loaded = std::make_shared<const io::LoadedGraph>(io::read_graph(path, task.sub(0.0, 0.8)));
  const geometry::GraphFaults faults = geometry::find_faults(loaded->graph, task.sub(0.8, 1.0));
  ReadTree made{loaded, {}, faults.count(geometry::GraphFaultKind::index_out_of_range) == 0};
  if (!faults.sound_trees()) made.faults = geometry::summary(faults, loaded->graph, loaded->reference_name);
  return made;
}

OpenTree prepared(const io::LoadedGraph& loaded, bool repair, const core::TaskContext& task) {
  OpenTree tree;
  tree.reference_name = loaded.reference_name.empty() ? "segment" : loaded.reference_name;
  geometry::VesselGraph graph = loaded.graph;
  if (repair) {
    geometry::RepairedGraph mended = geometry::repaired(std::move(graph), {}, task.sub(0.0, 0.3));
    for (const geometry::GraphRepairStep& step : mended.steps)
      tree.notes += (tree.notes.empty() ? "" : "\n") + step.text;
    graph = std::move(mended.graph);
  }
  tree.graph = std::make_shared<const geometry::VesselGraph>(std::move(graph));
  tree.ruler = std::make_shared<const analysis::TreeRuler>(tree.graph, task.sub(0.3, 0.8));
  tree.rays = std::make_shared<const analysis::TreeRays>(tree.graph, task.sub(0.8, 0.9));
  tree.blocks = std::make_shared<const geometry::SegmentBlocks>(*tree.graph, task.sub(0.9, 1.0));
  for (const std::string& note :
       {tree.ruler->why_no_tree(), geometry::unit_doubt(geometry::facts_of(*tree.graph))})
    if (!note.empty()) tree.notes += (tree.notes.empty() ? "" : "\n") + note;
  return tree;
}

}  // namespace

bool TreeOpening::takes(const fs::path& path) {
  try {
    return fs::is_regular_file(path) && io::is_graph_file(path);
  } catch (const std::exception&) {
    return false;  // whoever opens it says what is wrong
  }
}

void TreeOpening::open(const fs::path& path) {
  desk_.jobs.run(
      "open", tr("Reading the vessel tree"),
      [path](const core::TaskContext& task) { return std::any(read(path, task)); },
      [this, path](const std::any& result) {
        const auto& made = std::any_cast<const ReadTree&>(result);
        for (const std::string& warning : made.loaded->warnings)
          desk_.messages.say(QString::fromStdString(warning));
        if (made.faults.empty())
          prepare(made.loaded, path, {}, false);
        else
          ask(made.loaded, path, QString::fromStdString(made.faults), made.usable);
      },
      [this](const QString& message) { desk_.messages.complain(message, tr("The tree cannot be opened")); });
}

void TreeOpening::ask(const std::shared_ptr<const io::LoadedGraph>& loaded, const fs::path& path,
                      const QString& faults, bool usable) {
  auto* box = new QMessageBox(QMessageBox::Question, tr("Faults in the tree"),
                              tr("%1 has faults: %2.\n\nA repair changes what is shown, never the file.")
                                  .arg(QString::fromStdString(path.filename().string()), faults),
                              QMessageBox::NoButton, &desk_.window);
  box->setObjectName("tree_faults");
  box->setAttribute(Qt::WA_DeleteOnClose);
  const QAbstractButton* mend = box->addButton(tr("Repair and open"), QMessageBox::AcceptRole);
  const QAbstractButton* as_is =
      usable ? box->addButton(tr("Open as it is"), QMessageBox::AcceptRole) : nullptr;
  box->addButton(QMessageBox::Cancel);
  connect(box, &QMessageBox::buttonClicked, this,
          [this, loaded, path, mend, as_is, text = faults.toStdString()](QAbstractButton* button) {
            if (button == mend) prepare(loaded, path, text, true);
            if (as_is && button == as_is) prepare(loaded, path, text, false);
          });
  box->open();
}

void TreeOpening::prepare(const std::shared_ptr<const io::LoadedGraph>& loaded, const fs::path& path,
                          const std::string& faults, bool repair) {
  desk_.jobs.run(
      "open", tr("Measuring the vessel tree"),
      [loaded, repair](const core::TaskContext& task) { return std::any(prepared(*loaded, repair, task)); },
      [this, path, faults, repair](const std::any& result) {
        OpenTree tree = std::any_cast<const OpenTree&>(result);
        tree.name = path.filename().string();
        if (!repair && !faults.empty()) tree.notes = faults;
        close();
        page_ = new TreePage(desk_, window_, commands_, std::move(tree));
      },
      [this](const QString& message) { desk_.messages.complain(message, tr("The tree cannot be opened")); });
}

void TreeOpening::close() {
  if (!page_) return;
  delete page_.data();
  for (const char* id : {"tree.grid", "tree.subtree"}) commands_.action(id).setChecked(false);
  commands_.action("tree.select").setChecked(true);
}

void TreeOpening::with_page(const std::function<void(TreePage&)>& act) {
  if (page_)
    act(*page_);
  else
    desk_.messages.say(tr("No vessel tree is open: open a file of one first."));
}

}  // namespace ostia::workstation
