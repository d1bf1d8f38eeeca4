#pragma once
/// \file What leaves the window: the report, centerlines.

#include "ostia/session/case_report.h"
#include "ostia/session/property.h"

#include <QObject>
#include <filesystem>
#include <vector>

namespace ostia::workstation {

struct Desk;
class PictureWidget;

/// Made in the background from a snapshot of the case; editing goes on meanwhile.
class Reporting final : public QObject {
  Q_OBJECT
 public:
  explicit Reporting(Desk& desk);
  /// The report of the case as it is now, in a folder beside the case file (CASE-report, then CASE-report-2,
  /// ...). Tells when it is there, and opens it on demand.
  void make_report(const std::filesystem::path& case_file);
  /// `named`: whom the PDF and the HTML page name; nobody unless a person asks for it.
  void make_report_in(const std::filesystem::path& folder, const imaging::ShownIdentity& named = {});
  /// The same after the question whether to name the patient, where it is known who that is: each time anew.
  void ask_and_make(const std::filesystem::path& case_file);
  /// What a person says of the report, in a dialog; the findings are measured meanwhile.
  void say_in_report();
  /// The view becomes a further key image of the next report.
  void pin(PictureWidget& view);
  /// Further pages of the next report.
  void add_pages(const std::vector<session::KeyImage>& pages);
  std::size_t pinned() const { return pinned_.size(); }
  /// Asks for a file: the axes with their radii (VTP).
  void export_centerlines();

 signals:
  void report_made(const QString& folder);

 private:
  void show_made(const std::filesystem::path& folder);
  session::ReportOptions options_now() const;
  Desk& desk_;
  std::vector<session::KeyImage> pinned_;  // of this case alone
  int cases_ = 0;                          // that were on the table so far
  session::Subscription other_case_;
};

}  // namespace ostia::workstation
