#pragma once
/// \file What a person measures: places in the patient, and what follows from them.

#include "ostia/analysis/lumen_profile.h"
#include "ostia/imaging/volume.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::analysis {

enum class MeasureKind {
  distance,  ///< two points
  angle,     ///< three points, the vertex second
  area,      ///< a closed line of at least three points
  diameter,  ///< two points on one section of the lumen
  stenosis,  ///< a vessel and the abscissas of the proximal and distal reference
  volume,    ///< of a vessel's lumen between two abscissas
  ring_hu,   ///< CT numbers about the lumen, at an abscissa, between two distances from the wall
  arrow,     ///< points at its first point; its name stands at the second
  note,      ///< its name stands beside a point
};
inline constexpr std::array<MeasureKind, 9> measure_kinds = {
    MeasureKind::distance, MeasureKind::angle,    MeasureKind::area,
    MeasureKind::diameter, MeasureKind::stenosis, MeasureKind::volume,
    MeasureKind::ring_hu,  MeasureKind::arrow,    MeasureKind::note};
/// Says something, and measures nothing.
inline bool is_remark(MeasureKind kind) {
  return kind == MeasureKind::arrow || kind == MeasureKind::note;
}

struct MeasureTraits {
  MeasureKind kind;
  std::string_view name;   ///< in case files and reports' tables, where it stays what it is: "ring_hu"
  std::string_view label;  ///< to a person: "HU in a ring"
  std::size_t points;      ///< how many it has; 0: it lies on a vessel's axis
  bool more_points;        ///< that many at least
  std::string_view fault;  ///< what is wrong with another number of them
  bool of_vessel;          ///< it is nowhere but on a vessel
};
/// Throws InvalidInput for a kind that is none of them.
const MeasureTraits& traits_of(MeasureKind kind);
std::string to_string(MeasureKind kind);            ///< MeasureTraits::name
MeasureKind measure_kind(const std::string& name);  ///< throws InvalidInput listing the kinds

/// Plain value, kept in a case file; world points, LPS mm.
struct Measurement {
  std::int32_t id = 0;  ///< never used again within a case
  MeasureKind kind = MeasureKind::distance;
  std::string name;  ///< free text of the person; may be empty
  std::vector<Vec3> points;
  std::int32_t vessel = 0;                ///< of stenosis, volume, ring_hu (and of diameter, 0 for none)
  double from_mm = 0.0, to_mm = 0.0;      ///< abscissas; ring_hu: from_mm is its abscissa
  double inner_mm = 0.0, outer_mm = 1.0;  ///< of ring_hu: distances outside the wall
};
/// What is wrong with it in itself ("an angle needs three points"); nothing if sound.
std::optional<std::string> find_fault(const Measurement& measurement);

struct MeasuredValue {
  std::string name;  ///< "length", "area", "percent diameter", "MLD", ...
  double value = 0.0;
  std::string unit;  ///< "mm", "mm2", "mm3", "deg", "%", "HU"
};

/// What measuring draws on; any may be missing for kinds that do not need it.
struct MeasureContext {
  const lumen::LumenModel* model = nullptr;
  SurfaceOfVessel surface_of;
  std::function<const LumenProfile&(std::int32_t vessel)> profile_of;
  const imaging::ImageVolume* image = nullptr;
};
/// The first value is the one shown beside the mark; remarks have none. Throws InvalidInput for a fault, a
/// vessel that is not there, an abscissa outside it, or a context that lacks what the kind needs.
std::vector<MeasuredValue> measured(const Measurement& measurement, const MeasureContext& context);

/// "12.3 mm", "4.21 mm²": with the decimals that its unit deserves.
std::string to_text(const MeasuredValue& value);

}  // namespace ostia::analysis
