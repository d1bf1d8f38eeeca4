#pragma once
/// \file Cases for flow solvers, written and run beside the editing.

#include "flow/dialog.h"

#include "ostia/session/workbench.h"

#include <QObject>
#include <QPointer>
#include <QStringList>
#include <filesystem>
#include <vector>

namespace ostia::workstation {

struct Desk;
class FlowResults;

/// Asks by a FlowDialog, writes the case (of each tree one) in the background and, where OpenFOAM is there,
/// runs it and shows the wall's shear stress. What is cancelled leaves no process; the case that was being
/// run stays. Of a case that is no longer open there is a line alone, whose button shows the result once that
/// case is open again: nothing of it is shown over another or proposed for it.
class FlowCases final : public QObject {
  Q_OBJECT
 public:
  FlowCases(Desk& desk, FlowResults& results);
  /// Proposed is the mesh that was made last; where none was, the newest that was exported beside
  /// `case_file`.
  void ask(const std::filesystem::path& case_file);
  void mesh_made(const std::filesystem::path& mesh);  ///< of the case that is open

 private:
  void read_mesh(FlowDialog& dialog, const QString& file);
  void write(const FlowDialog& dialog);
  // `of`: the file of the case that was open when it was asked for; empty where none was
  void tell_written(const FlowChoice& made, const std::vector<std::string>& warnings,
                    const std::filesystem::path& of);
  void leave_case(const std::filesystem::path& folder, const QStringList& notes,
                  const std::filesystem::path& of);
  void run(const std::filesystem::path& case_folder, const std::filesystem::path& of);
  void show_result(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& walls,
                   const QString& outcome, const QString& trouble, const std::filesystem::path& of);
  void refuse_result(const std::filesystem::path& folder, const std::filesystem::path& of);
  Desk& desk_;
  FlowResults& results_;
  QPointer<FlowDialog> dialog_;  // that is open
  FlowChoice last_;
  std::filesystem::path made_mesh_;
  std::filesystem::path being_run_, being_run_of_;
  session::Subscription other_case_;
};

}  // namespace ostia::workstation
