#include "number_rows.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/io/contour_file.h"

#include <algorithm>
#include <map>

namespace ostia::io {
namespace {

using geometry::Contour;
using geometry::ContourSection;
using geometry::Vec3;

/// Reads one line's columns.
class Row {
 public:
  Row(const std::filesystem::path& path, const NumberRow& row) : path_(path), row_(row) {}
  std::string text(int column, const std::string& otherwise) const {
    return column < 0 ? otherwise : std::string(word(column));
  }
  double number(int column) const { return number_in(word(column), path_, row_.line); }

 private:
  std::string_view word(int column) const {
    if (column < 0 || static_cast<std::size_t>(column) >= row_.words.size())
      throw InvalidInput(path_.string() + ": line " + std::to_string(row_.line) + ": has no column " +
                         std::to_string(column) + " (counted from 0)");
    return row_.words[static_cast<std::size_t>(column)];
  }
  const std::filesystem::path& path_;
  const NumberRow& row_;
};

/// Counter-clockwise looking distally, by the way to the next contour; the first point stays.
void turn_distally(ContourSection& section) {
  auto& all = section.contours;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t a = i + 1 < all.size() ? i : i - 1;
    if (all.size() < 2 || all[i].points.size() < 3) return;
    const Vec3 along = geometry::contour_centroid(all[a + 1]) - geometry::contour_centroid(all[a]);
    if (geometry::contour_normal(all[i]).dot(along) < 0.0)
      std::reverse(all[i].points.begin() + 1, all[i].points.end());
  }
}

}  // namespace

geometry::ContourSet read_contour_table(const std::filesystem::path& path, const ContourColumns& columns) {
  if (!(columns.unit_mm > 0.0)) throw InvalidInput("the unit of a table of contours must be positive");
  const std::string text = core::read_file(path);
  const std::vector<NumberRow> rows = rows_of(text, columns.separator);
  if (rows.empty()) throw InvalidInput(path.string() + " is empty: it holds no contour");
  geometry::ContourSet set;
  std::map<std::string, std::size_t> places;
  for (const NumberRow& one : rows) {
    const Row row(path, one);
    ContourSection section;
    section.section = row.text(columns.section, "s01");
    section.observer = row.text(columns.observer, columns.default_observer);
    section.vessel = row.text(columns.vessel, columns.default_vessel);
    const bool diseased = row.text(columns.health, "") == columns.diseased_word;
    section.health = diseased ? geometry::Health::diseased : geometry::Health::healthy;
    const std::string key = section.section + "\n" + section.observer + "\n" + section.vessel;
    const auto [place, fresh] = places.emplace(key, set.sections.size());
    if (fresh) set.sections.push_back(section);
    auto& contours = set.sections[place->second].contours;
    const double s_mm = row.number(columns.s_mm) * columns.unit_mm;
    if (contours.empty() || contours.back().s_mm != s_mm) contours.push_back({s_mm, {}});
    Vec3 p(row.number(columns.x), row.number(columns.y), row.number(columns.z));
    if (columns.ras) p = Vec3(-p.x(), -p.y(), p.z());
    contours.back().points.push_back(columns.unit_mm * p);
  }
  for (ContourSection& section : set.sections) {
    turn_distally(section);
    if (const auto fault = geometry::find_fault(section))
      throw InvalidInput(path.string() + ": section " + section.section + " of " + section.observer + ": " +
                         *fault);
  }
  return set;
}

}  // namespace ostia::io
