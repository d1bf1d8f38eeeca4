#include "ostia/session/carry.h"

#include "follow_up/carry_axes.h"
#include "follow_up/carry_notes.h"
#include "follow_up/carry_walls.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/coronary/extract.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/session/case_report.h"
#include "ostia/session/scan_map.h"

#include <algorithm>
#include <numeric>
#include <system_error>

namespace ostia::session {
namespace {

constexpr double least_reach_mm = 0.5, most_reach_mm = 10.0;
constexpr double least_followed = 0.5;   // of the tree, of one patient
constexpr double surely_followed = 0.8;  // where the images are doubtful, or the trees say otherwise

/// The later scan's own tree, and how the former one lies to it.
struct OwnTree {
  std::optional<coronary::Extraction> found;
  std::optional<analysis::TreeFit> fit;
  std::string why_not;          ///< nothing was found
  std::string another_patient;  ///< by the trees
};

OwnTree own_tree(const geometry::VesselTree& before, const imaging::ImageVolume& after,
                 const core::TaskContext& task) {
  OwnTree out;
  try {
    out.found = coronary::extract(after, {}, task);
    const geometry::VesselTree& tree = out.found->vessels.tree;
    out.fit = analysis::fit_trees(before, tree);
    out.another_patient =
        analysis::why_another_patient(*out.fit, analysis::match_trees(before, tree, out.fit->motion));
  } catch (const InvalidInput& error) {
    out.why_not = error.what();
  } catch (const GeometryError& error) {
    out.why_not = error.what();
  }
  return out;
}

std::vector<CameVessel> came_vessels(const coronary::Extraction& found, const geometry::VesselTree& carried) {
  const geometry::VesselTree& tree = found.vessels.tree;
  const analysis::TreeMatch match =
      analysis::match_trees(carried, tree, [](const geometry::Vec3& place) { return place; });
  std::vector<CameVessel> came;
  for (std::size_t i = 0; i < tree.vessels.size(); ++i) {
    const geometry::Vessel& vessel = tree.vessels[i];
    if (std::ranges::find(match.after_alone, vessel.id) == match.after_alone.end()) continue;
    const geometry::AxisCurve axis(geometry::vessel_axis(tree, vessel));
    const double own = lumen::own_from_mm(tree, vessel.id);
    came.push_back({vessel.name, axis.point(0.5 * (own + axis.length())), axis.length() - own,
                    i < found.certainty.size() ? found.certainty[i].probability : 0.0});
  }
  return came;
}

double followed_share(const std::vector<CarriedVessel>& vessels) {
  double all = 0.0, followed = 0.0;
  for (const CarriedVessel& one : vessels) {
    all += one.before_mm;
    if (one.how == CarriedHow::followed)
      followed += std::max(0.0, one.before_mm - one.cut_mm - one.unseen_mm);
  }
  return all > 0.0 ? followed / all : 0.0;
}

/// Why the scans are hardly of one patient, or cannot be laid onto each other; empty where they may be.
std::string doubt_about_patient(const registration::Quality& quality, const OwnTree& own, double followed) {
  if (quality.verdict == registration::Verdict::failed) return quality.reason;
  const bool good = quality.verdict == registration::Verdict::good;
  const double least = good ? least_followed : surely_followed;
  if (followed < least)
    return "only " + core::rounded_text(100.0 * followed, 0) +
           " % of the tree could be followed in the later scan (one patient's: " +
           core::rounded_text(100.0 * least, 0) + " % or more" +
           (good ? ")" : ", where the scans lie doubtfully on each other: " + quality.reason + ")");
  return good && followed >= surely_followed ? std::string() : own.another_patient;
}

void require_one_patient(const std::string& doubt, const CarryOptions& options) {
  if (doubt.empty() || options.anyway) return;
  throw InvalidInput("the two scans are hardly of one patient, or do not fit: " + doubt +
                     "; carry it with --anyway if they are");
}

}  // namespace

void validate(const CarryOptions& options) {
  if (!(options.reach_mm >= least_reach_mm && options.reach_mm <= most_reach_mm))
    throw InvalidInput("carrying a tree: reach_mm is from " + core::trimmed_text(least_reach_mm, 1) + " to " +
                       core::trimmed_text(most_reach_mm, 1) + ", not " +
                       core::shown_text(options.reach_mm, 3));
}

std::string to_string(CarriedHow how) {
  if (how == CarriedHow::followed) return "followed";
  return how == CarriedHow::as_mapped ? "as mapped" : "left out";
}

bool CarriedCase::well() const {
  return another_patient.empty() && registration.quality.verdict == registration::Verdict::good &&
         std::ranges::all_of(carried.vessels,
                             [](const CarriedVessel& one) { return one.how == CarriedHow::followed; });
}

CarriedModel carry_model(const lumen::LumenModel& before, const Annotations& annotations,
                         const imaging::ImageVolume& after_image, const analysis::PointMap& map,
                         const CarryOptions& options, const core::TaskContext& task) {
  validate(options);
  task.set_stage("axes in the later scan");
  CarriedTree tree = carried_tree(before.tree, after_image, map, options, task.sub(0.0, 0.2));
  task.set_stage("walls of the former scan");
  const analysis::SurfaceOfVessel surfaces = solved_surfaces(before, task.sub(0.2, 0.5));
  task.set_stage("walls in the later scan");
  CarriedModel out;
  const std::vector<lumen::RadialWall> walls =
      carried_walls(before, surfaces, tree, after_image, map, task.sub(0.5, 1.0));
  out.model = lumen::model_of_walls(tree.tree, walls);
  out.model.blend = before.blend;
  out.model.next_tree_id = std::max(out.model.next_tree_id, before.next_tree_id);
  out.annotations = carried_notes(before, annotations, tree, map, out.not_carried);
  for (CarriedLine& line : tree.lines) out.vessels.push_back(std::move(line.told));
  out.followed_share = followed_share(out.vessels);
  task.set_progress(1.0);
  return out;
}

CarriedCase carry_case(const lumen::LumenModel& before, const Annotations& annotations,
                       const imaging::ImageVolume& before_image, const imaging::ImageVolume& after_image,
                       const CarryOptions& options, const core::TaskContext& task) {
  validate(options);
  CarriedCase out;
  OwnTree own;
  if (options.search) {
    own = own_tree(before.tree, after_image, task.sub(0.0, 0.3));
    if (!own.why_not.empty())
      out.warnings.push_back("the search finds no tree in the later scan to begin with: " + own.why_not);
  }
  const bool known = own.fit && own.another_patient.empty();
  out.registration = registration::register_scans(
      before_image, after_image, guidance_of(before.tree, before_image, known ? &*own.fit : nullptr), {},
      task.sub(0.3, 0.6));
  const registration::Quality& quality = out.registration.quality;
  if (quality.verdict == registration::Verdict::failed)
    require_one_patient(doubt_about_patient(quality, own, 1.0), options);
  if (quality.verdict == registration::Verdict::doubtful)
    out.warnings.push_back("the scans lie doubtfully on each other: " + quality.reason);
  out.carried = carry_model(before, annotations, after_image, scan_map(out.registration).map, options,
                            task.sub(0.6, 1.0));
  out.another_patient = doubt_about_patient(quality, own, out.carried.followed_share);
  require_one_patient(out.another_patient, options);
  if (!out.another_patient.empty())
    out.warnings.push_back("hardly one patient: " + out.another_patient);
  else if (!own.another_patient.empty())
    out.warnings.push_back("the search's tree lies otherwise (" + own.another_patient +
                           "), the images and the carried tree do not say so");
  out.searched = own.found.has_value();
  if (own.found) out.came = came_vessels(*own.found, out.carried.model.tree);
  return out;
}

CaseFile create_case(const std::filesystem::path& path, const CarriedModel& carried,
                     const std::optional<ImageReference>& image) {
  CaseFile made = CaseFile::create(path, carried.model, image);
  try {
    for (const VesselMark& mark : carried.annotations.marks) made.annotate(MarkVessel{mark});
    for (const analysis::Measurement& one : carried.annotations.measurements) made.annotate(MeasureAdd{one});
  } catch (...) {
    { const CaseFile closed = std::move(made); }
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    throw;
  }
  return made;
}

}  // namespace ostia::session
