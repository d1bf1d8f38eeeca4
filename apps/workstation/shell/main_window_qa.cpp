#include "qa/panel.h"
#include "shell/main_window.h"

#include <QAction>

namespace ostia::workstation {

QAction* MainWindow::build_qa() {
  const Guard loud = [this](const std::function<void()>& act) { guarded(act, true); };
  qa_ = std::make_shared<QaPanel>(bench_, pictures_, *scene_, *jobs_, loud, this);
  connect(qa_.get(), &QaPanel::said, this, &MainWindow::say);
  connect(qa_.get(), &QaPanel::refused, this,
          [this](const QString& why) { complain(why, tr("The truth cannot be opened")); });
  addDockWidget(Qt::RightDockWidgetArea, qa_.get());
  qa_->hide();
  QAction* made = qa_->toggleViewAction();
  made->setText(tr("&QA mode"));
  made->setObjectName("view.qa");
  actions_["view.qa"] = made;
  return made;
}

}  // namespace ostia::workstation
