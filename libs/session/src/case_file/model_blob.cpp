#include "case_file/model_blob.h"

#include "ostia/core/error.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace ostia::session {
namespace {

static_assert(std::endian::native == std::endian::little, "blobs are little-endian");

using geometry::Frame;
using geometry::Vec3;
using lumen::LumenModel;
using lumen::SurfaceSample;
using lumen::VesselLumen;

[[noreturn]] void damaged_blob(const std::string& what) {
  throw InvalidInput("the case is damaged: " + what);
}

template <class Value>
std::vector<Value> values_of(std::string_view bytes) {
  if (bytes.size() % sizeof(Value) != 0) damaged_blob("a list of numbers is cut short");
  std::vector<Value> values(bytes.size() / sizeof(Value));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

template <class Value>
std::string raw(const std::vector<Value>& values) {
  std::string bytes(values.size() * sizeof(Value), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

constexpr std::string_view blob_magic = "ostia-model-1\n";
constexpr std::uint64_t largest_model = 2ULL << 30;

class BlobWriter {
 public:
  explicit BlobWriter(std::string& out) : out_(&out) {}
  template <class Value>
  void number(Value value) {
    char bytes[sizeof(Value)];
    std::memcpy(bytes, &value, sizeof(Value));
    out_->append(bytes, sizeof(Value));
  }
  void text(std::string_view bytes) {
    number(static_cast<std::uint64_t>(bytes.size()));
    *out_ += bytes;
  }

 private:
  std::string* out_;
};

class BlobReader {
 public:
  explicit BlobReader(std::string_view bytes) : rest_(bytes) {}
  template <class Value>
  Value number() {
    Value value;
    std::memcpy(&value, take(sizeof(Value)).data(), sizeof(Value));
    return value;
  }
  std::string_view text() { return take(number<std::uint64_t>()); }
  std::size_t count(std::size_t least_bytes_each) {
    const auto n = number<std::uint64_t>();
    if (n > rest_.size() / least_bytes_each) damaged_blob("a list is longer than the model");
    return n;
  }
  bool done() const { return rest_.empty(); }

 private:
  std::string_view take(std::uint64_t size) {
    if (size > rest_.size()) damaged_blob("the model is cut short");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  std::string_view rest_;
};

void write_tree(BlobWriter& out, const geometry::VesselTree& tree) {
  out.number(static_cast<std::uint64_t>(tree.nodes.size()));
  for (const auto& n : tree.nodes) {
    out.number(n.id);
    out.text(bytes_of(n.position));
  }
  out.number(static_cast<std::uint64_t>(tree.segments.size()));
  for (const auto& s : tree.segments) {
    for (const std::int32_t id : {s.id, s.from, s.to}) out.number(id);
    out.text(bytes_of(s.axis.points));
    out.text(bytes_of(s.axis.radius));
    out.text(bytes_of(s.axis.abscissa));
    out.text(bytes_of(s.axis.frames));
  }
  out.number(static_cast<std::uint64_t>(tree.vessels.size()));
  for (const auto& v : tree.vessels) {
    out.number(v.id);
    out.text(v.name);
    out.text(bytes_of(v.segments));
  }
}

geometry::VesselTree read_tree(BlobReader& in) {
  geometry::VesselTree tree;
  tree.nodes.resize(in.count(12));
  for (auto& n : tree.nodes) {
    n.id = in.number<std::int32_t>();
    n.position = vec_of(in.text());
  }
  tree.segments.resize(in.count(44));
  for (auto& s : tree.segments) {
    s.id = in.number<std::int32_t>();
    s.from = in.number<std::int32_t>();
    s.to = in.number<std::int32_t>();
    s.axis.points = points_of(in.text());
    s.axis.radius = doubles_of(in.text());
    s.axis.abscissa = doubles_of(in.text());
    s.axis.frames = frames_of(in.text());
  }
  tree.vessels.resize(in.count(20));
  for (auto& v : tree.vessels) {
    v.id = in.number<std::int32_t>();
    v.name = std::string(in.text());
    v.segments = ids_of(in.text());
  }
  return tree;
}

void write_lumen(BlobWriter& out, const VesselLumen& lumen) {
  out.number(lumen.vessel);
  out.number(lumen.own_from_mm);
  out.number(static_cast<std::int32_t>(lumen.interpolation.kernel));
  out.number(lumen.interpolation.support_radius_mm);
  out.number(lumen.interpolation.offset_mm);
  out.number(static_cast<std::int32_t>(lumen.interpolation.far_field));
  out.number(static_cast<std::uint64_t>(lumen.samples.size()));
  for (const SurfaceSample& sample : lumen.samples) {
    out.number(sample.id);
    for (int k = 0; k < 3; ++k) out.number(sample.position[k]);
    for (int k = 0; k < 3; ++k) out.number(sample.normal[k]);
    out.number(sample.s_mm);
    out.number(static_cast<std::uint8_t>(sample.origin));
  }
}

template <class Enum>
Enum enum_of(std::int64_t value, Enum last) {
  if (value < 0 || value > static_cast<std::int64_t>(last))
    damaged_blob("an unknown choice " + std::to_string(value));
  return static_cast<Enum>(value);
}

VesselLumen read_lumen(BlobReader& in) {
  VesselLumen lumen;
  lumen.vessel = in.number<std::int32_t>();
  lumen.own_from_mm = in.number<double>();
  lumen.interpolation.kernel = enum_of(in.number<std::int32_t>(), lumen::Kernel::wendland_c4);
  lumen.interpolation.support_radius_mm = in.number<double>();
  lumen.interpolation.offset_mm = in.number<double>();
  lumen.interpolation.far_field = enum_of(in.number<std::int32_t>(), lumen::FarField::linear);
  lumen.samples.resize(in.count(65));
  for (SurfaceSample& sample : lumen.samples) {
    sample.id = in.number<std::int64_t>();
    for (int k = 0; k < 3; ++k) sample.position[k] = in.number<double>();
    for (int k = 0; k < 3; ++k) sample.normal[k] = in.number<double>();
    sample.s_mm = in.number<double>();
    sample.origin = enum_of(in.number<std::uint8_t>(), lumen::SampleOrigin::edit);
  }
  return lumen;
}

std::string inflated(std::string_view bytes) {
  if (bytes.size() < 8) damaged_blob("the starting model is cut short");
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), 8);
  // zlib cannot shrink more than about a thousandfold.
  if (size > largest_model || size > 1100 * bytes.size())
    damaged_blob("the starting model's size is impossible");
  std::string out(size, '\0');
  uLongf length = size;
  const int code = uncompress(reinterpret_cast<Bytef*>(out.data()), &length,
                              reinterpret_cast<const Bytef*>(bytes.data() + 8), bytes.size() - 8);
  if (code != Z_OK || length != size) damaged_blob("the starting model cannot be decompressed");
  return out;
}

}  // namespace

std::string bytes_of(const Vec3& v) {
  return bytes_of(std::vector<double>{v.x(), v.y(), v.z()});
}
std::string bytes_of(const std::vector<Vec3>& points) {
  std::vector<double> values;
  values.reserve(3 * points.size());
  for (const Vec3& p : points) values.insert(values.end(), {p.x(), p.y(), p.z()});
  return raw(values);
}
std::string bytes_of(const std::vector<double>& values) {
  return raw(values);
}
std::string bytes_of(const std::vector<Frame>& frames) {
  std::vector<Vec3> vectors;
  vectors.reserve(3 * frames.size());
  for (const Frame& f : frames) vectors.insert(vectors.end(), {f.tangent, f.normal, f.binormal});
  return bytes_of(vectors);
}
std::string bytes_of(const std::vector<std::int32_t>& ids) {
  return raw(ids);
}

Vec3 vec_of(std::string_view bytes) {
  if (bytes.size() != 3 * sizeof(double)) damaged_blob("a point has not three coordinates");
  Vec3 v;
  std::memcpy(v.data(), bytes.data(), bytes.size());
  return v;
}
std::vector<Vec3> points_of(std::string_view bytes) {
  const std::vector<double> values = doubles_of(bytes);
  if (values.size() % 3 != 0) damaged_blob("a list of points is cut short");
  std::vector<Vec3> points;
  points.reserve(values.size() / 3);
  for (std::size_t i = 0; i < values.size(); i += 3)
    points.emplace_back(values[i], values[i + 1], values[i + 2]);
  return points;
}
std::vector<double> doubles_of(std::string_view bytes) {
  return values_of<double>(bytes);
}
std::vector<Frame> frames_of(std::string_view bytes) {
  const std::vector<Vec3> vectors = points_of(bytes);
  if (vectors.size() % 3 != 0) damaged_blob("a list of frames is cut short");
  std::vector<Frame> frames;
  frames.reserve(vectors.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); i += 3)
    frames.push_back({vectors[i], vectors[i + 1], vectors[i + 2]});
  return frames;
}
std::vector<std::int32_t> ids_of(std::string_view bytes) {
  return values_of<std::int32_t>(bytes);
}

std::shared_ptr<const geometry::AxisCurve> axis_of(const geometry::VesselTree& tree,
                                                   const geometry::Vessel& vessel) {
  return std::make_shared<const geometry::AxisCurve>(geometry::vessel_axis(tree, vessel));
}

std::string packed(const LumenModel& model) {
  std::string plain(blob_magic);
  BlobWriter out(plain);
  write_tree(out, model.tree);
  out.number(static_cast<std::uint64_t>(model.vessels.size()));
  for (const auto& lumen : model.vessels) write_lumen(out, *lumen);
  out.number(model.blend.width_mm);
  out.number(static_cast<std::int32_t>(model.blend.joints));
  out.number(model.next_sample_id);
  out.number(model.next_tree_id);
  uLongf length = compressBound(plain.size());
  std::string bytes(8 + length, '\0');
  const std::uint64_t size = plain.size();
  std::memcpy(bytes.data(), &size, 8);
  if (compress2(reinterpret_cast<Bytef*>(bytes.data() + 8), &length,
                reinterpret_cast<const Bytef*>(plain.data()), plain.size(), 6) != Z_OK)
    throw ResourceError("the starting model cannot be compressed: out of memory");
  bytes.resize(8 + length);
  return bytes;
}

LumenModel unpacked(std::string_view bytes) {
  const std::string plain = inflated(bytes);
  if (!plain.starts_with(blob_magic)) damaged_blob("the starting model is none");
  BlobReader in(std::string_view(plain).substr(blob_magic.size()));
  LumenModel model;
  model.tree = read_tree(in);
  if (const auto fault = geometry::find_fault(model.tree)) damaged_blob("of the starting model " + *fault);
  const std::size_t vessels = in.count(44);
  if (vessels != model.tree.vessels.size()) damaged_blob("the starting model's walls are not its tree's");
  for (std::size_t i = 0; i < vessels; ++i) {
    VesselLumen lumen = read_lumen(in);
    lumen.axis = axis_of(model.tree, model.tree.vessels[i]);
    model.vessels.push_back(std::make_shared<const VesselLumen>(std::move(lumen)));
  }
  model.blend.width_mm = in.number<double>();
  model.blend.joints = enum_of(in.number<std::int32_t>(), lumen::JointShape::smooth);
  model.next_sample_id = in.number<std::int64_t>();
  model.next_tree_id = in.number<std::int32_t>();
  if (!in.done()) damaged_blob("the starting model is longer than it says");
  if (const auto fault = lumen::find_fault(model)) damaged_blob("of the starting model " + *fault);
  return model;
}

void Checksum::mix(std::uint64_t word) {
  // The finaliser of SplitMix64: every bit of the word reaches every bit of the sum.
  std::uint64_t x = (state_ ^ word) + 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  state_ = x ^ (x >> 31);
}

Checksum& Checksum::add(std::string_view bytes) {
  mix(bytes.size());
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t size = std::min<std::size_t>(8, bytes.size());
    std::memcpy(&word, bytes.data(), size);
    mix(word);
    bytes.remove_prefix(size);
  }
  return *this;
}
Checksum& Checksum::add(std::int64_t value) {
  mix(static_cast<std::uint64_t>(value));
  return *this;
}
Checksum& Checksum::add(double value) {
  mix(std::bit_cast<std::uint64_t>(value));
  return *this;
}

}  // namespace ostia::session
