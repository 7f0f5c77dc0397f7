// Metals from Ashikhmin-Shirley to Ward and back (Sztrajman et al. 2019, section 4.1.1, figures 6 and 7).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/renderer.hpp"
#include "study/study_sweep.hpp"
#include "table/table.hpp"

namespace remapc {

// One channel of one metal at one width, remapped to Ward that trims, by its F0 (Schlick's Fresnel) and by
// its index (exact Fresnel).
struct ConductorRow {
  std::string material;
  std::size_t channel = 0;
  double f0 = 0.0;
  TableRow by_f0, by_index;  // specular1 is F0 in both
};

// How far Schlick's picture of one metal is from that of exact Fresnel, all channels: RMS relative to exact.
struct FresnelDifference {
  std::string material;
  double alpha = 0.0;
  double error = 0.0;
};

// Figure 6 at one width.
struct ConductorCurve {
  double alpha = 0.0;
  std::size_t ok = 0, clamped = 0, other = 0;
  double line_deviation = 0.0;       // largest distance of an ok row from their straight line, in specular
  double limit_f0 = 0.0;             // F0 whose Ward specular is 1, by that line
  double ok_alpha = 0.0;             // mean target width of ok rows
  double clamped_alpha_shift = 0.0;  // largest relative distance of a clamped row's target width from it
};

struct RoundTrip {
  std::size_t rows = 0;
  double slope = 0.0;  // F0 that came back against F0, least squares with an offset
  double offset = 0.0;
  double f0_deviation = 0.0;     // largest |F0 that came back - F0|
  double alpha_deviation = 0.0;  // the same of alpha
};

struct ConductorsStudy {
  std::vector<ConductorRow> rows;
  std::vector<ConductorCurve> curves;
  double plain_difference = 0.0;  // largest, of alpha and specular, between Ward and Ward that trims
  RoundTrip round_trip;
  Table there, back;  // the sweeps: Ashikhmin-Shirley to Ward that trims, and its ok rows back
  std::vector<FresnelDifference> fresnel;
  double exact_specular_shift = 0.0;  // largest relative, Ward specular by index against by F0, ok rows
};

// Light at 45 degrees, uniform weights, as the paper has it.
ConductorsStudy study_conductors(const Renderer& renderer, const StudyOptions& options);

// What was found, one statement each.
std::vector<std::string> conductors_words(const ConductorsStudy& study);

// Writes conductors.csv, as_to_ward.csv, ward_to_as.csv, fresnel.csv and, where gnuplot is there,
// figure6_7.svg. The names of the files.
std::vector<std::string> write_conductors(const ConductorsStudy& study, const std::filesystem::path& folder);

}  // namespace remapc
