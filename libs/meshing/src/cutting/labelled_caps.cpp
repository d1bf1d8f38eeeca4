// Caps as the labels of a file have them.

#include "cutting/cap_regions.h"

#include "ostia/geometry/aabb_tree.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace ostia::meshing {
namespace {

using geometry::FacedSurface;

constexpr double stray_share = 0.05;       // of a label's largest piece
constexpr double highest_dome = 0.6;       // over the rim's radius
constexpr double longest_of_end = 3.0;     // what is longer, over its radius, is the wall of a branch
constexpr double rounded_end = 0.6;        // a smooth cap is as high as that; a patch of the wall is flatter
constexpr double largest_end_share = 0.5;  // of the surface

bool is_called_wall(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name.find("wall") != std::string::npos;
}

std::vector<Region> pieces_of(const Look& look, const std::vector<std::int32_t>& labels) {
  std::vector<Region> all = regions(look, [&](const SharedEdge& e) {
    return labels[static_cast<std::size_t>(e.left)] == labels[static_cast<std::size_t>(e.right)];
  });
  for (Region& region : all) measure(look, region);
  return all;
}

std::int32_t label_of(const Region& region, const std::vector<std::int32_t>& labels) {
  return labels[static_cast<std::size_t>(region.triangles[0])];
}

/// The label beyond most of a region's rim.
std::int32_t label_about(const Look& look, const Region& region, const std::vector<std::int32_t>& labels) {
  const std::int32_t own = label_of(region, labels);
  std::map<std::int32_t, double> shared;
  for (const std::size_t k : region.rim) {
    const SharedEdge& e = look.edges[k];
    const std::int32_t left = labels[static_cast<std::size_t>(e.left)];
    const auto at = [&](std::int32_t p) { return look.mesh.points[static_cast<std::size_t>(p)]; };
    shared[left == own ? labels[static_cast<std::size_t>(e.right)] : left] += (at(e.b) - at(e.a)).norm();
  }
  if (shared.empty()) return own;
  return std::ranges::max_element(shared, {}, [](const auto& one) { return one.second; })->first;
}

/// Pieces of next to nothing take the label of what is about them.
std::vector<std::int32_t> without_strays(const Look& look, const std::vector<std::int32_t>& labels) {
  const std::vector<Region> all = pieces_of(look, labels);
  std::map<std::int32_t, double> largest;
  for (const Region& region : all)
    largest[label_of(region, labels)] = std::max(largest[label_of(region, labels)], region.area_mm2);
  std::vector<std::int32_t> mended = labels;
  for (const Region& region : all) {
    if (region.area_mm2 >= stray_share * largest[label_of(region, labels)]) continue;
    const std::int32_t about = label_about(look, region, labels);
    for (const std::int32_t t : region.triangles) mended[static_cast<std::size_t>(t)] = about;
  }
  return mended;
}

/// One rim all round, and round as seen along its normal.
bool has_round_rim(const Region& region, const FlatCapOptions& options) {
  return !region.on_border && region.one_loop && region.rim.size() >= fewest_on_rim &&
         4.0 * std::numbers::pi * region.flat_area_mm2 >=
             options.least_roundness * region.rim_mm * region.rim_mm;
}

/// The judge of one surface's labels.
class Labels {
 public:
  Labels(const Look& look, const FacedSurface& surface, const FlatCapOptions& options)
      : look_(look), surface_(surface), options_(options) {
    for (std::size_t i = 0; i < look.mesh.triangles.size(); ++i)
      area_ += 0.5 * doubled_area(look.mesh, static_cast<std::int32_t>(i)).norm();
  }

  bool is_cap(Region& region) {
    if (region.rim_deg < 0.5 * options_.least_rim_deg) return false;
    if (is_flat(region, options_)) return true;
    if (!has_round_rim(region, options_) || region.area_mm2 > largest_end_share * area_) return false;
    region.end.radius_mm = std::sqrt(region.flat_area_mm2 / std::numbers::pi);
    return region.deviation_mm <= highest_dome * region.end.radius_mm && as_wide(region);
  }

  /// Whether it should be named where no end comes of it.
  bool is_in_question(const Region& region) const {
    return !region.on_border && region.one_loop && region.rim.size() >= fewest_on_rim &&
           region.area_mm2 <= largest_end_share * area_ &&
           region.deviation_mm <= longest_of_end * region.rim_mm / (2.0 * std::numbers::pi) &&
           !is_called_wall(region.end.name);
  }

  bool is_like_an_end(const Region& region) {
    const double radius = region.rim_mm / (2.0 * std::numbers::pi);
    return (region.rim_deg >= 0.5 * options_.least_rim_deg || region.deviation_mm >= rounded_end * radius) &&
           as_wide(region);
  }

  void name(Region& region, std::int32_t id) const {
    const auto face = std::ranges::find(surface_.faces, id, &geometry::Face::id);
    const GivenEnd named =
        end_named(face != surface_.faces.end() ? face->name : "label_" + std::to_string(id));
    region.end.name = named.name;
    region.end.kind = named.kind;
  }

  bool has_name(std::int32_t id) const {
    return std::ranges::find(surface_.faces, id, &geometry::Face::id) != surface_.faces.end();
  }

 private:
  bool as_wide(const Region& region) {
    if (!tree_) tree_.emplace(look_.mesh);
    return is_as_wide_as_lumen(*tree_, region.end);
  }

  const Look& look_;
  const FacedSurface& surface_;
  const FlatCapOptions& options_;
  double area_ = 0.0;
  std::optional<geometry::AabbTree> tree_;
};

}  // namespace

LabelledCaps caps_by_label(const Look& look, const FacedSurface& surface, const FlatCapOptions& options) {
  LabelledCaps found;
  const std::vector<std::int32_t> labels = without_strays(look, surface.face_ids);
  Labels judge(look, surface, options);
  std::vector<Region> all = pieces_of(look, labels);
  std::map<std::int32_t, std::vector<std::size_t>> pieces;
  for (std::size_t i = 0; i < all.size(); ++i) pieces[label_of(all[i], labels)].push_back(i);
  std::vector<std::size_t> taken;
  for (const auto& [id, own] : pieces) {
    const bool caps = std::ranges::all_of(own, [&](std::size_t i) { return judge.is_cap(all[i]); });
    for (const std::size_t i : own) {
      judge.name(all[i], id);
      if (caps) {
        if (!judge.has_name(id)) all[i].end.name.clear();
        if (own.size() > 1 && i != own.front() && !all[i].end.name.empty())
          all[i].end.name += "_" + std::to_string(1 + (std::ranges::find(own, i) - own.begin()));
        taken.push_back(i);
      } else if (judge.is_in_question(all[i])) {
        found.not_taken.push_back({all[i].end, judge.is_like_an_end(all[i])});
      }
    }
  }
  std::ranges::sort(taken);  // in the order of their lowest triangles
  for (const std::size_t i : taken) found.caps.push_back(std::move(all[i]));
  return found;
}

}  // namespace ostia::meshing
