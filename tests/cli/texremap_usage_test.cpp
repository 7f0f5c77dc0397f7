// Errors in the use of texremap: one wrong input per test, with its exit code and message.
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/texremap_session.hpp"
#include "remap/fit_file.hpp"
#include "remap/shipped_converters.hpp"
#include "support/example_fit.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

void check_failure(const ProcessResult& result, int exit_code, const std::string& message) {
  INFO(result.errors);
  CHECK(result.exit_code == exit_code);
  CHECK_THAT(result.last_error(), Contains(message));
  CHECK(result.last_error().starts_with("texremap: "));
  CHECK(result.output.empty());
}

}  // namespace

TEST_CASE("texremap: help, version and list answer on standard output", "[slow]") {
  const Session session;
  CHECK(session.texremap({"--version"}).output.starts_with("texremap "));
  for (const std::string command : {"convert", "list"}) {
    const ProcessResult result = session.texremap({command, "--help"});
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, Contains("Example:\n  texremap " + command));
  }
  CHECK_THAT(session.texremap({"list"}).output, Contains("mitsuba_ward_to_mitsuba_as"));
  const auto json = nlohmann::json::parse(session.texremap({"list", "--json"}).output);
  REQUIRE(json.size() == shipped_converters().size());
  CHECK(json[0]["self_test"] == true);
  CHECK(json[0]["source"]["model"].is_string());
}

TEST_CASE("texremap: a full standard output is a failure") {
  const ProcessResult result = run({"/bin/sh", "-c", "exec \"" REMAP_TEXREMAP "\" list > /dev/full"});
  check_failure(result, 1, "standard output: cannot be written");
}

TEST_CASE("texremap: an unknown command or option is refused with the nearest name") {
  const Session session;
  check_failure(session.texremap({"convrt"}), 2, "unknown command 'convrt' (did you mean convert?)");
  check_failure(session.texremap({"convert", "--form", "mitsuba/ward"}), 2,
                "unknown option --form (did you mean --from?)");
}

TEST_CASE("texremap: an unknown model is refused with the nearest name") {
  const Session session;
  check_failure(session.texremap({"convert", "--from", "mitsuba/wrad", "--to", "mitsuba/as", "--roughness",
                                  "r", "--specular", "s", "-o", "out"}),
                2, "did you mean mitsuba/ward?");
}

TEST_CASE("texremap: a conversion without models is refused") {
  const Session session;
  check_failure(session.texremap({"convert", "--roughness", "r", "--specular", "s", "-o", "out"}), 2,
                "--from is required (or --fit)");
}

TEST_CASE("texremap: unknown values of options are refused", "[slow]") {
  const Session session;
  session.write_pair("exr");
  check_failure(session.convert("r.exr", "s.exr", {"--type", "hlaf"}), 2,
                "--type: unknown pixel type 'hlaf' (did you mean half?)");
  check_failure(session.convert("r.exr", "s.exr", {"--format", "pgn"}), 2,
                "--format: unknown format 'pgn' (did you mean png?)");
  check_failure(session.convert("r.exr", "s.exr", {"--threads", "many"}), 2, "--threads");
  check_failure(session.convert("r.exr:X", "s.exr"), 2, "no channel 'X'");
  CHECK_FALSE(fs::exists(session.path("out")));
}

TEST_CASE("texremap: a missing input is named with the reason") {
  const Session session;
  check_failure(session.convert("r.exr", "s.exr"), 1, "r.exr: cannot be read: No such file or directory");
}

TEST_CASE("texremap: an input that is not an image is refused", "[slow]") {
  const Session session;
  session.write_pair("exr");
  std::ofstream(session.path("r.exr")) << "not an image";
  check_failure(session.convert("r.exr", "s.exr"), 1, "r.exr: cannot be read as an image");
  check_failure(session.convert(".", "s.exr"), 1, "is a folder, not an image file");
}

TEST_CASE("texremap: a truncated input is refused and leaves no result", "[slow]") {
  const Session session;
  const std::string extension = GENERATE("exr", "png", "tif", "jpg");
  const bool whole_numbers = extension != "exr";
  session.write_pair(extension, 256, whole_numbers ? OIIO::TypeUInt8 : OIIO::TypeHalf);
  const fs::path specular = session.path("s." + extension);
  fs::resize_file(specular, fs::file_size(specular) * 7 / 10);
  const std::string threads = GENERATE("1", "2");
  const ProcessResult result = session.convert("r." + extension, "s." + extension, {"--threads", threads});
  check_failure(result, 1, "s." + extension + ": rows ");
  CHECK_THAT(result.last_error(), Contains("the file may be truncated"));
  CHECK(session.file_count() == 0);
}

TEST_CASE("texremap: a file without the needed channels is refused with its channels") {
  const Session session;
  session.write_pair("exr");
  write_image(session.path("s.exr"), test_spec(64, 64, {"U", "V"}, OIIO::TypeHalf), noise);
  check_failure(session.convert("r.exr", "s.exr"), 1, "s.exr: has the channels U, V instead of R, G and B");
}

TEST_CASE("texremap: maps of different size are refused with both sizes") {
  const Session session;
  session.write_pair("exr");
  write_image(session.path("s.exr"), test_spec(32, 16, {"R", "G", "B"}, OIIO::TypeHalf), noise);
  check_failure(session.convert("r.exr", "s.exr"), 1, "s.exr: size 32x16 does not match ");
}

TEST_CASE("texremap: a roughness map that is not grey needs a channel", "[slow]") {
  const Session session;
  session.write_pair("exr");
  const ProcessResult result = session.convert("s.exr", "s.exr");
  check_failure(result, 2,
                "channel R is used as both roughness and specular (choose channels with FILE:CHANNEL)");
  fs::copy_file(session.path("s.exr"), session.path("color.exr"));
  check_failure(session.convert("color.exr", "s.exr"), 1, "is not grey");
  CHECK(session.file_count() == 0);
  CHECK(session.convert("color.exr:G", "s.exr").exit_code == 0);
  const TestImage in = read_image(session.path("color.exr")), out = read_image(session.path("out/color.exr"));
  CHECK(out.at(3, 4, 0) == in.at(3, 4, 0));
  CHECK(out.at(3, 4, 2) == in.at(3, 4, 2));
  CHECK(out.at(3, 4, 1) ==
        as_stored(converted_texel(in.at(3, 4, 1), {in.at(3, 4, 0), in.at(3, 4, 1), in.at(3, 4, 2)})[0],
                  OIIO::TypeHalf));
}

TEST_CASE("texremap: an impossible output folder is refused", "[slow]") {
  const Session session;
  session.write_pair("exr");
  std::vector<std::string> words = session.conversion("r.exr", "s.exr");
  words.back() = session.path("r.exr");
  check_failure(session.texremap(words), 1, "r.exr: is a file, not a folder");
  words.back() = session.path("r.exr/below");
  check_failure(session.texremap(words), 1, "folder cannot be created");
  words.back() = "/proc/nowhere";
  check_failure(session.texremap(words), 1, "/proc/nowhere: folder cannot be created");
  words.back() = "/proc/self";
  check_failure(session.texremap(words), 1, "cannot be written");
}

TEST_CASE("texremap: an input is never the output", "[slow]") {
  const Session session;
  session.write_pair("exr");
  const std::string before = read_file(session.path("r.exr"));
  std::vector<std::string> words = session.conversion("r.exr", "s.exr");
  words.push_back("--force");
  words[words.size() - 2] = session.path(".");
  check_failure(session.texremap(words), 2, "would overwrite the input");
  // Through a link: one result would overwrite the other input.
  fs::create_directory(session.path("out"));
  fs::create_symlink(session.path("s.exr"), session.path("out/r.exr"));
  check_failure(session.convert("r.exr", "s.exr", {"--force"}), 2, "would overwrite the input");
  CHECK(read_file(session.path("r.exr")) == before);
}

TEST_CASE("texremap: a result that exists is kept without --force", "[slow]") {
  const Session session;
  session.write_pair("exr");
  REQUIRE(session.convert("r.exr", "s.exr").exit_code == 0);
  std::ofstream(session.path("out/s.exr")) << "precious";
  fs::remove(session.path("out/r.exr"));
  check_failure(session.convert("r.exr", "s.exr"), 1, "out/s.exr: already exists (--force overwrites)");
  CHECK(read_file(session.path("out/s.exr")) == "precious");
  CHECK(session.file_count() == 1);
  CHECK(session.convert("r.exr", "s.exr", {"--force"}).exit_code == 0);
  CHECK(read_image(session.path("out/s.exr")).spec.width == 64);
}

TEST_CASE("texremap: a pixel type that the format cannot hold is refused") {
  const Session session;
  session.write_pair("exr");
  check_failure(session.convert("r.exr", "s.exr", {"--format", "png", "--type", "half"}), 1,
                "format png cannot hold half pixels (use uint16)");
  CHECK(session.file_count() == 0);
}

TEST_CASE("texremap: NaN, infinite and negative texels are converted and counted") {
  const Session session;
  session.write_pair("exr");
  write_image(session.path("s.exr"), test_spec(64, 64, {"R", "G", "B"}, OIIO::TypeHalf),
              [](int x, int y, int c) {
                if (y == 0 && c == 1) return x < 2 ? NAN : x < 5 ? INFINITY : x < 9 ? -0.5f : 0.25f;
                return 0.25f;
              });
  const ProcessResult result = session.convert("r.exr", "s.exr", {"--json"});
  REQUIRE(result.exit_code == 0);
  const auto json = nlohmann::json::parse(result.output);
  CHECK(json["texels"] == 64 * 64);
  CHECK(json["nan"] == 2);
  CHECK(json["infinite"] == 3);
  CHECK(json["negative"] == 4);
  CHECK(json["converter"] == "mitsuba_ward_to_mitsuba_as");
  CHECK(json["specular"] == session.path("out/s.exr"));
  CHECK_THAT(result.errors, Contains("texremap: 2 texels with NaN") && Contains("3 texels with infinite") &&
                                Contains("4 texels with negative"));
  CHECK(std::isnan(read_image(session.path("out/s.exr")).at(1, 0, 1)));
}

TEST_CASE("texremap: --quiet prints nothing") {
  const Session session;
  session.write_pair("jpg", 64, OIIO::TypeUInt8);
  const ProcessResult result = session.convert("r.jpg", "s.jpg", {"--quiet"});
  CHECK(result.exit_code == 0);
  CHECK(result.errors.empty());
  CHECK(result.output.empty());
}

TEST_CASE("texremap: --fit evaluates that fit, and its models must agree", "[slow]") {
  const Session session;
  session.write_pair("exr");
  const Fit fit = example_fit();
  write_file(session.path("fit.json"), fit_to_json(fit));
  const std::vector<std::string> words = {"convert",
                                          "--fit",
                                          session.path("fit.json"),
                                          "--roughness",
                                          session.path("r.exr"),
                                          "--specular",
                                          session.path("s.exr"),
                                          "-o",
                                          session.path("out")};
  REQUIRE(session.texremap(words).exit_code == 0);
  const TestImage in = read_image(session.path("r.exr")), out = read_image(session.path("out/r.exr"));
  CHECK(out.spec.get_string_attribute("remap:converter") == fit.id);
  const auto converter = make_lowered_converter(fit);
  for (int x = 0; x < 64; ++x) {
    const float roughness = in.at(x, 1, 0), specular = 0.0f;
    float expected = 0.0f, ignored = 0.0f;
    const std::array<const float*, 1> specular_in = {&specular};
    const std::array<float*, 1> specular_out = {&ignored};
    converter->convert(1, &roughness, specular_in, &expected, specular_out);
    CHECK(out.at(x, 1, 0) == as_stored(expected, OIIO::TypeHalf));
  }
  std::vector<std::string> disagreeing = words;
  disagreeing.insert(disagreeing.end(), {"--force", "--from", "mitsuba/ward"});
  check_failure(session.texremap(disagreeing), 2,
                "source model is example/a, but --from asks for mitsuba/ward");
}

TEST_CASE("texremap: --converters replaces the shipped converters by those of a fit, a folder or a list",
          "[slow]") {
  const Session session;
  const Fit fit = example_fit();
  std::filesystem::create_directory(session.path("fits"));
  write_file(session.path("fits/fit.json"), fit_to_json(fit));
  write_file(session.path("fits/manifest.json"), "{}");  // is not a fit, as in a folder of remapc
  const auto list = [&](const std::string& path) {
    const ProcessResult result = session.texremap({"list", "--converters", path, "--json"});
    require_success(result);
    return result.output;
  };
  const std::string of_fit = list(session.path("fits/fit.json"));
  CHECK_THAT(of_fit, Catch::Contains(fit.id));
  CHECK_THAT(of_fit, !Catch::Contains("mitsuba_ward_to_mitsuba_as"));
  CHECK(list(session.path("fits")) == of_fit);
  CHECK(list(REMAP_SOURCE_DIR "/generated/converters.json") == session.texremap({"list", "--json"}).output);

  const std::vector<std::string> numbers = {"convert", "--from",         fit.source.model,
                                            "--to",    fit.target.model, "--roughness",
                                            "0.25",    "--specular",     "0.3"};
  check_failure(session.texremap(numbers), 2, fit.source.model);
  std::vector<std::string> words = numbers;
  words.insert(words.end(), {"--converters", session.path("fits")});
  const ProcessResult converted = session.texremap(words);
  require_success(converted);
  words = numbers;
  words.insert(words.end(), {"--fit", session.path("fits/fit.json")});
  CHECK(session.texremap(words).output == converted.output);

  check_failure(session.texremap({"list", "--converters", session.path("nothing")}), 1, "does not exist");
  check_failure(session.texremap({"list", "--converters", session.path("")}), 1, "holds no converter");
}

TEST_CASE("texremap: --fit that cannot be lowered is interpreted, with a warning") {
  const Session session;
  session.write_pair("exr", 16);
  Fit fit = example_fit();
  const KernelExpansion spikes{{{0.0, 1.0, 0.0}}, {0.0, 1.0, 0.0}, 1e6, 0.5, {0.2, 0.7}, {0.1, -0.1}};
  fit.mapping = Svr{spikes, spikes};
  write_file(session.path("fit.json"), fit_to_json(fit));
  const ProcessResult result =
      session.texremap({"convert", "--fit", session.path("fit.json"), "--roughness", session.path("r.exr"),
                        "--specular", session.path("s.exr"), "-o", session.path("out")});
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.errors, Contains("warning: ") && Contains("fit.json: runs in the slow interpreter"));
  CHECK(session.result_count() == 2);
}

TEST_CASE("texremap: every instruction set writes the same files", "[slow]") {
  const Session session;
  session.write_pair("exr");
  std::vector<std::string> written;
  for (const InstructionSet set : instruction_sets()) {
    const std::string name(instruction_set_name(set));
    const ProcessResult result =
        session.convert("r.exr", "s.exr", {"--instructions", name, "--force", "--json"});
    REQUIRE(result.exit_code == 0);
    CHECK(nlohmann::json::parse(result.output)["instructions"] == name);
    written.push_back(read_file(session.path("out/r.exr")) + read_file(session.path("out/s.exr")));
    CHECK(written.back() == written.front());
  }
}

TEST_CASE("texremap: an unknown instruction set is refused with the nearest name") {
  const Session session;
  session.write_pair("exr", 16);
  check_failure(session.convert("r.exr", "s.exr", {"--instructions", "axv2"}), 2, "did you mean avx2?");
  CHECK(session.file_count() == 0);
}
