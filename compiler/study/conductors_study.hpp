// Converts metals from Ashikhmin-Shirley to Ward and back (Sztrajman et al. 2019, section 4.1.1, figures 6
// and 7). "Conserving Ward" is the model mitsuba/ward-conserving, which limits specular to 1.
#pragma once

#include <string>
#include <vector>

#include "study/material_study.hpp"
#include "table/table.hpp"

namespace remapc {

// One channel of one metal at one alpha, matched to conserving Ward from its F0 (Schlick's Fresnel) and from
// its index of refraction (exact Fresnel).
struct ConductorRow {
  std::string material;
  std::size_t channel = 0;
  double f0 = 0.0;
  TableRow by_f0, by_index;  // specular1 is F0 in both
};

// RMS difference between the pictures of one metal with Schlick's and with exact Fresnel, over all channels,
// relative to the RMS of the exact picture.
struct FresnelDifference {
  std::string material;
  double alpha = 0.0;
  double error = 0.0;
};

// One curve of figure 6.
struct ConductorCurve {
  double alpha = 0.0;
  std::size_t ok = 0, clamped = 0, other = 0;
  double line_deviation = 0.0;       // largest distance of an ok row from the fitted line, in specular
  double limit_f0 = 0.0;             // F0 at which that line reaches Ward specular 1
  double ok_alpha = 0.0;             // mean target alpha of the ok rows
  double clamped_alpha_shift = 0.0;  // largest relative difference between a clamped row's alpha and ok_alpha
};

struct RoundTrip {
  std::size_t rows = 0;
  double slope = 0.0;  // of F0 after the round trip over F0, least squares with an offset
  double offset = 0.0;
  double f0_deviation = 0.0;     // largest |F0 after the round trip - F0|
  double alpha_deviation = 0.0;  // largest difference in alpha
};

struct ConductorsStudy {
  std::vector<ConductorRow> rows;
  std::vector<ConductorCurve> curves;
  double plain_difference = 0.0;  // largest in alpha and specular, between Ward and conserving Ward
  RoundTrip round_trip;
  Table there, back;  // Ashikhmin-Shirley to conserving Ward, and the ok rows back
  std::vector<FresnelDifference> fresnel;
  double exact_specular_shift =
      0.0;  // largest relative difference of Ward specular, by_index to by_f0, ok rows
};

// Uses the paper's setting: light at 45 degrees, uniform weights.
ConductorsStudy study_conductors(const Renderer& renderer, const StudyOptions& options);

// The report of the study, with the tables conductors.csv, fresnel.csv, as_to_ward.csv and ward_to_as.csv,
// and figures 6 and 7 as figure6_7.svg.
StudyReport conductors_report(const ConductorsStudy& study);

}  // namespace remapc
