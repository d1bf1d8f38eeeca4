#include "volume.h"

#include "ostia/core/error.h"

namespace ostia::python {
namespace {

template <class T>
std::shared_ptr<const imaging::Volume<T>> kept(const py::array& array, const imaging::Geometry& grid) {
  auto* volume = new imaging::Volume<T>;
  volume->geometry = grid;
  lend(volume->voxels, array.data(), static_cast<std::size_t>(array.size()));
  auto owner = std::make_shared<Held>(array);
  return {volume, [owner](imaging::Volume<T>* gone) {
            take_back(gone->voxels);
            delete gone;
          }};
}

/// The type of voxels that an array's values have, or that hold them.
ArrayWanted voxels_for(const py::array& array) {
  const char kind = array.dtype().kind();
  const bool mask = kind == 'b' || (kind == 'u' && array.itemsize() == 1);
  if (kind == 'f') return {"array", 'f', 4, {-1, -1, -1}};
  if (mask) return {"array", 'u', 1, {-1, -1, -1}};
  return {"array", 'i', 2, {-1, -1, -1}};
}

}  // namespace

AnyVolume AnyVolume::of_array(const py::object& given, imaging::Geometry grid, const py::object& copy) {
  py::object values = any_array(given, "array");
  // A byte that is True is a voxel of 1.
  if (values.attr("dtype").attr("kind").cast<std::string>() == "b") values = values.attr("view")("uint8");
  const ArrayWanted wanted = voxels_for(values.cast<py::array>());
  const py::array array = taken(values, wanted, copying_of(copy));
  if (array.size() == 0)
    throw InvalidInput("array: of shape " + described(array) +
                       " has no voxels; give (z, y, x) of one or more each");
  if (wanted.kind == 'f') require_finite(array, "array");
  grid.size = {array.shape(2), array.shape(1), array.shape(0)};
  if (wanted.kind == 'f') return AnyVolume(kept<float>(array, grid));
  if (wanted.kind == 'u') return AnyVolume(kept<std::uint8_t>(array, grid));
  return AnyVolume(kept<std::int16_t>(array, grid));
}

const imaging::Geometry& AnyVolume::grid() const {
  return std::visit([](const auto& volume) -> const imaging::Geometry& { return volume->geometry; }, volume_);
}

py::array AnyVolume::array(const py::handle& owner) const {
  return visit([&]<class T>(const imaging::Volume<T>& volume) {
    const auto& size = volume.geometry.size;
    return view_of(py::dtype::of<T>(), {size[2], size[1], size[0]}, volume.voxels.data(), owner);
  });
}

std::string AnyVolume::type() const {
  constexpr const char* names[] = {"int16", "uint8", "float32"};
  return names[volume_.index()];
}

template <class T>
const imaging::Volume<T>& AnyVolume::as(const std::string& argument, const char* wanted) const {
  if (const auto* volume = std::get_if<std::shared_ptr<const imaging::Volume<T>>>(&volume_)) return **volume;
  throw InvalidInput(argument + ": a Volume of " + type() + "; it must be of " + wanted + ": give " +
                     argument + ".astype('" + wanted + "')");
}

std::shared_ptr<const imaging::ImageVolume> AnyVolume::shared_image(const std::string& argument) const {
  static_cast<void>(image(argument));
  return std::get<std::shared_ptr<const imaging::ImageVolume>>(volume_);
}

const imaging::ImageVolume& AnyVolume::image(const std::string& argument) const {
  return as<std::int16_t>(argument, "int16");
}
const imaging::MaskVolume& AnyVolume::mask(const std::string& argument) const {
  return as<std::uint8_t>(argument, "uint8");
}
const imaging::FloatVolume& AnyVolume::floats(const std::string& argument) const {
  return as<float>(argument, "float32");
}

}  // namespace ostia::python
