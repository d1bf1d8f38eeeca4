#include "ostia/view/truth_layer.h"

#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace ostia::view {
namespace {

using session::RuledSurface;
using Edge = std::pair<std::int32_t, std::int32_t>;

constexpr double beside_px = 30.0;   // contours so far above or below the view are looked at, too
constexpr double least_jump_px = 8;  // a longer piece than this and a few triangles is a jump
constexpr double longest_triangle_mm = 3.0;

/// Cuts by the two edges that they run between, to be joined.
struct Cuts {
  std::map<Edge, Vec2> at;
  std::map<Edge, std::array<Edge, 2>> next;
  std::map<Edge, int> degree;
  void link(const Edge& a, const Edge& b) {
    int& from = degree[a];
    if (from < 2) next[a][static_cast<std::size_t>(from)] = b;
    ++from;
  }
};

Edge edge_of(std::int32_t a, std::int32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

std::vector<Vec2> walked(Cuts& cuts, const Edge& start) {
  std::vector<Vec2> line{cuts.at[start]};
  Edge here = start, before{-1, -1};
  while (true) {
    const int degree = std::min(2, cuts.degree[here]);
    Edge step{-1, -1};
    for (int i = 0; i < degree; ++i) {
      const Edge& candidate = cuts.next[here][static_cast<std::size_t>(i)];
      if (candidate != before && cuts.degree[candidate] > 0) step = candidate;
    }
    if (here != start) cuts.degree[here] = 0;
    if (step.first < 0) break;
    before = here;
    here = step;
    line.push_back(cuts.at[here]);
    if (here == start) break;
  }
  cuts.degree[start] = 0;
  return line;
}

}  // namespace

std::vector<std::vector<Vec2>> lines_of_cut(const geometry::TriMesh& surface,
                                            const std::vector<std::optional<ViewPlace>>& places,
                                            double most_px) {
  Cuts cuts;
  for (const auto& t : surface.triangles) {
    std::array<Edge, 2> crossed;
    std::size_t count = 0;
    const bool known = std::all_of(
        t.begin(), t.end(), [&](std::int32_t i) { return places[static_cast<std::size_t>(i)].has_value(); });
    if (!known) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t ia = t[i], ib = t[(i + 1) % 3];
      const ViewPlace &a = *places[static_cast<std::size_t>(ia)], &b = *places[static_cast<std::size_t>(ib)];
      if ((a.out_mm < 0.0) == (b.out_mm < 0.0)) continue;
      const Edge edge = edge_of(ia, ib);
      cuts.at[edge] = a.px + a.out_mm / (a.out_mm - b.out_mm) * (b.px - a.px);
      if (count < 2) crossed[count++] = edge;
    }
    if (count != 2 || (cuts.at[crossed[0]] - cuts.at[crossed[1]]).norm() > most_px) continue;
    cuts.link(crossed[0], crossed[1]);
    cuts.link(crossed[1], crossed[0]);
  }
  std::vector<std::vector<Vec2>> lines;
  for (const bool ends : {true, false})  // open lines from their ends, then closed ones
    for (const auto& [edge, px] : cuts.at) {
      const auto degree = cuts.degree.find(edge);
      if (degree == cuts.degree.end() || degree->second == 0 || (ends && degree->second != 1)) continue;
      std::vector<Vec2> line = walked(cuts, edge);
      if (line.size() > 1) lines.push_back(std::move(line));
    }
  return lines;
}

TruthLayer::TruthLayer(PictureView& view, session::QualityCheck& check) : view_(view), check_(check) {
  view_.set_layer([this](Overlay& overlay) { draw(overlay); });
  own_.push_back(check.shown.observe([this](const bool&) { view_.touch_layer(); }));
  own_.push_back(check.observer.observe([this](const std::string&) { view_.touch_layer(); }));
  own_.push_back(check.truth_changed.observe([this] { view_.touch_layer(); }));
}
TruthLayer::~TruthLayer() {
  view_.set_layer({});
}

const std::vector<std::vector<Vec2>>& TruthLayer::lines() {
  const std::uint64_t truth = check_.truth_revision(), placed = view_.placement_revision();
  if (!made_ || truth != truth_ || placed != placed_) {
    lines_.clear();
    if (view_.ready()) make();
    truth_ = truth;
    placed_ = placed;
    made_ = true;
  }
  return lines_;
}

void TruthLayer::draw(Overlay& overlay) {
  if (!check_.has_truth() || !check_.shown.get()) return;
  for (const std::vector<Vec2>& line : lines()) overlay.lines.push_back({line, Role::truth});
}

namespace {

/// Whether the selected vessel's way runs through a section's vessel there.
bool is_of_selected(const session::Workbench& bench, const RuledSurface& section) {
  const lumen::LumenModel* model = bench.model();
  if (!model || section.s_mm.empty()) return false;
  const std::int32_t selected = bench.vessel.get();
  if (section.vessel == selected) return true;
  const double s = section.s_mm.front();
  const auto own = bench.axis(section.vessel), shown = bench.axis(selected);
  return own && shown && s <= shown->length() &&
         lumen::owner_at(model->tree, selected, s) == lumen::owner_at(model->tree, section.vessel, s) &&
         (own->point(s) - shown->point(s)).norm() < 1e-3;
}

/// Points of the contours that a curved view shows, and nothing of the others.
std::vector<std::optional<ViewPlace>> places_on(CurvedView& view, const RuledSurface& section) {
  std::vector<std::optional<ViewPlace>> places(section.surface.points.size());
  std::vector<bool> near(section.s_mm.size());
  for (std::size_t k = 0; k < near.size(); ++k) {
    const double row = view.row_of(section.s_mm[k]);
    near[k] = row > -beside_px && row < view.height() + beside_px;
  }
  for (std::size_t k = 0; k < near.size(); ++k) {
    const bool wanted = near[k] || (k > 0 && near[k - 1]) || (k + 1 < near.size() && near[k + 1]);
    if (!wanted) continue;
    for (std::size_t i = k * section.ring; i < (k + 1) * section.ring; ++i)
      places[i] = view.project_near(section.surface.points[i], section.s_mm[k]);
  }
  return places;
}

std::vector<std::optional<ViewPlace>> places_on(PlaneView& view, const RuledSurface& section) {
  std::vector<std::optional<ViewPlace>> places;
  const std::optional<reformat::Plane>& plane = view.plane();
  if (!plane) return places;
  const Vec3 normal = plane->normal();
  const double middle = (section.box.center() - plane->origin).dot(normal);
  const double half = 0.5 * section.box.sizes().dot(normal.cwiseAbs());
  if (std::abs(middle) > half) return places;
  for (const Vec3& point : section.surface.points) places.push_back(view.project(point));
  return places;
}

}  // namespace

std::vector<std::vector<Vec2>> lines_on(PictureView& view, const RuledSurface& wall) {
  auto* curved = dynamic_cast<CurvedView*>(&view);
  auto* flat = dynamic_cast<PlaneView*>(&view);
  std::vector<std::optional<ViewPlace>> places;
  if (curved && is_of_selected(view.bench(), wall)) places = places_on(*curved, wall);
  if (flat) places = places_on(*flat, wall);
  if (places.empty()) return {};
  return lines_of_cut(wall.surface, places, least_jump_px + longest_triangle_mm / view.pixel_mm());
}

void TruthLayer::make() {
  for (const session::TruthSection& section : check_.truth())
    for (std::vector<Vec2>& line : lines_on(view_, section)) lines_.push_back(std::move(line));
}

}  // namespace ostia::view
