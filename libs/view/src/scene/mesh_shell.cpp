#include "ostia/view/mesh_shell.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/element_centres.h"
#include "ostia/geometry/mixed_mesh_sides.h"

#include <span>
#include <string>

namespace ostia::view {
namespace {

using geometry::MixedMesh;
using geometry::Vec3;

constexpr std::size_t grain = 16384;

std::size_t first_side(const MixedMesh& mesh, std::size_t element) {
  const std::size_t tetrahedra = mesh.tetrahedra.size();
  return element < tetrahedra ? 4 * element : 4 * tetrahedra + 5 * (element - tetrahedra);
}

std::span<const std::array<int, 4>> sides_of(const MixedMesh& mesh, std::size_t element) {
  if (element < mesh.tetrahedra.size()) return geometry::tetrahedron_sides;
  return geometry::prism_sides;
}

std::span<const std::int32_t> corners_of(const MixedMesh& mesh, std::size_t element) {
  const std::size_t tetrahedra = mesh.tetrahedra.size();
  if (element < tetrahedra) return mesh.tetrahedra[element];
  return mesh.prisms[element - tetrahedra];
}

std::size_t element_count(const MixedMesh& mesh) {
  return mesh.tetrahedra.size() + mesh.prisms.size();
}

void check(const MixedMesh& mesh) {
  if (element_count(mesh) == 0) throw InvalidInput("the mesh to be shown has no elements");
  for (const Vec3& point : mesh.points)
    if (!point.allFinite())
      throw InvalidInput("the mesh to be shown has points whose coordinates are no numbers");
  const auto points = static_cast<std::int32_t>(mesh.points.size());
  for (std::size_t e = 0; e < element_count(mesh); ++e)
    for (const std::int32_t corner : corners_of(mesh, e))
      if (corner < 0 || corner >= points)
        throw InvalidInput("an element of the mesh to be shown refers to point " + std::to_string(corner) +
                           ", which does not exist");
}

void find_neighbours(ShownMesh& shown) {
  const MixedMesh& mesh = *shown.mesh;
  shown.across.assign(4 * mesh.tetrahedra.size() + 5 * mesh.prisms.size(), -1);
  const std::vector<geometry::MeshSide> sides = geometry::sorted_sides(mesh);
  const auto place = [&](const geometry::MeshSide& side) -> std::int32_t& {
    return shown.across[first_side(mesh, static_cast<std::size_t>(side.element)) +
                        static_cast<std::size_t>(side.side)];
  };
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    if (sides[i].key != sides[i + 1].key) continue;
    if (i > 0 && sides[i - 1].key == sides[i].key)
      throw InvalidInput("the mesh cannot be shown: more than two elements share a side");
    place(sides[i]) = sides[i + 1].element;
    place(sides[i + 1]) = sides[i].element;
  }
}

void add_side(const MixedMesh& mesh, std::size_t element, std::size_t side, std::vector<ShellSide>& shell) {
  const auto corners = corners_of(mesh, element);
  const std::array<int, 4>& local = sides_of(mesh, element)[side];
  ShellSide seen{{-1, -1, -1, -1}, static_cast<std::int32_t>(element)};
  for (std::size_t k = 0; k < 4; ++k)
    if (local[k] >= 0) seen.corners[k] = corners[static_cast<std::size_t>(local[k])];
  shell.push_back(seen);
}

}  // namespace

std::vector<std::int32_t> element_corners(const MixedMesh& mesh, std::size_t element) {
  const auto corners = corners_of(mesh, element);
  return {corners.begin(), corners.end()};
}

std::shared_ptr<const ShownMesh> prepared(std::shared_ptr<const MixedMesh> mesh,
                                          const core::TaskContext& task) {
  check(*mesh);
  auto shown = std::make_shared<ShownMesh>();
  shown->mesh = std::move(mesh);
  task.throw_if_cancelled();
  find_neighbours(*shown);
  task.throw_if_cancelled();
  shown->centres.resize(element_count(*shown->mesh));
  core::parallel_for(shown->centres.size(), grain, [&](std::size_t e) {
    shown->centres[e] = geometry::element_centre(*shown->mesh, e).cast<float>();
  });
  task.set_progress(1.0);
  return shown;
}

std::vector<ShellSide> shell_of(const ShownMesh& shown, const std::optional<MeshCut>& cut) {
  if (cut && !(cut->point.allFinite() && cut->normal.allFinite() && cut->normal.norm() > 1e-9))
    throw InvalidInput("the plane that cuts the mesh has no place or no direction");
  const MixedMesh& mesh = *shown.mesh;
  const std::size_t count = shown.centres.size();
  std::vector<char> there(count, 1);
  if (cut) {
    const Eigen::Vector3f normal = cut->normal.cast<float>();
    const auto level = static_cast<float>(cut->normal.dot(cut->point));
    core::parallel_for(count, grain,
                       [&](std::size_t e) { there[e] = normal.dot(shown.centres[e]) <= level ? 1 : 0; });
  }
  return core::parallel_reduce(
      count, grain, std::vector<ShellSide>(),
      [&](std::size_t first, std::size_t last) {
        std::vector<ShellSide> part;
        for (std::size_t e = first; e < last; ++e) {
          if (!there[e]) continue;
          const std::size_t from = first_side(mesh, e), sides = sides_of(mesh, e).size();
          for (std::size_t s = 0; s < sides; ++s) {
            const std::int32_t behind = shown.across[from + s];
            if (behind < 0 || !there[static_cast<std::size_t>(behind)]) add_side(mesh, e, s, part);
          }
        }
        return part;
      },
      [](std::vector<ShellSide> all, const std::vector<ShellSide>& part) {
        all.insert(all.end(), part.begin(), part.end());
        return all;
      });
}

}  // namespace ostia::view
