#include "dicom_source.h"

#include "shared_data.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <fstream>

namespace ostia::imaging {
namespace {

std::string pattern(std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * 31 + i / 251);
  return bytes;
}

std::string deflated(const std::string& bytes) {
  z_stream z{};
  EXPECT_EQ(deflateInit2(&z, 6, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string out(bytes.size() + 1024, '\0');
  std::string in = bytes;
  z.next_in = reinterpret_cast<Bytef*>(in.data());
  z.avail_in = static_cast<uInt>(in.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&z, Z_FINISH), Z_STREAM_END);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

TEST(DicomSource, FileAndMemoryGiveTheSameBytesAcrossWindows) {
  const std::string bytes = pattern(300'000);
  const auto path = ostia::testing::temporary_folder("source") / "bytes";
  std::ofstream(path, std::ios::binary) << bytes;
  DicomSource file = DicomSource::file(path), memory = DicomSource::memory(bytes);
  for (const std::size_t offset : {0u, 1u, 65'533u, 65'536u, 200'000u, 299'990u, 5u}) {
    for (const std::size_t count : {1u, 8u, 10u}) {
      EXPECT_EQ(file.bytes(offset, count), bytes.substr(offset, count)) << offset;
      EXPECT_EQ(memory.bytes(offset, count), bytes.substr(offset, count)) << offset;
    }
  }
  EXPECT_EQ(file.bytes(10, 250'000), bytes.substr(10, 250'000));
}

TEST(DicomSource, ReadsNothingBeyondTheEnd) {
  DicomSource source = DicomSource::memory("abcd");
  char buffer[8];
  EXPECT_TRUE(source.read(4, buffer, 0));
  EXPECT_FALSE(source.read(1, buffer, 4));
  EXPECT_FALSE(source.read(5, buffer, 0));
  EXPECT_FALSE(source.read(~0ULL, buffer, 2));
  EXPECT_TRUE(source.bytes(2, ~std::size_t{0}).empty());
}

TEST(DicomSource, RefusesWhatIsNoRegularFile) {
  const auto folder = ostia::testing::temporary_folder("source");
  EXPECT_THROW(DicomSource::file(folder / "absent"), IoError);
  EXPECT_THROW(DicomSource::file(folder), IoError);
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(DicomSource::file(folder / "pipe"), IoError);
  EXPECT_THROW(DicomSource::file("/dev/zero"), IoError);
}

TEST(DicomSource, InflatesWithinBounds) {
  const std::string bytes = pattern(500'000), packed = deflated(bytes);
  DicomSource source = DicomSource::memory("head" + packed);
  EXPECT_EQ(inflated(source, 4, 1'000'000), bytes);
  EXPECT_THROW(inflated(source, 4, 400'000), InvalidInput);
  DicomSource cut = DicomSource::memory(packed.substr(0, packed.size() / 2));
  EXPECT_THROW(inflated(cut, 0, 1'000'000), InvalidInput);
  DicomSource noise = DicomSource::memory(std::string(100, '\xFF'));
  EXPECT_THROW(inflated(noise, 0, 1'000'000), InvalidInput);
}

}  // namespace
}  // namespace ostia::imaging
