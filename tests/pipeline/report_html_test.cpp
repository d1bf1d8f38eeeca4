#include "builtin_model.h"
#include "shared_data.h"

#include "ostia/core/files.h"
#include "ostia/pipeline/report.h"

#include <gtest/gtest.h>

namespace ostia::pipeline {
namespace {

TEST(ReportHtml, ShowsPicturesAndFigures) {
  const auto path = testing::temporary_folder("report") / "report.html";
  write_report_html(path, builtin_model(), report_pictures(builtin_model()),
                    compare_with_truth(builtin_case(), builtin_model()));
  const std::string html = core::read_file(path);
  std::size_t pictures = 0;
  for (std::size_t at = html.find("data:image/png;base64,"); at != std::string::npos;
       at = html.find("data:image/png;base64,", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 4u);
  for (const char* text : {"Against the truth", "The lumen in the image", "The mesh, cut open",
                           "Diameter along each vessel", "inlet_", "outlet_"}) {
    EXPECT_NE(html.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(html.find("<script"), std::string::npos);
}

}  // namespace
}  // namespace ostia::pipeline
