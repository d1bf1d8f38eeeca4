#include "ostia/session/doubts.h"

#include "ostia/core/quantity_text.h"
#include "ostia/core/text.h"
#include "ostia/geometry/axis_curve.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace ostia::session {
namespace {

using CertaintyJson = nlohmann::ordered_json;
using coronary::VesselCertainty;
using coronary::VesselPiece;

constexpr const char* certainty_setting = "certainty";
constexpr double same_axis_mm = 1.0;  // that a place may lie beside an axis that was not moved there

double rounded(double value) {
  constexpr double digits = 1e4;
  return std::round(value * digits) / digits;
}

/// The least sure piece; null without any.
const VesselPiece* least_sure_of(const VesselCertainty& vessel) {
  const auto least = std::min_element(
      vessel.pieces.begin(), vessel.pieces.end(),
      [](const VesselPiece& a, const VesselPiece& b) { return a.probability < b.probability; });
  return least != vessel.pieces.end() ? &*least : nullptr;
}

/// Where a place lies on the model's axes as they are now.
struct OnAxis {
  std::int32_t vessel = 0;
  double s_mm = 0.0;
};

std::optional<OnAxis> on_axis(const lumen::LumenModel& model, const geometry::Vec3& place) {
  std::optional<OnAxis> best;
  double nearest_mm = same_axis_mm;
  for (const auto& vessel : model.vessels) {
    const geometry::AxisFoot foot = vessel->axis->nearest_foot(place);
    if (foot.s_mm < vessel->own_from_mm - same_axis_mm || foot.rho_mm >= nearest_mm) continue;
    nearest_mm = foot.rho_mm;
    best = {vessel->vessel, foot.s_mm};
  }
  return best;
}

/// A piece on the model as it is now.
struct DoubtfulPiece {
  OnAxis at;
  double half_mm = 0.0, length_mm = 0.0;  ///< of the piece; of the whole vessel
  double probability = 0.0;
};

}  // namespace

void keep_certainty(CaseFile& file, const std::vector<VesselCertainty>& certainty) {
  CertaintyJson vessels = CertaintyJson::array();
  for (const VesselCertainty& vessel : certainty) {
    CertaintyJson pieces = CertaintyJson::array();
    for (const VesselPiece& piece : vessel.pieces)
      pieces.push_back({rounded(piece.from_mm), rounded(piece.to_mm), rounded(piece.place.x()),
                        rounded(piece.place.y()), rounded(piece.place.z()), rounded(piece.probability)});
    vessels.push_back(
        {{"id", vessel.vessel}, {"probability", rounded(vessel.probability)}, {"pieces", pieces}});
  }
  file.set_setting(certainty_setting, CertaintyJson{{"v", 1}, {"vessels", vessels}}.dump());
}

std::vector<VesselCertainty> kept_certainty(const CaseFile& file) {
  const std::optional<std::string> text = file.setting(certainty_setting);
  if (!text) return {};
  std::vector<VesselCertainty> certainty;
  try {
    const CertaintyJson all = CertaintyJson::parse(*text);
    if (all.at("v") != 1) return {};
    for (const CertaintyJson& one : all.at("vessels")) {
      VesselCertainty vessel;
      vessel.vessel = one.at("id");
      vessel.probability = one.at("probability");
      for (const CertaintyJson& numbers : one.at("pieces")) {
        VesselPiece piece;
        piece.from_mm = numbers.at(0), piece.to_mm = numbers.at(1);
        piece.place = {numbers.at(2).get<double>(), numbers.at(3).get<double>(), numbers.at(4).get<double>()};
        piece.probability = numbers.at(5);
        vessel.pieces.push_back(piece);
      }
      certainty.push_back(std::move(vessel));
    }
  } catch (const CertaintyJson::exception&) {
    return {};
  }
  return certainty;
}

std::vector<DoubtfulPlace> doubtful_places(const std::vector<VesselCertainty>& certainty,
                                           const lumen::LumenModel& model, const Annotations& annotations,
                                           double below) {
  std::vector<DoubtfulPiece> pieces;
  for (const VesselCertainty& vessel : certainty)
    for (const VesselPiece& piece : vessel.pieces) {
      // A vessel as a whole can be less sure than each of its pieces: then its least sure piece stands for
      // it.
      double probability = piece.probability;
      if (&piece == least_sure_of(vessel)) probability = std::min(probability, vessel.probability);
      if (probability >= below) continue;
      const std::optional<OnAxis> at = on_axis(model, piece.place);
      const VesselMark* mark = at ? find_mark(annotations, at->vessel) : nullptr;
      if (at && !(mark && mark->checked))
        pieces.push_back({*at, 0.5 * (piece.to_mm - piece.from_mm),
                          lumen::vessel(model, at->vessel).axis->length(), probability});
    }
  std::sort(pieces.begin(), pieces.end(), [](const DoubtfulPiece& a, const DoubtfulPiece& b) {
    return a.at.vessel != b.at.vessel ? a.at.vessel < b.at.vessel : a.at.s_mm < b.at.s_mm;
  });
  std::vector<DoubtfulPlace> places;
  for (const DoubtfulPiece& piece : pieces) {
    const double from_mm = std::max(piece.at.s_mm - piece.half_mm, 0.0),
                 to_mm = std::min(piece.at.s_mm + piece.half_mm, piece.length_mm);
    const bool goes_on = !places.empty() && places.back().vessel == piece.at.vessel &&
                         from_mm <= places.back().to_mm + same_axis_mm;
    if (!goes_on) {
      places.push_back({piece.at.vessel, piece.at.s_mm, from_mm, to_mm, piece.probability});
      continue;
    }
    DoubtfulPlace& place = places.back();
    place.to_mm = std::max(place.to_mm, to_mm);
    if (piece.probability < place.probability)
      place.s_mm = piece.at.s_mm, place.probability = piece.probability;
  }
  std::stable_sort(places.begin(), places.end(), [](const DoubtfulPlace& a, const DoubtfulPlace& b) {
    return a.probability < b.probability;
  });
  return places;
}

std::map<std::int32_t, double> unlikely_vessels(const std::vector<VesselCertainty>& certainty,
                                                const lumen::LumenModel& model,
                                                const Annotations& annotations, double below) {
  std::map<std::int32_t, double> unlikely;
  for (const VesselCertainty& found : certainty) {
    if (found.probability >= below) continue;
    const VesselMark* mark = find_mark(annotations, found.vessel);
    if (mark && mark->checked) continue;
    const bool as_found =
        std::any_of(found.pieces.begin(), found.pieces.end(), [&](const VesselPiece& piece) {
          const std::optional<OnAxis> at = on_axis(model, piece.place);
          return at && at->vessel == found.vessel;
        });
    if (as_found) unlikely[found.vessel] = found.probability;
  }
  return unlikely;
}

std::string doubt_text(const VesselCertainty& certainty, double below) {
  const VesselPiece* const least = least_sure_of(certainty);
  if (!least || std::min(certainty.probability, least->probability) >= below) return {};
  std::string text = "probability " + core::ratio_text(certainty.probability);
  if (least->probability < certainty.probability && certainty.pieces.size() > 1)
    text += ", " + core::ratio_text(least->probability) + " from " + core::length_text(least->from_mm) +
            " to " + core::length_text(least->to_mm) + " mm";
  return text;
}

}  // namespace ostia::session
