#pragma once
/// \file What waits to be sent to an image archive: a queue of this machine that survives the program.

#include "ostia/pacs/send_queue.h"
#include "ostia/session/dicom_objects.h"

#include <QDialog>
#include <QObject>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;
class QTreeWidget;

namespace ostia::workstation {

struct Desk;
class Keyring;

/// Objects are made in a job "objects" and sent in a job "outbox": the window never waits for a network. What
/// is read and written here are small files of a folder of this machine.
class Outbox final : public QObject {
  Q_OBJECT
 public:
  Outbox(Desk& desk, Keyring& keyring);
  /// Of the folder; throws as pacs::SendQueue does. Empty where there is none.
  std::vector<pacs::QueueItem> items();
  bool sending() const;
  void send();  ///< all that waits; while it is sending, what came after that is sent next
  void retry(const std::string& id);
  void remove(const std::string& id);
  /// Why nothing of the case can be sent; empty where it can.
  QString why_not() const;
  /// Of the case as it is now; they are queued, and sent.
  void send_case(const std::set<session::DicomObjectKind>& kinds, const std::string& server);

 signals:
  void changed();

 private:
  std::shared_ptr<pacs::SendQueue> queue();
  void send_as(const std::vector<pacs::ServerDescription>& servers,
               const std::vector<pacs::Secrets>& secrets);
  Desk& desk_;
  Keyring& keyring_;
  const std::filesystem::path folder_;
  std::weak_ptr<pacs::SendQueue> queue_;  // its folder is locked only while somebody has it
  bool send_again_ = false;
};

/// The queue as a table: what, for whom, its state, why it failed.
class OutboxDialog final : public QDialog {
  Q_OBJECT
 public:
  OutboxDialog(Outbox& outbox, Desk& desk);

 private:
  void fill();
  void look_at_chosen();
  std::vector<std::string> chosen() const;
  Outbox& outbox_;
  Desk& desk_;
  QTreeWidget* list_;
  QLabel* said_;
  QPushButton *send_, *retry_, *remove_;
};

/// What of the case is sent, and where.
class SendDialog final : public QDialog {
  Q_OBJECT
 public:
  SendDialog(const std::vector<pacs::ServerDescription>& servers, Outbox& outbox, Desk& desk);
  void accept() override;

 private:
  std::set<session::DicomObjectKind> kinds() const;
  Outbox& outbox_;
  QComboBox* server_;
  std::vector<std::pair<session::DicomObjectKind, QCheckBox*>> kinds_;
  QPushButton* ok_ = nullptr;
};

}  // namespace ostia::workstation
