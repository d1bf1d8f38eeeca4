#pragma once
/// \file The report of computed pressures: pages, tables, lines.

#include <QObject>
#include <filesystem>

namespace ostia::workstation {

struct Desk;
class Pressures;

class PressureSaving final : public QObject {
  Q_OBJECT
 public:
  PressureSaving(Desk& desk, Pressures& pressures);
  /// What is known now, in a folder beside the case file (CASE-pressure, CASE-pressure-2, ...).
  void save(const std::filesystem::path& case_file);

 signals:
  void saved(const QString& folder);

 private:
  Desk& desk_;
  Pressures& pressures_;
};

}  // namespace ostia::workstation
