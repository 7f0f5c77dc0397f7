// Reads model files of libsvm (svm_save_model, svm-train): the text format of version 3, for regression.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "remap/mapping.hpp"

namespace remapc {

// Returns the sum of Gaussians in a model file with svm_type epsilon_svr or nu_svr and kernel_type rbf. Input
// k of the result is index k + 1 of the file; an index that a vector omits is 0. Scalings are identities,
// because the file does not state how its inputs were normalised.
//
// svm_load_model is not used, because it does not check counts and lengths and prints to standard error.
// `place`: file name for messages. Throws kInput with `place:line:` for another kind of model, a missing or
// repeated header line, an index above `input_count` or out of order, an invalid number, a number of vectors
// that differs from total_sv, and a last line without a line break.
remap::KernelExpansion expansion_from_svm_model(std::string_view text, std::size_t input_count,
                                                const std::string& place);

// The same for a file. Also throws kInput if the file cannot be read.
remap::KernelExpansion read_svm_model(const std::filesystem::path& path, std::size_t input_count);

}  // namespace remapc
