#include "ostia/view/mesh_scene.h"

#include "scene/flat_surface.h"
#include "scene/scene_lines.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mixed_mesh_sides.h"

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkPropAssembly.h>
#include <vtkProperty.h>

#include <algorithm>
#include <array>
#include <string>

namespace ostia::view {
namespace {

using geometry::Vec3;

constexpr figure::Color uncolored{0.72, 0.74, 0.78, 1.0};
constexpr figure::Color pointed_at{1.0, 0.25, 0.85, 1.0};  // no colour of the scales
constexpr figure::Color taken_hold_of{1.0, 0.55, 0.1, 1.0};
constexpr double line_px = 3.0;

}  // namespace

struct MeshScene::Impl {
  std::shared_ptr<const ShownMesh> mesh;
  std::shared_ptr<const std::vector<double>> values;
  std::optional<ValueScale> scale;
  std::optional<MeshCut> cut;
  std::vector<ShellSide> shell;
  std::vector<Vec3> outline;  // of the whole mesh
  ShownEdges edges = ShownEdges::near;
  double mm_per_px = 1.0, middle_edge_mm = 0.0;  // of the sides that are seen
  std::vector<SceneLine> highlight, handle;
  FlatGuest drawn;

  /// The median of the sides' first edges.
  void measure_edges() {
    std::vector<double> lengths;
    lengths.reserve(shell.size());
    const auto& points = mesh->mesh->points;
    for (const ShellSide& side : shell)
      lengths.push_back((points[static_cast<std::size_t>(side.corners[1])] -
                         points[static_cast<std::size_t>(side.corners[0])])
                            .norm());
    if (lengths.empty()) return;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    middle_edge_mm = *middle;
  }
  void show_lines() {
    std::vector<SceneLine> lines = highlight;
    lines.insert(lines.end(), handle.begin(), handle.end());
    drawn.set_lines(lines, line_px);
  }
};

MeshScene::MeshScene(std::shared_ptr<const ShownMesh> mesh) : impl_(std::make_unique<Impl>()) {
  if (!mesh) throw InvalidInput("there is no mesh to be shown");
  impl_->mesh = std::move(mesh);
  set_flat_points(*impl_->drawn.sides, impl_->mesh->mesh->points);
  impl_->shell = shell_of(*impl_->mesh);
  impl_->outline.reserve(impl_->shell.size());
  for (const ShellSide& side : impl_->shell)
    impl_->outline.push_back(impl_->mesh->mesh->points[static_cast<std::size_t>(side.corners[0])]);
  show_shell();
}

MeshScene::~MeshScene() = default;

void MeshScene::set_values(std::shared_ptr<const std::vector<double>> values, const ValueScale& scale) {
  validate(scale);
  const std::size_t count = impl_->mesh->centres.size();
  if (!values || values->size() != count)
    throw InvalidInput(std::to_string(values ? values->size() : 0) + " values were given for a mesh of " +
                       std::to_string(count) + " elements; one an element is needed");
  impl_->values = std::move(values);
  impl_->scale = scale;
  color();
}

void MeshScene::set_cut(const std::optional<MeshCut>& cut) {
  if (cut == impl_->cut) return;
  std::vector<ShellSide> shell = shell_of(*impl_->mesh, cut);
  impl_->cut = cut;
  impl_->shell = std::move(shell);
  show_shell();
}

void MeshScene::set_edges(ShownEdges edges) {
  impl_->edges = edges;
  show_edges();
}

bool MeshScene::edges_drawn() const {
  return impl_->drawn.surface->GetProperty()->GetEdgeVisibility() != 0;
}

void MeshScene::seen_at(double mm_per_px) {
  impl_->mm_per_px = mm_per_px;
  show_edges();
}

void MeshScene::show_edges() {
  const bool near = impl_->middle_edge_mm >= least_edge_px * impl_->mm_per_px;
  impl_->drawn.surface->GetProperty()->SetEdgeVisibility(impl_->edges == ShownEdges::always ||
                                                         (impl_->edges == ShownEdges::near && near));
}

void MeshScene::set_highlight(std::span<const std::size_t> elements) {
  const geometry::MixedMesh& mesh = *impl_->mesh->mesh;
  std::vector<SceneLine> lines;
  for (const std::size_t element : elements) {
    if (element >= impl_->mesh->centres.size())
      throw InvalidInput("the mesh that is shown has no element " + std::to_string(element));
    const auto corners = element_corners(mesh, element);
    const auto add = [&](const std::array<std::size_t, 2>& edge) {
      SceneLine line;
      line.color = pointed_at;
      for (const std::size_t end : edge)
        line.points.push_back(mesh.points[static_cast<std::size_t>(corners[end])]);
      lines.push_back(std::move(line));
    };
    if (corners.size() == 4)
      for (const auto& edge : geometry::tetrahedron_edges) add(edge);
    else
      for (const auto& edge : geometry::prism_edges) add(edge);
  }
  impl_->highlight = std::move(lines);
  impl_->show_lines();
}

void MeshScene::set_handle(std::span<const std::vector<Vec3>> lines) {
  impl_->handle.clear();
  for (const std::vector<Vec3>& line : lines) impl_->handle.push_back({line, false, taken_hold_of});
  impl_->show_lines();
}

std::size_t MeshScene::side_count() const {
  return impl_->shell.size();
}

vtkProp& MeshScene::prop() {
  return impl_->drawn.prop();
}

vtkSmartPointer<vtkProp> MeshScene::twin() const {
  return impl_->drawn.twin();
}

std::vector<Vec3> MeshScene::outline() const {
  return impl_->outline;
}

std::optional<ValueScale> MeshScene::bar() const {
  return impl_->scale;
}

void MeshScene::show_shell() {
  std::vector<std::array<std::int32_t, 4>> sides;
  sides.reserve(impl_->shell.size());
  for (const ShellSide& side : impl_->shell) sides.push_back(side.corners);
  set_flat_sides(*impl_->drawn.sides, sides);
  impl_->drawn.surface->SetVisibility(!sides.empty());
  impl_->measure_edges();
  show_edges();
  color();
}

void MeshScene::color() {
  std::vector<figure::Color> colors(impl_->shell.size(), uncolored);
  for (std::size_t i = 0; impl_->values && i < colors.size(); ++i) {
    const double value = (*impl_->values)[static_cast<std::size_t>(impl_->shell[i].element)];
    const ValueScale& scale = *impl_->scale;
    colors[i] = scale_color(scale.colors, (value - scale.low) / (scale.high - scale.low));
  }
  set_flat_colors(*impl_->drawn.sides, colors);
  impl_->drawn.surface->Modified();  // an assembly of props does not ask for their data
}

}  // namespace ostia::view
