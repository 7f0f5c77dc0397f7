// Model files of libsvm (svm_save_model, svm-train): the text format of version 3, for regression.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "model/mapping.hpp"

namespace remapc {

// The sum of Gaussians in a model file: svm_type epsilon_svr or nu_svr, kernel_type rbf. Input k of the model
// (index k + 1 of the file) becomes input k of the result; an index that a vector leaves out is 0. Scalings
// are identities: the file does not say how its inputs were normalised.
//
// The text is read here and not by svm_load_model, which trusts counts and lengths and prints to standard
// error. `place` (a file name) opens every message. Throws kInput with `place:line:` for another kind of
// model, a missing or repeated line of the header, an index beyond `input_count` or out of order, a number
// that is none or not finite, more or fewer vectors than total_sv says, a last line without its end.
remap::KernelExpansion expansion_from_svm_model(std::string_view text, std::size_t input_count,
                                                const std::string& place);

// The same for a file. Throws kInput where it cannot be read.
remap::KernelExpansion read_svm_model(const std::filesystem::path& path, std::size_t input_count);

}  // namespace remapc
