#include "image_source.h"
#include "nifti_header.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/imaging/image_file.h"

#include <zlib.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>

static_assert(std::endian::native == std::endian::little,
              "the writers store this machine's bytes and call them little");

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

/// The formats' names for the three types that are written.
template <class T>
constexpr const char* nrrd_type = "";
template <>
constexpr const char* nrrd_type<std::int16_t> = "short";
template <>
constexpr const char* nrrd_type<std::uint8_t> = "unsigned char";
template <>
constexpr const char* nrrd_type<float> = "float";
template <class T>
constexpr const char* meta_type = "";
template <>
constexpr const char* meta_type<std::int16_t> = "MET_SHORT";
template <>
constexpr const char* meta_type<std::uint8_t> = "MET_UCHAR";
template <>
constexpr const char* meta_type<float> = "MET_FLOAT";

template <class T>
constexpr NiftiType nifti_type{};
template <>
constexpr NiftiType nifti_type<std::int16_t>{4, 16};
template <>
constexpr NiftiType nifti_type<float>{16, 32};

std::string vector_text(const Vec3& v, const char* between) {
  return core::shortest_text(v[0]) + between + core::shortest_text(v[1]) + between +
         core::shortest_text(v[2]);
}

template <class T>
std::string_view bytes_of_voxels(const Volume<T>& image) {
  return {reinterpret_cast<const char*>(image.voxels.data()), image.voxels.size() * sizeof(T)};
}

template <class T>
std::string nrrd_header(const Volume<T>& image) {
  const Geometry& g = image.geometry;
  std::string text = "NRRD0004\ntype: " + std::string(nrrd_type<T>) +
                     "\ndimension: 3\nspace: left-posterior-superior\nsizes:";
  for (const std::int64_t n : g.size) text += " " + std::to_string(n);
  text += "\nspace directions:";
  for (int axis = 0; axis < 3; ++axis)
    text += " (" + vector_text(g.direction.col(axis) * g.spacing[axis], ",") + ")";
  text +=
      "\nkinds: domain domain domain\nendian: little\nencoding: gzip\nspace units: \"mm\" \"mm\" "
      "\"mm\"\nspace origin: (" +
      vector_text(g.origin, ",") + ")\n\n";
  return text;
}

/// MetaImage's letters: the side of the patient at which each axis begins.
std::string anatomical_orientation(const Mat3& direction) {
  std::string letters;
  for (int axis = 0; axis < 3; ++axis) {
    int main = 0;
    direction.col(axis).cwiseAbs().maxCoeff(&main);
    letters += direction(main, axis) > 0.0 ? "RAI"[main] : "LPS"[main];
  }
  return letters;
}

template <class T>
std::string meta_header(const Volume<T>& image, const std::string& data_file) {
  const Geometry& g = image.geometry;
  std::string text =
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = "
      "False\nDistanceUnits = mm\n"
      "TransformMatrix = ";
  text += vector_text(g.direction.col(0), " ") + " " + vector_text(g.direction.col(1), " ") + " " +
          vector_text(g.direction.col(2), " ");
  text += "\nOffset = " + vector_text(g.origin, " ") +
          "\nCenterOfRotation = 0 0 0\nAnatomicalOrientation = " + anatomical_orientation(g.direction) +
          "\nElementSpacing = " + vector_text(g.spacing, " ") + "\nDimSize =";
  for (const std::int64_t n : g.size) text += " " + std::to_string(n);
  return text + "\nElementType = " + meta_type<T> + "\nElementDataFile = " + data_file + "\n";
}

/// One gzip member, its blocks packed in parallel; the same bytes for any number of threads.
std::string gzipped(std::string_view bytes) {
  constexpr std::size_t block = std::size_t{1} << 20;
  const std::size_t blocks = std::max<std::size_t>(1, (bytes.size() + block - 1) / block);
  std::vector<std::string> packed(blocks);
  std::vector<uLong> sums(blocks);
  core::parallel_for(blocks, 1, [&](std::size_t b) {
    const std::string_view part = bytes.substr(b * block, block);
    z_stream z{};
    if (deflateInit2(&z, 4, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY) != Z_OK)
      throw ResourceError("zlib: out of memory");
    packed[b].resize(deflateBound(&z, static_cast<uLong>(part.size())) + 16);
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(part.data()));
    z.avail_in = static_cast<uInt>(part.size());
    z.next_out = reinterpret_cast<Bytef*>(packed[b].data());
    z.avail_out = static_cast<uInt>(packed[b].size());
    deflate(&z, b + 1 == blocks ? Z_FINISH : Z_FULL_FLUSH);
    packed[b].resize(packed[b].size() - z.avail_out);
    deflateEnd(&z);
    sums[b] = crc32(crc32(0, nullptr, 0), reinterpret_cast<const Bytef*>(part.data()),
                    static_cast<uInt>(part.size()));
  });
  std::string result("\x1f\x8b\x08\0\0\0\0\0\0\xff", 10);
  uLong sum = crc32(0, nullptr, 0);
  for (std::size_t b = 0; b < blocks; ++b) {
    result += packed[b];
    packed[b] = {};
    sum = crc32_combine(sum, sums[b], static_cast<z_off_t>(std::min(block, bytes.size() - b * block)));
  }
  for (const std::uint64_t number :
       {static_cast<std::uint64_t>(sum), static_cast<std::uint64_t>(bytes.size())})
    for (int i = 0; i < 4; ++i) result += static_cast<char>((number >> (8 * i)) & 0xff);
  return result;
}

/// Fills a staged file's temporary.
void fill(const core::StagedFile& staged, const fs::path& target, std::string_view head,
          std::string_view body) {
  errno = 0;
  std::ofstream out(staged.temporary(), std::ios::binary | std::ios::trunc);
  out.write(head.data(), static_cast<std::streamsize>(head.size()));
  out.write(body.data(), static_cast<std::streamsize>(body.size()));
  out.close();
  if (out) return;
  const std::string what = target.string() + ": writing failed (" + std::strerror(errno) + ")";
  if (errno == ENOSPC || errno == EDQUOT || errno == EFBIG)
    throw ResourceError(what + "; free some space and save again");
  throw IoError(what);
}

/// The data file that an older header of ours names, if it is one that we write (NAME.raw or NAME-N.raw).
std::string older_data_file(const fs::path& header) {
  try {
    const fs::path named = read_source(header).data_path.filename();
    const std::string stem = header.stem().string(), other = named.stem().string();
    if (named.extension() == ".raw" && other.rfind(stem, 0) == 0) {
      const std::string rest = other.substr(stem.size());
      if (rest.empty() || (rest.size() > 1 && rest[0] == '-' && to_integer(std::string_view(rest).substr(1))))
        return named.string();
    }
  } catch (const Error&) {
    // No image that could be read: nothing of ours to clear away.
  }
  return {};
}

/// Two files cannot be renamed at once. So the voxels go under a name that no header mentions yet; the
/// header's rename is the moment at which the new image replaces the old.
template <class T>
void write_pair(const fs::path& path, const Volume<T>& image) {
  fs::path data = path;
  data.replace_extension(".raw");
  for (int n = 2; fs::exists(fs::symlink_status(data)); ++n)
    data.replace_filename(path.stem().string() + "-" + std::to_string(n) + ".raw");
  const std::string older = fs::exists(path) ? older_data_file(path) : std::string();
  core::StagedFile voxels(data), header(path);
  fill(voxels, data, bytes_of_voxels(image), {});
  fill(header, path, meta_header(image, data.filename().string()), {});
  voxels.commit();
  std::error_code ignored;
  try {
    header.commit();
  } catch (...) {
    fs::remove(data, ignored);
    throw;
  }
  if (!older.empty()) fs::remove(path.parent_path() / older, ignored);
}

template <class T>
void check(const fs::path& path, const Volume<T>& image) {
  const Geometry& g = image.geometry;
  check_sizes(path, "size", g.size);
  if (static_cast<std::size_t>(g.voxels()) != image.voxels.size())
    refuse(path, "voxels", "their number does not fit the size");
  for (int axis = 0; axis < 3; ++axis) check_spacing(path, "spacing", g.spacing[axis]);
  if (!g.origin.allFinite() || !g.direction.allFinite()) refuse(path, "origin or direction", "not finite");
}

template <class T>
void write_nifti(const fs::path& path, const Volume<T>& image, bool packed) {
  for (const std::int64_t n : image.geometry.size)
    if (n > most_nifti_voxels)
      refuse(path, "size",
             std::to_string(n) + " voxels along an axis; NIfTI-1 counts to " +
                 std::to_string(most_nifti_voxels) + ", write .nrrd instead");
  const std::string head = nifti_header(image.geometry, nifti_type<T>);
  core::StagedFile staged(path);
  if (packed) {
    fill(staged, path, gzipped(head + std::string(bytes_of_voxels(image))), {});
  } else {
    fill(staged, path, head, bytes_of_voxels(image));
  }
  staged.commit();
}

template <class T>
void write(const fs::path& path, const Volume<T>& image) {
  check(path, image);
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".mhd") return write_pair(path, image);
  const bool packed = extension == ".gz" && lower_case(path.stem().extension().string()) == ".nii";
  if (packed || extension == ".nii") return write_nifti(path, image, packed);
  if (extension != ".nrrd" && extension != ".mha")
    refuse(path, "extension", "'" + extension + "' is not written; .nrrd, .mhd, .mha, .nii and .nii.gz are");
  core::StagedFile staged(path);
  if (extension == ".nrrd")
    fill(staged, path, nrrd_header(image), gzipped(bytes_of_voxels(image)));
  else
    fill(staged, path, meta_header(image, "LOCAL"), bytes_of_voxels(image));
  staged.commit();
}

}  // namespace

void write_image(const fs::path& path, const ImageVolume& image) {
  write(path, image);
}
void write_image(const fs::path& path, const MaskVolume& image) {
  write(path, image);
}
void write_image(const fs::path& path, const FloatVolume& image) {
  write(path, image);
}

}  // namespace ostia::imaging
