// Networks as lines of VTK polydata.

#include "centerline_tracts.h"
#include "graph/formats.h"
#include "surface_formats.h"
#include "vtk/xml.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/geometry/graph_tree.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace ostia::io {
namespace fs = std::filesystem;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// An array of one number each by its name in any case; null when there is none.
vtkDataArray* array_named(vtkDataSetAttributes& attributes, std::string_view wanted) {
  for (int i = 0; i < attributes.GetNumberOfArrays(); ++i) {
    vtkDataArray* array = attributes.GetArray(i);
    if (array && array->GetName() && array->GetNumberOfComponents() == 1 &&
        upper(array->GetName()) == upper(wanted))
      return array;
  }
  return nullptr;
}

/// Where radii are, and what they are multiplied with.
struct RadiusSource {
  vtkDataArray *from = nullptr, *to = nullptr;  ///< of the cells; the same for both ends of most files
  vtkDataArray* points = nullptr;
  double factor = 1.0;
};

RadiusSource radius_source(vtkPolyData& data) {
  RadiusSource source;
  vtkCellData& cells = *data.GetCellData();
  source.from = array_named(cells, "RadiusFrom");
  source.to = array_named(cells, "RadiusTo");
  if (source.from && source.to) return source;
  for (const char* name : {"MaximumInscribedSphereRadius", "Radius", "Raio", "Diameter"}) {
    source.factor = std::string_view(name) == "Diameter" ? 0.5 : 1.0;
    source.points = array_named(*data.GetPointData(), name);
    if (source.points) return source;
    source.from = source.to = array_named(cells, name);
    if (source.from) return source;
  }
  return source;
}

void check_lengths(const RadiusSource& source, vtkPolyData& data, const fs::path& path) {
  const auto check = [&](vtkDataArray* array, vtkIdType count, const char* what) {
    if (array && array->GetNumberOfTuples() < count)
      refuse(path, "its array " + std::string(array->GetName()) + " has " +
                       std::to_string(array->GetNumberOfTuples()) + " values for " + std::to_string(count) +
                       " " + what);
  };
  check(source.points, data.GetNumberOfPoints(), "points");
  check(source.from, data.GetNumberOfCells(), "cells");
  check(source.to, data.GetNumberOfCells(), "cells");
}

std::string names_of(vtkPolyData& data) {
  std::string all;
  for (vtkDataSetAttributes* attributes : {static_cast<vtkDataSetAttributes*>(data.GetPointData()),
                                           static_cast<vtkDataSetAttributes*>(data.GetCellData())})
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
      if (const char* name = attributes->GetArrayName(i))
        all += (all.empty() ? "" : ", ") + std::string(name);
  return all.empty() ? "it has no array" : "its arrays are " + all;
}

/// What no whole number can be is -1.
std::int64_t whole(double value) {
  constexpr double most = 9.0e18;
  return std::abs(value) < most ? static_cast<std::int64_t>(value) : -1;
}

void add_line(const vtkIdType* ids, vtkIdType count, vtkIdType cell, const RadiusSource& source,
              LoadedGraph& loaded, std::int64_t reference) {
  for (vtkIdType i = 1; i < count; ++i) {
    double from = nan, to = nan;
    if (source.points) {
      from = source.points->GetTuple1(ids[i - 1]);
      to = source.points->GetTuple1(ids[i]);
    } else if (source.from) {
      from = source.from->GetTuple1(cell);
      to = source.to->GetTuple1(cell);
    }
    loaded.graph.edges.push_back({static_cast<std::int32_t>(ids[i - 1]), static_cast<std::int32_t>(ids[i]),
                                  source.factor * from, source.factor * to});
    loaded.graph.references.push_back(reference);
  }
}

}  // namespace

namespace {

/// Whether the line is one of a group that is there already, place by place: vessels of a file share segments
/// by writing them again.
class RepeatedGroups {
 public:
  explicit RepeatedGroups(vtkPolyData& data)
      : data_(data), groups_(array_named(*data.GetCellData(), "GroupIds")) {
    if (!array_named(*data.GetCellData(), "CenterlineIds")) groups_ = nullptr;
  }

  bool repeats(vtkIdType cell, const vtkIdType* ids, vtkIdType count) {
    if (!groups_ || cell >= groups_->GetNumberOfTuples()) return false;
    const auto [first, fresh] = first_.try_emplace(whole(groups_->GetTuple1(cell)), ids, ids + count);
    if (fresh || first->second.size() != static_cast<std::size_t>(count)) return false;
    for (vtkIdType i = 0; i < count; ++i) {
      std::array<double, 3> here{}, there{};
      data_.GetPoint(ids[i], here.data());
      data_.GetPoint(first->second[static_cast<std::size_t>(i)], there.data());
      if (here != there) return false;
    }
    return true;
  }

 private:
  vtkPolyData& data_;
  vtkDataArray* groups_;
  std::map<std::int64_t, std::vector<vtkIdType>> first_;
};

/// Points at one place become one where a line begins or ends: files of lines write their forks once for each
/// line. Points that repeated lines alone have go.
void join_at_ends(const std::vector<std::int32_t>& ends, std::vector<bool> spare,
                  geometry::VesselGraph& graph) {
  std::vector<geometry::Vec3> places, kept;
  PointTable table(places);
  for (const std::int32_t end : ends) table.index_of(graph.points[static_cast<std::size_t>(end)]);
  for (const geometry::GraphEdge& edge : graph.edges)
    for (const std::int32_t point : {edge.from, edge.to}) spare[static_cast<std::size_t>(point)] = false;
  std::vector<std::int32_t> first(places.size(), -1), becomes(graph.points.size(), -1);
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    if (spare[i]) continue;
    const std::int32_t place = table.find(graph.points[i]);
    std::int32_t known = place < 0 ? -1 : first[static_cast<std::size_t>(place)];
    if (known < 0) {
      known = static_cast<std::int32_t>(kept.size());
      kept.push_back(graph.points[i]);
      if (place >= 0) first[static_cast<std::size_t>(place)] = known;
    }
    becomes[i] = known;
  }
  if (kept.size() == graph.points.size()) return;
  graph.points = std::move(kept);
  for (geometry::GraphEdge& edge : graph.edges)
    for (std::int32_t* point : {&edge.from, &edge.to}) *point = becomes[static_cast<std::size_t>(*point)];
}

}  // namespace

LoadedGraph read_graph_vtk(const fs::path& path, const core::TaskContext& task) {
  const vtkSmartPointer<vtkPolyData> data = read_polydata(path);
  task.throw_if_cancelled();
  task.set_progress(0.7);
  if (has_tracts(*data)) {
    const auto tree = tree_of_groups(lines_of_tracts(*data, path), vessel_names(*data));
    return {geometry::graph_of(tree), "segment", {}};
  }
  if (data->GetNumberOfPoints() > std::numeric_limits<std::int32_t>::max())
    refuse(path, "it has more than 2,147,483,647 points");
  LoadedGraph loaded;
  loaded.reference_name = "cell";
  const RadiusSource source = radius_source(*data);
  if (!source.points && !source.from)
    loaded.warnings.push_back(
        "it has no radius (MaximumInscribedSphereRadius, Radius or RadiusFrom and "
        "RadiusTo); " +
        names_of(*data));
  check_lengths(source, *data, path);
  vtkDataArray* references = array_named(*data->GetCellData(), "Reference");
  if (references && references->GetNumberOfTuples() < data->GetNumberOfCells()) references = nullptr;
  if (references) loaded.reference_name = "reference";
  // Cell data run over vertices, then lines.
  const vtkIdType first = data->GetNumberOfVerts();
  vtkCellArray* lines = data->GetLines();
  RepeatedGroups repeated(*data);
  std::vector<std::int32_t> ends;
  std::vector<bool> spare(static_cast<std::size_t>(data->GetNumberOfPoints()), false);
  loaded.graph.edges.reserve(static_cast<std::size_t>(lines->GetNumberOfConnectivityIds()));
  loaded.graph.references.reserve(static_cast<std::size_t>(lines->GetNumberOfConnectivityIds()));
  for (vtkIdType c = 0; c < lines->GetNumberOfCells(); ++c) {
    if (c % 100000 == 0) task.throw_if_cancelled();
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    lines->GetCellAtId(c, count, ids);
    if (count == 0) continue;
    if (repeated.repeats(first + c, ids, count)) {
      for (vtkIdType i = 0; i < count; ++i) spare[static_cast<std::size_t>(ids[i])] = true;
      continue;
    }
    ends.insert(ends.end(), {static_cast<std::int32_t>(ids[0]), static_cast<std::int32_t>(ids[count - 1])});
    add_line(ids, count, first + c, source, loaded,
             references ? whole(references->GetTuple1(first + c)) : first + c);
  }
  loaded.graph.points = from_vtk(data->GetPoints());
  join_at_ends(ends, std::move(spare), loaded.graph);
  return loaded;
}

void write_graph_vtp(const fs::path& path, const geometry::VesselGraph& graph,
                     const std::vector<SegmentValues>& values) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(to_vtk(graph.points));
  vtkNew<vtkCellArray> lines;
  const auto count = static_cast<vtkIdType>(graph.edges.size());
  lines->AllocateExact(count, 2 * count);
  // For tools that know one radius for a point: that of the segment that arrives.
  std::vector<double> radius(graph.points.size(), 0.0), from, to;
  for (const geometry::GraphEdge& edge : graph.edges) {
    lines->InsertNextCell({edge.from, edge.to});
    from.push_back(edge.radius_from);
    to.push_back(edge.radius_to);
    double& start = radius[static_cast<std::size_t>(edge.from)];
    if (start == 0.0) start = edge.radius_from;
  }
  for (const geometry::GraphEdge& edge : graph.edges)
    radius[static_cast<std::size_t>(edge.to)] = edge.radius_to;
  data->SetLines(lines);
  add_array(*data->GetPointData(), "MaximumInscribedSphereRadius", radius);
  add_array(*data->GetCellData(), "RadiusFrom", from);
  add_array(*data->GetCellData(), "RadiusTo", to);
  if (!graph.references.empty()) {
    vtkNew<vtkTypeInt64Array> references;
    references->SetName("Reference");
    references->SetNumberOfValues(count);
    std::copy(graph.references.begin(), graph.references.end(), references->GetPointer(0));
    data->GetCellData()->AddArray(references);
  }
  for (const SegmentValues& value : values) add_array(*data->GetCellData(), value.name.c_str(), value.values);
  core::write_file(path, polydata_text(*data));
}

}  // namespace ostia::io
