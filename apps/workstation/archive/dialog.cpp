#include "archive/dialog.h"

#include "archive/keyring.h"
#include "opening/opening.h"
#include "shell/desk.h"
#include "shell/hanging.h"
#include "shell/jobs.h"
#include "views/raster_image.h"

#include "ostia/core/files.h"
#include "ostia/core/private_folder.h"
#include "ostia/imaging/series_preview.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPainter>
#include <QPixmap>
#include <QPointer>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <tuple>

namespace ostia::workstation {
namespace {

enum FoundColumn { whose_column, date_column, what_column, modality_column, images_column, found_columns };
constexpr int study_uid_role = Qt::UserRole, series_uid_role = Qt::UserRole + 1,
              looked_role = Qt::UserRole + 2;

QString shown_day(const std::string& digits) {
  const QString text = QString::fromStdString(digits);
  return text.size() == 8 ? text.left(4) + "-" + text.mid(4, 2) + "-" + text.mid(6) : text;
}

/// "2026-03-01" and "20260301" as DICOM has it.
std::string typed_day(const QLineEdit& field) {
  return field.text().remove('-').trimmed().toStdString();
}

QString image_count(long images) {
  return images < 0 ? QString() : QString::number(images);
}

constexpr int series_picture_px = 72;

QImage shown_preview(const imaging::SeriesPreview& preview) {
  const QImage grey = preview_image(preview);
  QImage square(series_picture_px, series_picture_px, QImage::Format_RGB32);
  square.fill(Qt::black);
  QPainter(&square).drawImage((series_picture_px - grey.width()) / 2, (series_picture_px - grey.height()) / 2,
                              grey);
  return square;
}

/// Of one image out of the middle, which is not kept.
QImage series_picture_of(pacs::Archive& archive, const pacs::SeriesWanted& wanted,
                         const core::TaskContext& task) {
  const core::PrivateFolder own;
  const std::filesystem::path file = archive.fetch_middle(wanted, own.path() / "image", task);
  const imaging::DicomFolder found = imaging::scan_dicom(file, task);
  return found.series.empty()
             ? QImage()
             : shown_preview(imaging::preview(found.series.front(), series_picture_px, task));
}

QLineEdit* query_field(QFormLayout& form, const QString& text, const QString& name) {
  auto* field = new QLineEdit;
  field->setObjectName("archive_" + name);
  form.addRow(text, field);
  return field;
}

/// The same series again takes the place of what was fetched before.
std::filesystem::path fetched(pacs::Archive& archive, const pacs::SeriesWanted& wanted,
                              const std::filesystem::path& folder, const core::TaskContext& task) {
  const std::string name = core::sha256(archive.server().name + "\n" + wanted.series_uid).substr(0, 16);
  const std::filesystem::path target = folder / name, made = folder / (name + ".new");
  std::filesystem::create_directories(folder);
  std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
  std::filesystem::remove_all(made);  // whole, of a run that ended before it was given its name
  const bool again = std::filesystem::exists(target);
  archive.fetch(wanted, again ? made : target, task);
  if (again) core::publish_folder(made, target);
  return target;
}

}  // namespace

ArchiveDialog::ArchiveDialog(std::vector<pacs::ServerDescription> servers, Keyring& keyring, Desk& desk,
                             Opening& opening)
    : QDialog(&desk.window), servers_(std::move(servers)), keyring_(keyring), desk_(desk), opening_(opening) {
  setObjectName("archive");
  setWindowTitle(tr("From the PACS"));
  resize_within(*this, QSize(900, 640));
  auto* form = new QFormLayout;
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  build_server(*form);
  build_query(*form);
  auto* search = new QPushButton(tr("&Search"));
  search->setObjectName("archive_search");
  search->setDefault(true);
  list_ = new QTreeWidget;
  list_->setObjectName("archive_found");
  list_->setAccessibleName(tr("Studies and series"));
  list_->setColumnCount(found_columns);
  list_->setIconSize(QSize(series_picture_px, series_picture_px));
  list_->setHeaderLabels(
      {tr("Patient, series"), tr("Date"), tr("Description"), tr("Modality"), tr("Images")});
  list_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  said_ = new QLabel;
  said_->setObjectName("archive_said");
  said_->setWordWrap(true);
  said_->setTextFormat(Qt::PlainText);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel);
  open_ = buttons->button(QDialogButtonBox::Open);
  open_->setObjectName("archive_open");
  open_->setEnabled(false);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addWidget(search, 0, Qt::AlignRight);
  layout->addWidget(list_, 1);
  layout->addWidget(said_);
  layout->addWidget(buttons);
  connect(search, &QPushButton::clicked, this, &ArchiveDialog::search);
  connect(buttons, &QDialogButtonBox::accepted, this, &ArchiveDialog::fetch);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(list_, &QTreeWidget::itemExpanded, this, &ArchiveDialog::look_into);
  connect(list_, &QTreeWidget::currentItemChanged, this, [this](const QTreeWidgetItem* item) {
    open_->setEnabled(item && !item->data(whose_column, series_uid_role).toString().isEmpty());
  });
  choose_server();
}

ArchiveDialog::~ArchiveDialog() {
  desk_.jobs.cancel("archive");
  desk_.jobs.cancel("archive picture");
}

void ArchiveDialog::build_server(QFormLayout& form) {
  server_ = new QComboBox;
  server_->setObjectName("archive_server");
  for (const pacs::ServerDescription& one : servers_) server_->addItem(QString::fromStdString(one.name));
  form.addRow(tr("Server"), server_);
  password_ = query_field(form, tr("Password or token"), "password");
  password_->setEchoMode(QLineEdit::Password);
  remember_ = new QCheckBox(tr("&Keep it in the desktop's keyring"));
  remember_->setObjectName("archive_remember");
  form.addRow(QString(), remember_);
  connect(server_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &ArchiveDialog::choose_server);
}

void ArchiveDialog::build_query(QFormLayout& form) {
  name_ = query_field(form, tr("Patient's name"), "name");
  name_->setPlaceholderText(tr("DOE^J*"));
  id_ = query_field(form, tr("Patient's ID"), "id");
  auto* days = new QHBoxLayout;
  from_ = new QLineEdit;
  to_ = new QLineEdit;
  for (auto [field, name, text] :
       {std::tuple(from_, "archive_from", tr("From day")), std::tuple(to_, "archive_to", tr("To day"))}) {
    field->setObjectName(name);
    field->setAccessibleName(text);
    field->setPlaceholderText(QStringLiteral("2026-01-31"));
    days->addWidget(field);
  }
  form.addRow(tr("Days, from and to"), days);
  description_ = query_field(form, tr("Description"), "description");
  modality_ = query_field(form, tr("Modality"), "modality");
  modality_->setText(QStringLiteral("CT"));
}

const pacs::ServerDescription& ArchiveDialog::server() const {
  return servers_[static_cast<std::size_t>(server_->currentIndex())];
}

void ArchiveDialog::choose_server() {
  const bool asks = server().transport == pacs::Transport::dicomweb && server().login != pacs::Login::none;
  password_->clear();
  password_->setEnabled(asks);
  remember_->setChecked(false);
  remember_->setEnabled(asks);
  list_->clear();
  forget_pictures();
  say({});
  if (!asks) return;
  keyring_.read(server_->currentText(), this, [this, name = server_->currentText()](const QString& password) {
    if (name != server_->currentText() || password.isEmpty() || !password_->text().isEmpty()) return;
    password_->setText(password);
    remember_->setChecked(true);
  });
}

ArchiveDialog::Asked ArchiveDialog::asked() const {
  pacs::Secrets secrets = pacs::secrets_from({});
  if (!password_->text().isEmpty()) secrets.password = password_->text().toStdString();
  return {server(), secrets};
}

void ArchiveDialog::search() {
  pacs::Query query;
  query.patient_name = name_->text().trimmed().toStdString();
  query.patient_id = id_->text().trimmed().toStdString();
  query.from_date = typed_day(*from_);
  query.to_date = typed_day(*to_);
  query.description = description_->text().trimmed().toStdString();
  query.modality = modality_->text().trimmed().toStdString();
  list_->clear();
  forget_pictures();
  say(tr("Searching\u2026"));
  if (remember_->isChecked() && !password_->text().isEmpty())
    keyring_.keep(server_->currentText(), password_->text());
  const QPointer<ArchiveDialog> self(this);
  desk_.jobs.run(
      "archive", tr("Searching in the PACS"),
      [query, at = asked()](const core::TaskContext& task) {
        return std::any(pacs::open_archive(at.server, at.secrets)->find(query, task));
      },
      [self, at = server().name](const std::any& result) {
        if (self && self->server().name == at)
          self->show_studies(std::any_cast<const pacs::FindResult&>(result));
      },
      [self](const QString& message) {
        if (self) self->say(message);
      });
}

void ArchiveDialog::show_studies(const pacs::FindResult& result) {
  for (const pacs::Found& one : result.found) {
    auto* item = new QTreeWidgetItem(list_);
    item->setText(
        whose_column,
        QString::fromStdString(one.patient_name + (one.patient_id.empty() ? "" : "  " + one.patient_id)));
    item->setText(date_column, shown_day(one.study_date));
    item->setText(what_column, QString::fromStdString(one.study_description));
    item->setText(modality_column, QString::fromStdString(one.modality));
    item->setText(images_column, image_count(one.images));
    item->setData(whose_column, study_uid_role, QString::fromStdString(one.study_uid));
    item->setChildIndicatorPolicy(QTreeWidgetItem::ShowIndicator);
  }
  QStringList lines{tr("%n study(ies)", nullptr, static_cast<int>(result.found.size()))};
  if (result.cut_off) lines << tr("There are more: ask for less.");
  for (const std::string& warning : result.warnings) lines << QString::fromStdString(warning);
  say(lines.join('\n'));
}

void ArchiveDialog::look_into(QTreeWidgetItem* study) {
  if (study->data(whose_column, looked_role).toBool()) return;
  const QString uid = study->data(whose_column, study_uid_role).toString();
  pacs::Query query;
  query.level = pacs::Level::series;
  query.study_uid = uid.toStdString();
  const QPointer<ArchiveDialog> self(this);
  desk_.jobs.run(
      "archive of " + uid, tr("Looking for series"),
      [query, at = asked()](const core::TaskContext& task) {
        return std::any(pacs::open_archive(at.server, at.secrets)->find(query, task));
      },
      [self, uid](const std::any& result) {
        if (self) self->show_series(uid, std::any_cast<const pacs::FindResult&>(result));
      },
      [self](const QString& message) {
        if (self) self->say(message);
      });
}

void ArchiveDialog::show_series(const QString& study, const pacs::FindResult& result) {
  for (int row = 0; row < list_->topLevelItemCount(); ++row) {
    QTreeWidgetItem* parent = list_->topLevelItem(row);
    if (parent->data(whose_column, study_uid_role).toString() != study) continue;
    parent->setData(whose_column, looked_role, true);
    for (const pacs::Found& one : result.found) {
      auto* item = new QTreeWidgetItem(parent);
      item->setText(whose_column, tr("Series %1").arg(QString::fromStdString(one.series_number)));
      item->setText(what_column, QString::fromStdString(one.series_description));
      item->setText(modality_column, QString::fromStdString(one.modality));
      item->setText(images_column, image_count(one.images));
      item->setData(whose_column, study_uid_role, study);
      item->setData(whose_column, series_uid_role, QString::fromStdString(one.series_uid));
      QPixmap none(series_picture_px, series_picture_px);  // its room: rows do not move when pictures come
      none.fill(palette().color(QPalette::AlternateBase));
      item->setIcon(whose_column, none);
      without_picture_.push_back({study.toStdString(), one.series_uid});
    }
  }
  next_picture();
}

void ArchiveDialog::forget_pictures() {
  desk_.jobs.cancel("archive picture");
  without_picture_.clear();
  asking_picture_ = false;
}

void ArchiveDialog::next_picture() {
  if (asking_picture_ || without_picture_.empty()) return;
  asking_picture_ = true;
  const pacs::SeriesWanted wanted = without_picture_.front();
  without_picture_.pop_front();
  const QPointer<ArchiveDialog> self(this);
  const auto go_on = [self] {
    if (!self) return;
    self->asking_picture_ = false;
    self->next_picture();
  };
  const QString uid = QString::fromStdString(wanted.series_uid);
  desk_.jobs.run(
      "archive picture", tr("Pictures of the series"),
      [wanted, at = asked()](const core::TaskContext& task) {
        return std::any(series_picture_of(*pacs::open_archive(at.server, at.secrets), wanted, task));
      },
      [self, uid, go_on](const std::any& result) {
        if (self) self->show_picture(uid, std::any_cast<const QImage&>(result));
        go_on();
      },
      [self, uid, go_on](const QString& why) {  // a list without this picture is a list
        if (self)
          if (QTreeWidgetItem* item = self->item_of(uid)) item->setToolTip(whose_column, why);
        go_on();
      });
}

QTreeWidgetItem* ArchiveDialog::item_of(const QString& series) const {
  for (int row = 0; row < list_->topLevelItemCount(); ++row)
    for (int n = 0; n < list_->topLevelItem(row)->childCount(); ++n)
      if (QTreeWidgetItem* item = list_->topLevelItem(row)->child(n);
          item->data(whose_column, series_uid_role).toString() == series)
        return item;
  return nullptr;
}

void ArchiveDialog::show_picture(const QString& series, const QImage& picture) {
  QTreeWidgetItem* item = item_of(series);
  if (item && !picture.isNull()) item->setIcon(whose_column, QPixmap::fromImage(picture));
}

void ArchiveDialog::fetch() {
  const QTreeWidgetItem* item = list_->currentItem();
  if (!item) return;
  const pacs::SeriesWanted wanted{item->data(whose_column, study_uid_role).toString().toStdString(),
                                  item->data(whose_column, series_uid_role).toString().toStdString()};
  if (wanted.series_uid.empty()) return;
  desk_.jobs.run(
      "archive fetch", tr("Fetching the series"),
      [wanted, at = asked(), folder = desk_.state_folder / "archive"](const core::TaskContext& task) {
        return std::any(fetched(*pacs::open_archive(at.server, at.secrets), wanted, folder, task));
      },
      [&opening = opening_](const std::any& result) {
        opening.open(std::any_cast<const std::filesystem::path&>(result));
      },
      [&desk = desk_](const QString& message) { desk.cannot_open(message, tr("The series did not come")); });
  accept();
}

void ArchiveDialog::say(const QString& text) {
  said_->setText(text);
}

}  // namespace ostia::workstation
