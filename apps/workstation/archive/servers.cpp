#include "archive/servers.h"

#include "archive/keyring.h"
#include "shell/desk.h"
#include "shell/hanging.h"
#include "shell/jobs.h"

#include "ostia/core/error.h"
#include "ostia/pacs/archive.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPointer>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QScrollArea>
#include <QSpinBox>
#include <QVBoxLayout>
#include <memory>
#include <set>
#include <utility>

namespace ostia::workstation {
namespace {

using pacs::ServerDescription;
using pacs::Transport;

template <class Value>
Value chosen_value(const QComboBox& box) {
  return static_cast<Value>(box.currentData().toInt());
}

template <class Value>
QComboBox* value_box(const char* name, const QString& title,
                     const std::vector<std::pair<QString, Value>>& items) {
  auto* box = new QComboBox;
  box->setObjectName(QString::fromLatin1(name));
  box->setAccessibleName(title);
  for (const auto& [text, value] : items) box->addItem(text, static_cast<int>(value));
  return box;
}

QSpinBox* port_box(const char* name, const QString& title) {
  auto* box = new QSpinBox;
  box->setObjectName(QString::fromLatin1(name));
  box->setAccessibleName(title);
  box->setRange(1, 65535);
  return box;
}

std::string typed_text(const QLineEdit& field) {
  return field.text().trimmed().toStdString();
}

QString shown_path(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

bool wants_secret(const ServerDescription& server) {
  return server.transport == Transport::dicomweb && server.login != pacs::Login::none;
}

struct SecretsWanted {
  std::vector<ServerDescription> servers;
  std::vector<pacs::Secrets> found;
  std::function<void(std::vector<pacs::Secrets>)> then;
};

void read_next_secret(Keyring& keyring, QObject* context, const std::shared_ptr<SecretsWanted>& wanted) {
  while (wanted->found.size() < wanted->servers.size() &&
         !wants_secret(wanted->servers[wanted->found.size()]))
    wanted->found.push_back(pacs::secrets_from({}));
  if (wanted->found.size() == wanted->servers.size()) return wanted->then(wanted->found);
  keyring.read(QString::fromStdString(wanted->servers[wanted->found.size()].name), context,
               [&keyring, context, wanted](const QString& password) {
                 pacs::Secrets secrets = pacs::secrets_from({});
                 if (!password.isEmpty()) secrets.password = password.toStdString();
                 wanted->found.push_back(std::move(secrets));
                 read_next_secret(keyring, context, wanted);
               });
}

struct PasswordMove {
  QString from;  ///< empty: `password` was typed
  QString to, password;
};

/// All are read before `then` is told: two servers may have exchanged their names.
void read_moved(Keyring& keyring, QObject* context, const std::shared_ptr<std::vector<PasswordMove>>& moves,
                std::size_t next, const std::function<void()>& then) {
  while (next < moves->size() && (*moves)[next].from.isEmpty()) ++next;
  if (next == moves->size()) return then();
  keyring.read((*moves)[next].from, context, [&keyring, context, moves, next, then](const QString& password) {
    (*moves)[next].password = password;
    read_moved(keyring, context, moves, next + 1, then);
  });
}

}  // namespace

std::vector<ServerDescription> known_servers() {
  const std::filesystem::path file = pacs::default_servers_file();
  return std::filesystem::exists(file) ? pacs::read_servers(file) : std::vector<ServerDescription>();
}

void read_secrets(Keyring& keyring, const std::vector<ServerDescription>& servers, QObject* context,
                  std::function<void(std::vector<pacs::Secrets>)> then) {
  read_next_secret(keyring, context,
                   std::make_shared<SecretsWanted>(SecretsWanted{servers, {}, std::move(then)}));
}

ServersDialog::ServersDialog(std::vector<ServerDescription> servers, Keyring& keyring, Desk& desk,
                             std::filesystem::path file)
    : QDialog(&desk.window), keyring_(keyring), desk_(desk), file_(std::move(file)) {
  for (ServerDescription& one : servers) {
    names_before_.push_back(QString::fromStdString(one.name));
    rows_.push_back({std::move(one), names_before_.back()});
  }
  setObjectName("servers");
  setWindowTitle(tr("PACS servers"));
  resize_within(*this, QSize(820, 680));
  list_ = new QListWidget;
  list_->setObjectName("servers_list");
  list_->setAccessibleName(tr("PACS servers"));
  list_->setMaximumWidth(220);
  auto* fresh = new QPushButton(tr("&New"));
  fresh->setObjectName("servers_new");
  remove_ = new QPushButton(tr("&Remove"));
  remove_->setObjectName("servers_remove");
  auto* left = new QVBoxLayout;
  left->addWidget(list_, 1);
  auto* both = new QHBoxLayout;
  both->addWidget(fresh);
  both->addWidget(remove_);
  left->addLayout(both);
  right_ = new QWidget;
  auto* form = new QFormLayout(right_);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  build_form(*form);
  auto* scrolled = new QScrollArea;
  scrolled->setWidgetResizable(true);
  scrolled->setFrameShape(QFrame::NoFrame);
  scrolled->setWidget(right_);
  auto* columns = new QHBoxLayout;
  columns->addLayout(left);
  columns->addWidget(scrolled, 1);
  said_ = new QLabel;
  said_->setObjectName("servers_said");
  said_->setWordWrap(true);
  said_->setTextFormat(Qt::PlainText);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Cancel);
  test_ = buttons->addButton(tr("&Test the connection"), QDialogButtonBox::ActionRole);
  test_->setObjectName("servers_test");
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(columns, 1);
  layout->addWidget(said_);
  layout->addWidget(buttons);
  connect(fresh, &QPushButton::clicked, this, &ServersDialog::add);
  connect(remove_, &QPushButton::clicked, this, &ServersDialog::remove);
  connect(test_, &QPushButton::clicked, this, &ServersDialog::test);
  connect(buttons, &QDialogButtonBox::accepted, this, &ServersDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(list_, &QListWidget::currentRowChanged, this, [this](int row) {
    if (showing_) return;
    keep_typed();
    show_server(row);
  });
  for (const Row& one : rows_) list_->addItem(QString::fromStdString(one.server.name));
  if (rows_.empty())
    show_server(-1);
  else
    list_->setCurrentRow(0);
}

ServersDialog::~ServersDialog() {
  desk_.jobs.cancel("server test");
}

QLineEdit* ServersDialog::line(QFormLayout& form, const QString& text, const QString& name,
                               const QString& tip) {
  auto* field = new QLineEdit;
  field->setObjectName("servers_" + name);
  field->setToolTip(tip);
  form.addRow(text, field);
  return field;
}

void ServersDialog::build_form(QFormLayout& form) {
  name_ = line(form, tr("Name here"), "name", tr("As lists of this program call it."));
  transport_ = value_box<Transport>(
      "servers_transport", tr("Protocol"),
      {{tr("DICOM (C-FIND, C-GET, C-STORE)"), Transport::dimse}, {tr("DICOMweb"), Transport::dicomweb}});
  form.addRow(tr("Protocol"), transport_);
  host_ = line(form, tr("Host"), "host");
  port_ = port_box("servers_port", tr("Port"));
  form.addRow(tr("Port"), port_);
  title_ = line(form, tr("Its title"), "title", tr("Application entity title of the server."));
  own_title_ = line(form, tr("Our title"), "own_title", tr("As the server knows this machine."));
  retrieval_ = value_box<pacs::Retrieval>("servers_retrieval", tr("Images come by"),
                                          {{tr("C-GET: on our connection"), pacs::Retrieval::get},
                                           {tr("C-MOVE: the server connects to us"), pacs::Retrieval::move}});
  form.addRow(tr("Images come by"), retrieval_);
  receive_port_ = port_box("servers_receive_port", tr("Our port for C-MOVE"));
  form.addRow(tr("Our port for C-MOVE"), receive_port_);
  tls_ = new QCheckBox(tr("&Encrypted (TLS)"));
  tls_->setObjectName("servers_tls");
  form.addRow(QString(), tls_);
  url_ = line(form, tr("Address"), "url", QStringLiteral("https://host/dicom-web"));
  login_ = value_box<pacs::Login>("servers_login", tr("Login"),
                                  {{tr("none"), pacs::Login::none},
                                   {tr("name and password"), pacs::Login::basic},
                                   {tr("token"), pacs::Login::bearer}});
  form.addRow(tr("Login"), login_);
  user_ = line(form, tr("User"), "user");
  password_ = line(form, tr("Password or token"), "password",
                   tr("Kept in the desktop's keyring alone. Empty: the one that is there stays."));
  password_->setEchoMode(QLineEdit::Password);
  proxy_ = line(form, tr("Proxy"), "proxy", QStringLiteral("http://host:port"));
  authorities_ =
      line(form, tr("Trusted certificates"), "authorities", tr("A file in PEM; empty: those of the system."));
  certificate_ = line(form, tr("Our certificate"), "certificate", tr("A file in PEM; empty: none."));
  key_ = line(form, tr("Its key"), "key", tr("A file in PEM."));
  for (QComboBox* box : {transport_, retrieval_, login_})
    connect(box, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &ServersDialog::show_what_counts);
  connect(tls_, &QCheckBox::toggled, this, &ServersDialog::show_what_counts);
  connect(name_, &QLineEdit::textEdited, this, [this](const QString& text) {
    if (QListWidgetItem* item = list_->currentItem()) item->setText(text.trimmed());
  });
}

void ServersDialog::show_server(int row) {
  const QScopedValueRollback<bool> showing(showing_, true);
  shown_ = row;
  const bool any = row >= 0;
  right_->setEnabled(any);
  remove_->setEnabled(any);
  test_->setEnabled(any);
  const ServerDescription one = any ? rows_[static_cast<std::size_t>(row)].server : ServerDescription();
  const auto text = [](const std::string& value) { return QString::fromStdString(value); };
  name_->setText(text(one.name));
  transport_->setCurrentIndex(transport_->findData(static_cast<int>(one.transport)));
  host_->setText(text(one.host));
  port_->setValue(one.port);
  title_->setText(text(one.title));
  own_title_->setText(text(one.own_title));
  retrieval_->setCurrentIndex(retrieval_->findData(static_cast<int>(one.retrieval)));
  receive_port_->setValue(one.receive_port);
  tls_->setChecked(one.tls);
  url_->setText(text(one.url));
  login_->setCurrentIndex(login_->findData(static_cast<int>(one.login)));
  user_->setText(text(one.user));
  password_->setText(any ? rows_[static_cast<std::size_t>(row)].password : QString());
  proxy_->setText(text(one.proxy));
  authorities_->setText(shown_path(one.authorities));
  certificate_->setText(shown_path(one.certificate));
  key_->setText(shown_path(one.key));
  say(any ? QString() : tr("No server is described yet: New begins one."));
  show_what_counts();
}

void ServersDialog::show_what_counts() {
  const bool web = chosen_value<Transport>(*transport_) == Transport::dicomweb;
  auto& form = *qobject_cast<QFormLayout*>(right_->layout());
  const auto want = [&](QWidget* field, bool wanted) {
    field->setVisible(wanted);
    if (QWidget* label = form.labelForField(field)) label->setVisible(wanted);
  };
  for (QWidget* field :
       {static_cast<QWidget*>(host_), static_cast<QWidget*>(port_), static_cast<QWidget*>(title_),
        static_cast<QWidget*>(own_title_), static_cast<QWidget*>(retrieval_), static_cast<QWidget*>(tls_)})
    want(field, !web);
  want(receive_port_, !web && chosen_value<pacs::Retrieval>(*retrieval_) == pacs::Retrieval::move);
  want(url_, web);
  want(login_, web);
  want(proxy_, web);
  const auto login = chosen_value<pacs::Login>(*login_);
  want(user_, web && login == pacs::Login::basic);
  want(password_, web && login != pacs::Login::none);
  const bool tls = web || tls_->isChecked();
  want(authorities_, tls);
  want(certificate_, tls);
  want(key_, tls);
}

ServerDescription ServersDialog::typed() const {
  ServerDescription one = rows_[static_cast<std::size_t>(shown_)].server;
  const ServerDescription usual;
  one.name = typed_text(*name_);
  one.transport = chosen_value<Transport>(*transport_);
  const bool web = one.transport == Transport::dicomweb;
  one.host = web ? std::string() : typed_text(*host_);
  one.port = web ? usual.port : port_->value();
  one.title = web ? std::string() : typed_text(*title_);
  one.own_title = web ? usual.own_title : typed_text(*own_title_);
  one.retrieval = web ? usual.retrieval : chosen_value<pacs::Retrieval>(*retrieval_);
  one.receive_port = one.retrieval == pacs::Retrieval::move ? receive_port_->value() : usual.receive_port;
  one.tls = !web && tls_->isChecked();
  one.url = web ? typed_text(*url_) : std::string();
  one.login = web ? chosen_value<pacs::Login>(*login_) : pacs::Login::none;
  one.user = one.login == pacs::Login::basic ? typed_text(*user_) : std::string();
  one.proxy = web ? typed_text(*proxy_) : std::string();
  const bool tls = web || one.tls;
  one.authorities = tls ? typed_text(*authorities_) : std::string();
  one.certificate = tls ? typed_text(*certificate_) : std::string();
  one.key = tls ? typed_text(*key_) : std::string();
  return one;
}

void ServersDialog::keep_typed() {
  if (shown_ < 0 || shown_ >= static_cast<int>(rows_.size())) return;
  Row& row = rows_[static_cast<std::size_t>(shown_)];
  row.server = typed();
  row.password = wants_secret(row.server) ? password_->text() : QString();
}

void ServersDialog::add() {
  keep_typed();
  Row fresh;
  fresh.server.name = tr("new").toStdString();
  rows_.push_back(std::move(fresh));
  {
    const QScopedValueRollback<bool> showing(showing_, true);
    list_->addItem(tr("new"));
    list_->setCurrentRow(list_->count() - 1);
  }
  show_server(list_->count() - 1);
  name_->setFocus();
  name_->selectAll();
}

void ServersDialog::remove() {
  if (shown_ < 0) return;
  rows_.erase(rows_.begin() + shown_);
  {
    const QScopedValueRollback<bool> showing(showing_, true);
    delete list_->takeItem(shown_);
  }
  show_server(list_->currentRow());
}

void ServersDialog::test() {
  keep_typed();
  const Row row = rows_[static_cast<std::size_t>(shown_)];
  say(tr("Asking the server\u2026"));
  const QPointer<ServersDialog> self(this);
  ServerDescription kept = row.server;
  if (!row.kept_as.isEmpty()) kept.name = row.kept_as.toStdString();
  read_secrets(keyring_, {kept}, this, [this, self, row](std::vector<pacs::Secrets> secrets) {
    if (!row.password.isEmpty()) secrets[0].password = row.password.toStdString();
    desk_.jobs.run(
        "server test", tr("Asking the server"),
        [server = row.server, secret = secrets[0]](const core::TaskContext& task) {
          pacs::open_archive(server, secret)->echo(task);
          return std::any(true);
        },
        [self](const std::any&) {
          if (self) self->say(tr("It answers, and lets us in."));
        },
        [self](const QString& message) {
          if (self) self->say(message);
        });
  });
}

void ServersDialog::accept() {
  keep_typed();
  std::vector<ServerDescription> servers;
  for (const Row& one : rows_) servers.push_back(one.server);
  try {
    std::filesystem::create_directories(file_.parent_path());
    pacs::write_servers(file_, servers);
  } catch (const std::exception& error) {
    return say(QString::fromStdString(error.what()));
  }
  keep_passwords();
  QDialog::accept();
}

void ServersDialog::keep_passwords() {
  const auto moves = std::make_shared<std::vector<PasswordMove>>();
  std::set<QString> wanted;
  for (const Row& one : rows_) {
    if (!wants_secret(one.server)) continue;
    const QString name = QString::fromStdString(one.server.name);
    wanted.insert(name);
    if (!one.password.isEmpty())
      moves->push_back({{}, name, one.password});
    else if (one.kept_as != name)
      moves->push_back({one.kept_as, name, {}});
  }
  std::vector<QString> gone;
  for (const QString& name : names_before_)
    if (wanted.count(name) == 0) gone.push_back(name);
  // The dialog may be gone before the keyring has answered.
  read_moved(keyring_, &desk_.window, moves, 0, [&keyring = keyring_, moves, gone] {
    for (const QString& name : gone) keyring.forget(name);
    for (const PasswordMove& one : *moves)
      if (!one.password.isEmpty()) keyring.keep(one.to, one.password);
  });
}

void ServersDialog::say(const QString& text) {
  said_->setText(text);
}

}  // namespace ostia::workstation
