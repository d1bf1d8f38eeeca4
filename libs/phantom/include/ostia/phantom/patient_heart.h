#pragma once
/// \file A synthetic heart around a patient's own coronary tree (docs/methods/phantom-trees.md).

#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/heart.h"
#include "ostia/phantom/heart_warp.h"
#include "ostia/phantom/patient_tree.h"

#include <memory>
#include <string>
#include <vector>

namespace ostia::phantom {

/// Of a vessel, how much the patient had and how much was grown.
struct PatientPart {
  std::string vessel;
  double measured_mm = 0.0, grown_mm = 0.0;
};

/// How the heart came to lie under the arteries.
struct PatientRecord {
  std::string digest;  ///< PatientTree::digest
  double rim_mm = 0.0;
  /// The patient was moved as a whole, by `rotation` and then `shift_mm`, into the phantom's chest.
  geometry::Mat3 rotation = geometry::Mat3::Identity();
  Vec3 shift_mm = Vec3::Zero();
  Vec3 size = Vec3::Ones();  ///< of the patient's heart over the phantom's: to the right, up, along the axis
  double height_mm = 0.0;    ///< root mean square of how far arteries are from their usual height above the
                             ///< epicardium, before it is bent
  double groove_mm = 0.0;    ///< the same, from their grooves
  double height_left_mm = 0.0, groove_left_mm = 0.0;                      ///< the same after it
  double least_jacobian = 1.0, largest_jacobian = 1.0, longest_mm = 0.0;  ///< of the map (HeartWarp)
  int smoothings = 0;
  std::vector<PatientPart> parts;    ///< in the tree's order; drawn vessels have nothing measured
  std::vector<std::string> remarks;  ///< what was mended, grown and left out, in plain words
};

struct PatientHeart {
  std::shared_ptr<const HeartWarp> warp;
  CoronaryTree tree;
  PatientRecord record;
};

/// The patient's tree is moved as a whole to where it fits on the heart best, and the heart is bent smoothly
/// until the arteries run where arteries run. Vessels that stop early go on by the phantom's own rules, and
/// usual ones that are missing are drawn. Names that are not known are "V1", "V2", .... Throws InvalidInput
/// for what `validate` says, a tree without an LAD, a heart that would be less than 0.7 or more than 1.4
/// times as large as usual (a mask of another scale), arteries that lie on no heart (20 mm off), a map that
/// folds. The same for any number of threads.
PatientHeart patient_heart(const PatientTree& patient, const HeartShape& heart,
                           const CoronaryOptions& options);

/// How well a tree lies on a heart, without building one: to compare ways in which a file may be meant.
struct PatientLie {
  double height_mm = 0.0, groove_mm = 0.0;  ///< PatientRecord's
  Vec3 size = Vec3::Ones();
  bool left = false, right = false;  ///< an LAD, an RCA
};
PatientLie lie_of(const PatientTree& patient, const HeartShape& heart);

}  // namespace ostia::phantom
