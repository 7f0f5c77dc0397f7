// Dielectrics, diffuse below a smooth coat, from Ashikhmin-Shirley to Ward in one, two and three stages
// (Sztrajman et al. 2019, section 4.1.2, figures 8 to 10).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "probe/picture_taker.hpp"
#include "study/study_sweep.hpp"
#include "table/table.hpp"

namespace remapc {

// Ward specular over the index of refraction, at one width by one strategy. Differences are relative to the
// range of the two-stage curve at that width.
struct DielectricCurve {
  int stages = 0;
  double alpha = 0.0;
  double second_difference = 0.0;  // largest second difference between neighbours 0.05 apart in the index
  double largest_step = 0.0;       // largest change of specular between neighbours
  double step_ior = 0.0;           // where it is: the upper of the two
  double mean_error = 0.0, worst_error = 0.0;  // image error of the whole picture
  std::size_t rows = 0, unstable = 0, clamped = 0;
  double least_highlight = 1.0;  // smallest specular of a row, relative to that of two stages

  // Smooth curves have a second difference of half a per cent.
  bool jumps() const { return second_difference > 0.05; }
  bool loses_highlight() const { return least_highlight < 0.1; }
};

// The one-stage match from another fixed guess (shares of the target's ranges): where it ends elsewhere than
// in the best minimum known.
struct GuessTrial {
  RoleValues guess;
  double alpha = 0.0;  // source width
  std::size_t rows = 0;
  std::size_t lost = 0;  // rows whose error is above that of three stages by more than 1 %
  double first_lost_ior = 0.0, last_lost_ior = 0.0;
  std::size_t jumps = 0;  // changes between found and lost along the index
};

struct DielectricsStudy {
  double diffuse = 0.0;
  std::vector<Table> stages;  // of 1, 2, 3 stages; specular1 is the index
  std::vector<DielectricCurve> curves;
  std::vector<GuessTrial> trials;
  double error_gain = 0.0;  // how much lower the image error of three stages is than of two: mean, relative
  double worst_difference = 0.0;  // of specular between two and three stages, relative to the curve's range
};

// mitsuba/as-dielectric to mitsuba/ward; light as for study_conductors.
DielectricsStudy study_dielectrics(const Renderer& renderer, const StudyOptions& options, double diffuse);

std::vector<std::string> dielectrics_words(const DielectricsStudy& study);

// Writes stages1.csv, stages2.csv, stages3.csv, guesses.csv, dielectrics.csv (the measured materials in two
// stages) and, where gnuplot is there, figure8_10.svg. The names of the files.
std::vector<std::string> write_dielectrics(const DielectricsStudy& study,
                                           const std::filesystem::path& folder);

}  // namespace remapc
