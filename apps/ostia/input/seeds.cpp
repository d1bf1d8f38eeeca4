#include "input/seeds.h"

#include "input/points.h"
#include "options/model_options.h"
#include "output/refusal.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/polyline.h"
#include "ostia/io/markups_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace ostia::app {
namespace {

using geometry::Vec3;

constexpr double piece_mm = 20.0;  // of a curve, found as from:through:to

/// The unit of coordinates that do not say theirs.
double unit_of(const SeedFrame& frame) {
  return frame.seed_unit_mm.value_or(frame.grid ? 1.0 : frame.unit_mm);
}

Vec3 typed_point(std::string_view text, const SeedFrame& frame) {
  const Vec3 place = parse_point(text, frame.coords, frame.grid);
  return frame.coords == "ijk" ? place : Vec3(place * unit_of(frame));
}

bool all_within(const geometry::Box3& box, const io::MarkupsFile& file, double factor) {
  const Vec3 margin = Vec3::Constant(0.05 * box.sizes().norm());  // a seed may lie just off an end
  const geometry::Box3 wide(box.min() - margin, box.max() + margin);
  return std::all_of(file.markups.begin(), file.markups.end(), [&](const io::Markup& markup) {
    return std::all_of(markup.points.begin(), markup.points.end(),
                       [&](const Vec3& p) { return wide.contains(p * factor); });
  });
}

/// By what a file's points are multiplied to be mm. Slicer writes "mm" whatever the model's unit is; where
/// its points lie on the surface in the surface's own unit alone, that is what they are in.
double factor_for(const io::MarkupsFile& file, const std::string& name, const SeedFrame& frame) {
  if (frame.seed_unit_mm) return *frame.seed_unit_mm / file.unit_mm.value_or(1.0);
  if (!file.unit_mm) return unit_of(frame);
  const double own = frame.unit_mm / *file.unit_mm;
  if (own == 1.0 || frame.box.isEmpty() || all_within(frame.box, file, 1.0) ||
      !all_within(frame.box, file, own))
    return 1.0;
  core::log_warning(name +
                    ": its points lie on the surface in the surface's own unit of length, and are taken "
                    "in it (--seed-units settles it)");
  return own;
}

io::MarkupsFile read_seeds(const std::string& text, const SeedFrame& frame) {
  const std::filesystem::path path(text);
  io::MarkupsFile file = io::read_markups(path);
  for (const std::string& warning : file.warnings) core::log_warning(own_name(path) + ": " + warning);
  const bool voxels = !file.frame_told && frame.coords == "ijk";
  if (!file.frame_told)
    for (io::Markup& markup : file.markups)
      for (Vec3& p : markup.points) p = world_of(p, frame.coords, frame.grid);
  const double factor = voxels ? 1.0 : factor_for(file, own_name(path), frame);
  for (io::Markup& markup : file.markups)
    for (Vec3& p : markup.points) p *= factor;
  return file;
}

segmentation::BranchSeeds parse_branch(std::string_view text, const SeedFrame& frame) {
  const std::vector<std::string_view> points = parts_of(text, ':');
  if (points.size() != 2 && points.size() != 3) {
    throw InvalidInput(
        "\"" + std::string(text) +
        "\" is no branch: write P:P or P:P:P (from, through, to), each P as x,y,z, or name a file "
        "of points (.mrk.json, .fcsv, .csv)");
  }
  segmentation::BranchSeeds seeds;
  seeds.from = typed_point(points.front(), frame);
  seeds.to = typed_point(points.back(), frame);
  if (points.size() == 3) seeds.through = typed_point(points[1], frame);
  return seeds;
}

/// A drawn curve has more points than fronts need, and short pieces let them out at the sides: three points
/// for every `piece_mm`, evenly along it. Both ends stay, and so do all points of a list that has no more.
std::vector<Vec3> thinned(const std::vector<Vec3>& points) {
  const std::vector<double> s = geometry::abscissas(points);
  const auto pieces = static_cast<std::size_t>(std::max(1.0, std::round(s.back() / piece_mm)));
  const std::size_t most = 2 * pieces + 1;
  if (points.size() <= most) return points;
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < most; ++i) {
    const double at = s.back() * static_cast<double>(i) / static_cast<double>(most - 1);
    const auto behind = std::lower_bound(s.begin(), s.end(), at);
    const auto k = std::min(static_cast<std::size_t>(behind - s.begin()), s.size() - 1);
    const bool before = k > 0 && at - s[k - 1] < s[k] - at;
    const Vec3& p = points[before ? k - 1 : k];
    if (kept.empty() || p != kept.back()) kept.push_back(p);
  }
  return kept;
}

/// One after another, each through a point between where there is one.
void add_pieces(const std::vector<Vec3>& points, std::vector<segmentation::BranchSeeds>& all) {
  for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
    segmentation::BranchSeeds piece;
    piece.from = points[i];
    if (i + 2 < points.size()) piece.through = points[i + 1];
    piece.to = points[std::min(i + 2, points.size() - 1)];
    all.push_back(piece);
  }
}

}  // namespace

SeedFrame seed_frame(const InputOptions& input, const pipeline::Source& source,
                     const std::string& seed_units) {
  SeedFrame frame;
  frame.coords = input.coords;
  if (source.image) frame.grid = &source.image->geometry;
  if (source.mask) frame.grid = &source.mask->geometry;
  InputOptions seeds;
  seeds.units = seed_units;
  frame.seed_unit_mm = source_options(seeds).unit_mm;
  if (source.kind != pipeline::SourceKind::surface) return frame;
  frame.unit_mm = source.unit_mm;
  frame.box = geometry::bounds(source.surface.points);
  return frame;
}

bool names_point_file(std::string_view text) {
  const std::filesystem::path path(text);
  std::error_code none;
  return io::is_point_file(path) || std::filesystem::is_regular_file(path, none);
}

std::vector<Vec3> seed_points(const std::string& text, const SeedFrame& frame) {
  if (!names_point_file(text)) return {typed_point(text, frame)};
  std::vector<Vec3> points;
  for (const io::Markup& markup : read_seeds(text, frame).markups)
    points.insert(points.end(), markup.points.begin(), markup.points.end());
  return points;
}

Vec3 seed_point(const std::string& option, const std::string& text, const SeedFrame& frame) {
  const std::vector<Vec3> points = seed_points(text, frame);
  if (points.size() != 1)
    throw InvalidInput(option + ": " + own_name(text) + " has " + std::to_string(points.size()) +
                       " points where one is wanted; give x,y,z, or a file of one point");
  return points.front();
}

std::vector<segmentation::BranchSeeds> seed_branches(const std::string& text, const SeedFrame& frame) {
  if (!names_point_file(text)) return {parse_branch(text, frame)};
  std::vector<segmentation::BranchSeeds> branches;
  for (const io::Markup& markup : read_seeds(text, frame).markups) {
    if (markup.points.size() < 2)
      throw InvalidInput("--branch: " + own_name(text) + ": the list" +
                         (markup.name.empty() ? "" : " \"" + markup.name + "\"") +
                         " has one point; a vessel has two at least, from, through any number, to");
    const std::vector<Vec3> kept = thinned(markup.points);
    if (kept.size() < markup.points.size())
      core::log_info(own_name(text) + ": of the " + std::to_string(markup.points.size()) + " points of " +
                     (markup.name.empty() ? "a list" : "\"" + markup.name + "\"") + " " +
                     std::to_string(kept.size()) + " are used as seeds");
    add_pieces(kept, branches);
  }
  return branches;
}

std::string seed_digest(const std::string& text) {
  return names_point_file(text) ? "sha256:" + core::sha256_file(text) : text;
}

}  // namespace ostia::app
