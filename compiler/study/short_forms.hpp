// Chooses the constants of short forms and judges them by materials and lights that had no say.
#pragma once

#include <functional>
#include <vector>

#include "lights/environment.hpp"
#include "lights/lit_sphere.hpp"
#include "lower/fit.hpp"
#include "lower/short_form.hpp"
#include "study/conversions.hpp"

namespace remap {

struct ShortFormsOptions : SphereSampling {
  std::vector<StudyPair> pairs;
  std::vector<Environment> choosing, judging;  // lights of the choice, and of the figures
  std::vector<Fit> fits;                       // compiled converters to compare with
  std::vector<ShortForm> known;                // forms of which only the converters are judged
};

// All pairs of hub models, and the lobes of an exponent to `mitsuba/ggx` and back.
std::vector<StudyPair> short_pairs();

// Calls `finished` for each form.
void study_short_forms(const ShortFormsOptions& options,
                       const std::function<void(const ShortForm&)>& finished);

}  // namespace remap
