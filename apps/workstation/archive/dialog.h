#pragma once
/// \file A search in an image archive, and the series that is opened from it.

#include "ostia/pacs/archive.h"

#include <QDialog>
#include <QImage>
#include <deque>
#include <vector>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace ostia::workstation {

struct Desk;
class Keyring;
class Opening;

/// Searches, lists and fetches in the background (jobs "archive", "archive fetch"); a series that is whole is
/// opened. Studies show their series when they are unfolded, and then a picture of each, made of one image of
/// its middle (jobs "archive picture", one after the other).
class ArchiveDialog final : public QDialog {
  Q_OBJECT
 public:
  /// `servers`: at least one.
  ArchiveDialog(std::vector<pacs::ServerDescription> servers, Keyring& keyring, Desk& desk, Opening& opening);
  ~ArchiveDialog() override;

 private:
  struct Asked {
    pacs::ServerDescription server;
    pacs::Secrets secrets;
  };
  void build_server(QFormLayout& form);
  void build_query(QFormLayout& form);
  void choose_server();
  Asked asked() const;
  void search();
  void show_studies(const pacs::FindResult& result);
  void look_into(QTreeWidgetItem* study);
  void show_series(const QString& study, const pacs::FindResult& result);
  void forget_pictures();
  void next_picture();
  void show_picture(const QString& series, const QImage& picture);
  QTreeWidgetItem* item_of(const QString& series) const;
  void fetch();
  void say(const QString& text);
  const pacs::ServerDescription& server() const;

  const std::vector<pacs::ServerDescription> servers_;
  Keyring& keyring_;
  Desk& desk_;
  Opening& opening_;
  QComboBox* server_;
  QLineEdit* password_;
  QCheckBox* remember_;
  QLineEdit *name_, *id_, *from_, *to_, *description_, *modality_;
  QTreeWidget* list_;
  QLabel* said_;
  QPushButton* open_;
  std::deque<pacs::SeriesWanted> without_picture_;
  bool asking_picture_ = false;
};

}  // namespace ostia::workstation
