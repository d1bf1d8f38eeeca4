#pragma once
// multipart/related as it comes over the network (RFC 2046), part by part and never whole.

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace ostia::pacs {

/// Who gets the parts.
class PartSink {
 public:
  virtual ~PartSink() = default;
  virtual void begin_part(std::string_view headers) = 0;
  virtual void body(std::string_view bytes) = 0;  ///< some of the part's
  virtual void end_part() = 0;
};

/// Keeps no more than a boundary's length of a body, and 16 KiB of a part's headers; bodies are handed on
/// from where they lie.
class MultipartParser {
 public:
  MultipartParser(const std::string& boundary, PartSink& sink);
  MultipartParser(const MultipartParser&) = delete;
  MultipartParser& operator=(const MultipartParser&) = delete;
  /// Throws InvalidInput for headers without end.
  void feed(std::string_view bytes);
  /// The closing boundary has come: nothing is missing.
  bool finished() const { return state_ == State::finished; }

 private:
  enum class State { preamble, delimiter, headers, body, finished };
  using Searcher = std::boyer_moore_horspool_searcher<std::string::const_iterator>;
  /// Takes what can be taken off `rest`.
  void consume(std::string_view& rest);
  bool pass_body(std::string_view& rest);
  bool pass_delimiter(std::string_view& rest);
  bool pass_headers(std::string_view& rest);
  const std::string delimiter_;
  const Searcher searcher_;
  PartSink& sink_;
  State state_ = State::preamble;
  std::string held_ = "\r\n";  // the first boundary may stand at the very beginning
};

/// Of `multipart/related; type="application/dicom"; boundary=X`; empty where it is none.
std::string boundary_of(std::string_view content_type);

}  // namespace ostia::pacs
