#pragma once
/// \file OpenFOAM's polyMesh (User Guide, "Mesh description"): faces with their owner and neighbour cells,
/// inner ones first and in upper-triangular order, then one range of faces for each patch. Metres.

#include "ostia/geometry/vec.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::io {

struct PolyMesh {
  struct Patch {
    std::string name;
    bool wall = false;
    std::size_t faces = 0;
  };

  const std::vector<geometry::Vec3>& points;  ///< mm
  std::size_t cells = 0;
  std::vector<std::array<std::int32_t, 4>> faces;  ///< out of their owner; the fourth of a triangle is -1
  std::vector<std::int32_t> owner, neighbour;      ///< neighbours of the inner ones alone
  std::vector<Patch> patches;
};

/// Into constant/polyMesh of a case, which is returned. Throws IoError, ResourceError.
std::filesystem::path write_poly_mesh(const PolyMesh& mesh, const std::filesystem::path& case_folder);

class TextFile;
/// What each of OpenFOAM's files begins with.
void put_foam_header(TextFile& out, const char* type, const char* object, const std::string& note = {});

}  // namespace ostia::io
