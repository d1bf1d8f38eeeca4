#include "meshing/preview.h"

#include "ostia/core/error.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/pipeline/exported_meshes.h"
#include "ostia/pipeline/volume_mesh.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

using geometry::MixedMesh;
using meshing::ElementMeasure;

std::vector<fs::path> meshes_in(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const pipeline::ExportedMesh& one : pipeline::exported_meshes(folder)) found.push_back(one.file);
  if (found.empty())
    throw IoError(QCoreApplication::translate("jobs", "%1 holds no mesh.vtu")
                      .arg(QString::fromStdString(folder.string()))
                      .toStdString());
  return found;
}

/// Elements alone: boundary and nodes of the second order are not looked at.
void append(MixedMesh& to, const MixedMesh& one) {
  const auto first = static_cast<std::int32_t>(to.points.size());
  to.points.insert(to.points.end(), one.points.begin(), one.points.end());
  for (geometry::Tetrahedron element : one.tetrahedra) {
    for (std::int32_t& corner : element) corner += first;
    to.tetrahedra.push_back(element);
  }
  for (geometry::Prism element : one.prisms) {
    for (std::int32_t& corner : element) corner += first;
    to.prisms.push_back(element);
  }
}

/// Tetrahedra of all meshes come before the prisms of the first.
void join(const std::vector<MixedMesh>& meshes, const std::vector<meshing::ElementMeasures>& measures,
          MixedMesh& mesh, meshing::ElementMeasures& all) {
  for (const MixedMesh& one : meshes) append(mesh, one);
  for (std::size_t m = 0; m < all.size(); ++m) {
    for (const bool tetrahedra : {true, false}) {
      for (std::size_t i = 0; i < meshes.size(); ++i) {
        const auto middle = measures[i][m].begin() + static_cast<std::ptrdiff_t>(meshes[i].tetrahedra.size());
        all[m].insert(all[m].end(), tetrahedra ? measures[i][m].begin() : middle,
                      tetrahedra ? middle : measures[i][m].end());
      }
    }
  }
}

std::shared_ptr<const MeshPreview> shown(std::string name, std::vector<MixedMesh> meshes,
                                         std::vector<meshing::ElementMeasures> measures,
                                         meshing::QualityVerdict verdict, const core::TaskContext& task) {
  auto mesh = std::make_shared<MixedMesh>();
  meshing::ElementMeasures all;
  join(meshes, measures, *mesh, all);
  meshes.clear();
  measures.clear();
  auto preview = std::make_shared<MeshPreview>();
  preview->name = std::move(name);
  preview->verdict = std::move(verdict);
  preview->mesh = view::prepared(std::move(mesh), task);
  for (std::size_t m = 0; m < all.size(); ++m)
    preview->measures[m] = std::make_shared<const std::vector<double>>(std::move(all[m]));
  return preview;
}

}  // namespace

std::shared_ptr<const MeshPreview> preview_of(const fs::path& folder, meshing::QualityVerdict verdict,
                                              const core::TaskContext& task) {
  task.set_stage("preview");
  const std::vector<fs::path> files = meshes_in(folder);
  std::vector<MixedMesh> meshes;
  std::vector<meshing::ElementMeasures> measures;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto from = 0.7 * static_cast<double>(i) / static_cast<double>(files.size()),
               to = 0.7 * static_cast<double>(i + 1) / static_cast<double>(files.size());
    meshes.push_back(io::read_volume_mesh(files[i]));
    task.throw_if_cancelled();
    measures.push_back(meshing::element_measures(meshes.back(), task.sub(from, to)));
  }
  return shown(folder.filename().string(), std::move(meshes), std::move(measures), std::move(verdict),
               task.sub(0.7, 1.0));
}

fs::path mesh_meant_by(const fs::path& path) {
  std::error_code ignored;
  const fs::path whole = fs::absolute(path, ignored);
  if (whole.parent_path().filename() == "polyMesh") {
    const fs::path constant = whole.parent_path().parent_path();
    if (io::is_volume_mesh(constant.parent_path())) return constant.parent_path();
  }
  if (io::is_volume_mesh(path)) return path;
  return fs::is_regular_file(path / "mesh.vtu", ignored) ? path / "mesh.vtu" : fs::path();
}

std::shared_ptr<const MeshPreview> opened_mesh(const fs::path& path, const core::TaskContext& task) {
  task.set_stage("reading");
  const fs::path file = mesh_meant_by(path);
  if (file.empty())
    throw InvalidInput(
        QCoreApplication::translate("jobs", "%1 is no volume mesh. These are read: %2")
            .arg(QString::fromStdString(path.string()), QString::fromStdString(io::readable_volume_meshes()))
            .toStdString());
  std::vector<MixedMesh> meshes;
  io::LayeredMesh read = io::read_layered_mesh(file);
  meshes.push_back(std::move(read.mesh));
  task.throw_if_cancelled();
  meshing::QualityVerdict verdict =
      pipeline::judged(meshes.front(), read.in_layers, task.sub(0.2, 0.6)).verdict;
  std::vector<meshing::ElementMeasures> measures;
  measures.push_back(meshing::element_measures(meshes.front(), task.sub(0.6, 0.8)));
  return shown((file.parent_path().filename() / file.filename()).string(), std::move(meshes),
               std::move(measures), std::move(verdict), task.sub(0.8, 1.0));
}

QString title_of(ElementMeasure measure) {
  const auto text = [](const char* english) { return QCoreApplication::translate("MeshPreview", english); };
  switch (measure) {
    case ElementMeasure::least_dihedral_deg:
      return text(QT_TRANSLATE_NOOP("MeshPreview", "least dihedral angle, \u00b0"));
    case ElementMeasure::scaled_jacobian:
      return text(QT_TRANSLATE_NOOP("MeshPreview", "scaled Jacobian"));
    case ElementMeasure::non_orthogonality_deg:
      return text(QT_TRANSLATE_NOOP("MeshPreview", "non-orthogonality, \u00b0"));
    case ElementMeasure::skewness:
      return text(QT_TRANSLATE_NOOP("MeshPreview", "skewness"));
    case ElementMeasure::mean_edge_mm:
      return text(QT_TRANSLATE_NOOP("MeshPreview", "edge length, mm"));
  }
  return {};
}

view::ValueScale scale_of(const MeshPreview& preview, ElementMeasure measure) {
  const std::vector<double>& values = *preview.measures[static_cast<std::size_t>(measure)];
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  view::ValueScale scale;
  scale.title = title_of(measure).toStdString();
  scale.low = 0.0;
  switch (measure) {
    case ElementMeasure::least_dihedral_deg:
      scale.high = 90.0;
      break;
    case ElementMeasure::scaled_jacobian:
      scale.high = 1.0;
      break;
    case ElementMeasure::non_orthogonality_deg:
      scale.high = 90.0;
      break;
    case ElementMeasure::skewness:
      scale.high = view::rounded_range({0.0, std::max(1.0, std::isfinite(*high) ? *high : 1.0)}).second;
      break;
    case ElementMeasure::mean_edge_mm:
      std::tie(scale.low, scale.high) = view::rounded_range({*low, *high > *low ? *high : *low + 1e-3});
      break;
  }
  return scale;
}

std::vector<std::size_t> worst_elements(const MeshPreview& preview, ElementMeasure measure,
                                        std::size_t most) {
  const std::vector<double>& values = *preview.measures[static_cast<std::size_t>(measure)];
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const bool largest = meshing::larger_is_worse(measure);
  const auto count = static_cast<std::ptrdiff_t>(std::min(most, order.size()));
  std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](std::size_t a, std::size_t b) {
    if (values[a] != values[b]) return largest ? values[a] > values[b] : values[a] < values[b];
    return a < b;
  });
  order.resize(static_cast<std::size_t>(count));
  return order;
}

}  // namespace ostia::workstation
