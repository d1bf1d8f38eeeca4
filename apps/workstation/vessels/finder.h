#pragma once
/// \file Vessels that the program finds in the image: the whole tree, or one by a click.

#include "ostia/segmentation/minimal_path.h"
#include "ostia/session/workbench.h"

#include <QObject>
#include <any>
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
  Desk& desk_;
  Opening& opening_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
