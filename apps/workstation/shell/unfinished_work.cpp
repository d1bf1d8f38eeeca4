#include "shell/unfinished_work.h"

#include "shell/main_window.h"

#include <QMessageBox>
#include <QPushButton>
#include <utility>

namespace ostia::workstation {

bool may_be_left(const Jobs& jobs, QWidget* parent) {
  QStringList unfinished;
  for (const auto& [kind, title] : {std::pair("report", MainWindow::tr("the report")),
                                    {"surface", MainWindow::tr("the surface")},
                                    {"mesh", MainWindow::tr("the mesh")},
                                    {"flow_case", MainWindow::tr("the flow case")},
                                    {"flow_run", MainWindow::tr("the solver's run")}})
    if (jobs.running(kind)) unfinished << title;
  if (unfinished.isEmpty()) return true;
  QMessageBox box(
      QMessageBox::Question, QStringLiteral("Ostia"),
      MainWindow::tr("Not finished yet: %1. It is lost if the window closes now; the case is safe.")
          .arg(unfinished.join(QStringLiteral(", "))),
      QMessageBox::NoButton, parent);
  box.setObjectName("unfinished");
  const QAbstractButton* close_now =
      box.addButton(MainWindow::tr("Close all the same"), QMessageBox::DestructiveRole);
  box.setDefaultButton(box.addButton(MainWindow::tr("Go on working"), QMessageBox::RejectRole));
  box.exec();
  return box.clickedButton() == close_now;
}

}  // namespace ostia::workstation
