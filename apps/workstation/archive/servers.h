#pragma once
/// \file Which image archives there are, and an editor of them.

#include "ostia/pacs/server.h"

#include <QDialog>
#include <filesystem>
#include <functional>
#include <vector>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;
class QSpinBox;

namespace ostia::workstation {

struct Desk;
class Keyring;

/// The file of this user (pacs::default_servers_file). Nothing where there is no such file; throws as
/// pacs::read_servers does.
std::vector<pacs::ServerDescription> known_servers();
/// Has the secrets of these servers read in the keyring, one after the other; `then` is told in the
/// interface's thread, in their order.
void read_secrets(Keyring& keyring, const std::vector<pacs::ServerDescription>& servers, QObject* context,
                  std::function<void(std::vector<pacs::Secrets>)> then);

/// Names on the left, what the chosen one is on the right; Save writes the file, and passwords that were
/// typed go into the keyring alone. A server can be tried as it is typed (job "server test").
class ServersDialog final : public QDialog {
  Q_OBJECT
 public:
  ServersDialog(std::vector<pacs::ServerDescription> servers, Keyring& keyring, Desk& desk,
                std::filesystem::path file = pacs::default_servers_file());
  ~ServersDialog() override;
  void accept() override;

 private:
  void build_form(QFormLayout& form);
  QLineEdit* line(QFormLayout& form, const QString& text, const QString& name, const QString& tip = {});
  void show_server(int row);
  void keep_typed();  ///< of the server that is shown
  void show_what_counts();
  pacs::ServerDescription typed() const;
  void add();
  void remove();
  void test();
  void keep_passwords();  ///< each under its server's name; those of servers that are gone are forgotten
  void say(const QString& text);

  struct Row {
    pacs::ServerDescription server;
    QString kept_as{};   ///< by which name the keyring may know it
    QString password{};  ///< that was typed; empty: as the keyring has it
  };
  std::vector<Row> rows_;
  std::vector<QString> names_before_;
  Keyring& keyring_;
  Desk& desk_;
  const std::filesystem::path file_;
  int shown_ = -1;
  bool showing_ = false;
  QListWidget* list_;
  QWidget* right_;
  QLineEdit *name_, *host_, *title_, *own_title_, *url_, *user_, *password_, *proxy_, *authorities_,
      *certificate_, *key_;
  QComboBox *transport_, *retrieval_, *login_;
  QSpinBox *port_, *receive_port_;
  QCheckBox* tls_;
  QPushButton *remove_, *test_;
  QLabel* said_;
};

}  // namespace ostia::workstation
