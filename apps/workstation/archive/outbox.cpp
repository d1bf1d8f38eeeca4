#include "archive/outbox.h"

#include "archive/keyring.h"
#include "archive/servers.h"
#include "opening/technique.h"
#include "shell/desk.h"
#include "shell/hanging.h"
#include "shell/jobs.h"
#include "shell/language.h"

#include "ostia/core/error.h"
#include "ostia/core/private_folder.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDate>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <any>
#include <utility>

namespace ostia::workstation {
namespace {

using session::DicomObjectKind;

const char* const outbox_job = "outbox";
const char* const objects_job = "objects";
enum QueueCells { what_cell, server_cell, state_cell, tries_cell, why_cell, queue_cells };
constexpr int item_role = Qt::UserRole, item_state_role = Qt::UserRole + 1;

/// What objects are made of, while the person goes on.
struct ObjectsWanted {
  std::filesystem::path case_file;
  session::KnownImage known;
  std::shared_ptr<const imaging::ImageVolume> image;
  session::DicomObjectsOptions options;
  std::string server;
};

dicom::SourceSeries source_of_image(const session::KnownImage& known, const core::TaskContext& task) {
  if (const auto series = series_of_image(known, task.sub(0.0, 0.5)))
    return dicom::source_of(*series, task.sub(0.5, 1.0));
  throw InvalidInput("the series of this case is not where it was; open it again");
}

void make_and_queue(const ObjectsWanted& wanted, pacs::SendQueue& queue, const core::TaskContext& task) {
  const session::CaseFile file = session::CaseFile::open(wanted.case_file, session::OpenMode::read_only);
  const dicom::SourceSeries source = source_of_image(wanted.known, task.sub(0.0, 0.2));
  const session::DicomObjects made =
      session::dicom_objects(file, source, wanted.image.get(), wanted.options, task.sub(0.2, 0.9));
  const core::PrivateFolder own;
  const std::filesystem::path folder = own.path() / "objects";
  session::write_dicom_objects(folder, made, source, task.sub(0.9, 1.0));
  for (const session::DicomObjectFile& one : made.objects)
    queue.add(folder / one.name, wanted.server, session::to_string(one.kind));
}

QString queue_word(pacs::QueueState state) {
  switch (state) {
    case pacs::QueueState::waiting:
      return OutboxDialog::tr("waiting");
    case pacs::QueueState::sent:
      return OutboxDialog::tr("sent");
    case pacs::QueueState::failed:
      break;
  }
  return OutboxDialog::tr("refused");
}

/// As people call it: "Segmentation".
QString object_word(const std::string& kind) {
  if (kind == session::to_string(DicomObjectKind::segmentation)) return SendDialog::tr("Segmentation");
  if (kind == session::to_string(DicomObjectKind::report)) return SendDialog::tr("Report (PDF)");
  if (kind == session::to_string(DicomObjectKind::surface)) return SendDialog::tr("Lumen's surface (STL)");
  if (kind == session::to_string(DicomObjectKind::measurements))
    return SendDialog::tr("Measurements (structured report)");
  if (kind == session::to_string(DicomObjectKind::images)) return SendDialog::tr("Key images");
  return kind.empty() ? SendDialog::tr("DICOM object") : QString::fromStdString(kind);
}

}  // namespace

Outbox::Outbox(Desk& desk, Keyring& keyring)
    : QObject(&desk.window), desk_(desk), keyring_(keyring), folder_(desk.state_folder / "outbox") {}

std::shared_ptr<pacs::SendQueue> Outbox::queue() {
  std::shared_ptr<pacs::SendQueue> now = queue_.lock();
  if (!now) queue_ = now = std::make_shared<pacs::SendQueue>(folder_);
  return now;
}

std::vector<pacs::QueueItem> Outbox::items() {
  std::error_code ignored;
  if (!std::filesystem::exists(folder_, ignored)) return {};
  return queue()->items();
}

bool Outbox::sending() const {
  return desk_.jobs.running(outbox_job);
}

void Outbox::send() {
  if (sending()) {
    send_again_ = true;
    return;
  }
  std::vector<pacs::ServerDescription> servers;
  const bool known = desk_.messages.guarded([&] { servers = known_servers(); }, true);
  if (!known) return;
  read_secrets(keyring_, servers, this, [this, servers](const std::vector<pacs::Secrets>& secrets) {
    desk_.messages.guarded([&] { send_as(servers, secrets); }, true);
  });
}

void Outbox::send_as(const std::vector<pacs::ServerDescription>& servers,
                     const std::vector<pacs::Secrets>& secrets) {
  send_again_ = sending();
  if (send_again_) return;
  desk_.jobs.run(
      outbox_job, tr("Sending to the PACS"),
      [queue = queue(), servers, secrets](const core::TaskContext& task) {
        queue->send_waiting(
            [&](const std::string& name) {
              const pacs::ServerDescription& server = pacs::server_named(servers, name);
              return pacs::open_archive(server, secrets[static_cast<std::size_t>(&server - servers.data())]);
            },
            task);
        return std::any(queue->items());
      },
      [this](const std::any& result) {
        if (send_again_) return send();
        int waiting = 0, refused = 0;
        for (const pacs::QueueItem& item : std::any_cast<const std::vector<pacs::QueueItem>&>(result)) {
          waiting += item.state == pacs::QueueState::waiting ? 1 : 0;
          refused += item.state == pacs::QueueState::failed ? 1 : 0;
        }
        if (waiting + refused == 0)
          desk_.messages.say(tr("All is sent to the PACS."));
        else
          desk_.messages.say(tr("Not sent: %1 wait, %2 were refused; File > PACS > Outbox says why.")
                                 .arg(waiting)
                                 .arg(refused));
        emit changed();
      },
      [this](const QString& message) {
        desk_.messages.complain(message, tr("The outbox was not sent"));
        emit changed();
      });
  emit changed();
}

void Outbox::retry(const std::string& id) {
  queue()->retry(id);
  emit changed();
}

void Outbox::remove(const std::string& id) {
  queue()->remove(id);
  emit changed();
}

QString Outbox::why_not() const {
  if (!desk_.bench.has_case()) return tr("No case is open.");
  const session::OpenImage& image = desk_.bench.image();
  if (!image.volume) return tr("The image of the case is not open.");
  const auto known = desk_.machine.find_image(image.reference.sha256);
  if (!known || known->series_uid.empty())
    return tr("The image of the case is no DICOM series: its objects would be nobody's.");
  if (!image.reference.axes.empty())
    return tr("The image is turned against its files: objects would lie elsewhere than in them.");
  return {};
}

void Outbox::send_case(const std::set<DicomObjectKind>& kinds, const std::string& server) {
  ObjectsWanted wanted;
  wanted.case_file = desk_.case_path;
  wanted.known = *desk_.machine.find_image(desk_.bench.image().reference.sha256);
  wanted.image = desk_.bench.image().volume;
  wanted.options.kinds = kinds;
  wanted.options.report.date = QDate::currentDate().toString(Qt::ISODate).toStdString();
  wanted.options.report.language = session::report_language(language_in_use().toStdString());
  wanted.server = server;
  std::shared_ptr<pacs::SendQueue> into;
  if (!desk_.messages.guarded([&] { into = queue(); }, true)) return;
  desk_.jobs.run(
      objects_job, tr("Making DICOM objects"),
      [wanted, into](const core::TaskContext& task) {
        make_and_queue(wanted, *into, task);
        return std::any(true);
      },
      [this](const std::any&) {
        emit changed();
        send();
      },
      [this](const QString& message) { desk_.messages.complain(message, tr("Nothing was sent")); });
}

OutboxDialog::OutboxDialog(Outbox& outbox, Desk& desk) : QDialog(&desk.window), outbox_(outbox), desk_(desk) {
  setObjectName("outbox");
  setWindowTitle(tr("Outbox"));
  resize_within(*this, QSize(820, 460));
  list_ = new QTreeWidget;
  list_->setObjectName("outbox_items");
  list_->setAccessibleName(tr("What is sent to the PACS"));
  list_->setHeaderLabels({tr("What"), tr("To"), tr("State"), tr("Tries"), tr("Why")});
  list_->setRootIsDecorated(false);
  list_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  list_->setAllColumnsShowFocus(true);
  list_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  said_ = new QLabel;
  said_->setObjectName("outbox_said");
  said_->setWordWrap(true);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  send_ = buttons->addButton(tr("&Send what waits"), QDialogButtonBox::ActionRole);
  send_->setObjectName("outbox_send");
  retry_ = buttons->addButton(tr("&Try again"), QDialogButtonBox::ActionRole);
  retry_->setObjectName("outbox_retry");
  remove_ = buttons->addButton(tr("&Remove"), QDialogButtonBox::ActionRole);
  remove_->setObjectName("outbox_remove");
  remove_->setToolTip(tr("Takes what is chosen out of the outbox; what was not sent is not sent any more."));
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(list_, 1);
  layout->addWidget(said_);
  layout->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(send_, &QPushButton::clicked, &outbox, &Outbox::send);
  connect(retry_, &QPushButton::clicked, this, [this] {
    desk_.messages.guarded(
        [this] {
          for (const std::string& id : chosen()) outbox_.retry(id);
        },
        true);
    outbox_.send();
  });
  connect(remove_, &QPushButton::clicked, this, [this] {
    desk_.messages.guarded(
        [this] {
          for (const std::string& id : chosen()) outbox_.remove(id);
        },
        true);
  });
  connect(list_, &QTreeWidget::itemSelectionChanged, this, &OutboxDialog::look_at_chosen);
  connect(&outbox, &Outbox::changed, this, &OutboxDialog::fill);
  connect(&desk.jobs, &Jobs::changed, this, &OutboxDialog::fill);
  fill();
}

std::vector<std::string> OutboxDialog::chosen() const {
  std::vector<std::string> ids;
  for (const QTreeWidgetItem* item : list_->selectedItems())
    ids.push_back(item->data(what_cell, item_role).toString().toStdString());
  return ids;
}

void OutboxDialog::fill() {
  const std::vector<std::string> before = chosen();
  std::vector<pacs::QueueItem> items;
  QString trouble;
  try {
    items = outbox_.items();
  } catch (const Error& error) {
    trouble = QString::fromStdString(error.what());
  }
  list_->clear();
  bool waiting = false;
  for (const pacs::QueueItem& one : items) {
    auto* item = new QTreeWidgetItem(
        list_, {object_word(one.what), QString::fromStdString(one.server), queue_word(one.state),
                QString::number(one.attempts), QString::fromStdString(one.reason)});
    item->setToolTip(why_cell, QString::fromStdString(one.reason));
    item->setData(what_cell, item_role, QString::fromStdString(one.id));
    item->setData(what_cell, item_state_role, static_cast<int>(one.state));
    item->setSelected(std::find(before.begin(), before.end(), one.id) != before.end());
    waiting = waiting || one.state == pacs::QueueState::waiting;
  }
  said_->setText(!trouble.isEmpty()  ? trouble
                 : outbox_.sending() ? tr("Sending\u2026")
                 : items.empty()     ? tr("Nothing waits to be sent.")
                                     : QString());
  said_->setVisible(!said_->text().isEmpty());
  send_->setEnabled(waiting && !outbox_.sending());
  look_at_chosen();
}

void OutboxDialog::look_at_chosen() {
  bool refused = false;
  for (const QTreeWidgetItem* item : list_->selectedItems())
    refused = refused ||
              item->data(what_cell, item_state_role).toInt() == static_cast<int>(pacs::QueueState::failed);
  retry_->setEnabled(refused && !outbox_.sending());
  remove_->setEnabled(!list_->selectedItems().isEmpty() && !outbox_.sending());
}

SendDialog::SendDialog(const std::vector<pacs::ServerDescription>& servers, Outbox& outbox, Desk& desk)
    : QDialog(&desk.window), outbox_(outbox) {
  setObjectName("send");
  setWindowTitle(tr("Send to the PACS"));
  server_ = new QComboBox;
  server_->setObjectName("send_server");
  server_->setAccessibleName(tr("Server"));
  for (const pacs::ServerDescription& one : servers) server_->addItem(QString::fromStdString(one.name));
  auto* form = new QFormLayout;
  form->addRow(tr("Server"), server_);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  for (const DicomObjectKind kind :
       {DicomObjectKind::segmentation, DicomObjectKind::report, DicomObjectKind::measurements,
        DicomObjectKind::surface, DicomObjectKind::images}) {
    const std::string word = session::to_string(kind);
    auto* box = new QCheckBox(object_word(word));
    box->setObjectName("send_" + QString::fromStdString(word));
    box->setChecked(true);
    connect(box, &QCheckBox::toggled, this, [this] { ok_->setEnabled(!kinds().empty()); });
    layout->addWidget(box);
    kinds_.emplace_back(kind, box);
  }
  auto* note =
      new QLabel(tr("They are of the patient of the image and name them, as its files do. What cannot "
                    "be sent now waits in the outbox."));
  note->setWordWrap(true);
  layout->addWidget(note);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  ok_ = buttons->addButton(tr("&Send"), QDialogButtonBox::AcceptRole);
  ok_->setObjectName("send_now");
  ok_->setDefault(true);
  layout->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &SendDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

std::set<DicomObjectKind> SendDialog::kinds() const {
  std::set<DicomObjectKind> all;
  for (const auto& [kind, box] : kinds_)
    if (box->isChecked()) all.insert(kind);
  return all;
}

void SendDialog::accept() {
  outbox_.send_case(kinds(), server_->currentText().toStdString());
  QDialog::accept();
}

}  // namespace ostia::workstation
