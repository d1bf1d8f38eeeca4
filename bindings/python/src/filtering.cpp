// Filters of ITK.

#include "call.h"
#include "errors.h"
#include "rooms.h"
#include "volume.h"

#include "ostia/core/log.h"
#include "ostia/filtering/filter.h"

#include <pybind11/stl.h>

#include <string>
#include <vector>

namespace ostia::python {
namespace {

using core::TaskContext;
using filtering::FilterFacts;
using filtering::FilterInputs;
using filtering::FilterStep;
using filtering::ParameterFacts;
using imaging::FloatVolume;

FloatVolume floats_of(const AnyVolume& image) {
  return image.visit([](const auto& volume) {
    return FloatVolume{volume.geometry, {volume.voxels.begin(), volume.voxels.end()}};
  });
}

std::vector<FilterStep> steps_of(const py::object& given) {
  std::vector<FilterStep> steps;
  if (py::isinstance<py::str>(given)) {
    steps.push_back(filtering::step_of_text(given.cast<std::string>()));
  } else {
    for (const std::string& text : given.cast<std::vector<std::string>>())
      steps.push_back(filtering::step_of_text(text));
  }
  return steps;
}

AnyVolume run_filters(const AnyVolume& image, const py::object& with, const py::object& mask,
                      const py::object& reference, const py::object& progress) {
  const std::vector<FilterStep> steps = steps_of(with);
  FilterInputs inputs;
  if (!mask.is_none()) inputs.mask = &mask.cast<const AnyVolume&>().mask("mask");
  FloatVolume other;
  if (!reference.is_none()) {
    other = floats_of(reference.cast<const AnyVolume&>());
    inputs.reference = &other;
  }
  auto done = watched(progress, [&](const TaskContext& task) {
    auto result = filtering::filtered(floats_of(image), steps, inputs, task);
    for (const std::string& warning : result.warnings) core::log_warning(warning);
    return result;
  });
  return AnyVolume(std::move(done.image));
}

py::dict dict_of(const ParameterFacts& one) {
  py::dict out;
  out["name"] = one.name;
  out["text"] = one.text;
  out["unit"] = one.unit;
  if (one.words.empty()) {
    out["default"] = one.value;
    out["least"] = one.least;
    out["most"] = one.most;
    out["whole"] = one.whole;
  } else {
    out["default"] = one.words[static_cast<std::size_t>(one.value)];
    out["words"] = one.words;
  }
  return out;
}

py::list list_filters() {
  py::list all;
  for (const FilterFacts& one : filtering::filters()) {
    py::dict out;
    out["name"] = one.name;
    out["text"] = one.text;
    out["itk"] = one.itk;
    py::list parameters;
    for (const ParameterFacts& parameter : one.parameters) parameters.append(dict_of(parameter));
    out["parameters"] = parameters;
    out["values"] = name_of(one.result);
    out["unit"] = one.unit;
    out["companion"] = name_of(one.companion);
    out["least_voxels"] = one.least_voxels;
    out["bytes_per_voxel"] = one.bytes_per_voxel;
    all.append(out);
  }
  return all;
}

}  // namespace

void bind_filtering(py::module_& m) {
  m.def("filter_image", &run_filters, py::arg("image"), py::arg("with_"), py::kw_only(),
        py::arg("mask") = py::none(), py::arg("reference") = py::none(), py::arg("progress") = py::none(),
        "The image through filters of ITK, as `ostia filter --with` takes them: \"median:radius_mm=0.8\", or "
        "a list of "
        "such texts, one after the other. A Volume of float32 in single precision, whatever the image's "
        "type. mask: "
        "where n4 works (uint8); reference: the image that match-histogram goes by.");
  m.def("list_filters", &list_filters,
        "The filters with their parameters, units, bounds and defaults: a list of dictionaries, as `ostia "
        "filter --list "
        "--json` has it.");
}

}  // namespace ostia::python
