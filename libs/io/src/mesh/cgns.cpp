// CGNS (SIDS, "Unstructured Grid Element Numbering Conventions"): one zone, a section for each kind of
// element and for each face, and a boundary condition that names the face's elements.

#include "mesh/formats.h"
#include "mesh/text.h"

#include "ostia/core/error.h"

#include <cgnslib.h>

#include <cerrno>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

CGNS_ENUMT(ElementType_t) element_type(Shape shape, bool quadratic) {
  switch (shape) {
    case Shape::tetrahedron:
      return quadratic ? CGNS_ENUMV(TETRA_10) : CGNS_ENUMV(TETRA_4);
    case Shape::prism:
      return quadratic ? CGNS_ENUMV(PENTA_18) : CGNS_ENUMV(PENTA_6);
    case Shape::triangle:
      return quadratic ? CGNS_ENUMV(TRI_6) : CGNS_ENUMV(TRI_3);
    default:
      return quadratic ? CGNS_ENUMV(QUAD_9) : CGNS_ENUMV(QUAD_4);
  }
}

CGNS_ENUMT(BCType_t) condition(geometry::FaceKind kind) {
  switch (kind) {
    case geometry::FaceKind::inlet:
      return CGNS_ENUMV(BCInflow);
    case geometry::FaceKind::outlet:
      return CGNS_ENUMV(BCOutflow);
    default:
      return CGNS_ENUMV(BCWall);
  }
}

class CgnsFile {
 public:
  CgnsFile(fs::path path, const PreparedMesh& mesh) : path_(std::move(path)), mesh_(mesh) {
    errno = 0;
    require(cg_set_file_type(CG_FILE_HDF5));
    require(cg_open(path_.c_str(), CG_MODE_WRITE, &file_));
    open_ = true;
  }
  ~CgnsFile() {
    if (open_) cg_close(file_);
  }
  CgnsFile(const CgnsFile&) = delete;
  CgnsFile& operator=(const CgnsFile&) = delete;

  void write_zone() {
    require(cg_base_write(file_, "Base", 3, 3, &base_));
    require(cg_goto(file_, base_, "end"));
    require(cg_dataclass_write(CGNS_ENUMV(Dimensional)));
    require(cg_units_write(CGNS_ENUMV(Kilogram), CGNS_ENUMV(Millimeter), CGNS_ENUMV(Second),
                           CGNS_ENUMV(Kelvin), CGNS_ENUMV(Degree)));
    require(cg_descriptor_write("Axes", "LPS"));
    const std::array<cgsize_t, 3> size = {static_cast<cgsize_t>(mesh_.mesh.points.size()),
                                          static_cast<cgsize_t>(mesh_.elements()), 0};
    require(cg_zone_write(file_, base_, mesh_.title.c_str(), size.data(), CGNS_ENUMV(Unstructured), &zone_));
    for (int axis = 0; axis < 3; ++axis) write_coordinates(axis);
  }

  void write_elements() {
    for (const ElementBlock& block : mesh_.blocks())
      write_section(mesh_.name(block), element_type(block.shape, mesh_.mesh.quadratic()), block.count,
                    mesh_.connectivity(block, uprights_second_order));
  }

  /// A cap of triangles and quadrilaterals is two sections: checkers and readers stumble over MIXED ones.
  void write_face(std::size_t f) {
    const PreparedMesh::Facets& facets = mesh_.facets[f];
    const bool both = !facets.triangles.empty() && !facets.quads.empty();
    const cgsize_t first = next_;
    for (const Shape shape : facet_shapes) {
      const std::vector<std::int32_t>& of_shape = facets.of(shape);
      if (of_shape.empty()) continue;
      const std::string kind = !both ? "" : shape == Shape::triangle ? "_triangles" : "_quads";
      write_section(section_name(f, kind), element_type(shape, mesh_.mesh.quadratic()), of_shape.size(),
                    mesh_.connectivity(shape, of_shape));
    }
    write_condition(f, {first, next_ - 1});
  }

  void close() {
    open_ = false;
    require(cg_close(file_));
  }

 private:
  void write_coordinates(int axis) {
    std::vector<double> values;
    values.reserve(mesh_.mesh.points.size());
    for (const geometry::Vec3& p : mesh_.mesh.points) values.push_back(p[axis]);
    const std::string name = std::string("Coordinate") + "XYZ"[axis];
    int number = 0;
    require(
        cg_coord_write(file_, base_, zone_, CGNS_ENUMV(RealDouble), name.c_str(), values.data(), &number));
    require(cg_goto(file_, base_, "Zone_t", zone_, "GridCoordinates_t", 1, "DataArray_t", number, "end"));
    constexpr std::array<float, 5> length = {0, 1, 0, 0, 0};  // mass, length, time, temperature, angle
    require(cg_exponents_write(CGNS_ENUMV(RealSingle), length.data()));
  }

  void write_section(const std::string& name, CGNS_ENUMT(ElementType_t) type, std::size_t elements,
                     const std::vector<std::int32_t>& nodes) {
    std::vector<cgsize_t> from_one(nodes.begin(), nodes.end());
    for (cgsize_t& node : from_one) ++node;
    int ignored = 0;
    const cgsize_t last = next_ + static_cast<cgsize_t>(elements) - 1;
    require(
        cg_section_write(file_, base_, zone_, name.c_str(), type, next_, last, 0, from_one.data(), &ignored));
    next_ = last + 1;
  }

  /// CGNS knows 32 characters.
  std::string section_name(std::size_t f, const std::string& kind) const {
    const std::string name = mesh_.names[f] + kind;
    return name.size() <= 32 ? name : "face_" + std::to_string(mesh_.mesh.faces[f].id) + kind;
  }

  void write_condition(std::size_t f, std::array<cgsize_t, 2> range) {
    int number = 0;
    const geometry::Face& face = mesh_.mesh.faces[f];
    require(cg_boco_write(file_, base_, zone_, mesh_.names[f].c_str(), condition(face.kind),
                          CGNS_ENUMV(PointRange), 2, range.data(), &number));
    require(cg_boco_gridlocation_write(file_, base_, zone_, number, CGNS_ENUMV(FaceCenter)));
    require(cg_goto(file_, base_, "Zone_t", zone_, "ZoneBC_t", 1, "BC_t", number, "end"));
    require(cg_descriptor_write("CellEntityIds", std::to_string(face.id).c_str()));
  }

  void require(int status) const {
    if (status == CG_OK) return;
    if (errno == ENOSPC || errno == EDQUOT || errno == EFBIG) throw_cannot_write(path_, errno);
    throw IoError("cannot write " + path_.string() + ": " + cg_get_error());
  }

  fs::path path_;
  const PreparedMesh& mesh_;
  int file_ = 0, base_ = 0, zone_ = 0;
  cgsize_t next_ = 1;
  bool open_ = false;
};

}  // namespace

void write_cgns(const PreparedMesh& mesh, const fs::path& path) {
  CgnsFile file(path, mesh);
  file.write_zone();
  file.write_elements();
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) file.write_face(f);
  file.close();
}

}  // namespace ostia::io
