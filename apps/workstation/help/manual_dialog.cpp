#include "help/manual_dialog.h"

#include "shell/hanging.h"

#include <QApplication>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QImage>
#include <QListWidget>
#include <QPushButton>
#include <QScrollBar>
#include <QSplitter>
#include <QTextBrowser>
#include <QUrl>
#include <QVBoxLayout>
#include <array>

// Outside of any namespace: what rcc makes is there.
static void init_manual() {
  Q_INIT_RESOURCE(ostia_help);
}

namespace ostia::workstation {
namespace {

struct Page {
  const char *file, *title;
};
constexpr std::array pages{Page{"index.md", QT_TRANSLATE_NOOP("manual", "Beginning")},
                           Page{"clinician.md", QT_TRANSLATE_NOOP("manual", "From DICOM to a report")},
                           Page{"window.md", QT_TRANSLATE_NOOP("manual", "The window")},
                           Page{"editing.md", QT_TRANSLATE_NOOP("manual", "Editing the lumen")},
                           Page{"measuring.md", QT_TRANSLATE_NOOP("manual", "Measuring")},
                           Page{"report.md", QT_TRANSLATE_NOOP("manual", "Report and export")},
                           Page{"pacs.md", QT_TRANSLATE_NOOP("manual", "PACS")},
                           Page{"calcium.md", QT_TRANSLATE_NOOP("manual", "Calcium score")},
                           Page{"fat.md", QT_TRANSLATE_NOOP("manual", "Fat around the arteries")},
                           Page{"comparison.md", QT_TRANSLATE_NOOP("manual", "Compared with the last scan")},
                           Page{"researcher.md", QT_TRANSLATE_NOOP("manual", "For researchers")},
                           Page{"qa.md", QT_TRANSLATE_NOOP("manual", "Quality mode")},
                           Page{"keys.md", QT_TRANSLATE_NOOP("manual", "Keys and mouse")},
                           Page{"trouble.md", QT_TRANSLATE_NOOP("manual", "When something is wrong")}};

/// Pictures no wider than the page.
class Reader final : public QTextBrowser {
 public:
  using QTextBrowser::QTextBrowser;
  QVariant loadResource(int type, const QUrl& name) override {
    const QVariant found = QTextBrowser::loadResource(type, name);
    if (type != QTextDocument::ImageResource) return found;
    QImage picture;
    if (!picture.loadFromData(found.toByteArray())) return found;
    const int widest = std::max(200, viewport()->width() - 40);
    return picture.width() > widest ? picture.scaledToWidth(widest, Qt::SmoothTransformation) : picture;
  }
};

}  // namespace

QString manual_folder() {
  init_manual();
  const QString folder = QApplication::applicationDirPath() + "/../share/ostia/manual";
  if (QFileInfo::exists(folder + "/index.md")) return QFileInfo(folder).canonicalFilePath();
  return QStringLiteral(":/manual");
}

ManualDialog::ManualDialog(QWidget* parent) : QDialog(parent) {
  setObjectName("manual");
  setWindowTitle(tr("Manual"));
  resize_within(*this, QSize(1080, 760));
  auto* contents = new QListWidget;
  contents->setObjectName("contents");
  contents->setAccessibleName(tr("Contents"));
  contents->setToolTip(tr("The manual's pages"));
  auto* reader = new Reader;
  reader->setObjectName("page");
  reader->setAccessibleName(tr("Page of the manual"));
  const QString folder = manual_folder();
  const auto url = [folder](const QString& file) {
    return folder.startsWith(':') ? QUrl("qrc" + folder + '/' + file)
                                  : QUrl::fromLocalFile(folder + '/' + file);
  };
  for (const Page& page : pages) {
    auto* item = new QListWidgetItem(QCoreApplication::translate("manual", page.title), contents);
    item->setData(Qt::UserRole, QString(page.file));
  }
  connect(contents, &QListWidget::currentItemChanged, reader, [reader, url](QListWidgetItem* item) {
    const QUrl wanted = url(item->data(Qt::UserRole).toString());
    if (reader->source().adjusted(QUrl::RemoveFragment) != wanted) reader->setSource(wanted);
  });
  // A link followed in the text moves the list's mark.
  connect(reader, &QTextBrowser::sourceChanged, contents, [contents](const QUrl& now) {
    for (int i = 0; i < contents->count(); ++i)
      if (contents->item(i)->data(Qt::UserRole).toString() == now.fileName()) contents->setCurrentRow(i);
  });
  auto* split = new QSplitter;
  split->addWidget(contents);
  split->addWidget(reader);
  split->setSizes({230, 850});
  split->setStretchFactor(0, 0);
  split->setStretchFactor(1, 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  auto* back = buttons->addButton(tr("Back"), QDialogButtonBox::ActionRole);
  back->setToolTip(tr("The page before"));
  back->setEnabled(false);
  connect(back, &QPushButton::clicked, reader, &QTextBrowser::backward);
  connect(reader, &QTextBrowser::backwardAvailable, back, &QPushButton::setEnabled);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(split, 1);
  layout->addWidget(buttons);
  contents->setCurrentRow(0);
}

}  // namespace ostia::workstation
