#pragma once
/// \file An image of one of the three types of voxels that the libraries know, as Python has it.

#include "array.h"

#include "ostia/imaging/volume.h"

#include <memory>
#include <string>
#include <utility>
#include <variant>

namespace ostia::python {

/// Immutable; copies share the voxels.
class AnyVolume {
 public:
  template <class T>
  explicit AnyVolume(imaging::Volume<T> volume)
      : volume_(std::make_shared<const imaging::Volume<T>>(std::move(volume))) {}
  template <class T>
  explicit AnyVolume(std::shared_ptr<const imaging::Volume<T>> volume) : volume_(std::move(volume)) {}

  /// Of an array of (z, y, x), kept as it is where it can be. Throws InvalidInput.
  static AnyVolume of_array(const py::object& array, imaging::Geometry grid, const py::object& copy);

  const imaging::Geometry& grid() const;
  py::array array(const py::handle& owner) const;  ///< a view, (z, y, x)
  std::string type() const;                        ///< "int16", "uint8", "float32"

  /// What an argument of a function must be: throws InvalidInput that names it for another type of voxels.
  const imaging::ImageVolume& image(const std::string& argument) const;
  const imaging::MaskVolume& mask(const std::string& argument) const;
  const imaging::FloatVolume& floats(const std::string& argument) const;
  /// The same for what keeps it.
  std::shared_ptr<const imaging::ImageVolume> shared_image(const std::string& argument) const;

  template <class Call>
  auto visit(Call&& call) const {
    return std::visit([&](const auto& volume) { return call(*volume); }, volume_);
  }

 private:
  template <class T>
  const imaging::Volume<T>& as(const std::string& argument, const char* wanted) const;
  std::variant<std::shared_ptr<const imaging::ImageVolume>, std::shared_ptr<const imaging::MaskVolume>,
               std::shared_ptr<const imaging::FloatVolume>>
      volume_;
};

}  // namespace ostia::python
