// Runs in the worker: ITK's readers of images.

#include "foreign_check.h"
#include "foreign_source.h"
#include "image_data.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/imaging/foreign_image.h"

#include <itkGiplImageIO.h>
#include <itkHDF5ImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkTIFFImageIO.h>
#include <itkVTKImageIO.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <limits>
#include <new>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

using Reader = itk::ImageIOBase;

Reader::Pointer reader_of(const std::string& format) {
  if (format == "GIPL") return Reader::Pointer(itk::GiplImageIO::New());
  if (format == "TIFF") return Reader::Pointer(itk::TIFFImageIO::New());
  if (format == "VTK image") return Reader::Pointer(itk::VTKImageIO::New());
  if (format == "Analyze") return Reader::Pointer(itk::NiftiImageIO::New());
  if (format == "HDF5 image") return Reader::Pointer(itk::HDF5ImageIO::New());
  throw InvalidInput("no format that is read here");
}

const char* nrrd_type(const Reader& reader) {
  switch (reader.GetComponentType()) {
    case Reader::IOComponentEnum::UCHAR:
      return "uint8";
    case Reader::IOComponentEnum::CHAR:
      return "int8";
    case Reader::IOComponentEnum::USHORT:
      return "uint16";
    case Reader::IOComponentEnum::SHORT:
      return "int16";
    case Reader::IOComponentEnum::UINT:
      return "uint32";
    case Reader::IOComponentEnum::INT:
      return "int32";
    case Reader::IOComponentEnum::ULONG:
    case Reader::IOComponentEnum::ULONGLONG:
      return "uint64";
    case Reader::IOComponentEnum::LONG:
    case Reader::IOComponentEnum::LONGLONG:
      return "int64";
    case Reader::IOComponentEnum::FLOAT:
      return "float";
    case Reader::IOComponentEnum::DOUBLE:
      return "double";
    default:
      throw InvalidInput("its voxels are of a type that is not known");
  }
}

/// Sizes along three axes; what a file has beyond them must be one voxel.
std::array<std::int64_t, 3> size_of(const Reader& reader) {
  std::array<std::int64_t, 3> size{1, 1, 1};
  std::int64_t voxels = 1;
  for (unsigned a = 0; a < reader.GetNumberOfDimensions(); ++a) {
    const itk::SizeValueType n = reader.GetDimensions(a);
    if (n == 0 || n > static_cast<itk::SizeValueType>(max_voxels))
      throw InvalidInput("its size along axis " + std::to_string(a + 1) + " is " + std::to_string(n) +
                         " voxels");
    if (a > 2 && n > 1)
      throw InvalidInput("it has " + std::to_string(a + 1) + " dimensions; one image of three is read");
    if (a < 3) size[a] = static_cast<std::int64_t>(n);
    if (__builtin_mul_overflow(voxels, static_cast<std::int64_t>(n), &voxels) || voxels > max_voxels)
      throw InvalidInput("it has more than " + std::to_string(max_voxels) + " voxels");
  }
  return size;
}

/// (x,y,z) of an axis' step or of the origin, 0 where the file has fewer axes.
std::string triple(const std::array<double, 3>& v) {
  return "(" + core::shortest_text(v[0]) + "," + core::shortest_text(v[1]) + "," + core::shortest_text(v[2]) +
         ")";
}

std::string nrrd_header(const Reader& reader, const std::array<std::int64_t, 3>& size) {
  const unsigned axes = std::min(reader.GetNumberOfDimensions(), 3U);
  std::string sizes, steps;
  std::array<double, 3> origin{0.0, 0.0, 0.0};
  for (unsigned a = 0; a < 3; ++a) {
    std::array<double, 3> step{0.0, 0.0, 0.0};
    step[a] = 1.0;
    if (a < axes) {
      const std::vector<double> along = reader.GetDirection(a);
      for (unsigned b = 0; b < 3; ++b) step[b] = b < along.size() ? along[b] * reader.GetSpacing(a) : 0.0;
      origin[a] = reader.GetOrigin(a);
    }
    sizes += " " + std::to_string(size[a]);
    steps += " " + triple(step);
  }
  return std::string("NRRD0004\ntype: ") + nrrd_type(reader) +
         "\ndimension: 3\nspace: left-posterior-superior\nsizes:" + sizes + "\nspace directions:" + steps +
         "\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: " + triple(origin) +
         "\n\n";
}

void read_and_write(const fs::path& in, const fs::path& out) {
  const std::string format = foreign_image_format(in);
  Reader::Pointer reader = reader_of(format);
  if (!reader->CanReadFile(in.c_str())) throw InvalidInput("its header is damaged or of another kind");
  reader->SetFileName(in.string());
  reader->ReadImageInformation();
  if (reader->GetNumberOfComponents() != 1)
    throw InvalidInput("it has " + std::to_string(reader->GetNumberOfComponents()) +
                       " values a voxel, such as colours; an image of one is read");
  const std::array<std::int64_t, 3> size = size_of(*reader);
  const std::string header = nrrd_header(*reader, size);
  const auto count = static_cast<std::size_t>(size[0] * size[1] * size[2]);
  const std::size_t bytes = count * reader->GetComponentSize();
  require_complete(in, format, count, bytes);
  itk::ImageIORegion all(reader->GetNumberOfDimensions());
  for (unsigned a = 0; a < reader->GetNumberOfDimensions(); ++a) {
    all.SetIndex(a, 0);
    all.SetSize(a, reader->GetDimensions(a));
  }
  reader->SetIORegion(all);
  std::vector<char> voxels(bytes);
  reader->Read(voxels.data());
  std::ofstream file(out, std::ios::binary);
  file << header;
  file.write(voxels.data(), static_cast<std::streamsize>(bytes));
  file.close();
  if (!file) throw ResourceError("no room for its voxels on the disk");
}

}  // namespace

int read_foreign_image_in_worker(const fs::path& in, const fs::path& out) {
  const auto failed = [](const std::string& message, ExitCode code) {
    std::fprintf(stderr, "%s\n", message.c_str());
    return static_cast<int>(code);
  };
  try {
    itk::Object::GlobalWarningDisplayOff();
    read_and_write(in, out);
    return 0;
  } catch (const Error& error) {
    return failed(error.what(), error.exit_code());
  } catch (const std::bad_alloc&) {
    return failed("out of memory", ExitCode::resources);
  } catch (const itk::MemoryAllocationError&) {
    return failed("out of memory", ExitCode::resources);
  } catch (const itk::ExceptionObject& error) {
    std::string text = error.GetDescription();  // one line
    std::replace(text.begin(), text.end(), '\n', ' ');
    return failed("ITK says: " + text, ExitCode::bad_input);
  } catch (const std::exception& error) {
    return failed(error.what(), ExitCode::bad_input);
  }
}

}  // namespace ostia::imaging
