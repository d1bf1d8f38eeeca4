#include "completion.h"
#include "description_files.h"
#include "man_page.h"

#include "ostia/core/version.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::command_line {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A program with a command below a command, made as the real ones are.
struct Program {
  Program() {
    app.set_help_flag("-h,--help", "Print this help message and exit");
    app.add_option("--log", log, "Format of the log")->check(CLI::IsMember({"text", "json"}));
    app.add_option("--threads", threads, "Threads to use")->check(CLI::Range(0, 1024));
    app.add_option("--config", "A file of options");
    app.add_option("--secret", log, "Of no use to people")->group("");
    CLI::App* measure = app.add_subcommand("measure", "What a thing's [size] is: its \\ and 'more'");
    CLI::App* length = measure->add_subcommand("length", "How long it is");
    length->add_option("INPUT", input, "The thing")->required();
    length->add_option("-o,--output", output, "Folder that is made")->required();
    length->add_flag("--json", json, "As JSON");
    length->footer("Example:\n  thing measure length a.stl -o out");
  }
  CLI::App app{"Measures things.", "thing"};
  std::string log = "text", input, output;
  int threads = 0;
  bool json = false;
};

TEST(Description, HasCommandsAndOptions) {
  const CommandDescription program = describe(Program().app);
  EXPECT_EQ(program.text, "Measures things");
  ASSERT_EQ(program.options.size(), 4u);  // help, log, threads, config, not what is hidden
  EXPECT_THAT(program.options[1].choices, ElementsAre("text", "json"));
  EXPECT_FALSE(program.options[1].takes_path());
  EXPECT_EQ(program.options[2].limits, "in [0 - 1024]");
  EXPECT_TRUE(program.options[3].takes_path());
  ASSERT_EQ(program.commands.size(), 1u);
  const CommandDescription& length = program.commands.front().commands.front();
  EXPECT_EQ(length.joined("-"), "thing-measure-length");
  EXPECT_EQ(length.examples, "thing measure length a.stl -o out\n");
  ASSERT_EQ(length.options.size(), 4u);
  EXPECT_TRUE(length.options[1].positional());
  EXPECT_THAT(length.options[2].names, ElementsAre("-o", "--output"));
  EXPECT_TRUE(length.options[2].takes_path());
  EXPECT_THAT(length.options[3].value, IsEmpty());
}

TEST(Description, BecomesAManualPage) {
  const CommandDescription program = describe(Program().app);
  const CommandDescription& measure = program.commands.front();
  const std::string page = man_page(measure.commands.front(), program);
  EXPECT_THAT(page, HasSubstr(".TH THING\\-MEASURE\\-LENGTH 1 \"\" \"Ostia " + core::version() + "\""));
  EXPECT_THAT(page, HasSubstr("thing\\-measure\\-length \\- How long it is\n"));
  EXPECT_THAT(page, HasSubstr("\\fBthing measure length\\fR \\fIINPUT\\fR \\fB\\-o\\fR \\fITEXT\\fR"));
  EXPECT_THAT(
      page, HasSubstr("\\fB\\-o\\fR, \\fB\\-\\-output\\fR \\fITEXT\\fR\nFolder that is made.\nRequired.\n"));
  EXPECT_THAT(page, HasSubstr(".SH EXAMPLES\n.nf\nthing measure length a.stl \\-o out\n.fi\n"));
  EXPECT_THAT(man_page(measure, program), HasSubstr("its \\e and 'more'"));
  EXPECT_THAT(man_page(measure, program), HasSubstr("See \\fBthing\\-measure\\-length\\fR(1)."));
  EXPECT_THAT(man_page(program, program), HasSubstr("One of text, json."));
  EXPECT_THAT(man_page(program, program), Not(HasSubstr("secret")));
}

TEST(Description, BecomesACompletionForBash) {
  const std::string script = bash_completion(describe(Program().app));
  EXPECT_THAT(script, HasSubstr("'thing measure length') command='thing measure length' ;;"));
  EXPECT_THAT(script, HasSubstr("*' --log') COMPREPLY=($(compgen -W 'text json' -- \"$now\")); return ;;"));
  EXPECT_THAT(script, HasSubstr("'thing measure length -o' | 'thing measure length --output') return ;;"));
  EXPECT_THAT(script, HasSubstr("complete -o bashdefault -o default -F _thing thing\n"));
  EXPECT_THAT(script, Not(HasSubstr("secret")));
}

TEST(Description, BecomesACompletionForZsh) {
  const std::string script = zsh_completion(describe(Program().app));
  EXPECT_THAT(script, testing::StartsWith("#compdef thing\n"));
  EXPECT_THAT(script, HasSubstr("'--log[Format of the log]:TEXT:(text json)'"));
  EXPECT_THAT(script, HasSubstr("'--output[Folder that is made]:TEXT:_files'"));
  EXPECT_THAT(script, HasSubstr(R"('measure:What a thing'\''s \[size\] is\: its \\ and '\''more'\''')"));
  EXPECT_THAT(script, HasSubstr("length) _thing_measure_length ;;"));
}

TEST(Description, IsWrittenWhereItIsAskedForAlone) {
  EXPECT_EQ(described_into({"--describe", "folder"}), std::filesystem::path("folder"));
  EXPECT_FALSE(described_into({"--describe"}));
  EXPECT_FALSE(described_into({"model", "--describe", "folder"}));
}

}  // namespace
}  // namespace ostia::command_line
