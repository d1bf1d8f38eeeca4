#pragma once
/// \file What the program left when it crashed, shown to its user.

#include <QDialog>
#include <QObject>
#include <filesystem>
#include <vector>

namespace ostia::workstation {

struct Desk;

class CrashReports final : public QObject {
  Q_OBJECT
 public:
  explicit CrashReports(Desk& desk);
  /// As it was when the folder was last looked into: at the start, and whenever one of the others is called.
  bool any() const { return any_; }
  /// Asks once, where there is a report that was not offered yet: look at it, delete it, or neither.
  void offer();
  void show();
  void delete_all();

 private:
  std::vector<std::filesystem::path> left();
  Desk& desk_;
  bool any_ = false;
};

/// All reports, with a way to copy and to delete them.
class CrashReportDialog final : public QDialog {
  Q_OBJECT
 public:
  CrashReportDialog(Desk& desk, CrashReports& reports, const std::vector<std::filesystem::path>& left);
};

}  // namespace ostia::workstation
