// Linked into programs and tests of the sanitizer build: what libraries of the system keep until the end.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:gdcm\n"           // its JPEG-LS codec, for a stream that it refuses
         "leak:libfontconfig\n"  // its caches
         "leak:argz_add_sep\n"   // the C library's setlocale
         "leak:libcairo\n";      // a recording surface that was written as PDF or SVG
}
