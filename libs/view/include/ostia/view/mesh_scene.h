#pragma once
/// \file A volume mesh in three dimensions, its elements coloured by a number, cut by a plane.

#include "ostia/view/mesh_shell.h"
#include "ostia/view/scene_guest.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace ostia::view {

/// When the elements' edges are drawn. Of a whole tree there are more than pixels: it would be black.
enum class ShownEdges {
  never,
  near,  ///< while the middle one of those that are seen is least_edge_px long, or longer
  always,
};

/// Elements are flat; their edges are drawn where they are near.
class MeshScene final : public SceneGuest {
 public:
  /// In one colour and whole. Throws InvalidInput for null.
  explicit MeshScene(std::shared_ptr<const ShownMesh> mesh);
  ~MeshScene() override;
  /// One value an element, tetrahedra first. Throws InvalidInput for another number of them or a range that
  /// is none.
  void set_values(std::shared_ptr<const std::vector<double>> values, const ValueScale& scale);
  void set_cut(const std::optional<MeshCut>& cut);  ///< throws as shell_of does
  static constexpr double least_edge_px = 9.0;
  void set_edges(ShownEdges edges);
  bool edges_drawn() const;  ///< in the last picture
  /// Edges of elements, seen through all else. Throws InvalidInput for an element that is not there.
  void set_highlight(std::span<const std::size_t> elements);
  /// What the hand takes hold of: polylines, mm, seen through all else.
  void set_handle(std::span<const std::vector<geometry::Vec3>> lines);
  std::size_t side_count() const;  ///< that are drawn

  vtkProp& prop() override;
  vtkSmartPointer<vtkProp> twin() const override;
  std::vector<geometry::Vec3> outline() const override;
  std::optional<ValueScale> bar() const override;
  void seen_at(double mm_per_px) override;

 private:
  void show_edges();
  void show_shell();
  void color();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::view
