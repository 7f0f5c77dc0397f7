// What every regression gives: a mapping, and how it was found.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "model/fit.hpp"
#include "table/table.hpp"

namespace remapc {

struct Regression {
  remap::MappingKind mapping;
  std::map<std::string, std::string> method;  // for the model card: hyper-parameters, search, starts
};

// Called now and then with the share of the work that is done, 0 to 1, from any thread. Throwing from it ends
// the regression. May be empty.
using FitProgress = std::function<void(double share)>;

// Throws kInput, the message opened by `kind`, for fewer than 10 rows, or where alpha1 or specular1 is the
// same in all.
void require_variety(const std::vector<TableRow>& rows, const std::string& kind);

// Whether target alpha varies with specular at fixed source alpha by more than its own scatter: the spread of
// alpha2 over the rows of one alpha1, against what a smooth curve over alpha1 leaves. Decides whether
// roughness is fitted from roughness alone.
bool alpha_needs_specular(const std::vector<TableRow>& rows);

// `id`, or where it is empty that of a converter between the models. Throws kUsage where it is no identifier.
std::string fit_id(const std::string& id, const std::string& source_model, const std::string& target_model);

}  // namespace remapc
