#include "report/set_preview.hpp"

#include <algorithm>
#include <atomic>

#include "core/errors.hpp"
#include "core/report_text.hpp"
#include "look/scene.hpp"
#include "report/contact_sheet.hpp"
#include "texremap/report/job_looks.hpp"

namespace remap {
namespace {

// Renders a material, and reports the finished fraction of its rows.
LitLooks lit(const MaterialLooks& looks, const RadiancePyramid& environment, const SetPreviewOptions& options,
             const std::function<void(double)>& progress) {
  std::atomic<int> rows = 0;
  SphereSampling sampling;
  sampling.resolution = options.resolution;
  sampling.samples = options.directions;
  sampling.progress = [&] { progress(static_cast<double>(++rows) / options.resolution); };
  return light(looks, environment, sampling);
}

std::string figure_text(const SetFigure& figure) {
  const auto text = [](const std::string& name, const PictureError& of) {
    return "\n" + name + ":\nerror " + fixed(100.0 * of.rms, 1) + " %\nSSIM " + fixed(of.ssim, 3);
  };
  return figure.name + (figure.copied ? text("copied", *figure.copied) : "") +
         text("converted", figure.converted);
}

// Reads the first materials of all jobs.
std::vector<MaterialLooks> first_looks(const ConvertPlan& plan, const JobLooks& looks,
                                       const SetPreviewOptions& options) {
  std::vector<MaterialLooks> shown;
  for (const Job& job : plan.list.jobs)
    for (MaterialLooks& material : looks.of(job, options.resolution, options.most_materials - shown.size()))
      shown.push_back(std::move(material));
  return shown;
}

}  // namespace

SetPreview preview_sets(const ConvertPlan& plan, const SetPreviewOptions& options) {
  if (plan.list.jobs.empty()) throw usage_error("preview: no texture set and no asset found");
  const JobLooks looks(plan);
  const std::vector<MaterialLooks> shown = first_looks(plan, looks, options);
  if (shown.empty()) throw usage_error("preview: the conversion changes no material");
  const bool has_copies =
      std::ranges::any_of(shown, [](const auto& look) { return look.copied.has_value(); });
  SetPreview preview;
  preview.notes = looks.notes();
  preview.copied_title = looks.copied_title();
  preview.labels.columns = {"source\n" + options.source};
  if (has_copies) preview.labels.columns.push_back(preview.copied_title + "\n" + options.target);
  preview.labels.columns.push_back("converted\n" + options.target);
  preview.sheet = contact_sheet(shown.size(), preview.labels.columns.size(), cell_side(options.resolution));
  const RadiancePyramid environment(std::span(&options.light, 1), kPreviewLightRows);
  const std::vector<std::uint32_t> places =
      pixels_of_cell(shape_pixels(Shape::kSphere, options.resolution), options.resolution);
  for (std::size_t row = 0; row < shown.size(); ++row) {
    const auto progress = [&](double share) {
      if (options.progress)
        options.progress((static_cast<double>(row) + share) / static_cast<double>(shown.size()));
    };
    const LitLooks pictures = lit(shown[row], environment, options, progress);
    for (std::size_t i = 0; i < pictures.pictures.size(); ++i) {
      const bool is_last = i + 1 == pictures.pictures.size();
      place_picture(&preview.sheet, cell_side(options.resolution), row,
                    is_last ? preview.labels.columns.size() - 1 : i, places, pictures.pictures[i].colors);
    }
    preview.figures.push_back({shown[row].name, pictures.copied, pictures.converted});
    preview.labels.rows.push_back(figure_text(preview.figures.back()));
  }
  return preview;
}

}  // namespace remap
