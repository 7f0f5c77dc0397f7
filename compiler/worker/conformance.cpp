#include "worker/conformance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "remap/error.hpp"
#include "text/number_text.hpp"
#include "worker/picture_measures.hpp"

namespace remapc {
namespace {

using remap::number_text;
using Verdict = WorkerFinding::Verdict;

constexpr Light kHeadlight{}, kAside{60.0, 3.0}, kFar{0.0, 6.0};

// Pictures that differ by more are different; half floats are exact to 5e-4.
constexpr double kSamePicture = 2e-3;
// A larger difference in the light's strength is a wrong constant, not rounding.
constexpr double kSameLight = 2e-3;
// A diffuse lobe that differs by more from Lambert's law is another lobe.
constexpr double kLambertian = 0.02;

std::string percent(double share) { return number_text(remap::rounded_up(100.0 * share, 2)) + " %"; }

// Names the constants that renderers put between their unit of light and radiant intensity.
std::string known_factor(double found) {
  const double pi = std::numbers::pi;
  for (const auto& [value, name] :
       {std::pair{pi, "pi"}, std::pair{1.0 / pi, "1 / pi"}, std::pair{4.0 * pi, "4 pi"},
        std::pair{0.25 / pi, "1 / (4 pi)"}, std::pair{4.0, "4"}, std::pair{0.25, "1 / 4"}})
    if (std::fabs(found / value - 1.0) < 0.01) return std::string(" (") + name + ")";
  return "";
}

class ModelCheck {
 public:
  ModelCheck(Worker& worker, const ModelDescription& model, int resolution,
             std::vector<WorkerFinding>* findings)
      : worker_(worker), model_(model), resolution_(resolution), findings_(findings) {}

  void run() {
    try {
      check_refusals();
      check_geometry();
      check_light();
      check_values();
      check_repeats();
      check_samples();
      check_color();
      check_width();
    } catch (const remap::Error& error) {
      if (error.kind() != remap::ErrorKind::kInput) throw;
      add("answer", Verdict::kWrong, error.what());
    }
  }

 private:
  void add(const std::string& check, Verdict verdict, const std::string& words) {
    findings_->push_back({model_.name, check, verdict, words});
  }

  // A check with a pass, of which `found` says more, and a fault.
  void judge(const std::string& check, bool good, const std::string& found, const std::string& fault) {
    add(check, good ? Verdict::kGood : Verdict::kWrong, good ? found : fault);
  }

  double most(ParameterRole role) const { return model_.parameter(role).range.max; }
  bool has_diffuse() const { return model_.has(ParameterRole::kDiffuse); }

  // A highlight of the given width at full specular, without diffuse.
  Material highlight(double alpha) const {
    return grey_material(model_, std::clamp(alpha, model_.alpha.min, model_.alpha.max),
                         most(ParameterRole::kSpecular), 0.0);
  }
  // The same width with diffuse, and with the smallest specular.
  Material paint(double diffuse) const {
    return grey_material(model_, wide_, model_.parameter(ParameterRole::kSpecular).range.min, diffuse);
  }

  Image take(const Material& material, const Light& light, int seed = 0, int enlarged = 1, int samples = 1) {
    return worker_.render(picture_request(material, Scene{enlarged * resolution_, samples, light, seed}));
  }

  // The light that diffuse adds.
  Image diffuse_picture(double diffuse, const Light& light) {
    Image lit = take(paint(diffuse), light);
    const Image dark = take(paint(0.0), light);
    for (std::size_t i = 0; i < lit.values.size(); ++i) lit.values[i] -= dark.values[i];
    return lit;
  }

  void check_refusals() {
    Material outside = highlight(wide_);
    const ParameterDescription& specular = model_.parameter(ParameterRole::kSpecular);
    outside.parameters[specular.name] = {specular.range.max + 1.0};
    refuses("range", outside,
            specular.name + " = " + number_text(specular.range.max + 1.0) +
                " was rendered, but is out of range (answer with an error)");
    Material unknown = highlight(wide_);
    unknown.model += "-which-is-none";
    refuses("unknown model", unknown, unknown.model + " was rendered, but is unknown (answer with an error)");
  }

  void refuses(const std::string& check, const Material& material, const std::string& otherwise) {
    try {
      take(material, kHeadlight);
    } catch (const remap::Error&) {
      if (!worker_.is_usable()) throw;
      add(check, Verdict::kGood, "refused");
      return;
    }
    add(check, Verdict::kWrong, otherwise);
  }

  // Checks where the light is: background, symmetry, left and right.
  void check_geometry() {
    const Image front = take(highlight(wide_), kHeadlight);
    const double top = brightest(front);
    if (!(top > 0.0)) {
      add("highlight", Verdict::kWrong, "the picture at full specular is black under a headlight");
      return;
    }
    const double outside = brightest(front, true);
    judge("background", outside <= 1e-6 * top, "black",
          "pixels outside the sphere are up to " + number_text(outside) +
              ", not 0: wrong field of view, or an environment");
    const double rows = difference(front, flipped(front, true)),
                 columns = difference(front, flipped(front, false));
    const double uneven = model_.noise ? 0.0 : std::max(rows, columns);
    judge("symmetry", uneven <= kSamePicture, "to " + percent(uneven),
          "under a headlight the " + std::string(rows >= columns ? "upper and lower" : "left and right") +
              " halves differ by " + percent(uneven) +
              ": the picture is shifted, often by one pixel, or the sphere is a mesh");
    const Centroid place = centroid(take(highlight(wide_), kAside));
    std::string words = "a light at +60 degrees lights ";
    words += std::fabs(place.y) > std::fabs(place.x) ? (place.y > 0.0 ? "the top" : "the bottom")
             : place.x < -0.1                        ? "the left"
                                                     : "the middle";
    words += " of the picture, not the right: ";
    words += std::fabs(place.y) > std::fabs(place.x) ? "rows and columns are exchanged"
             : place.x < -0.1 ? "columns run from +x to -x, or the light turns the other way"
                              : "the light does not move";
    judge("orientation", place.x > 0.1 && std::fabs(place.y) < 0.05, "a light at +60 degrees is on the right",
          words);
  }

  // Compares diffuse light with Lambert's law: intensity, inverse square, linearity.
  void check_light() {
    if (!has_diffuse()) {
      add("light scale", Verdict::kRemark, "unknown: the model has no diffuse parameter");
      return;
    }
    const double full = most(ParameterRole::kDiffuse);
    const Image near = diffuse_picture(full, kHeadlight),
                unit = lambertian(Scene{resolution_, 1, kHeadlight});
    const double scale = factor(near, unit) / full;
    if (!(scale > 0.0)) {
      add("light scale", Verdict::kWrong, "diffuse adds no light");
      return;
    }
    Image scaled = unit;
    for (float& value : scaled.values) value = static_cast<float>(value * scale * full);
    const double left = difference(near, scaled);
    if (left > kLambertian)
      add("light scale", Verdict::kRemark,
          "the diffuse lobe is not Lambertian (" + percent(left) + " left); the best Lambertian lobe is " +
              number_text(remap::rounded(scale, 4)) + " times as bright as it should be");
    else if (std::fabs(scale - 1.0) > kSameLight)
      add("light scale", Verdict::kWrong,
          "diffuse light is " + number_text(remap::rounded(scale, 4)) + " times as strong as it should be" +
              known_factor(scale) + "; the light must have a radiant intensity of 1");
    else
      add("light scale", Verdict::kGood, "within " + percent(std::fabs(scale - 1.0)));
    check_distance(near, unit);
    check_linearity(near, full);
  }

  void check_distance(const Image& near, const Image& unit) {
    const Image far = diffuse_picture(most(ParameterRole::kDiffuse), kFar);
    const double found = factor(far, near), expected = factor(lambertian(Scene{resolution_, 1, kFar}), unit);
    judge("inverse square", std::fabs(found / expected - 1.0) < 0.01, "holds",
          "a light twice as far is " + number_text(remap::rounded(found, 3)) + " times as bright, not " +
              number_text(remap::rounded(expected, 3)));
  }

  void check_linearity(const Image& whole, double full) {
    const double half = factor(diffuse_picture(0.5 * full, kHeadlight), whole);
    const double exponent = std::log(half) / std::log(0.5);
    judge("linearity", std::fabs(half - 0.5) < 1e-3, "half the diffuse is half the light",
          "half the diffuse gives " + number_text(remap::rounded(half, 3)) +
              " of the light, not 0.5: a tone curve or display gamma of about " +
              number_text(remap::rounded(exponent > 1.0 ? exponent : 1.0 / exponent, 2)));
  }

  // Checks what storage or tone mapping did to the values.
  void check_values() {
    const Image sharp = take(highlight(0.1), kHeadlight);
    const std::size_t flat = count_of_brightest(sharp);
    judge("clamping", brightest(sharp) != 1.0 || flat <= 4,
          "none seen up to " + number_text(remap::rounded(brightest(sharp), 3)),
          std::to_string(flat) + " pixels of a highlight are exactly 1: values are clamped");
    const std::string coarse = coarse_values(sharp);
    if (coarse == "8 bits")
      add("precision", Verdict::kWrong, "values have 8 bits (write floats)");
    else if (!coarse.empty())
      add("precision", Verdict::kRemark, "values are " + coarse + ": steps of 0.05 %");
    else
      add("precision", Verdict::kGood, "floats");
  }

  // Renders the same picture with another between, and the same with another seed.
  void check_repeats() {
    const Image first = take(highlight(0.3), kAside);
    take(highlight(wide_), kHeadlight);
    const double again = difference(first, take(highlight(0.3), kAside));
    judge("repeatability", !(again > 0.0), "bit for bit",
          "the same request gives pictures that differ by " + percent(again) +
              ": noise must depend on the seed only, and requests must not affect later ones");
    const double noise = difference(first, take(highlight(0.3), kAside, 1));
    if (noise > 0.0 && !model_.noise)
      add("noise", Verdict::kWrong,
          "another seed gives a picture that differs by " + percent(noise) +
              " (describe the model with \"noise\": true, or remove the noise)");
    else if (noise > 0.0)
      add("noise", Verdict::kRemark, percent(noise) + " between two seeds");
    else
      add("noise", Verdict::kGood, "none");
  }

  // The pixel centres of a picture are among those of a picture three times as large.
  void check_samples() {
    if (model_.noise) {
      add("pixel centres", Verdict::kRemark, "not checked: the model has noise");
      return;
    }
    const Material material = highlight(0.2);
    const Image small = take(material, kAside), large = take(material, kAside, 0, 3);
    const double jitter = difference(small, every_third(large));
    judge("pixel centres", jitter <= kSamePicture, "to " + percent(jitter),
          "pixels differ by " + percent(jitter) +
              " from those of a larger picture with the same centres: jitter in the pixel, a filter, or a "
              "shifted picture");
    const double grid = difference(take(material, kAside, 0, 1, 3), mean_of_nine(large));
    judge("pixel grid", grid <= kSamePicture, "to " + percent(grid),
          "3 x 3 samples in a pixel differ by " + percent(grid) +
              " from the mean of nine pixels (sample an even grid)");
  }

  // Checks that channels are independent and in order.
  void check_color() {
    Material colored = highlight(wide_);
    const ParameterDescription& specular = model_.parameter(ParameterRole::kSpecular);
    const auto at = [&](double share) {
      return specular.range.min + share * (specular.range.max - specular.range.min);
    };
    const std::array values = {at(1.0), at(0.5), at(0.25)};
    colored.parameters[specular.name] = {values[0], values[1], values[2]};
    Image picture;
    try {
      picture = take(colored, kHeadlight);
    } catch (const remap::Error& error) {
      if (!worker_.is_usable()) throw;
      add("color", Verdict::kRemark, "none in " + specular.name + ": " + error.what());
      return;
    }
    std::string wrong;
    for (int c = 0; c < 3; ++c) {
      Material grey = highlight(wide_);
      grey.parameters[specular.name] = {values[static_cast<std::size_t>(c)]};
      const double off = difference(take(grey, kHeadlight), channel(picture, c));
      if (off > kSamePicture && wrong.empty())
        wrong = "channel " + std::to_string(c) + " differs by " + percent(off) +
                " from a grey picture of its value; channels must be red, green, blue and independent";
    }
    judge("color", wrong.empty(), "red, green, blue", wrong);
  }

  // A wider highlight has more light relative to its peak.
  void check_width() {
    const auto spread = [&](double alpha) {
      const Image image = take(highlight(alpha), kHeadlight);
      double sum = 0.0;
      for (std::size_t i = 0; i < image.values.size(); ++i) sum += static_cast<double>(image.values[i]);
      return sum / std::max(brightest(image), 1e-30);
    };
    judge("width", spread(0.15) < spread(0.3) && spread(0.3) < spread(0.6),
          "a larger alpha is a wider highlight",
          "highlights do not widen from alpha 0.15 to 0.3 and 0.6 (check the convention)");
  }

  static constexpr double wide_ = 0.5;
  Worker& worker_;
  const ModelDescription& model_;
  int resolution_;
  std::vector<WorkerFinding>* findings_;
};

}  // namespace

std::vector<WorkerFinding> check_worker(Worker& worker, int resolution) {
  std::vector<WorkerFinding> findings;
  for (const ModelDescription& model : worker.description().models) {
    ModelCheck(worker, model, resolution, &findings).run();
    if (!worker.is_usable()) break;
  }
  return findings;
}

}  // namespace remapc
