#include "text_writer.h"

#include "ostia/core/error.h"

namespace ostia::io {

TextWriter::TextWriter(const std::filesystem::path& path, const core::TaskContext& task)
    : file_(path), task_(task), out_(file_.temporary(), std::ios::binary | std::ios::trunc) {
  if (!out_) throw IoError("cannot write " + path.string());
}

void TextWriter::flush() {
  task_.throw_if_cancelled();
  out_.write(block_.data(), static_cast<std::streamsize>(block_.size()));
  block_.clear();
}

void TextWriter::commit() {
  flush();
  out_.close();
  if (!out_) throw ResourceError("cannot write the whole file: the disk is full or gone");
  file_.commit();
}

}  // namespace ostia::io
