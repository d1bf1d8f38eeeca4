// A network's faults in words.

#include "ostia/core/error.h"
#include "ostia/geometry/graph_faults.h"

#include <array>

namespace ostia::geometry {
namespace {

struct Words {
  std::string_view key, one, many;
};

constexpr std::array<Words, 14> words{{
    {"index_out_of_range", "segment names a point that is not there",
     "segments name points that are not there"},
    {"non_finite_point", "point has a coordinate that is no finite number",
     "points have coordinates that are no finite numbers"},
    {"zero_length", "segment has no length", "segments have no length"},
    {"missing_radius", "segment has no radius", "segments have no radius"},
    {"negative_radius", "segment has a negative radius", "segments have negative radii"},
    {"zero_radius", "segment has the radius zero", "segments have the radius zero"},
    {"duplicate_point", "point is at the place of another", "points are at the places of others"},
    {"duplicate_segment", "segment is there twice", "segments are there more than once"},
    {"loose_point", "point belongs to no segment", "points belong to no segment"},
    {"several_parents", "point has several parents", "points have several parents"},
    {"cycle", "segment closes a loop", "segments close loops"},
    {"several_roots", "root more than the part it is in can have",
     "roots more than the parts they are in can have"},
    {"no_root", "part has no root", "parts have no root"},
    {"several_parts", "part is not joined to the first", "parts are not joined to the first"},
}};

const Words& words_of(GraphFaultKind kind) {
  return words[static_cast<std::size_t>(kind)];
}

}  // namespace

std::string_view name_of(GraphFaultKind kind) {
  return words_of(kind).key;
}

namespace {

/// The segment that reaches each of the points, or else the first that leaves it; -1 without any.
std::vector<std::int32_t> segments_at(const VesselGraph& graph, const std::vector<std::int32_t>& points) {
  std::vector<std::int32_t> reaching(points.size(), -1), leaving(points.size(), -1);
  if (points.empty()) return reaching;
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto index = static_cast<std::int32_t>(e);
      if (graph.edges[e].to == points[i] && reaching[i] < 0) reaching[i] = index;
      if (graph.edges[e].from == points[i] && leaving[i] < 0) leaving[i] = index;
    }
  for (std::size_t i = 0; i < points.size(); ++i)
    if (reaching[i] < 0) reaching[i] = leaving[i];
  return reaching;
}

}  // namespace

std::string text_of(const GraphFault& fault, const VesselGraph& graph, const std::string& reference_name) {
  std::string places;
  const auto add = [&](const std::string& place) { places += (places.empty() ? "" : ", ") + place; };
  const bool referenced = graph.references.size() == graph.edges.size();
  const auto named = [&](std::int32_t e) {
    return referenced ? reference_name + " " + std::to_string(graph.references[static_cast<std::size_t>(e)])
                      : "segment " + std::to_string(e);
  };
  for (const std::int32_t e : fault.edges) add(named(e));
  const std::vector<std::int32_t> segments = segments_at(graph, fault.points);
  for (std::size_t i = 0; i < fault.points.size(); ++i)
    add("point " + std::to_string(fault.points[i]) +
        (referenced && segments[i] >= 0 ? " of " + named(segments[i]) : ""));
  const std::size_t shown = fault.edges.size() + fault.points.size();
  if (shown < fault.count) add("...");
  const Words& said = words_of(fault.kind);
  return std::to_string(fault.count) + " " + std::string(fault.count == 1 ? said.one : said.many) +
         (places.empty() ? "" : " (" + places + ")");
}

std::string summary(const GraphFaults& faults, const VesselGraph& graph, const std::string& reference_name) {
  std::string all;
  for (const GraphFault& fault : faults.found)
    all += (all.empty() ? "" : "; ") + text_of(fault, graph, reference_name);
  return all.empty() ? "none" : all;
}

void require_sound(const VesselGraph& graph, const std::string& what, bool tree,
                   const core::TaskContext& task, const std::string& reference_name) {
  const GraphFaults faults = find_faults(graph, task);
  if (graph.edges.empty()) throw InvalidInput(what + " has no segments");
  if (tree ? faults.sound_trees() : faults.sound()) return;
  throw InvalidInput(what + " is no sound " + (tree ? "tree" : "network") + ": " +
                     summary(faults, graph, reference_name) +
                     "; `ostia convert --repair` mends what can be mended");
}

}  // namespace ostia::geometry
