#pragma once
/// \file Models and their parts as bytes.

#include "ostia/lumen/lumen_model.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::session {

/// Little-endian IEEE doubles, x y z after each other. The readers throw InvalidInput where the size does not
/// fit.
std::string bytes_of(const geometry::Vec3& v);
std::string bytes_of(const std::vector<geometry::Vec3>& points);
std::string bytes_of(const std::vector<double>& values);
std::string bytes_of(const std::vector<geometry::Frame>& frames);
std::string bytes_of(const std::vector<std::int32_t>& ids);
geometry::Vec3 vec_of(std::string_view bytes);
std::vector<geometry::Vec3> points_of(std::string_view bytes);
std::vector<double> doubles_of(std::string_view bytes);
std::vector<geometry::Frame> frames_of(std::string_view bytes);
std::vector<std::int32_t> ids_of(std::string_view bytes);

/// A vessel's axis as its tree has it.
std::shared_ptr<const geometry::AxisCurve> axis_of(const geometry::VesselTree& tree,
                                                   const geometry::Vessel& vessel);

/// A whole model, compressed, and back to the last bit. `unpacked` throws InvalidInput for bytes that are not
/// a sound model.
std::string packed(const lumen::LumenModel& model);
lumen::LumenModel unpacked(std::string_view bytes);

/// A sum for the detection of damage (SplitMix64 over words); no protection against intent.
class Checksum {
 public:
  Checksum& add(std::string_view bytes);
  Checksum& add(const char* text) { return add(std::string_view(text)); }
  Checksum& add(const std::string& text) { return add(std::string_view(text)); }
  Checksum& add(std::int64_t value);
  Checksum& add(double value);
  Checksum& add(const geometry::Vec3& v) { return add(v.x()).add(v.y()).add(v.z()); }
  std::uint64_t value() const { return state_; }

 private:
  void mix(std::uint64_t word);
  std::uint64_t state_ = 0x9e3779b97f4a7c15ULL;
};

}  // namespace ostia::session
