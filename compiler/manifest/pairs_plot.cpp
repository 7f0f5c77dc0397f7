// The plot is drawn without a plotting program, so that every machine gives the same bytes.
#include <algorithm>
#include <map>
#include <set>

#include "manifest/report.hpp"
#include "manifest/trust.hpp"
#include "model/interpreter.hpp"
#include "text/report_text.hpp"

namespace remapc {
namespace {

constexpr int kPanel = 116, kGap = 12, kMargin = 140, kTop = 40;
// Panels outside of the matrix carry their names above them.
constexpr int kSpokeTop = 40, kSpokeLabel = 26;
constexpr int kSteps = 48;
constexpr double kSpecular = 0.5, kLargestRatio = 2.0;

struct Place {
  double x, y;
};

std::string polyline(const Place& corner, const std::string& color, const remap::Range& alphas,
                     const auto& share_at) {
  std::string points;
  for (int i = 0; i <= kSteps; ++i) {
    const double alpha = alphas.min + (alphas.max - alphas.min) * i / kSteps;
    const double share = std::clamp(share_at(alpha), 0.0, 1.0);
    points += (points.empty() ? "" : " ") + fixed(corner.x + kPanel * alpha, 1) + "," +
              fixed(corner.y + kPanel * (1.0 - share), 1);
  }
  return "<polyline fill=\"none\" stroke=\"" + color + "\" stroke-width=\"1.5\" points=\"" + points +
         "\"/>\n";
}

std::string panel(const remap::Fit& fit, const Place& corner) {
  const double specular = std::min(kSpecular, fit.domain.specular.max);
  const std::string x = fixed(corner.x, 1), y = fixed(corner.y, 1), side = std::to_string(kPanel);
  std::string text = "<rect x=\"" + x + "\" y=\"" + y + "\" width=\"" + side + "\" height=\"" + side +
                     "\" fill=\"white\" stroke=\"#999\"/>\n<path d=\"M" + x + "," +
                     fixed(corner.y + kPanel, 1) + " l" + side + ",-" + side + "\" stroke=\"#ccc\"/>\n";
  text += polyline(corner, "#1f6fb4", fit.domain.alpha,
                   [&](double alpha) { return remap::evaluate_fit(fit, alpha, specular).alpha; });
  text += polyline(corner, "#e07b00", fit.domain.alpha, [&](double alpha) {
    return remap::evaluate_fit(fit, alpha, specular).specular / (specular * kLargestRatio);
  });
  return text;
}

std::string label(double x, double y, const std::string& anchor, const std::string& text) {
  return "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" text-anchor=\"" + anchor + "\">" + text +
         "</text>\n";
}

std::set<std::string> hub_models(const std::vector<remap::Fit>& fits) {
  std::map<std::string, std::set<std::string>> neighbours;
  for (const remap::Fit& fit : fits) {
    if (!is_measured(fit)) continue;
    neighbours[fit.source.model].insert(fit.target.model);
    neighbours[fit.target.model].insert(fit.source.model);
  }
  std::set<std::string> models;
  for (const auto& [model, others] : neighbours)
    if (others.size() > 1 || neighbours.at(*others.begin()).size() == 1) models.insert(model);
  return models;
}

}  // namespace

std::string pairs_plot(const std::vector<remap::Fit>& fits) {
  const std::set<std::string> hub = hub_models(fits);
  const std::vector<std::string> models(hub.begin(), hub.end());
  const auto place = [&](std::size_t row, std::size_t column) {
    return Place{kMargin + static_cast<double>(column) * (kPanel + kGap),
                 kTop + static_cast<double>(row) * (kPanel + kGap)};
  };
  std::vector<const remap::Fit*> pairs, spokes;  // within the hub, and to or from it
  for (const remap::Fit& fit : fits) {
    if (!is_measured(fit)) continue;
    (hub.contains(fit.source.model) && hub.contains(fit.target.model) ? pairs : spokes).push_back(&fit);
  }
  const std::size_t columns = std::max<std::size_t>(models.size(), 1);
  const auto spoke_place = [&](std::size_t i) {
    const Place cell = place(models.size() + i / columns, i % columns);
    return Place{cell.x, cell.y + kSpokeTop + static_cast<double>(i / columns) * kSpokeLabel};
  };
  const Place end = spokes.empty()
                        ? place(models.size(), columns)
                        : Place{place(0, columns).x, spoke_place(spokes.size() - 1).y + kPanel + kGap};
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + fixed(end.x, 1) + "\" height=\"" +
                     fixed(end.y, 1) + "\" font-family=\"sans-serif\" font-size=\"10\">\n" +
                     "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  for (std::size_t i = 0; i < models.size(); ++i) {
    text += label(place(0, i).x + 0.5 * kPanel, kTop - 8.0, "middle", models[i]);
    text += label(kMargin - 8.0, place(i, 0).y + 0.5 * kPanel, "end", models[i]);
  }
  const auto index = [&](const std::string& model) {
    return static_cast<std::size_t>(std::find(models.begin(), models.end(), model) - models.begin());
  };
  for (const remap::Fit* fit : pairs)
    text += panel(*fit, place(index(fit->source.model), index(fit->target.model)));
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    const Place corner = spoke_place(i);
    text += panel(*spokes[i], corner);
    text += label(corner.x + 0.5 * kPanel, corner.y - 16.0, "middle", spokes[i]->source.model);
    text += label(corner.x + 0.5 * kPanel, corner.y - 5.0, "middle", "to " + spokes[i]->target.model);
  }
  return text + "</svg>\n";
}

}  // namespace remapc
