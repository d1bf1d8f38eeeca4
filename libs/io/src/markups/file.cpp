#include "formats.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

std::string lower_name(const fs::path& path) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

using Reader = MarkupsFile (*)(const fs::path&);
constexpr std::array<std::pair<std::string_view, Reader>, 4> readers{{{".json", markups::read_json},
                                                                      {".fcsv", markups::read_fcsv},
                                                                      {".csv", markups::read_table},
                                                                      {".tsv", markups::read_table}}};

/// Nothing where no reader takes the name.
Reader reader_of(const fs::path& path) {
  const std::string name = lower_name(path);
  for (const auto& [extension, read] : readers)
    if (name.ends_with(extension)) return read;
  return nullptr;
}

void require_writable(const fs::path& path, const std::vector<Markup>& markups) {
  const auto refuse_to_write = [&](const Markup& markup, const std::string& what) {
    throw InvalidInput("cannot write " + path.string() + ": the list \"" + markup.name + "\" " + what);
  };
  if (markups.empty()) throw InvalidInput("cannot write " + path.string() + ": there are no points");
  for (const Markup& markup : markups) {
    const std::size_t n = markup.points.size();
    if (n == 0) refuse_to_write(markup, "has no points");
    if (!markup.labels.empty() && markup.labels.size() != n)
      refuse_to_write(
          markup, "has " + std::to_string(markup.labels.size()) + " labels for " + markups::points_text(n));
    if (!markup.radius.empty() && markup.radius.size() != n)
      refuse_to_write(
          markup, "has " + std::to_string(markup.radius.size()) + " radii for " + markups::points_text(n));
    for (const geometry::Vec3& p : markup.points)
      if (!p.allFinite()) refuse_to_write(markup, "has a point that is not finite");
    for (const double r : markup.radius)
      if (!(r > 0.0 && r < markups::most_mm)) refuse_to_write(markup, "has a radius that is not positive");
  }
}

}  // namespace

bool is_markups_file(const fs::path& path) {
  const std::string name = lower_name(path);
  return name.ends_with(".mrk.json") || name.ends_with(".fcsv");
}

bool is_point_file(const fs::path& path) {
  return reader_of(path) != nullptr;
}

MarkupsFile read_markups(const fs::path& path) {
  if (const auto read = reader_of(path)) return read(path);
  markups::refuse(path, "files of points end in .mrk.json, .fcsv, .csv or .tsv");
}

void write_markups(const fs::path& path, const std::vector<Markup>& markups) {
  if (!is_markups_file(path))
    throw InvalidInput("cannot write " + path.string() + ": markups are written as .mrk.json or .fcsv");
  require_writable(path, markups);
  core::write_file(
      path, lower_name(path).ends_with(".fcsv") ? markups::fcsv_text(markups) : markups::json_text(markups));
}

namespace markups {

void refuse(const fs::path& path, const std::string& what) {
  throw InvalidInput("cannot read " + path.string() + ": " + what);
}

std::string points_text(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " point" : " points");
}

}  // namespace markups
}  // namespace ostia::io
