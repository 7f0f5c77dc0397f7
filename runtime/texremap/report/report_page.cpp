#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "command_line/progress.hpp"
#include "convert/transfer.hpp"
#include "core/base64.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json_field.hpp"
#include "core/number_text.hpp"
#include "core/packed_values.hpp"
#include "look/brdf.hpp"
#include "look/environment.hpp"
#include "look/scene.hpp"
#include "remap/version.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/options/convert_options.hpp"
#include "texremap/report/job_looks.hpp"
#include "texremap/report/reporter.hpp"
#include "texremap/run/job_processes.hpp"
#include "texture/content_hash.hpp"
#include "texture/image_library.hpp"

namespace remap {

extern const std::string_view kReportHtml, kViewerStyle, kViewerScript;  // viewer_text.cpp.in

namespace {

constexpr std::size_t kMostMaterials = 16;
constexpr int kLargestSide = 1024;
constexpr std::size_t kMostTexels = 2 * kLargestSide * kLargestSide;  // of one map in all materials
constexpr int kStillSide = 192, kStillDirections = 96;                // of pictures without WebGL
constexpr std::size_t kLargestPng = 256 * 1024;                       // a larger image becomes JPEG
constexpr int kLightRows = 128;                                       // of the light that the viewer reads
constexpr int kJpegQuality = 85;

// These are the images of a page: data URIs by a hash of their bytes, so that the page holds equal images
// only once.
using PageImages = std::map<std::string, std::string>;

// Returns the key of an image.
std::string add_image(const ImagePixels& pixels, PageImages& images) {
  const ImageCodec& codec = image_library().codec();
  std::string bytes = codec.encode_png(pixels, kUsualPngLevel), type = "png";
  if (bytes.size() > kLargestPng && !pixels.has_alpha()) try {
      bytes = codec.encode_jpeg(pixels, kJpegQuality), type = "jpeg";
    } catch (const Error&) {  // a host that only writes PNG
    }
  ContentHash hash;
  hash.add(bytes);
  const std::string key = hash.hex().substr(0, 16);
  images.emplace(key, "data:image/" + type + ";base64," + base64(bytes));
  return key;
}

// A ShownJob is what the page shows of a job. It comes from the process that has read the job's files.
struct ShownJob {
  std::vector<std::string> materials;  // JSON of each
  PageImages images;
  std::string trouble;  // why the job is not shown, or empty
};
template <typename Archive>
void fields(Archive& archive, ShownJob& job) {
  archive(job.materials, job.images, job.trouble);
}

// Returns an image of rows of linear values times `factor`: one row is grey, three are red, green, blue.
ImagePixels pixels_of(const std::vector<std::vector<float>>& rows, int width, Transfer transfer,
                      float factor = 1.0f) {
  const std::size_t count = rows.front().size();
  ImagePixels pixels{static_cast<std::size_t>(width), count / static_cast<std::size_t>(width), rows.size(),
                     PixelType::kUint8, std::vector<std::byte>(rows.size() * count)};
  std::vector<float> scaled(count);
  for (std::size_t c = 0; c < rows.size(); ++c) {
    for (std::size_t i = 0; i < count; ++i) scaled[i] = factor * rows[c][i];
    store_linear(transfer, PixelType::kUint8, scaled.data(), count, pixels.bytes.data() + c, rows.size());
  }
  return pixels;
}

float largest_of(const std::vector<std::vector<float>>& rows) {
  float largest = 0.0f;
  for (const auto& row : rows)
    for (const float value : row)
      if (std::isfinite(value)) largest = std::max(largest, value);
  return largest;
}

// Returns the maps of one side as they are stored. Exponents are shown as parts of the largest.
Json maps_json(const ScaledMaps& maps, PageImages& images) {
  Json list = Json::list();
  for (const auto& [parameter, rows] : maps.rows) {
    if (rows.empty()) continue;
    const bool is_color_map = is_color(parameter);
    const float largest = largest_of(rows);
    const bool is_scaled = largest > 1.0f;
    std::string name = parameter == Parameter::kRoughness ? std::string(encoding_name(maps.encoding))
                                                          : std::string(parameter_name(parameter));
    std::ranges::replace(name, '_', ' ');
    if (is_scaled) name += " (white is " + number_text(largest) + ")";
    const ImagePixels pixels = pixels_of(rows, maps.width, is_color_map ? Transfer::kSrgb : Transfer::kLinear,
                                         is_scaled ? 1.0f / largest : 1.0f);
    list.push_back({{"name", name},
                    {"image", add_image(pixels, images)},
                    {"width", maps.full_width},
                    {"height", maps.full_height},
                    {"shown_width", maps.width}});
  }
  return list;
}

std::string add_still(const DisplayedSphere& picture, PageImages& images) {
  const auto side = static_cast<std::size_t>(kStillSide);
  ImagePixels pixels{side, side, 4, PixelType::kUint8, std::vector<std::byte>(4 * side * side)};
  const std::vector<std::uint32_t> places = shape_pixels(Shape::kSphere, kStillSide);
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::byte* texel = &pixels.bytes[4 * static_cast<std::size_t>(places[i])];
    for (std::size_t c = 0; c < 3; ++c)
      texel[c] = static_cast<std::byte>(std::lround(255.0f * picture.colors[3 * i + c]));
    texel[3] = std::byte{255};
  }
  return add_image(pixels, images);
}

// Returns a look as the viewer shades it. The image of roughness holds the root of alpha.
Json look_json(const std::string& title, const TexturedBall& ball, const DisplayedSphere& picture,
               const PictureError* error, PageImages& images) {
  std::vector<std::vector<float>> roughness(1), specular(3), diffuse(3);
  for (const BallTexel& texel : ball.texels) {
    roughness[0].push_back(static_cast<float>(std::sqrt(texel.alpha)));
    for (std::size_t c = 0; c < 3; ++c) {
      specular[c].push_back(static_cast<float>(texel.specular[c]));
      diffuse[c].push_back(static_cast<float>(texel.diffuse[c]));
    }
  }
  const float range = std::max(1.0f, largest_of(specular));
  Json json = {{"title", title},
               {"model", ball.name},
               {"brdf", glsl_name(ball.model.brdf)},
               {"schlick", ball.model.fresnel == Fresnel::kSchlick},
               {"range", range}};
  json["roughness"] = add_image(pixels_of(roughness, ball.width, Transfer::kLinear), images);
  json["specular"] = add_image(pixels_of(specular, ball.width, Transfer::kSrgb, 1.0f / range), images);
  if (largest_of(diffuse) > 0.0f)
    json["diffuse"] = add_image(pixels_of(diffuse, ball.width, Transfer::kSrgb), images);
  json["still"] = add_still(picture, images);
  if (error != nullptr) {
    json["rms"] = error->rms;
    json["ssim"] = error->ssim;
  }
  return json;
}

// Returns the light as RGBE (Ward 1991), row by row from the top.
Json light_json(const Image& map) {
  std::string bytes;
  for (std::size_t i = 0; i < map.values.size(); i += 3) {
    const float largest = std::max({map.values[i], map.values[i + 1], map.values[i + 2], 1e-9f});
    int exponent = 0;
    std::frexp(largest, &exponent);
    for (std::size_t c = 0; c < 3; ++c)
      bytes += static_cast<char>(static_cast<int>(std::ldexp(map.values[i + c], 8 - exponent)));
    bytes += static_cast<char>(exponent + 128);
  }
  return {{"width", map.width}, {"height", map.height}, {"rgbe", base64(bytes)}};
}

// Returns `text` with each `%NAME%` replaced. Values are not searched, because they may hold names of files.
std::string filled(std::string_view text, const std::map<std::string_view, std::string>& values) {
  std::string result;
  while (!text.empty()) {
    const std::size_t begin = text.find('%'), end = begin == text.npos ? begin : text.find('%', begin + 1);
    if (end == text.npos) break;
    const auto value = values.find(text.substr(begin + 1, end - begin - 1));
    const bool is_known = value != values.end();
    result += text.substr(0, is_known ? begin : begin + 1);
    if (is_known) result += value->second;
    text.remove_prefix(is_known ? end + 1 : begin + 1);
  }
  return result += text;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '<')
      result += "&lt;";
    else if (letter == '>')
      result += "&gt;";
    else if (letter == '&')
      result += "&amp;";
    else
      result += letter;
  }
  return result;
}

// Returns JSON for a script element, which ends at the first `</script`.
std::string script_text(const Json& json) {
  std::string text = json.dump(), result;
  for (const char letter : text) result += letter == '<' ? std::string("\\u003c") : std::string(1, letter);
  return result;
}

// Returns the studio with mean luminance 1.
Environment studio_light() {
  Environment studio = builtin_environments(kLightRows).back();
  const double luminance = mean_luminance(studio);
  return exposed(std::move(studio), 1.0 / luminance);
}

// Adds normals as pictures store them: x, y and z from 0 to 1.
std::string add_normals(const Image& normals, PageImages& images) {
  std::vector<std::vector<float>> stored(3);
  for (std::size_t i = 0; i < normals.values.size(); ++i)
    stored[i % 3].push_back(0.5f + 0.5f * normals.values[i]);
  return add_image(pixels_of(stored, normals.width, Transfer::kLinear), images);
}

Json material_json(const MaterialLooks& looks, const std::string& copied_title, const LitLooks& lit,
                   PageImages& images) {
  Json json = {{"name", looks.name}};
  json["looks"] = Json::list();
  const auto add = [&](const std::string& title, const TexturedBall& ball, const DisplayedSphere& picture,
                       const PictureError* error) {
    json["looks"].push_back(look_json(title, ball, picture, error, images));
  };
  add("source", looks.source, lit.pictures[0], nullptr);
  if (looks.copied) add(copied_title, *looks.copied, lit.pictures[1], &*lit.copied);
  add("converted", looks.converted, lit.pictures.back(), &lit.converted);
  json["outside"] = looks.outside;
  if (!looks.normals.values.empty()) json["normal"] = add_normals(looks.normals, images);
  json["maps"] = {{"before", maps_json(looks.before, images)}, {"after", maps_json(looks.after, images)}};
  return json;
}

class ReportPage {
 public:
  ReportPage(const ConvertPlan& plan, const std::vector<JobReport>& reports)
      : plan_(plan), side_(side_of_maps(plan, reports)), looks_(plan) {}

  std::string html() {
    add_materials();
    if (json_["materials"].empty())
      throw input_error("--report: no material can be shown" +
                        (notes_.empty() ? " (the conversion changed none)" : ": " + notes_.front()));
    std::vector<std::string> notes = plan_.messages;
    for (const std::string& note : looks_.notes()) notes.push_back("note: " + note);
    notes.insert(notes.end(), notes_.begin(), notes_.end());
    json_["command"] = plan_.command;
    json_["light"] = light_json(environment_.map);
    json_["notes"] = notes;
    for (const auto& [key, url] : images_) json_["images"][key] = url;
    return filled(kReportHtml, {{"TITLE", escaped(title())},
                                {"VERSION", std::string("texremap ") + kVersion},
                                {"STYLE", std::string(kViewerStyle)},
                                {"SCRIPT", std::string(kViewerScript)},
                                {"DATA", script_text(json_)}});
  }

 private:
  std::string title() const {
    const std::vector<Job>& jobs = plan_.list.jobs;
    const std::string source = plan_.sets() != nullptr ? plan_.conversion.source
                               : jobs.size() == 1      ? display_path(jobs.front().name)
                                                       : counted(jobs.size(), "asset");
    return source + " to " + plan_.conversion.target;
  }

  // Returns the width of the largest maps that the page can hold.
  static int side_of_maps(const ConvertPlan& plan, const std::vector<JobReport>& reports) {
    std::size_t materials = 0;
    for (const JobReport& report : reports)
      materials += plan.sets() != nullptr ? 1 : report.count(MaterialState::kConverted);
    const double most = std::sqrt(static_cast<double>(kMostTexels) /
                                  static_cast<double>(std::clamp<std::size_t>(materials, 1, kMostMaterials)));
    int side = kLargestSide;
    while (side > most) side /= 2;
    return side;
  }

  // Reads the files in separate processes, as the conversion does, because a hostile file may crash a
  // decoder.
  void add_materials() {
    const std::vector<Job>& jobs = plan_.list.jobs;
    ApartJobs apart;
    apart.count = std::min(jobs.size(), kMostMaterials);
    apart.at_once = static_cast<unsigned>(std::min(apart.count, static_cast<std::size_t>(plan_.threads)));
    std::vector<ShownJob> shown(apart.count);
    Progress progress("report", apart.count, !plan_.quiet);
    apart.work = [&](std::size_t i, const std::function<void(double)>&) {
      return packed(shown_job(jobs[i]));
    };
    apart.finished = [&](std::size_t i, std::string result) {
      shown[i] = unpacked<ShownJob>(std::move(result));
      progress.advance();
    };
    apart.crashed = [&](std::size_t i, const std::string& reason) {
      shown[i].trouble = display_path(jobs[i].name) + ": " + reason;
      progress.advance();
    };
    run_apart(apart);
    json_["materials"] = Json::list();
    bool is_cut = jobs.size() > kMostMaterials;
    for (ShownJob& job : shown) {
      if (!job.trouble.empty()) notes_.push_back(job.trouble);
      images_.merge(job.images);
      for (const std::string& material : job.materials) {
        is_cut |= json_["materials"].size() == kMostMaterials;
        if (json_["materials"].size() < kMostMaterials)
          json_["materials"].push_back(parse_json(material, "report"));
      }
    }
    if (is_cut) notes_.push_back("only the first " + std::to_string(kMostMaterials) + " materials are shown");
  }

  ShownJob shown_job(const Job& job) const {
    ShownJob shown;
    try {
      SphereSampling sampling;
      sampling.resolution = kStillSide;
      sampling.samples = kStillDirections;
      sampling.jobs = 1;
      const auto render = [&](std::span<const TexturedBall> balls, const Image& normals) {
        return render_textured(pyramid_, balls, normals, sampling);
      };
      for (const MaterialLooks& looks : looks_.of(job, side_, kMostMaterials))
        shown.materials.push_back(
            material_json(looks, looks_.copied_title(), light(looks, render, kStillSide), shown.images)
                .dump());
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      shown.trouble = error.what();
    }
    return shown;
  }

  const ConvertPlan& plan_;
  const int side_;
  const JobLooks looks_;
  const Environment environment_ = studio_light();
  const RadiancePyramid pyramid_{std::span(&environment_, 1), kPreviewLightRows};
  PageImages images_;
  std::vector<std::string> notes_;
  Json json_;
};

}  // namespace

void write_report_page(const ConvertPlan& plan, const std::vector<JobReport>& reports) {
  try {
    write_file(plan.report, ReportPage(plan, reports).html());
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    say("warning: " + std::string(error.what()));
  }
}

}  // namespace remap
