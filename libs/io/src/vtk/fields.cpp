#include "vtk/fields.h"

#include "ostia/core/error.h"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>

#include <limits>

namespace ostia::io {
namespace {

constexpr int most_components = 9;

void check(const std::string& name, const FieldValues& field, std::size_t tuples, const std::string& where) {
  if (field.components < 1 || field.components > most_components)
    throw InvalidInput("the field " + name + " has " + std::to_string(field.components) +
                       " components; there are 1 to 9");
  const std::size_t wanted = tuples * static_cast<std::size_t>(field.components);
  if (field.values.size() != wanted)
    throw InvalidInput("the field " + name + " has " + std::to_string(field.values.size()) + " values, but " +
                       std::to_string(tuples) + " " + where + " of " + std::to_string(field.components) +
                       " components need " + std::to_string(wanted));
}

}  // namespace

void add_fields(vtkDataSetAttributes& attributes, const std::map<std::string, FieldValues>& fields,
                std::size_t tuples, std::size_t length, const std::string& where) {
  for (const auto& [name, field] : fields) {
    check(name, field, tuples, where);
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(field.components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(length));
    array->Fill(std::numeric_limits<double>::quiet_NaN());
    std::copy(field.values.begin(), field.values.end(), array->GetPointer(0));
    attributes.AddArray(array);
  }
}

std::map<std::string, FieldValues> fields_of(vtkDataSetAttributes& attributes, std::size_t tuples,
                                             const std::function<std::size_t(std::size_t)>& order) {
  std::map<std::string, FieldValues> fields;
  for (int a = 0; a < attributes.GetNumberOfArrays(); ++a) {
    vtkDataArray* array = attributes.GetArray(a);  // none where it holds no numbers
    if (!array || !array->GetName()) continue;
    const int components = array->GetNumberOfComponents();
    const std::string name = array->GetName();
    if (name == "CellEntityIds" || components < 1 || components > most_components) continue;
    FieldValues& field = fields[name];
    field.components = components;
    field.values.reserve(tuples * static_cast<std::size_t>(components));
    for (std::size_t i = 0; i < tuples; ++i) {
      for (int c = 0; c < components; ++c)
        field.values.push_back(array->GetComponent(static_cast<vtkIdType>(order(i)), c));
    }
  }
  return fields;
}

}  // namespace ostia::io
