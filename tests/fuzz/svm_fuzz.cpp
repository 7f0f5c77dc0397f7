// Models of libsvm, of one input and of two.
#include "fit/svr/svm_model_file.hpp"
#include "fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = remap::text_of(data, size);
  for (const std::size_t inputs : {1u, 2u})
    remap::read_or_refuse([&] { remapc::expansion_from_svm_model(text, inputs, "svm.model"); });
  return 0;
}
