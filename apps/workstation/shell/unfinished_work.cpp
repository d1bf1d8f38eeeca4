#include "shell/unfinished_work.h"

#include "shell/jobs.h"

#include <QMessageBox>
#include <QPushButton>
#include <utility>

namespace ostia::workstation {

bool may_be_left(const Jobs& jobs, QWidget* parent) {
  QStringList unfinished;
  for (const auto& [kind, title] : {std::pair("report", Jobs::tr("the report")),
                                    {"surface", Jobs::tr("the surface")},
                                    {"mesh", Jobs::tr("the mesh")},
                                    {"flow_case", Jobs::tr("the flow case")},
                                    {"flow_run", Jobs::tr("the solver's run")}})
    if (jobs.running(kind)) unfinished << title;
  if (unfinished.isEmpty()) return true;
  QMessageBox box(QMessageBox::Question, QStringLiteral("Ostia"),
                  Jobs::tr("Not finished yet: %1. It is lost if the window closes now; the case is safe.")
                      .arg(unfinished.join(QStringLiteral(", "))),
                  QMessageBox::NoButton, parent);
  box.setObjectName("unfinished");
  const QAbstractButton* close_now =
      box.addButton(Jobs::tr("Close all the same"), QMessageBox::DestructiveRole);
  box.setDefaultButton(box.addButton(Jobs::tr("Go on working"), QMessageBox::RejectRole));
  box.exec();
  return box.clickedButton() == close_now;
}

}  // namespace ostia::workstation
