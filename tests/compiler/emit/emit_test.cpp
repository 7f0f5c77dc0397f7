// This file tests the parts of the emitter: templates, layout and determinism.
#include "emit/emit.hpp"

#include <stdexcept>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "emit/header_data.hpp"
#include "lower/fit_file.hpp"
#include "lower/interpreter.hpp"
#include "remap/error.hpp"
#include "support/random_warp.hpp"

using namespace remap;

TEST_CASE("emit: the description of a header has the values of the fit and no code") {
  const Fit fit = load_fit(std::string(REMAP_SOURCE_DIR) + "/fits/mitsuba_phong_to_mitsuba_ggx.json");
  const HeaderData data = describe(fit);
  CHECK(data.source.width == "exponent");
  CHECK(data.source.parameters[0].name == "width");
  CHECK(data.target.parameters[1].name == "specular");
  REQUIRE(data.golden.size() > 8);
  for (const GoldenValues& texel : data.golden) {
    const double in = static_cast<double>(texel.in[1]);
    double out = 0.0;
    const double width = evaluate_texel(fit, static_cast<double>(texel.in[0]), {&in, 1}, {&out, 1});
    CHECK(texel.out[0] == static_cast<float>(width));
    CHECK(texel.out[1] == static_cast<float>(out));
  }
  const auto& converter = std::get<ConverterData>(data.code);
  CHECK(converter == fit.converter);
  CHECK(converter.info.image_rms_error >= fit.image_error->rms);
}

TEST_CASE("emit: the committed header is what its fit gives, read again or not") {
  const std::string root = REMAP_SOURCE_DIR;
  const Fit fit = load_fit(root + "/fits/mitsuba_ward_to_mitsuba_as.json");
  const std::string committed = read_file(root + "/generated/mitsuba_ward_to_mitsuba_as.hpp");
  CHECK(emit_header(fit) == committed);
  CHECK(emit_header(fit_from_json(fit_to_json(fit), "copy")) == committed);
}

TEST_CASE("emit: the header names models, table, errors and licence, and defines no macro but its guard") {
  const Fit fit = load_fit(std::string(REMAP_SOURCE_DIR) + "/fits/mitsuba_ward_to_mitsuba_as.json");
  const std::string header = emit_header(fit);
  for (const std::string& part : {fit.source.model, fit.target.model, fit.table.sha256, std::string("MIT-0"),
                                  std::string("remapc emit")})
    CHECK(header.find(part) != std::string::npos);
  std::size_t defines = 0;
  for (std::size_t at = header.find("#define"); at != std::string::npos; at = header.find("#define", at + 1))
    ++defines;
  CHECK(defines == 1);
}

TEST_CASE("emit: warps are headers of whole materials") {
  WarpMapFit fit;
  fit.id = "leaf";
  fit.source_model = "mitsuba/ggx";
  fit.template_model = "cycles/ggx";
  fit.warp = random_warp(3, 4, 32);
  fit.copy_rms_error = 0.0123;
  fit.method = {{"source", "brown_leaf"}};
  fit.tool_version = "0";
  const std::string header = emit_header(fit);
  CHECK(emit_header(fit) == header);
  CHECK(header.size() < 1000000);  // its codes take 229 KB as numbers
  for (const std::string part :
       {"kId = \"leaf\"", "kSourceModel = \"mitsuba/ggx\"", "kTargetModel = \"cycles/ggx\"",
        "kTemplateModel = kTargetModel", "kCopyRmsError = 0.0123", "// source: brown_leaf", "MIT-0",
        "std::array<float, 3> specular;", "SeparableView", "BlendedView"})
    CHECK(header.find(part) != std::string::npos);
  for (const std::string part : {"QuadraticView", "CopiedView", "Conventions"})
    CHECK(header.find(part) == std::string::npos);
  fit.warp.table.nodes = 31;
  CHECK_THROWS_WITH(emit_header(fit), Catch::Contains("leaf: the table has the wrong size"));
}

TEST_CASE("emit: no text of a fit leaves its comment") {
  const std::string fits = std::string(REMAP_SOURCE_DIR) + "/fits/";
  const std::vector<std::string> remarks = {"ends in a backslash \\",
                                            "and in one before blanks \\ \t ",
                                            "and in its trigraph ?\?/",
                                            "turned \xe2\x80\xae about",
                                            "split\nin two\\",
                                            std::string("cut\0off", 7),
                                            "feed\fed"};
  const auto check = [&](const std::string& header) {
    CHECK(header.find(
              "// ends in a backslash \\.\n// and in one before blanks \\.\n// and in its trigraph ?\?/.\n"
              "// turned \\u202e about\n// split\n// in two\\.\n// cut\\x00off\n// feed\\x0ced\n") !=
          std::string::npos);
  };
  auto fit = load_fit(fits + "mitsuba_phong_to_mitsuba_ggx.json");
  fit.remarks = remarks;
  check(emit_header(fit));
  auto workflow = std::get<WorkflowFit>(load_any_fit(fits + "metallic_to_specular.json"));
  workflow.remarks = remarks;
  check(emit_header(workflow));
}
