#include "help/about_dialog.h"

#include <vtkVersion.h>

#include <QApplication>
#include <QDialogButtonBox>
#include <QLabel>
#include <QTextBrowser>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

QString libraries() {
  return AboutDialog::
      tr("<p>It is built with Qt %1 (LGPL-3), VTK %2 (BSD-3), CGAL (GPL-3 and LGPL-3), TetGen (AGPL-3, in "
         "the worker), CHOLMOD (GPL-2 or later), GDCM (BSD-3, in the worker), SQLite (public domain), "
         "Eigen (MPL-2), TBB, Embree and OpenSSL (Apache-2.0), Cairo and Pango (LGPL-2.1), libzip "
         "and ISA-L (BSD-3), zlib, spdlog, fmt, nlohmann-json and nanoflann.</p>")
          .arg(QString::fromLatin1(qVersion()), QString::fromLatin1(vtkVersion::GetVTKVersion()));
}

}  // namespace

AboutDialog::AboutDialog(QWidget* parent) : QDialog(parent) {
  setObjectName("about");
  setWindowTitle(tr("About Ostia"));
  auto* text = new QTextBrowser(this);
  text->setAccessibleName(tr("About Ostia"));
  text->setOpenLinks(false);
  text->setHtml(
      tr("<h2>Ostia %1</h2><p>The coronary modelling workstation.</p>")
          .arg(QApplication::applicationVersion()) +
      tr("<p><b>Research software, not a medical device.</b> It has no approval of any authority. Nothing "
         "that it shows or measures may be the ground of a diagnosis or a treatment.</p>") +
      tr("<p>Ostia's own sources are under the Apache License 2.0. The program as it is built and handed on "
         "contains libraries under stricter licences and is as a whole under the GNU Affero General Public "
         "License 3 (AGPL-3): whoever gets it has a right to all of its sources.</p>") +
      libraries() +
      tr("<p>The editing of the lumen follows Wels et al., which is the subject of the patent application "
         "EP 16170187.5; look into its state before commercial use. Details: docs/licences.md.</p>"));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(text, 1);
  layout->addWidget(buttons);
  resize(560, 480);
}

}  // namespace ostia::workstation
