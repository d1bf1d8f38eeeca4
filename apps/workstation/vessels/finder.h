#pragma once
/// \file Vessels that the program finds in the image: the whole tree, or one by a click.

#include "ostia/segmentation/minimal_path.h"
#include "ostia/session/workbench.h"

#include <QObject>
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
  /// By its distal end: joined to the tree, or, without a case, by two clicks the first vessel of a new one.
  void find_vessel(const geometry::Vec3& end);

 private:
  void first_vessel(const session::OpenImage& image, const geometry::Vec3& end);
  void join_way(const segmentation::MinimalPath& way);
  bool image_is_there();
  void drop_begun();
  Desk& desk_;
  Opening& opening_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
