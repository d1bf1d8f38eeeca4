#pragma once
/// \file Vessels that the program finds in the image: the whole tree, or one by a click.

#include "ostia/segmentation/minimal_path.h"
#include "ostia/session/workbench.h"

#include <QObject>
#include <any>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ostia::workstation {

struct Desk;
class Opening;

/// In the background. What was begun on one case or image does not end on another: it is dropped.
class VesselFinder final : public QObject {
  Q_OBJECT
 public:
  VesselFinder(Desk& desk, Opening& opening);
  /// A first case of the open image, with labelled vessels. Where nothing is found, a line says why, and the
  /// guided way is open.
  void find_tree();
  /// By its distal end: joined to the tree. Without a case, or with the tool for it, by two clicks (ostium,
  /// distal end) an artery of its own.
  void find_vessel(const geometry::Vec3& end);

  // A case always has a vessel. So where its only one is taken back or deleted, the case is put aside:
  // closed, with its file where it is, until it comes back by the opposite command or another is opened.
  bool can_take_back() const;  ///< the first vessel of a case that was begun by hand, or a deleted last one
  bool can_do_again() const;   ///< a first vessel that was taken back
  void take_back();
  void do_again();
  void delete_last();

 private:
  /// The two ends of an artery, one click after the other; nothing before the second.
  std::optional<std::pair<geometry::Vec3, geometry::Vec3>> two_ends(const geometry::Vec3& end);
  void first_vessel(const session::OpenImage& image, const geometry::Vec3& from, const geometry::Vec3& end);
  void another_artery(const session::OpenImage& image, const geometry::Vec3& from, const geometry::Vec3& end);
  void branch(const session::OpenImage& image, const geometry::Vec3& end);
  void take(const std::any& found);
  void join(const lumen::Edit& edit, const std::vector<std::string>& warnings);
  bool image_is_there();
  void drop_begun();
  void put_aside(bool deleted);
  void bring_back();
  Desk& desk_;
  Opening& opening_;
  std::filesystem::path begun_;  // the case that was begun by hand
  std::filesystem::path aside_;
  bool aside_deleted_ = false;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
