#pragma once
/// \file The kinds of measurements that there are, and what each is made of.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

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
/// Null for a kind that is none of them.
const MeasureTraits* find_traits(MeasureKind kind);
/// Throws InvalidInput for a kind that is none of them.
const MeasureTraits& traits_of(MeasureKind kind);
std::string to_string(MeasureKind kind);            ///< MeasureTraits::name
MeasureKind measure_kind(const std::string& name);  ///< throws InvalidInput listing the kinds

}  // namespace ostia::analysis
