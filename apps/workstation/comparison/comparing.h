#pragma once
/// \file The case on the table compared with the same patient's former one, which is only read.

#include "comparison/one_cursor.h"

#include "ostia/geometry/tri_mesh.h"
#include "ostia/session/comparison.h"

#include <QObject>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::workstation {

struct Desk;
struct FormerCase;
struct FormerImage;

/// Reads the former case and its image, measures both and compares them, in jobs "comparison". Nothing of it
/// is written into either case.
class Comparing final : public QObject {
  Q_OBJECT
 public:
  explicit Comparing(Desk& desk);
  ~Comparing() override;
  void choose();  ///< asks for the former case
  /// Asks for its image where it is not where this machine saw it last.
  void compare_with(const std::filesystem::path& former_case);
  void compare_again();  ///< the case on the table as it is now
  void close();          ///< the former case and its image go
  bool running() const;
  /// Null: nothing is compared.
  const std::shared_ptr<const session::Comparison>& made() const { return made_; }
  session::Workbench& former() { return former_; }
  OneCursor& cursor() { return cursor_; }
  /// The case on the table has changed since.
  session::Property<bool> outdated{false};
  session::Signal<> changed;  ///< there is another comparison, or none
  /// The former tree's wall, carried to where it lies in the present scan by the map of the trees; null where
  /// nothing is compared.
  const std::shared_ptr<const geometry::TriMesh>& former_wall() const { return former_wall_; }
  QString former_name() const;  ///< by which views and pages call the former scan; nothing of the patient
  /// Why there is nothing to compare with, or no comparison; empty where there is.
  QString why_not_choose() const;
  QString why_none() const;
  void go_to(int lesion);  ///< index of ScanChange::lesions; both scans where they reach it
  /// For a report: the lesions as a table, and diameter and plaque along the vessels.
  std::vector<session::KeyImage> pages() const;
  void save();  ///< asks for a folder: pages, tables and pictures as `ostia compare` makes them

 private:
  struct Made;
  /// `reason`: why what was tried is not it.
  void ask_for_image(const std::shared_ptr<const FormerCase>& former, const QString& reason);
  void compare(const std::shared_ptr<const FormerCase>& former, const FormerImage& image);
  void take(const std::shared_ptr<Made>& found);
  void doubt(const std::shared_ptr<Made>& found, const QStringList& why);
  void show(const std::shared_ptr<Made>& found);
  Desk& desk_;
  session::Workbench former_;
  OneCursor cursor_;
  std::shared_ptr<const session::Comparison> made_;
  std::shared_ptr<const geometry::TriMesh> former_wall_;
  std::shared_ptr<const Made> shown_;  // what made_ is of
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
