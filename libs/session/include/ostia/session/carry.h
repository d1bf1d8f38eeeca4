#pragma once
/// \file A checked tree of one scan carried onto another scan of the same patient (docs/methods/carry.md).

#include "ostia/analysis/tree_match.h"
#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/registration/register.h"
#include "ostia/session/annotation.h"
#include "ostia/session/case_file.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

struct CarryOptions {
  /// How far the image may pull an axis from where the map has carried it, [0.5, 10].
  double reach_mm = 3.0;
  /// The later scan is searched for its own tree, too: where to begin, and which vessels came.
  bool search = true;
  bool anyway = false;  ///< scans that are hardly of one patient are carried, too, and it is told
};
void validate(const CarryOptions& options);  ///< throws InvalidInput

enum class CarriedHow {
  followed,   ///< pulled to the vessel that the later scan shows
  as_mapped,  ///< kept where the map has carried it: the image does not show the way
  left_out,   ///< it is not in the carried tree
};
std::string to_string(CarriedHow how);  ///< "followed", "as mapped", "left out"

/// What became of a vessel of the former tree; lengths and shares are of its own part.
struct CarriedVessel {
  std::int32_t vessel = 0;  ///< its id, the same in both trees
  std::string name;
  CarriedHow how = CarriedHow::left_out;
  double before_mm = 0.0, after_mm = 0.0;         ///< lengths
  double shift_mm = 0.0, largest_shift_mm = 0.0;  ///< from the mapped axis to the pulled one
  double unseen_mm = 0.0;          ///< within it, without contrast: there the former axis and wall are kept
  double cut_mm = 0.0;             ///< of its end that is not carried
  double wall_kept_share = 0.0;    ///< of the wall that is the former one, the image being unclear
  std::vector<std::string> notes;  ///< what a person should look at; why it is left out
};

/// A vessel of the later scan that the former tree does not have.
struct CameVessel {
  std::string name;
  geometry::Vec3 place = geometry::Vec3::Zero();  ///< the middle of its own part, mm, in the later scan
  double length_mm = 0.0;
  double probability = 0.0;  ///< that it is an artery, by the search
};

struct CarriedModel {
  lumen::LumenModel model;  ///< ids of vessels are those of the former one
  Annotations annotations;
  std::vector<CarriedVessel> vessels;    ///< all of the former tree, in its order
  std::vector<std::string> not_carried;  ///< of what was noted, a sentence each
  double followed_share = 0.0;           ///< of the former tree's length
};

/// Carries a model and what was noted on it by a known map. Axes go along point by point and are pulled to
/// the middle of the lumen within reach; an end that the image does not show for more than 3 mm is cut, a
/// vessel of which less than 5 mm (or half) is seen is left out with all that hangs on it; where a stretch
/// within a vessel shows no lumen the former shape bridges it. Walls are found anew on rays; where their edge
/// is unclear they are the former ones, turned with the axis. Names, colours, comments, the reader's words
/// on lesions and measurements go along; nothing is checked any more, and each vessel's note says so.
/// Deterministic, the same for any number of threads. Throws InvalidInput for bad options, a map that is not
/// finite, no vessel that the image shows; what lumen::solve and lumen::model_of_walls throw; Cancelled.
CarriedModel carry_model(const lumen::LumenModel& before, const Annotations& annotations,
                         const imaging::ImageVolume& after_image, const analysis::PointMap& map,
                         const CarryOptions& options = {}, const core::TaskContext& task = core::no_task());

struct CarriedCase {
  CarriedModel carried;
  registration::Registration registration;
  bool searched = false;         ///< the later scan's own tree was found
  std::vector<CameVessel> came;  ///< where it was, by the search's order
  std::string another_patient;   ///< why the scans are hardly of one patient; empty where they may be
  std::vector<std::string> warnings;
  /// Nobody needs to look at more than what is carried anyway.
  bool well() const;
};

/// Lays the scans onto each other (by the trees' ostia and forks where the search finds them, then by the
/// images) and carries the model. Throws as register_scans and carry_model do, and InvalidInput for scans
/// that are hardly of one patient or do not fit (unless `anyway`): the verdict of the registration, the trees
/// (analysis::why_another_patient) where the images do not say otherwise, or less than half of the tree that
/// is seen.
CarriedCase carry_case(const lumen::LumenModel& before, const Annotations& annotations,
                       const imaging::ImageVolume& before_image, const imaging::ImageVolume& after_image,
                       const CarryOptions& options = {}, const core::TaskContext& task = core::no_task());

/// A new case whose beginning is the carried model, what was noted as steps behind it. Throws as
/// CaseFile::create does; then there is no such file.
CaseFile create_case(const std::filesystem::path& path, const CarriedModel& carried,
                     const std::optional<ImageReference>& image);

std::string carried_json(const CarriedCase& carried);  ///< docs/schemas/carried-case.schema.json

}  // namespace ostia::session
