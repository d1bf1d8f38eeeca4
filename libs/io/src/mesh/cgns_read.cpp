// CGNS, read: one unstructured zone; sections of tetrahedra and wedges, and of triangles and quadrilaterals
// that boundary conditions name.

#include "mesh/builder.h"
#include "mesh/readers.h"
#include "mesh/tagged_sides.h"
#include "surface_formats.h"

#include <cgnslib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

struct CgnsKind {
  Shape shape;
  std::size_t nodes;
};

std::optional<CgnsKind> kind_of(CGNS_ENUMT(ElementType_t) type) {
  switch (type) {
    case CGNS_ENUMV(TETRA_4):
      return CgnsKind{Shape::tetrahedron, 4};
    case CGNS_ENUMV(TETRA_10):
      return CgnsKind{Shape::tetrahedron, 10};
    case CGNS_ENUMV(PENTA_6):
      return CgnsKind{Shape::prism, 6};
    case CGNS_ENUMV(PENTA_18):
      return CgnsKind{Shape::prism, 18};
    case CGNS_ENUMV(TRI_3):
      return CgnsKind{Shape::triangle, 3};
    case CGNS_ENUMV(TRI_6):
      return CgnsKind{Shape::triangle, 6};
    case CGNS_ENUMV(QUAD_4):
      return CgnsKind{Shape::quad, 4};
    case CGNS_ENUMV(QUAD_9):
      return CgnsKind{Shape::quad, 9};
    default:
      return std::nullopt;
  }
}

/// mm in a unit of length; 0 for one that is not known.
double millimetres(CGNS_ENUMT(LengthUnits_t) unit) {
  switch (unit) {
    case CGNS_ENUMV(Meter):
      return 1000.0;
    case CGNS_ENUMV(Centimeter):
      return 10.0;
    case CGNS_ENUMV(Millimeter):
      return 1.0;
    case CGNS_ENUMV(Foot):
      return 304.8;
    case CGNS_ENUMV(Inch):
      return 25.4;
    default:
      return 0.0;
  }
}

/// A face's elements are numbered from `first` to `last`.
struct Condition {
  geometry::Face face;
  cgsize_t first = 0, last = 0;
};

class CgnsInput {
 public:
  explicit CgnsInput(const fs::path& path) : path_(path), mesh_(path) {
    require(cg_open(path.c_str(), CG_MODE_READ, &file_));
  }
  ~CgnsInput() {
    if (file_ > 0) cg_close(file_);
  }
  CgnsInput(const CgnsInput&) = delete;
  CgnsInput& operator=(const CgnsInput&) = delete;

  LayeredMesh read() {
    int bases = 0, zones = 0;
    require(cg_nbases(file_, &bases));
    if (bases > 0) require(cg_nzones(file_, base_, &zones));
    if (bases != 1 || zones != 1) refuse(path_, "it has other than one base with one zone");
    read_points();
    read_conditions();
    int sections = 0;
    require(cg_nsections(file_, base_, zone_, &sections));
    for (int section = 1; section <= sections; ++section) read_section(section);
    if (!mesh_.has_boundary()) return mesh_.finish({});
    LayeredMesh read = mesh_.finish(faces());
    name_rest(read.mesh, rest_);
    return read;
  }

 private:
  void read_points() {
    std::array<char, 64> name{};
    std::array<cgsize_t, 9> size{};
    CGNS_ENUMT(ZoneType_t) type{};
    require(cg_zone_type(file_, base_, zone_, &type));
    if (type != CGNS_ENUMV(Unstructured)) refuse(path_, "its zone is structured");
    require(cg_zone_read(file_, base_, zone_, name.data(), size.data()));
    if (size[0] < 1 || static_cast<std::uintmax_t>(size[0]) > fs::file_size(path_))
      refuse(path_, "its number of points is out of range");
    const double unit = unit_mm();
    std::vector<geometry::Vec3>& points = mesh_.points();
    points.resize(static_cast<std::size_t>(size[0]));
    for (int axis = 0; axis < 3; ++axis) {
      const std::string coordinate = std::string("Coordinate") + "XYZ"[axis];
      const cgsize_t first = 1;
      std::vector<double> values(points.size());
      require(cg_coord_read(file_, base_, zone_, coordinate.c_str(), CGNS_ENUMV(RealDouble), &first,
                            size.data(), values.data()));
      for (std::size_t i = 0; i < points.size(); ++i) points[i][axis] = unit * values[i];
    }
  }

  /// Of the file's unit; one that it does not say is the millimetre.
  double unit_mm() {
    CGNS_ENUMT(MassUnits_t) mass{};
    CGNS_ENUMT(LengthUnits_t) length{};
    CGNS_ENUMT(TimeUnits_t) time{};
    CGNS_ENUMT(TemperatureUnits_t) temperature{};
    CGNS_ENUMT(AngleUnits_t) angle{};
    require(cg_goto(file_, base_, "end"));
    if (cg_units_read(&mass, &length, &time, &temperature, &angle) != CG_OK) return 1.0;
    const double unit = millimetres(length);
    return unit > 0.0 ? unit : 1.0;
  }

  void read_conditions() {
    int count = 0;
    if (cg_nbocos(file_, base_, zone_, &count) != CG_OK) return;
    for (int i = 1; i <= count; ++i) {
      std::array<char, 64> name{};
      CGNS_ENUMT(BCType_t) type{};
      CGNS_ENUMT(PointSetType_t) set{};
      CGNS_ENUMT(DataType_t) normals{};
      cgsize_t points = 0, normal_list = 0;
      std::array<int, 3> normal_index{};
      int sets = 0;
      require(cg_boco_info(file_, base_, zone_, i, name.data(), &type, &set, &points, normal_index.data(),
                           &normal_list, &normals, &sets));
      if (points != 2 || (set != CGNS_ENUMV(PointRange) && set != CGNS_ENUMV(ElementRange)))
        refuse(path_,
               std::string("boundary condition ") + name.data() + " is no range of elements; such are read");
      if (set == CGNS_ENUMV(PointRange)) require_elements(i, name.data());
      std::array<cgsize_t, 2> range{};
      require(cg_boco_read(file_, base_, zone_, i, range.data(), nullptr));
      Condition condition;
      condition.face = face_named(id_of(i).value_or(0), name.data());
      if (type == CGNS_ENUMV(BCInflow)) condition.face.kind = geometry::FaceKind::inlet;
      if (type == CGNS_ENUMV(BCOutflow)) condition.face.kind = geometry::FaceKind::outlet;
      if (type == CGNS_ENUMV(BCWall)) condition.face.kind = geometry::FaceKind::wall;
      condition.first = range[0];
      condition.last = range[1];
      conditions_.push_back(condition);
    }
    std::vector<geometry::Face> all = faces();
    make_ids_unique(all);
    for (std::size_t c = 0; c < conditions_.size(); ++c) conditions_[c].face.id = all[c].id;
    rest_ = unused_face_id(all);
  }

  std::vector<geometry::Face> faces() const {
    std::vector<geometry::Face> faces;
    for (const Condition& condition : conditions_) faces.push_back(condition.face);
    return faces;
  }

  /// A range without a location is of vertices (SIDS, 9.3).
  void require_elements(int condition, const char* name) {
    CGNS_ENUMT(GridLocation_t) location{};
    require(cg_boco_gridlocation_read(file_, base_, zone_, condition, &location));
    if (location == CGNS_ENUMV(Vertex))
      refuse(path_, std::string("boundary condition ") + name +
                        " is of points; such of elements are read (GridLocation FaceCenter)");
  }

  /// Its descriptor CellEntityIds.
  std::optional<std::int32_t> id_of(int condition) {
    require(cg_goto(file_, base_, "Zone_t", zone_, "ZoneBC_t", 1, "BC_t", condition, "end"));
    int descriptors = 0;
    require(cg_ndescriptors(&descriptors));
    for (int d = 1; d <= descriptors; ++d) {
      std::array<char, 64> name{};
      char* text = nullptr;
      require(cg_descriptor_read(d, name.data(), &text));
      const std::optional<int> id =
          std::string(name.data()) == "CellEntityIds" ? number<int>(text) : std::nullopt;
      cg_free(text);
      if (id) return id;
    }
    return std::nullopt;
  }

  void read_section(int section) {
    std::array<char, 64> name{};
    CGNS_ENUMT(ElementType_t) type{};
    cgsize_t first = 0, last = 0, values = 0;
    int boundary = 0, parents = 0;
    require(cg_section_read(file_, base_, zone_, section, name.data(), &type, &first, &last, &boundary,
                            &parents));
    const std::optional<CgnsKind> kind = kind_of(type);
    if (!kind)
      refuse(path_, std::string("section ") + name.data() + " has elements of type " +
                        cg_ElementTypeName(type) +
                        "; tetrahedra, wedges, triangles and quadrilaterals are read");
    require(cg_ElementDataSize(file_, base_, zone_, section, &values));
    const auto elements = static_cast<std::size_t>(std::max<cgsize_t>(last - first + 1, 0));
    constexpr std::uintmax_t most_compressed = 1100;  // deflate's bound
    if (values < 0 || static_cast<std::uintmax_t>(values) != elements * kind->nodes ||
        static_cast<std::uintmax_t>(values) > most_compressed * fs::file_size(path_))
      refuse(path_, std::string("section ") + name.data() + " is not as long as its elements");
    mesh_.set_in_layers(std::string_view(name.data()).ends_with(layers_suffix));
    std::vector<cgsize_t> nodes(static_cast<std::size_t>(values));
    require(cg_elements_read(file_, base_, zone_, section, nodes.data(), nullptr));
    std::vector<std::int32_t> one(kind->nodes);
    for (std::size_t e = 0; e < elements; ++e) {
      for (std::size_t k = 0; k < kind->nodes; ++k)
        one[k] =
            static_cast<std::int32_t>(std::clamp<cgsize_t>(nodes[e * kind->nodes + k] - 1, -1, INT32_MAX));
      mesh_.add(kind->shape, one, face_of(first + static_cast<cgsize_t>(e)), uprights_second_order);
    }
  }

  /// `rest_` for a facet that no condition names.
  std::int32_t face_of(cgsize_t element) const {
    for (const Condition& condition : conditions_)
      if (element >= condition.first && element <= condition.last) return condition.face.id;
    return rest_;
  }

  void require(int status) const {
    if (status != CG_OK) refuse(path_, cg_get_error());
  }

  fs::path path_;
  MeshBuilder mesh_;
  int file_ = 0;
  static constexpr int base_ = 1, zone_ = 1;
  std::vector<Condition> conditions_;
  std::int32_t rest_ = 1;
};

}  // namespace

LayeredMesh read_cgns(const fs::path& path) {
  return CgnsInput(path).read();
}

}  // namespace ostia::io
