#pragma once
/// \file The text files of the Rotterdam centerline challenge: world mm, one point a line, blanks between
/// numbers. http://coronary.bigr.nl/centerlines/

#include "ostia/geometry/vec.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::io {

using geometry::Vec3;

/// `reference.txt`: five columns x y z r io.
struct RotterdamReference {
  std::vector<Vec3> points;
  std::vector<double> radius;           ///< mm
  std::vector<double> observer_spread;  ///< io: how far the observers were from each other there, mm
};
/// Throws InvalidInput naming the file and the line for an empty file, another number of columns, numbers
/// that are not finite or use a decimal comma, fewer than two places, a radius or spread that is not
/// positive. IoError where it cannot be read. Text after `#`, blank lines, a byte order mark and CRLF are
/// taken, and so are points that repeat the one before, which are kept; the locale has no say.
RotterdamReference read_rotterdam_reference(const std::filesystem::path& path);
/// With six decimals (1 nm), whole or not at all. The writers refuse what the readers would refuse, and
/// points that repeat the one before.
void write_rotterdam_reference(const std::filesystem::path& path, const RotterdamReference& reference);

/// How many points are at the very place of the one before.
std::size_t count_repeated(const std::vector<Vec3>& points);
/// The same without those, for what needs a direction at each point.
RotterdamReference without_repeated(const RotterdamReference& line);

/// A line with radii where its columns say so: three (x y z), four (x y z r) or five (x y z r io). Throws as
/// read_rotterdam_reference does.
RotterdamReference read_rotterdam_axis(const std::filesystem::path& path);
/// True for a text that begins with rows of three to five numbers with blanks between them, two at least.
bool is_rotterdam_line(const std::filesystem::path& path);

/// `result.txt`: x y z; a radius and the observers' spread may follow, as references have them, and are
/// ignored.
std::vector<Vec3> read_rotterdam_line(const std::filesystem::path& path);
void write_rotterdam_line(const std::filesystem::path& path, const std::vector<Vec3>& points);

/// `pointA.txt`, `pointB.txt`, `pointS.txt`, `pointE.txt`: one x y z.
Vec3 read_rotterdam_point(const std::filesystem::path& path);
void write_rotterdam_point(const std::filesystem::path& path, const Vec3& point);

}  // namespace ostia::io
