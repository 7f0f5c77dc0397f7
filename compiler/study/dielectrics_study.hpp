// Matches dielectrics (diffuse below a smooth coat) from Ashikhmin-Shirley to Ward in one, two and three
// stages (Sztrajman et al. 2019, section 4.1.2, figures 8 to 10).
#pragma once

#include <vector>

#include "study/material_study.hpp"
#include "table/table.hpp"

namespace remapc {

// Ward specular over the index of refraction, at one alpha and one number of stages. Differences are relative
// to the range of the two-stage curve at that alpha.
struct DielectricCurve {
  int stages = 0;
  double alpha = 0.0;
  double second_difference = 0.0;              // largest, between neighbors 0.05 apart in the index
  double largest_step = 0.0;                   // largest change of specular between neighbors
  double step_ior = 0.0;                       // upper index of that step
  double mean_error = 0.0, worst_error = 0.0;  // of the whole picture
  std::size_t rows = 0, unstable = 0, clamped = 0;
  double least_highlight = 1.0;  // smallest specular of a row, relative to two stages

  // Smooth curves have a second difference of about half a percent.
  bool jumps() const { return second_difference > 0.05; }
  bool loses_highlight() const { return least_highlight < 0.1; }
};

// The one-stage match from one fixed guess (as shares of the target's ranges). A row is lost if the match
// does not end in the best known minimum.
struct GuessTrial {
  RoleValues guess;
  double alpha = 0.0;  // of the source
  std::size_t rows = 0;
  std::size_t lost = 0;  // rows whose error exceeds that of three stages by more than 1 %
  double first_lost_ior = 0.0, last_lost_ior = 0.0;
  std::size_t jumps = 0;  // number of changes between found and lost along the index
};

struct DielectricsStudy {
  double diffuse = 0.0;
  std::vector<Table> stages;  // tables of 1, 2 and 3 stages; specular1 is the index
  std::vector<DielectricCurve> curves;
  std::vector<GuessTrial> trials;
  double error_gain = 0.0;        // mean relative reduction of the image error from two to three stages
  double worst_difference = 0.0;  // largest of specular, two to three stages, relative to the range
};

// Matches mitsuba/as-dielectric to mitsuba/ward in the setting of study_conductors. `diffuse`: reflectance of
// the source, 0 to 1.
DielectricsStudy study_dielectrics(const Renderer& renderer, const StudyOptions& options, double diffuse);

// The report of the study, with the tables stages1.csv, stages2.csv, stages3.csv, guesses.csv and
// dielectrics.csv (the measured materials in two stages), and figures 8 and 10 as figure8_10.svg.
StudyReport dielectrics_report(const DielectricsStudy& study);

}  // namespace remapc
