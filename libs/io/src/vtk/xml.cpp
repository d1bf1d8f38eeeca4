#include "vtk/xml.h"

#include "surface_formats.h"
#include "vtk/trial.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPolyDataReader.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <set>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

/// deflate cannot shrink further than this (RFC 1951); a header that claims more than the file can hold lies.
constexpr std::uint64_t largest_compression = 1032;

void check_count(std::string_view header, std::string_view attribute, std::uint64_t file_bytes,
                 const fs::path& path) {
  for (std::size_t at = header.find(attribute); at != std::string_view::npos;
       at = header.find(attribute, at + 1)) {
    const std::size_t start = header.find_first_of("\"'", at + attribute.size());
    if (start == std::string_view::npos) return;
    const std::size_t end = header.find(header[start], start + 1);
    if (end == std::string_view::npos) return;
    const std::string_view text = header.substr(start + 1, end - start - 1);
    const auto value = number<std::int64_t>(text);
    if (!value || *value < 0)
      refuse(path, std::string(attribute) + "\"" + std::string(text) + "\" is no count");
    if (static_cast<std::uint64_t>(*value) > file_bytes * largest_compression / 4) {
      refuse(path, std::string(attribute) + std::string(text) + " is more than its " +
                       std::to_string(file_bytes) + " bytes can hold");
    }
  }
}

/// Everything that must be known before VTK sees the file.
void check_xml(const fs::path& path, std::string_view type) {
  const std::string content = core::read_file(path);
  const std::size_t data = std::min(content.find("<AppendedData"), content.size());
  const std::string_view header(content.data(), data);
  if (header.find("<!DOCTYPE") != std::string_view::npos ||
      header.find("<!ENTITY") != std::string_view::npos) {
    refuse(path, "it declares XML entities, which no VTK file needs");
  }
  if (header.find("<VTKFile") == std::string_view::npos) refuse(path, "it is no VTK XML file (no <VTKFile>)");
  if (content.rfind("</VTKFile>") == std::string::npos)
    refuse(path, "it is cut short: its last line, </VTKFile>, is missing; copy it again");
  if (header.find("<" + std::string(type)) == std::string_view::npos)
    refuse(path, "it holds no " + std::string(type));
  for (const std::string_view attribute :
       {"NumberOfPoints=", "NumberOfPolys=", "NumberOfLines=", "NumberOfVerts=", "NumberOfStrips=",
        "NumberOfCells=", "NumberOfTuples="}) {
    check_count(header, attribute, content.size(), path);
  }
}

/// The counts of a legacy file's header words, before VTK reserves memory for them: it takes a negative one
/// for none, and each number that is counted has a byte at least.
void check_legacy(const std::string& content, const fs::path& path) {
  if (content.compare(0, 5, "# vtk") != 0) refuse(path, "it is no legacy VTK file (no \"# vtk\")");
  for (const std::string_view name : {"POINTS", "VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS"}) {
    const std::string words = "\n" + std::string(name) + " ";
    for (std::size_t at = content.find(words); at != std::string::npos; at = content.find(words, at + 1)) {
      Words line(std::string_view(content).substr(at + words.size(), 80));
      Words counts(line.line());
      for (std::string_view word = counts.next(); !word.empty(); word = counts.next()) {
        const auto count = number<std::int64_t>(word);
        if (!count && name == "POINTS") break;  // its second word is a type
        if (!count || *count < 0 || static_cast<std::uint64_t>(*count) > content.size())
          refuse(path, "its " + std::string(name) + " " + std::string(word.substr(0, 40)) +
                           " is no count that its " + std::to_string(content.size()) + " bytes can hold");
      }
    }
  }
}

void check_cells(vtkCellArray* cells, vtkIdType points, const char* kind, const fs::path& path) {
  if (!cells || cells->GetNumberOfCells() == 0) return;
  vtkDataArray* offsets = cells->GetOffsetsArray();
  vtkDataArray* connectivity = cells->GetConnectivityArray();
  const auto where = [&](vtkIdType cell) { return std::string(kind) + " cell " + std::to_string(cell); };
  double previous = offsets->GetTuple1(0);
  if (previous != 0.0) refuse(path, where(0) + " has a bad offset");
  for (vtkIdType c = 1; c < offsets->GetNumberOfTuples(); ++c) {
    const double offset = offsets->GetTuple1(c);
    if (offset < previous || offset > static_cast<double>(connectivity->GetNumberOfTuples()))
      refuse(path, where(c - 1) + " has a bad offset");
    previous = offset;
  }
  for (vtkIdType i = 0; i < connectivity->GetNumberOfTuples(); ++i) {
    const double id = connectivity->GetTuple1(i);
    if (!(id >= 0 && id < static_cast<double>(points))) {
      refuse(path, "the connectivity of its " + std::string(kind) + " cells names point " +
                       std::to_string(static_cast<long long>(id)) + ", but there are " +
                       std::to_string(points) + " points");
    }
  }
}

void check_polydata(vtkPolyData& data, const fs::path& path) {
  const vtkIdType points = data.GetNumberOfPoints();
  check_cells(data.GetVerts(), points, "vertex", path);
  check_cells(data.GetLines(), points, "line", path);
  check_cells(data.GetPolys(), points, "polygon", path);
  check_cells(data.GetStrips(), points, "strip", path);
}

void add_text(vtkDataObject& data, const char* name, const char* value) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  data.GetFieldData()->AddArray(array);
}

/// Names without numbers: those of the labels in their order, or of labels 1, 2, ... Empty where neither
/// fits.
std::vector<geometry::Face> faces_by_order(vtkStringArray& names, const std::set<std::int32_t>& labels,
                                           std::vector<std::string>* warnings) {
  const vtkIdType count = names.GetNumberOfValues();
  std::vector<geometry::Face> faces;
  if (labels.empty()) return faces;
  if (count == static_cast<vtkIdType>(labels.size())) {
    vtkIdType i = 0;
    for (const std::int32_t label : labels) faces.push_back(face_named(label, names.GetValue(i++)));
  } else if (*labels.begin() >= 1 && *labels.rbegin() <= count) {
    for (const std::int32_t label : labels) faces.push_back(face_named(label, names.GetValue(label - 1)));
  } else if (warnings) {
    warnings->push_back("its FaceNames are left out: " + std::to_string(count) + " names for " +
                        std::to_string(labels.size()) + " labels (" + std::to_string(*labels.begin()) +
                        " to " + std::to_string(*labels.rbegin()) +
                        "); an array FaceIds says which is whose");
  }
  return faces;
}

template <class Writer, class Data>
std::string text_of(Data& data, Packing packing) {
  add_text(data, "Axes", "LPS");
  add_text(data, "Unit", "mm");
  vtkNew<Writer> writer;
  writer->SetInputData(&data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  if (packing == Packing::deflate)
    writer->SetCompressorTypeToZLib();
  else
    writer->SetCompressorTypeToNone();
  writer->WriteToOutputStringOn();
  if (writer->Write() != 1) throw std::bad_alloc();  // in memory nothing else can fail
  return writer->GetOutputString();
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_polydata(const fs::path& path) {
  vtkSmartPointer<vtkPolyData> data;
  if (upper(path.extension().string()) == ".VTK") {
    check_legacy(core::read_file(path), path);
    vtkNew<vtkPolyDataReader> reader;
    run(*reader, path);
    data = reader->GetOutput();
  } else {
    check_xml(path, "PolyData");
    vtkNew<vtkXMLPolyDataReader> reader;
    run(*reader, path);
    data = reader->GetOutput();
  }
  if (!data || data->GetNumberOfPoints() == 0) refuse(path, "it has no points");
  check_polydata(*data, path);
  return data;
}

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const fs::path& path) {
  check_xml(path, "UnstructuredGrid");
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  run(*reader, path);
  vtkSmartPointer<vtkUnstructuredGrid> data = reader->GetOutput();
  if (!data || data->GetNumberOfPoints() == 0) refuse(path, "it has no points");
  check_cells(data->GetCells(), data->GetNumberOfPoints(), "volume", path);
  return data;
}

std::string polydata_text(vtkPolyData& data, Packing packing) {
  return text_of<vtkXMLPolyDataWriter>(data, packing);
}
std::string grid_text(vtkUnstructuredGrid& data) {
  return text_of<vtkXMLUnstructuredGridWriter>(data, Packing::deflate);
}

vtkSmartPointer<vtkPoints> to_vtk(const std::vector<geometry::Vec3>& points) {
  auto out = vtkSmartPointer<vtkPoints>::New();
  out->SetDataTypeToDouble();
  out->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) out->SetPoint(static_cast<vtkIdType>(i), points[i].data());
  return out;
}

std::vector<geometry::Vec3> from_vtk(vtkPoints* points) {
  std::vector<geometry::Vec3> out(static_cast<std::size_t>(points->GetNumberOfPoints()));
  for (std::size_t i = 0; i < out.size(); ++i) points->GetPoint(static_cast<vtkIdType>(i), out[i].data());
  return out;
}

void add_array(vtkDataSetAttributes& attributes, const char* name, const std::vector<std::int32_t>& values) {
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  attributes.AddArray(array);
}

void add_array(vtkDataSetAttributes& attributes, const char* name, const std::vector<double>& values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  attributes.AddArray(array);
}

void add_array(vtkDataSetAttributes& attributes, const char* name,
               const std::vector<geometry::Vec3>& values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    array->SetTuple(static_cast<vtkIdType>(i), values[i].data());
  attributes.AddArray(array);
}

void add_faces(vtkDataObject& data, const std::vector<geometry::Face>& faces) {
  vtkNew<vtkIntArray> ids;
  vtkNew<vtkStringArray> names;
  ids->SetName("FaceIds");
  names->SetName("FaceNames");
  for (const geometry::Face& face : faces) {
    ids->InsertNextValue(face.id);
    names->InsertNextValue(face.name);
  }
  data.GetFieldData()->AddArray(ids);
  data.GetFieldData()->AddArray(names);
}

std::vector<geometry::Face> faces_of(vtkDataObject& data, const std::vector<std::int32_t>& ids,
                                     std::vector<std::string>* warnings) {
  std::set<std::int32_t> missing(ids.begin(), ids.end());
  auto* numbers = vtkIntArray::SafeDownCast(data.GetFieldData()->GetAbstractArray("FaceIds"));
  auto* names = vtkStringArray::SafeDownCast(data.GetFieldData()->GetAbstractArray("FaceNames"));
  if (names && !numbers) {
    std::vector<geometry::Face> ordered = faces_by_order(*names, missing, warnings);
    if (!ordered.empty()) return ordered;
  }
  std::vector<geometry::Face> faces;
  for (vtkIdType i = 0;
       numbers && names && i < std::min(numbers->GetNumberOfTuples(), names->GetNumberOfTuples()); ++i) {
    faces.push_back(face_named(numbers->GetValue(i), names->GetValue(i)));
    missing.erase(numbers->GetValue(i));
  }
  for (const std::int32_t id : missing) faces.push_back(face_without_name(id));
  return faces;
}

}  // namespace ostia::io
