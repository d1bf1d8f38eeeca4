#include "ostia/dicom/documents.h"

#include "tags.h"

#include "ostia/core/error.h"
#include "ostia/geometry/stl.h"

namespace ostia::dicom {
namespace {

constexpr const char* pdf_storage = "1.2.840.10008.5.1.4.1.1.104.1";
constexpr const char* stl_storage = "1.2.840.10008.5.1.4.1.1.104.3";
constexpr const char* capture_storage = "1.2.840.10008.5.1.4.1.1.7";
constexpr std::size_t most_document_bytes = 0xFFFFFFF0u;

void add_document(DicomDataset& d, const SourceSeries& source, std::string bytes, const std::string& title,
                  const char* mime) {
  d.set_text(0x0008002A, "DT", "");
  d.set_text(0x00280301, "CS", source.pseudonym ? "NO" : "YES");
  set_own_text(d, d, 0x00420010, "ST", title);
  d.set_text(0x00420012, "LO", mime);
  d.set_u32(0x00420015, {static_cast<std::uint32_t>(bytes.size())});
  d.set_bytes(0x00420011, "OB", std::move(bytes));
  add_source_instances(source, d, 0x00420013);
}

void require_document(const std::string& bytes, const char* what) {
  if (bytes.size() > most_document_bytes)
    throw InvalidInput(std::string("DICOM: the ") + what + " has 4 GiB or more and fits no object");
}

}  // namespace

DicomDataset encapsulated_pdf(const SourceSeries& source, std::string pdf, const std::string& title,
                              const ObjectOptions& options) {
  if (!pdf.starts_with("%PDF-")) throw InvalidInput("DICOM: the document is no PDF");
  require_document(pdf, "PDF");
  DicomDataset d = object_head(source, pdf_storage, "DOC", "report", options);
  d.set_text(0x00080064, "CS", "WSD");
  set_code(d, 0x0040A043, {"18748-4", "LN", "Diagnostic imaging report"});
  add_document(d, source, std::move(pdf), title, "application/pdf");
  seal(d);
  return d;
}

DicomDataset encapsulated_stl(const SourceSeries& source, const geometry::TriMesh& surface,
                              const std::string& title, const ObjectOptions& options) {
  if (surface.triangles.empty()) throw InvalidInput("DICOM: the surface has no triangles");
  std::string bytes = geometry::binary_stl(surface);
  require_document(bytes, "surface");
  DicomDataset d = object_head(source, stl_storage, "M3D", "surface", options);
  d.set_text(tag::frame_of_reference, "UI", source.frame_of_reference);
  d.set_text(0x00201040, "LO", "");
  set_code(d, 0x004008EA, codes::millimetre);
  set_code(d, 0x0040A043, {"85040-4", "LN", "3D body structure"});
  d.set_text(0x00687001, "CS", "NO");  // model modification
  d.set_text(0x00687002, "CS", "NO");  // model mirroring
  set_code(d, 0x00687003, {"129013", "DCM", "Planning Intent"});
  add_document(d, source, std::move(bytes), title, "model/stl");
  add_referenced_series(source, d);
  d.set_text(0x00280301, "CS", "NO");
  seal(d);
  return d;
}

DicomDataset secondary_capture(const SourceSeries& source, const CapturedPicture& picture,
                               const ObjectOptions& options) {
  if (picture.width < 1 || picture.height < 1 || picture.width > 65535 || picture.height > 65535 ||
      picture.rgb.size() !=
          3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height))
    throw InvalidInput("DICOM: the picture is empty, too large or does not fill its size");
  DicomDataset d = object_head(source, capture_storage, "OT", "key images", options);
  d.set_text(0x00080008, "CS", "DERIVED\\SECONDARY");
  d.set_text(0x00080064, "CS", "WSD");
  add_source_instances(source, d, 0x00082112);
  set_own_text(d, d, 0x00204000, "LT", picture.caption);
  d.set_text(0x00180015, "CS", "HEART");
  d.set_text(0x00200020, "CS", "");  // a picture lies no way in the patient
  d.set_u16(0x00280002, {3});
  d.set_text(0x00280004, "CS", "RGB");
  d.set_u16(0x00280006, {0});
  d.set_u16(tag::rows, {static_cast<std::uint16_t>(picture.height)});
  d.set_u16(tag::columns, {static_cast<std::uint16_t>(picture.width)});
  d.set_u16(tag::bits_allocated, {8});
  d.set_u16(0x00280101, {8});
  d.set_u16(0x00280102, {7});
  d.set_u16(0x00280103, {0});
  d.set_text(0x00280301, "CS", "NO");
  d.set_bytes(tag::pixel_data, "OB", std::string(picture.rgb.begin(), picture.rgb.end()));
  seal(d);
  return d;
}

}  // namespace ostia::dicom
