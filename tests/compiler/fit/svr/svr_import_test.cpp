// Model files of libsvm: they are read as libsvm reads them, and faults are reported with their line.
#include "fit/svr/svr_import.hpp"

#include <cmath>
#include <memory>

#include <catch2/catch.hpp>
#include <libsvm/svm.h>
#include <nlohmann/json.hpp>

#include "fit/svr/svm_model_file.hpp"
#include "model/evaluate.hpp"
#include "model/interpreter.hpp"
#include "remap/error.hpp"
#include "remap/fit_file.hpp"
#include "support/temporary_folder.hpp"
#include "system/files.hpp"

using namespace remapc;
using remap::KernelExpansion;

namespace {

struct ModelDeleter {
  void operator()(svm_model* model) const { svm_free_and_destroy_model(&model); }
};
using Model = std::unique_ptr<svm_model, ModelDeleter>;

void be_quiet(const char*) {}

// A regression of y = x0 - x1^2 / 2 on a 7 x 7 grid of [0, 1], as users train one.
Model trained_model(int svm_type) {
  svm_set_print_string_function(be_quiet);
  std::vector<svm_node> nodes;
  std::vector<double> outputs;
  for (int i = 0; i < 49; ++i) {
    const double x = (i % 7) / 6.0, y = (i / 7) / 6.0;
    nodes.insert(nodes.end(), {{1, x}, {2, y}, {-1, 0.0}});
    outputs.push_back(x - 0.5 * y * y);
  }
  std::vector<svm_node*> lists;
  for (std::size_t i = 0; i < outputs.size(); ++i) lists.push_back(&nodes[3 * i]);
  const svm_problem problem{static_cast<int>(outputs.size()), outputs.data(), lists.data()};
  svm_parameter parameters{};
  parameters.svm_type = svm_type;
  parameters.kernel_type = RBF;
  parameters.gamma = 0.7;
  parameters.C = 10.0;
  parameters.p = 0.001;
  parameters.nu = 0.5;
  parameters.eps = 1e-4;
  parameters.cache_size = 10.0;
  parameters.shrinking = 1;
  const remap::TemporaryFolder folder;
  const std::string path = (folder.path() / "trained.model").string();
  const Model model(svm_train(&problem, &parameters));
  svm_save_model(path.c_str(), model.get());
  return Model(svm_load_model(path.c_str()));  // a model that outlives `nodes`
}

double predicted(const svm_model& model, double x, double y) {
  const std::array<svm_node, 3> nodes = {{{1, x}, {2, y}, {-1, 0.0}}};
  return svm_predict(&model, nodes.data());
}

const std::string kHeader =
    "svm_type epsilon_svr\nkernel_type rbf\ngamma 0.5\nnr_class 2\ntotal_sv 2\nrho -0.25\nSV\n";
const std::string kVectors = "1.5 1:0.25 2:0.75 \n-1.5 2:0.5 \n";

std::string with(std::string text, const std::string& old_part, const std::string& new_part) {
  const auto found = text.find(old_part);
  REQUIRE(found != std::string::npos);
  return text.replace(found, old_part.size(), new_part);
}

nlohmann::json description() {
  const nlohmann::json alpha = {{"name", "alpha"}, {"offset", 0.05}, {"scale", 2.0}};
  const nlohmann::json specular = {{"name", "specular"}, {"offset", 0.1}, {"scale", -4.0}};
  const nlohmann::json side = {{"model", "mitsuba/ward"}, {"roughness", "alpha"}, {"specular", "specular"}};
  const nlohmann::json output = {{"offset", -0.5}, {"scale", 3.0}};
  return {{"source", side},
          {"target", {{"model", "mitsuba/as"}, {"roughness", "alpha"}, {"specular", "f0"}}},
          {"domain", {{"alpha", {0.05, 0.9}}, {"specular", {0.0, 0.5}}}},
          {"alpha", {{"model_file", "a.model"}, {"inputs", {alpha, specular}}, {"output", output}}},
          {"specular", {{"model_file", "s.model"}, {"inputs", {specular, alpha}}, {"output", output}}}};
}

}  // namespace

TEST_CASE("model file: both kinds of regression give what libsvm predicts") {
  for (const int type : {EPSILON_SVR, NU_SVR}) {
    const Model model = trained_model(type);
    const remap::TemporaryFolder folder;
    const std::string path = (folder.path() / "saved.model").string();
    REQUIRE(svm_save_model(path.c_str(), model.get()) == 0);
    const Model loaded(svm_load_model(path.c_str()));
    const KernelExpansion expansion = read_svm_model(path, 2);
    CHECK(expansion.count() == static_cast<std::size_t>(loaded->l));
    // Files hold eight digits of a vector; both readers see the same ones.
    for (double x = -0.2; x <= 1.2; x += 0.1)
      for (double y = -0.2; y <= 1.2; y += 0.1)
        CHECK(std::fabs(remap::expansion_value(expansion, x, y) - predicted(*loaded, x, y)) < 1e-12);
  }
}

TEST_CASE("model file: an index that a vector leaves out is 0") {
  const KernelExpansion expansion = expansion_from_svm_model(kHeader + kVectors, 2, "m");
  CHECK(expansion.gamma == 0.5);
  CHECK(expansion.bias == 0.25);
  CHECK(expansion.weights == std::vector<double>{1.5, -1.5});
  CHECK(expansion.vectors == std::vector<double>{0.25, 0.75, 0.0, 0.5});
  const std::string windows = with(with(kHeader + kVectors, "rbf\n", "rbf\r\n"), "SV\n", "SV\r\n");
  CHECK(expansion_from_svm_model(windows, 2, "m") == expansion);
}

TEST_CASE("model file: faults are reported with their line") {
  const std::string good = kHeader + kVectors;
  const auto refusal = [](const std::string& text) {
    try {
      expansion_from_svm_model(text, 2, "m");
    } catch (const remap::Error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  using Catch::Contains;
  using Catch::StartsWith;
  CHECK_THAT(refusal(""), StartsWith("m:1: the header does not end with a line SV"));
  CHECK_THAT(refusal("{\"a\": 1}\n"), StartsWith("m:1: unknown header line"));
  CHECK_THAT(refusal(with(good, "epsilon_svr", "c_svc")), StartsWith("m:1: unsupported svm_type \"c_svc\""));
  CHECK_THAT(refusal(with(good, "rbf", "linear")), StartsWith("m:2: unsupported kernel_type \"linear\""));
  CHECK_THAT(refusal(with(good, "0.5\n", "-0.5\n")), StartsWith("m:3: gamma must be above 0"));
  CHECK_THAT(refusal(with(good, "gamma 0.5\n", "")), Contains("the header has no line gamma"));
  CHECK_THAT(refusal(with(good, "gamma 0.5", "gamma")), StartsWith("m:3:"));
  CHECK_THAT(refusal(with(good, "nr_class 2", "nr_class 3")), StartsWith("m:4: nr_class"));
  CHECK_THAT(refusal(with(good, "nr_class 2", "rho 1")), StartsWith("m:6: repeated header line rho"));
  CHECK_THAT(refusal(with(good, "total_sv 2", "total_sv 3")),
             StartsWith("m:10: the file has 2 vectors, but total_sv is 3"));
  CHECK_THAT(refusal(with(good, "total_sv 2", "total_sv 1")),
             StartsWith("m:9: more vectors than total_sv (1)"));
  CHECK_THAT(refusal(with(good, "total_sv 2", "total_sv -2")), StartsWith("m:5: total_sv"));
  CHECK_THAT(refusal(with(good, "total_sv 2", "total_sv 99999999999")), StartsWith("m:5: total_sv"));
  CHECK_THAT(refusal(with(good, "rho -0.25", "rho nan")),
             StartsWith("m:6: rho is not a finite number: \"nan\""));
  CHECK_THAT(refusal(with(good, "2:0.75", "3:0.75")),
             StartsWith("m:8: an index is not an integer from 0 to 2: \"3\""));
  CHECK_THAT(refusal(with(good, "1:0.25", "0:0.25")), StartsWith("m:8: index 0"));
  CHECK_THAT(refusal(with(good, "2:0.75", "1:0.75")), StartsWith("m:8: index 1"));
  CHECK_THAT(refusal(with(good, "2:0.75", "2:")), StartsWith("m:8: a value is not a finite number: \"\""));
  CHECK_THAT(refusal(with(good, "2:0.75", "2")), StartsWith("m:8: \"2\" is not of the form index:value"));
  CHECK_THAT(refusal(with(good, "1.5 1", "inf 1")),
             StartsWith("m:8: the weight is not a finite number: \"inf\""));
  CHECK_THAT(refusal(with(good, "-1.5 2:0.5 \n", "\n")),
             StartsWith("m:9: the weight is not a finite number: \"\""));
  // Cut anywhere, it is refused: none of the shorter texts is a model.
  for (std::size_t length = 0; length < good.size(); ++length)
    CHECK(refusal(good.substr(0, length)) != "none");
}

TEST_CASE("import: a description and two model files give what libsvm predicts behind the scalings") {
  const remap::TemporaryFolder folder;
  const Model alpha = trained_model(EPSILON_SVR), specular = trained_model(NU_SVR);
  for (const auto& [model, name] : {std::pair(alpha.get(), "a.model"), std::pair(specular.get(), "s.model")})
    REQUIRE(svm_save_model((folder.path() / name).c_str(), model) == 0);
  remap::write_file(folder.path() / "d.json", description().dump());
  const remap::Fit fit = import_svr(folder.path() / "d.json");
  CHECK(fit.id == "mitsuba_ward_to_mitsuba_as");
  CHECK(fit.target.specular == "f0");
  CHECK(fit.domain == remap::Domain{{0.05, 0.9}, {0.0, 0.5}});
  CHECK(fit.method.contains("imported"));
  CHECK(remap::fit_from_json(remap::fit_to_json(fit), "again") == fit);
  for (double a = 0.05; a <= 0.9; a += 0.05) {
    for (double s = 0.0; s <= 0.5; s += 0.1) {
      const double x = (a - 0.05) * 2.0, y = (s - 0.1) * -4.0;
      const remap::MappedTexel texel = remap::evaluate_mapping(fit.mapping, a, s);
      CHECK(std::fabs(texel.alpha - (predicted(*alpha, x, y) / 3.0 - 0.5)) < 1e-12);
      CHECK(std::fabs(texel.specular - (predicted(*specular, y, x) / 3.0 - 0.5)) < 1e-12);
    }
  }
}

TEST_CASE("import: faults of a description are reported with their place") {
  const remap::TemporaryFolder folder;
  for (const char* name : {"a.model", "s.model"}) remap::write_file(folder.path() / name, kHeader + kVectors);
  const auto refusal = [&](const std::string& text) {
    remap::write_file(folder.path() / "d.json", text);
    try {
      import_svr(folder.path() / "d.json");
    } catch (const remap::Error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const auto without = [&](const std::string& pointer, const nlohmann::json& value) {
    nlohmann::json changed = description();
    changed[nlohmann::json::json_pointer(pointer)] = value;
    return refusal(changed.dump());
  };
  using Catch::Contains;
  CHECK(refusal(description().dump()) == "none");
  CHECK_THAT(refusal("{"), Contains("d.json: invalid JSON"));
  CHECK_THAT(refusal("[]"), Contains("d.json: must be an object"));
  CHECK_THAT(without("/speculr", 1), Contains("unknown field \"speculr\""));
  CHECK_THAT(without("/id", "two words"), Contains("d.json.id"));
  CHECK_THAT(without("/source", 3), Contains("d.json.source"));
  CHECK_THAT(without("/source/roughness", "shine"), Contains("d.json.source.roughness"));
  CHECK_THAT(without("/domain/alpha", {0.9, 0.1}), Contains("d.json.domain.alpha"));
  CHECK_THAT(without("/alpha/model_file", "none.model"), Contains("none.model: cannot be read"));
  CHECK_THAT(without("/alpha/model_file", 3), Contains("alpha.model_file: must be a string"));
  CHECK_THAT(without("/alpha/inputs", nlohmann::json::array()), Contains("alpha.inputs: must be a list"));
  CHECK_THAT(without("/alpha/inputs/0/name", "roughness"),
             Contains("alpha.inputs[0].name: unknown input \"roughness\""));
  CHECK_THAT(without("/alpha/inputs/0/name", "specular"), Contains("must contain alpha once"));
  CHECK_THAT(without("/alpha/inputs/1/scale", 0), Contains("alpha.inputs[1].scale: must not be 0"));
  CHECK_THAT(without("/specular/output/offset", "0"),
             Contains("specular.output.offset: must be a finite number"));
  CHECK_THAT(without("/specular/output", 1), Contains("specular.output: must be an object"));
  nlohmann::json one_input = description();
  one_input["alpha"]["inputs"].erase(1);
  CHECK_THAT(refusal(one_input.dump()), Contains("a.model:8: an index is not an integer from 0 to 1: \"2\""));
  nlohmann::json no_domain = description();
  no_domain.erase("domain");
  CHECK_THAT(refusal(no_domain.dump()), Contains("missing field \"domain\""));
}
