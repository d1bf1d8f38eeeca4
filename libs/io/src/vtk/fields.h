#pragma once
/// \file Fields of volume_fields.h and surface_fields.h as VTK's arrays.

#include "ostia/io/volume_fields.h"

#include <vtkDataSetAttributes.h>

#include <functional>

namespace ostia::io {

/// Throws InvalidInput where a field has not `tuples` times its components values, or other than 1 to 9
/// components. Its array has `length` tuples (`tuples` at least), NaN beyond the field's own.
void add_fields(vtkDataSetAttributes& attributes, const std::map<std::string, FieldValues>& fields,
                std::size_t tuples, std::size_t length, const std::string& where);

/// The numbers among the arrays, of 1 to 9 components, without CellEntityIds. The value i of a field is that
/// of VTK's tuple `order(i)`.
std::map<std::string, FieldValues> fields_of(vtkDataSetAttributes& attributes, std::size_t tuples,
                                             const std::function<std::size_t(std::size_t)>& order);

}  // namespace ostia::io
