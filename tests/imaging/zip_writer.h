#pragma once
/// \file Zip archives made byte by byte for tests, good ones and bad ones.

#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::testing {

struct ZipMember {
  std::string name, content;
  bool deflated = false;
  std::uint32_t mode = 0;           ///< Unix mode; 0: written by DOS
  std::uint16_t flags = 0;          ///< bit 0: encrypted
  std::int64_t declared_size = -1;  ///< instead of the true one
  std::int64_t declared_crc = -1;
  int method = -1;  ///< declared, instead of stored (0) or deflated (8)
};

inline std::string little(std::uint64_t value, int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xFF));
  return bytes;
}

inline std::string deflated(const std::string& content) {
  z_stream z{};
  deflateInit2(&z, 9, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&z, static_cast<uLong>(content.size())), '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  z.avail_in = static_cast<uInt>(content.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  deflate(&z, Z_FINISH);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

/// APPNOTE.TXT 4.3: local headers with data, central directory, end record.
inline std::string zip_bytes(const std::vector<ZipMember>& members) {
  std::string out, directory;
  for (const ZipMember& m : members) {
    const std::string packed = m.deflated ? deflated(m.content) : m.content;
    const auto crc = m.declared_crc >= 0 ? static_cast<std::uint64_t>(m.declared_crc)
                                         : crc32(0, reinterpret_cast<const Bytef*>(m.content.data()),
                                                 static_cast<uInt>(m.content.size()));
    const auto size = m.declared_size >= 0 ? static_cast<std::uint64_t>(m.declared_size) : m.content.size();
    const auto method = static_cast<std::uint64_t>(m.method >= 0 ? m.method : m.deflated ? 8 : 0);
    const std::string common = little(m.flags, 2) + little(method, 2) + little(0, 2) + little(0x21, 2) +
                               little(crc, 4) + little(packed.size(), 4) + little(size, 4) +
                               little(m.name.size(), 2);
    const std::size_t offset = out.size();
    out += std::string("PK\x03\x04") + little(20, 2) + common + little(0, 2) + m.name + packed;
    directory += std::string("PK\x01\x02") + little(20 | (m.mode != 0 ? 3U << 8 : 0U), 2) + little(20, 2) +
                 common + little(0, 2) + little(0, 2) + little(0, 2) + little(0, 2) +
                 little(static_cast<std::uint64_t>(m.mode) << 16, 4) + little(offset, 4) + m.name;
  }
  const std::size_t at = out.size();
  return out + directory + "PK\x05\x06" + little(0, 4) + little(members.size(), 2) +
         little(members.size(), 2) + little(directory.size(), 4) + little(at, 4) + little(0, 2);
}

}  // namespace ostia::testing
