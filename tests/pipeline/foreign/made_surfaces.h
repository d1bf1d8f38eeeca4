#pragma once
/// \file Surfaces of the kinds that other programs write, with what is known of them.

#include "ostia/geometry/tri_mesh.h"

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// A surface in mm as another program has it.
struct MadeSurface {
  geometry::TriMesh mesh;
  std::vector<std::int32_t> labels;  ///< one a triangle, or none
};

/// A kind of file that people bring.
struct ForeignKind {
  std::string name;
  std::string file;         ///< its extension says what writes it: .vtp, .stl, .ply
  std::string label_array;  ///< of a .vtp: "CellEntityIds", "ModelFaceID"; empty: none
  double unit_mm = 1.0;     ///< in which the file is written
  std::size_t parts = 1, outlets = 2;
  std::function<MadeSurface()> make;
  bool calibre_tells_unit = true;  ///< an aorta in centimetres has the numbers of a coronary in millimetres
};

/// For messages of the tests.
inline std::ostream& operator<<(std::ostream& out, const ForeignKind& kind) {
  return out << kind.name;
}

/// Those that are meshed within a few seconds, and a tree of 46 outlets.
std::vector<ForeignKind> foreign_kinds();
ForeignKind tree_of_46_outlets();

/// Writes the kind's file into the folder.
std::filesystem::path write_foreign(const ForeignKind& kind, const MadeSurface& made,
                                    const std::filesystem::path& folder);

/// A fault that a file may have on top of its kind, or what else may come on top of it.
struct Fault {
  std::string name;
  std::function<void(MadeSurface&)> add;
  std::function<void(ForeignKind&)> tell = [](ForeignKind&) {};  ///< what is known of it then
};
std::vector<Fault> faults();

}  // namespace ostia::pipeline
