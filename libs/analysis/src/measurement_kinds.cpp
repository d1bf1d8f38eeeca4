#include "ostia/analysis/measurement_kinds.h"

#include "ostia/core/error.h"

#include <algorithm>

namespace ostia::analysis {
namespace {

// Kind, name, label; points, more, fault; of a vessel.
constexpr std::array<MeasureTraits, measure_kinds.size()> measure_table = {{
    {MeasureKind::distance, "distance", "distance", 2, false, "a distance needs two points", false},
    {MeasureKind::angle, "angle", "angle", 3, false, "an angle needs three points, its vertex second", false},
    {MeasureKind::area, "area", "area", 3, true, "an area needs a line of at least three points", false},
    {MeasureKind::diameter, "diameter", "diameter", 2, false, "a diameter needs two points", false},
    {MeasureKind::stenosis, "stenosis", "stenosis", 0, true, "", true},
    {MeasureKind::volume, "volume", "volume", 0, true, "", true},
    {MeasureKind::ring_hu, "ring_hu", "HU in a ring", 0, true, "", true},
    {MeasureKind::arrow, "arrow", "arrow", 2, false, "an arrow needs two points, its tip first", false},
    {MeasureKind::note, "note", "note", 1, false, "a note needs one place", false},
}};

}  // namespace

const MeasureTraits* find_traits(MeasureKind kind) {
  const auto found = std::ranges::find(measure_table, kind, &MeasureTraits::kind);
  return found == measure_table.end() ? nullptr : &*found;
}

const MeasureTraits& traits_of(MeasureKind kind) {
  if (const MeasureTraits* traits = find_traits(kind)) return *traits;
  throw InvalidInput("a kind of measurement that is none of those there are");
}

std::string to_string(MeasureKind kind) {
  return std::string(traits_of(kind).name);
}

MeasureKind measure_kind(const std::string& name) {
  std::string known;
  for (const MeasureTraits& one : measure_table) {
    if (name == one.name) return one.kind;
    known += (known.empty() ? "" : ", ") + std::string(one.name);
  }
  throw InvalidInput("there is no measurement called \"" + name + "\"; choose one of " + known);
}

}  // namespace ostia::analysis
