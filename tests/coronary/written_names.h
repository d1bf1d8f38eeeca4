#pragma once
/// \file The names that a reader wrote down for patients' trees (data/names).

#include "ostia/core/csv.h"
#include "ostia/geometry/polyline.h"
#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::testing {

struct WrittenName {
  std::string patient;
  geometry::Vec3 place;     ///< on the vessel, LPS, mm
  std::string name, other;  ///< `other` is as good; empty: nothing is
};

/// All rows below the head.
inline std::vector<WrittenName> written_names(const std::filesystem::path& csv) {
  std::ifstream in(csv, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::string_view rest = text;
  std::vector<std::vector<std::string>> rows(1);
  while (!rest.empty()) {
    const core::CsvCell cell = core::take_csv_cell(rest);
    rows.back().push_back(cell.text);
    if (cell.last) rows.emplace_back();
  }
  std::vector<WrittenName> names;
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (rows[i].size() >= 6)
      names.push_back({rows[i][0],
                       {std::stod(rows[i][1]), std::stod(rows[i][2]), std::stod(rows[i][3])},
                       rows[i][4],
                       rows[i][5]});
  return names;
}

/// The vessel that owns the segment nearest to a place.
inline const geometry::Vessel& vessel_at(const geometry::VesselTree& tree, const geometry::Vec3& place) {
  double least = 1e9;
  std::int32_t nearest = -1;
  for (const geometry::TreeSegment& segment : tree.segments) {
    const double d = (geometry::closest(segment.axis.points, place).point - place).norm();
    if (d >= least) continue;
    least = d;
    nearest = segment.id;
  }
  for (const geometry::Vessel& vessel : tree.vessels)
    for (const std::int32_t id : vessel.segments)
      if (id == nearest) return vessel;
  return tree.vessels.front();
}

/// Numbers count for D, OM and S; of other branches there may be several in any order.
inline bool is_named(const std::string& found, const WrittenName& written) {
  const auto without_number = [](std::string name) {
    if (name.starts_with("D") || name.starts_with("OM") || name.starts_with("S")) return name;
    while (!name.empty() && name.back() >= '0' && name.back() <= '9') name.pop_back();
    return name;
  };
  return without_number(found) == written.name ||
         (!written.other.empty() && without_number(found) == written.other);
}

}  // namespace ostia::testing
