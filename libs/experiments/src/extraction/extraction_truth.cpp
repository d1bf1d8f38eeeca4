#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/experiments/extraction.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using TruthJson = nlohmann::json;

/// As the found ones are graded: by the diameter of the circle with the lumen's area. The case's own
/// `diameter_stenosis` is of the mean distance from the axis, which in an eccentric lumen is less.
std::vector<evaluation::Lesion> lesions_of(const TruthJson& facts) {
  std::vector<evaluation::Lesion> lesions;
  for (const TruthJson& vessel : facts.at("vessels"))
    for (const TruthJson& one : vessel.at("stenoses"))
      lesions.push_back({vessel.at("name"), one.at("s_from_mm"), one.at("s_to_mm"), one.at("s_throat_mm"),
                         1.0 - std::sqrt(1.0 - one.at("area_stenosis").get<double>())});
  return lesions;
}

/// A vessel that the challenge has no reference of, from its own axis.
io::RotterdamReference reference_of(const geometry::VesselTree& tree, const geometry::Vessel& vessel) {
  constexpr double observers_mm = 0.2;  // no observer traced it; the spread of those that did
  const geometry::Centerline axis = geometry::vessel_axis(tree, vessel);
  return {axis.points, axis.radius, std::vector<double>(axis.size(), observers_mm)};
}

void require(const fs::path& file) {
  if (!fs::is_regular_file(file))
    throw InvalidInput((file.parent_path().filename() / file.filename()).string() +
                       " is missing: make the suite by `ostia phantom`");
}

}  // namespace

ExtractionTruth read_extraction_truth(const fs::path& folder) {
  for (const char* name : {"case.json", "centerlines.vtp", "contours.json"}) require(folder / name);
  ExtractionTruth truth;
  truth.case_name = folder.filename().string();
  truth.tree = io::read_centerlines(folder / "centerlines.vtp");
  truth.contours = io::read_contours(folder / "contours.json");
  std::map<std::string, fs::path> annotated;
  try {
    const TruthJson facts = TruthJson::parse(core::read_file(folder / "case.json"));
    truth.lesions = lesions_of(facts);
    for (const TruthJson& one : facts.at("data_set_vessels"))
      annotated[one.at("vessel")] = folder / one.at("folder").get<std::string>() / "reference.txt";
  } catch (const TruthJson::exception& error) {
    throw InvalidInput(truth.case_name + "/case.json: " + error.what());
  }
  for (const geometry::Vessel& vessel : truth.tree.vessels) {
    const auto own = annotated.find(vessel.name);
    if (own != annotated.end()) require(own->second);
    truth.vessels.push_back({vessel.name, own != annotated.end(),
                             own != annotated.end() ? io::read_rotterdam_reference(own->second)
                                                    : reference_of(truth.tree, vessel)});
  }
  return truth;
}

}  // namespace ostia::experiments
