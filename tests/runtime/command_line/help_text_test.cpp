// This file tests the layout of --help: groups, rare options, wrapped lines.
#include "command_line/help_text.hpp"

#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <catch2/catch.hpp>

#include "command_line/command.hpp"

using namespace remap;

namespace {

// Returns what `read` makes of `tool bake`, a command with options of all kinds.
template <typename Read>
auto of_bake(const Read& read) {
  Command app("A tool.", "tool");
  Command* bake = app.add_subcommand("bake", "Bake a map");
  std::string input, model = "svr", stroke, folder = "fits";
  std::vector<std::size_t> layers = {16, 16};
  bool exact = false, quiet = false;
  bake->add_option("table", input, "The table to read")->required();
  bake->option_group("Fit");
  bake->add_option("--model", model, "How to fit it, in a description that takes more than a single line")
      ->one_of({"auto", "svr"});
  Option* sizes = bake->add_option("--layers", layers, "Units of each layer")
                      ->delimiter(',')
                      ->range(std::size_t{1}, std::size_t{4096});
  bake->add_flag("--exact", exact, "As it was fitted")->excludes(sizes);
  bake->option_group("Output");
  bake->add_option("-o,--output FOLDER", folder, "Folder for the fit");
  bake->add_option("--mask SOURCE_MASK TEMPLATE_MASK[:CHANNEL]", stroke, "Two masks");
  bake->option_group(kRareOptions);
  bake->add_flag("--quiet", quiet, "Print nothing");
  bake->footer("Example:\n  tool bake table.csv");
  lay_out_help(app.app());
  return read(bake->app());
}

// Returns the help as --help or --help-all shows it.
std::string help_of_bake(CLI::AppFormatMode mode) {
  return of_bake([&](const CLI::App& app) { return app.help("tool", mode); });
}

}  // namespace

TEST_CASE("help_text: options stand in their groups, with what CLI11 knows of them") {
  CHECK(help_of_bake(CLI::AppFormatMode::Normal) ==
        "Bake a map\n"
        "\n"
        "Usage: tool bake table [options]\n"
        "\n"
        "Arguments:\n"
        "  table                   The table to read (required)\n"
        "\n"
        "Fit:\n"
        "  --model NAME            How to fit it, in a description that takes more than a\n"
        "                          single line (one of auto, svr; default: svr)\n"
        "  --layers N              Units of each layer (1 to 4096; default: 16,16)\n"
        "  --exact                 As it was fitted\n"
        "\n"
        "Output:\n"
        "  -o, --output FOLDER     Folder for the fit (default: fits)\n"
        "  --mask SOURCE_MASK TEMPLATE_MASK[:CHANNEL]\n"
        "                          Two masks\n"
        "\n"
        "Help:\n"
        "  -h, --help              Show this help\n"
        "  --help-all              Show all options\n"
        "\n"
        "Example:\n"
        "  tool bake table.csv\n"
        "\n"
        "See tool bake --help-all for 1 more option.\n");
}

TEST_CASE("help_text: --help-all shows rare options") {
  const std::string help = help_of_bake(CLI::AppFormatMode::All);
  CHECK_THAT(help, Catch::Contains("\nRare options:\n  --quiet                 Print nothing\n"));
  CHECK_THAT(help, !Catch::Contains("--help-all for"));
}

TEST_CASE("help_text: commands stand in their groups") {
  Command app("A tool.", "tool");
  app.add_subcommand("bake", "Bake a map", "Make");
  app.add_subcommand("show", "Show a map", "Look");
  app.add_subcommand("burn", "Burn a map", "Make");
  lay_out_help(app.app());
  CHECK(app.app().help() ==
        "A tool.\n"
        "\n"
        "Usage: tool COMMAND [options]\n"
        "\n"
        "Make:\n"
        "  bake                    Bake a map\n"
        "  burn                    Burn a map\n"
        "\n"
        "Look:\n"
        "  show                    Show a map\n"
        "\n"
        "Help:\n"
        "  -h, --help              Show this help\n");
}

TEST_CASE("help_text: long lines break at blanks, indented lines stay") {
  const std::string words =
      "0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123";
  CHECK(wrapped(words, 0) ==
        "0123456789 0123456789 0123456789 0123456789 0123456789 0123456789 0123456789\n0123");
  CHECK(wrapped("a\n\n " + words + "\nb", 2) == "a\n\n   " + words + "\n  b");
  CHECK(wrapped(std::string(90, 'x') + " y", 4) == std::string(90, 'x') + "\n    y");
}

TEST_CASE("help_text: the table says what the help says") {
  const Json table = of_bake([](const CLI::App& app) { return help_table(app); });
  CHECK(*table.find("name")->text() == "tool bake");
  CHECK(*table.find("usage")->text() == "Usage: tool bake table [options]");
  CHECK(*table.find("arguments")->entries()->front().find("names")->text() == "table");
  const Json& fit = table.find("groups")->entries()->front();
  CHECK(*fit.find("group")->text() == "Fit");
  const Json& model = fit.find("options")->entries()->front();
  CHECK(*model.find("names")->text() == "--model");
  CHECK(*model.find("choices")->text() == "auto, svr");
}

TEST_CASE("help_text: excluded options stand in the order of their names, wherever they lie in memory") {
  for (const bool narrow_first : {true, false}) {
    Command app("A tool.", "tool");
    bool exact = false, narrow = false, wide = false, plain = false;
    Option* b =
        narrow_first ? app.add_flag("--narrow", narrow, "Narrow") : app.add_flag("--wide", wide, "Wide");
    Option* a = app.add_flag("--plain", plain, "Plain");
    Option* c =
        narrow_first ? app.add_flag("--wide", wide, "Wide") : app.add_flag("--narrow", narrow, "Narrow");
    app.add_flag("--exact", exact, "Exact")->excludes(c)->excludes(a)->excludes(b);
    lay_out_help(app.app());
    const std::string text = app.app().help("tool", CLI::AppFormatMode::All);
    CHECK_THAT(text, Catch::Matchers::Contains("Exact (not with --narrow; not with --plain; not with\n"));
  }
}
