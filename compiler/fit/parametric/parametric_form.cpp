#include "fit/parametric/parametric_form.hpp"

#include "core/errors.hpp"

namespace remap {

bool ParametricForm::is_repeated(std::size_t term) const {
  return term > 0 && powers[term] == powers[term - 1];
}

ParametricForm find_form(const std::string& name) {
  if (name == "paper") return {"quartic", "slope", {4}, {1}, false};
  if (name == "paper+pole") return {"quartic", "slope+pole", {4}, {1}, true};
  throw usage_error("--form: unknown form '" + name + "' (choose paper or paper+pole)");
}

}  // namespace remap
