// What a generated header costs those who include it: bytes, and seconds of the compiler.
#include <cstdlib>
#include <filesystem>

#include "bench/bench.hpp"
#include "core/files.hpp"

namespace remap_bench {
namespace {

const std::filesystem::path kFolder = REMAP_BENCH_FOLDER;

std::string user_code(const std::string& code) {
  return "#include <cstddef>\n#include \"" + code + ".hpp\"\nusing header = remap::" + code +
         ";\n"
         "std::size_t convert(std::size_t count, header::Texels<const float> in, header::Texels<> out) {\n"
         "  return header::evaluate_batch(count, in, out);\n}\n"
         "header::Texel<> convert_one(header::Texel<> in) { return header::evaluate(in); }\n";
}

void add_compilation(const std::string& name, const std::string& text) {
  const std::filesystem::path source = kFolder / (name + "_user.cpp"), object = kFolder / (name + "_user.o");
  remap::write_file(source, text);
  const std::string command = "\"" REMAP_BENCH_COMPILER "\" -std=c++17 -O2 -c \"" + source.string() +
                              "\" -o \"" + object.string() + "\"";
  add_benchmark("compile/" + name, 1, 7, [command] {
    if (std::system(command.c_str()) != 0) std::abort();
  });
}

}  // namespace

void add_compilations() {
  add_compilation("empty", "");
  for (const std::string code : {"svr", "parametric", "mlp"}) add_compilation(code, user_code(code));
}

Section header_section(const Medians& medians) {
  Section section{"Headers: size; time to compile a file that uses one (-O2), more than an empty file", {}};
  const auto empty = medians.seconds("compile/empty");
  for (const std::string code : {"svr", "parametric", "mlp"}) {
    const auto seconds = medians.seconds("compile/" + code);
    if (!seconds || !empty) continue;
    const double size = static_cast<double>(std::filesystem::file_size(kFolder / (code + ".hpp"))) / 1024.0;
    section.rows.push_back({code + ", size", size, "KB", {}, "", 40.0, false});
    section.rows.push_back({code + ", compilation", *seconds - *empty, "s", {}, "", 0.5, false});
  }
  return section;
}

}  // namespace remap_bench
