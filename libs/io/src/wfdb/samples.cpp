// Formats as signal(5) of the WFDB Applications Guide has them.

#include "wfdb/samples.h"

#include <cstddef>

namespace ostia::io {
namespace {

class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
  std::size_t size() const { return bytes_.size(); }
  std::uint32_t operator[](std::size_t i) const { return static_cast<unsigned char>(bytes_[i]); }
  /// `count` bytes from `i` on, the least significant first.
  std::uint32_t little(std::size_t i, int count) const {
    std::uint32_t value = 0;
    for (int k = count - 1; k >= 0; --k) value = value << 8 | (*this)[i + static_cast<std::size_t>(k)];
    return value;
  }

 private:
  std::string_view bytes_;
};

/// The two's complement number in the lowest bits.
std::int32_t signed_of(std::uint32_t value, int bits) {
  const std::uint32_t sign = 1U << (bits - 1);
  const std::uint32_t low = bits == 32 ? value : value & ((1U << bits) - 1);
  if (low == sign) return missing_sample;
  return static_cast<std::int32_t>((low ^ sign) - sign);
}

/// A binary number whose zero is in the middle of its range.
std::int32_t offset_of(std::uint32_t value, int bits) {
  return value == 0 ? missing_sample : static_cast<std::int32_t>(value) - (1 << (bits - 1));
}

void unpack_212(const Bytes& bytes, std::vector<std::int32_t>& samples) {
  std::size_t i = 0;
  for (; i + 3 <= bytes.size(); i += 3) {
    samples.push_back(signed_of((bytes[i + 1] & 0x0F) << 8 | bytes[i], 12));
    samples.push_back(signed_of((bytes[i + 1] & 0xF0) << 4 | bytes[i + 2], 12));
  }
  if (i + 2 <= bytes.size())  // an odd number of samples
    samples.push_back(signed_of((bytes[i + 1] & 0x0F) << 8 | bytes[i], 12));
}

/// Three samples of 10 bits in four bytes.
void unpack_310(const Bytes& bytes, std::vector<std::int32_t>& samples) {
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
    const std::uint32_t a = bytes.little(i, 2), b = bytes.little(i + 2, 2);
    samples.push_back(signed_of(a >> 1, 10));
    samples.push_back(signed_of(b >> 1, 10));
    samples.push_back(signed_of(a >> 11 | (b >> 11) << 5, 10));
  }
}

void unpack_311(const Bytes& bytes, std::vector<std::int32_t>& samples) {
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
    const std::uint32_t all = bytes.little(i, 4);
    for (int k = 0; k < 3; ++k) samples.push_back(signed_of(all >> (10 * k), 10));
  }
}

/// Samples of whole bytes.
template <class Sample>
void unpack_whole(const Bytes& bytes, std::size_t width, std::vector<std::int32_t>& samples,
                  const Sample& sample) {
  samples.reserve(bytes.size() / width);
  for (std::size_t i = 0; i + width <= bytes.size(); i += width) samples.push_back(sample(i));
}

}  // namespace

std::optional<std::vector<std::int32_t>> unpacked_samples(int format, std::string_view text) {
  const Bytes bytes(text);
  std::vector<std::int32_t> samples;
  switch (format) {
    case 16:
      unpack_whole(bytes, 2, samples, [&](std::size_t i) { return signed_of(bytes.little(i, 2), 16); });
      break;
    case 24:
      unpack_whole(bytes, 3, samples, [&](std::size_t i) { return signed_of(bytes.little(i, 3), 24); });
      break;
    case 32:
      unpack_whole(bytes, 4, samples, [&](std::size_t i) { return signed_of(bytes.little(i, 4), 32); });
      break;
    case 61:
      unpack_whole(bytes, 2, samples,
                   [&](std::size_t i) { return signed_of(bytes[i] << 8 | bytes[i + 1], 16); });
      break;
    case 80:
      unpack_whole(bytes, 1, samples, [&](std::size_t i) { return offset_of(bytes[i], 8); });
      break;
    case 160:
      unpack_whole(bytes, 2, samples, [&](std::size_t i) { return offset_of(bytes.little(i, 2), 16); });
      break;
    case 212:
      unpack_212(bytes, samples);
      break;
    case 310:
      unpack_310(bytes, samples);
      break;
    case 311:
      unpack_311(bytes, samples);
      break;
    default:
      return std::nullopt;
  }
  return samples;
}

}  // namespace ostia::io
