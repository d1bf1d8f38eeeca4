// Parts out of a stream, in pieces of any size.

#include "multipart.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::pacs {
namespace {

struct Gathered : PartSink {
  std::vector<std::string> headers, bodies;
  std::size_t ended = 0, largest_piece = 0;
  void begin_part(std::string_view text) override {
    headers.emplace_back(text);
    bodies.emplace_back();
  }
  void body(std::string_view bytes) override {
    largest_piece = std::max(largest_piece, bytes.size());
    bodies.back() += bytes;
  }
  void end_part() override { ++ended; }
};

const std::vector<std::string> parts{"plain", "",      std::string("\r\n--other\r\n\0x--", 14),
                                     "\r\n",  "--b--", std::string(3000, '\r')};

std::string message(bool with_preamble) {
  std::string text = with_preamble ? "preamble\r\n" : "";
  for (const std::string& part : parts)
    text += (text.empty() ? "--boundary" : "\r\n--boundary") + std::string("\r\nContent-Type: a/b\r\n\r\n") +
            part;
  return text + "\r\n--boundary--\r\nepilogue";
}

TEST(Multipart, PartsAreTheSameInPiecesOfAnySize) {
  for (const bool preamble : {false, true})
    for (const std::size_t size : {1UL, 2UL, 3UL, 7UL, 64UL, 100000UL}) {
      Gathered gathered;
      MultipartParser parser("boundary", gathered);
      const std::string text = message(preamble);
      for (std::size_t at = 0; at < text.size(); at += size)
        parser.feed(std::string_view(text).substr(at, size));
      EXPECT_EQ(gathered.bodies, parts) << size;
      EXPECT_EQ(gathered.ended, parts.size());
      EXPECT_NE(gathered.headers[0].find("Content-Type: a/b"), std::string::npos);
      EXPECT_TRUE(parser.finished());
    }
}

TEST(Multipart, WhatIsCutShortIsNotFinished) {
  const std::string text = message(false);
  for (const std::size_t size : {0UL, 5UL, 40UL, text.size() / 2, text.rfind("--boundary--") + 11}) {
    Gathered gathered;
    MultipartParser parser("boundary", gathered);
    parser.feed(std::string_view(text).substr(0, size));
    EXPECT_FALSE(parser.finished()) << size;
  }
}

TEST(Multipart, HeadersWithoutEndAreRefused) {
  Gathered gathered;
  MultipartParser parser("b", gathered);
  parser.feed("--b\r\n");
  EXPECT_THROW(parser.feed(std::string(20000, 'x')), InvalidInput);
}

TEST(Multipart, TheBoundaryIsReadOffTheContentType) {
  EXPECT_EQ(boundary_of("multipart/related; type=\"application/dicom\"; boundary=abc"), "abc");
  EXPECT_EQ(boundary_of("Multipart/Related; Boundary=\"a b;c\"; type=x"), "a b;c");
  EXPECT_EQ(boundary_of("multipart/related; notboundary=x; boundary=y"), "y");
  EXPECT_EQ(boundary_of("application/json"), "");
  EXPECT_EQ(boundary_of("multipart/related"), "");
}

}  // namespace
}  // namespace ostia::pacs
