#include "ostia/reformat/section.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>

namespace ostia::reformat {
namespace {

using EdgeKey = std::uint64_t;

EdgeKey edge_key(std::int32_t a, std::int32_t b) {
  const auto low = static_cast<std::uint32_t>(std::min(a, b));
  const auto high = static_cast<std::uint32_t>(std::max(a, b));
  return (static_cast<EdgeKey>(low) << 32) | high;
}

/// One triangle's share of the section, from the edge where it enters to the edge where it leaves.
struct Piece {
  EdgeKey from = 0, to = 0;
  bool used = false;
};

/// Height of each point above the plane; zero is lifted to "in front" by the comparison `< 0`.
std::vector<double> heights(const geometry::TriMesh& surface, const Vec3& point, const Vec3& normal) {
  std::vector<double> result(surface.points.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = (surface.points[i] - point).dot(normal);
    if (!std::isfinite(result[i])) {
      throw InvalidInput("point " + std::to_string(i) + " of the surface to cut is not finite");
    }
  }
  return result;
}

std::vector<Piece> pieces_of(const geometry::TriMesh& surface, const std::vector<double>& height) {
  std::vector<Piece> pieces;
  const auto count = static_cast<std::int32_t>(surface.points.size());
  for (const geometry::Triangle& triangle : surface.triangles) {
    for (const std::int32_t corner : triangle) {
      if (corner < 0 || corner >= count) {
        throw InvalidInput("a triangle of the surface to cut names point " + std::to_string(corner) + " of " +
                           std::to_string(count));
      }
    }
    Piece piece;
    bool crosses = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = triangle[k];
      const std::int32_t b = triangle[(k + 1) % 3];
      const bool a_behind = height[static_cast<std::size_t>(a)] < 0.0;
      const bool b_behind = height[static_cast<std::size_t>(b)] < 0.0;
      if (a_behind == b_behind) continue;
      crosses = true;
      // The direction follows from the triangle's winding, so neighbours agree on it.
      (a_behind ? piece.from : piece.to) = edge_key(a, b);
    }
    if (crosses) pieces.push_back(piece);
  }
  return pieces;
}

Vec3 crossing(const geometry::TriMesh& surface, const std::vector<double>& height, EdgeKey key) {
  const auto a = static_cast<std::size_t>(key >> 32);
  const auto b = static_cast<std::size_t>(key & 0xffffffffU);
  const double t = height[a] / (height[a] - height[b]);
  return surface.points[a] + t * (surface.points[b] - surface.points[a]);
}

/// Pieces by the edge where they begin or end, so that lines can be followed both ways.
using PieceIndex = std::unordered_multimap<EdgeKey, std::size_t>;

std::optional<std::size_t> take_unused(const PieceIndex& index, std::vector<Piece>& pieces, EdgeKey key) {
  const auto range = index.equal_range(key);
  std::optional<std::size_t> found;  // the lowest, so that the result does not depend on the hash table
  for (auto it = range.first; it != range.second; ++it) {
    if (!pieces[it->second].used && (!found || it->second < *found)) found = it->second;
  }
  if (found) pieces[*found].used = true;
  return found;
}

std::vector<std::vector<EdgeKey>> chained(std::vector<Piece> pieces) {
  PieceIndex by_from;
  PieceIndex by_to;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    by_from.emplace(pieces[i].from, i);
    by_to.emplace(pieces[i].to, i);
  }
  std::vector<std::vector<EdgeKey>> lines;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].used) continue;
    pieces[i].used = true;
    std::vector<EdgeKey> forward{pieces[i].from, pieces[i].to};
    while (forward.back() != forward.front()) {
      const auto next = take_unused(by_from, pieces, forward.back());
      if (!next) break;
      forward.push_back(pieces[*next].to);
    }
    std::vector<EdgeKey> backward;
    EdgeKey head = forward.front();
    while (forward.back() != head) {
      const auto previous = take_unused(by_to, pieces, head);
      if (!previous) break;
      head = pieces[*previous].from;
      backward.push_back(head);
    }
    std::reverse(backward.begin(), backward.end());
    backward.insert(backward.end(), forward.begin(), forward.end());
    lines.push_back(std::move(backward));
  }
  return lines;
}

}  // namespace

std::vector<std::vector<Vec3>> section(const geometry::TriMesh& surface, const Vec3& point,
                                       const Vec3& normal) {
  if (!point.allFinite() || !normal.allFinite() || !(normal.norm() > 0.0)) {
    throw InvalidInput("a section needs a finite point and a normal that is not zero");
  }
  const std::vector<double> height = heights(surface, point, normal.normalized());
  std::vector<std::vector<Vec3>> result;
  for (const std::vector<EdgeKey>& chain : chained(pieces_of(surface, height))) {
    std::vector<Vec3> line;
    line.reserve(chain.size());
    for (const EdgeKey key : chain) {
      const Vec3 p = crossing(surface, height, key);
      if (line.empty() || (p - line.back()).norm() > 0.0) line.push_back(p);  // vertices in the plane repeat
    }
    if (line.size() > 1) result.push_back(std::move(line));
  }
  return result;
}

std::vector<std::vector<Vec3>> section(const geometry::TriMesh& surface, const Plane& plane) {
  validate(plane);
  return section(surface, plane.origin, plane.normal());
}

double length(const std::vector<Vec3>& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += (line[i] - line[i - 1]).norm();
  return sum;
}

double enclosed_area(const std::vector<Vec3>& closed_line) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < closed_line.size(); ++i) {
    sum += 0.5 * (closed_line[i - 1] - closed_line[0]).cross(closed_line[i] - closed_line[0]);
  }
  return sum.norm();
}

}  // namespace ostia::reformat
