#include "worker/worker.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/input_file.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "look/scene.hpp"
#include "remap/error.hpp"
#include "worker/folders.hpp"
#include "worker/protocol.hpp"

namespace remap {
namespace {

// With these counts, the sagitta r (1 - cos(pi / n)) of both circles is below 1e-4.
constexpr std::uint32_t kRound = 384, kTube = 192;

static_assert(std::endian::native == std::endian::little, "meshes are written in memory order");

template <typename Value>
void append(std::string* bytes, Value value) {
  char raw[sizeof(Value)];
  std::memcpy(raw, &value, sizeof(Value));
  bytes->append(raw, sizeof(Value));
}

void append_vertex(std::string* bytes, double around, double tube) {
  const double tilt = kTorusTilt * std::numbers::pi / 180.0;
  // `height` is measured along the axis of the torus
  const auto world = [&](double a, double b, double height) {
    for (const double value :
         {a, b * std::cos(tilt) + height * std::sin(tilt), height * std::cos(tilt) - b * std::sin(tilt)})
      append(bytes, static_cast<float>(value));
  };
  const double ca = std::cos(around), sa = std::sin(around), ct = std::cos(tube), st = std::sin(tube);
  const double radius = kTorusRadius + kTubeRadius * ct;
  world(radius * ca, radius * sa, kTubeRadius * st);
  world(ct * ca, ct * sa, st);
}

void append_triangle(std::string* bytes, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  append(bytes, static_cast<unsigned char>(3));
  for (const std::uint32_t vertex : {a, b, c}) append(bytes, static_cast<std::int32_t>(vertex));
}

// Writes the torus (scene.hpp) as a PLY file: binary, little endian, vertices with normals, triangles
// counter-clockwise from outside. Facets deviate by at most 1e-4 of the sphere's radius. Throws kOutput.
// Throws kUsage for the sphere, which renderers make themselves.
void write_mesh(Shape shape, const std::filesystem::path& path) {
  if (shape == Shape::kSphere) throw usage_error("mesh: the sphere has none (choose another shape)");
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(kRound * kTube);
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) bytes += std::string("\nproperty float ") + name;
  bytes += "\nelement face " + std::to_string(2 * kRound * kTube) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::uint32_t i = 0; i < kRound; ++i)
    for (std::uint32_t j = 0; j < kTube; ++j)
      append_vertex(&bytes, 2.0 * std::numbers::pi * i / kRound, 2.0 * std::numbers::pi * j / kTube);
  const auto vertex = [](std::uint32_t i, std::uint32_t j) { return i % kRound * kTube + j % kTube; };
  for (std::uint32_t i = 0; i < kRound; ++i)
    for (std::uint32_t j = 0; j < kTube; ++j) {
      append_triangle(&bytes, vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      append_triangle(&bytes, vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  write_file(path, bytes);
}

using std::chrono::duration;
using std::chrono::duration_cast;

// A wait checks this often for an interruption.
constexpr std::chrono::milliseconds kGlance{100};

// These limit parts of a message, so that it has room for the place and for how to install the worker.
constexpr std::size_t kLongestWhat = 1000, kLongestLog = 500;

// Returns the last line of a log, which is the most useful.
std::string end_of(const std::string& log) {
  return log.size() <= kLongestLog ? log : "..." + log.substr(log.size() - kLongestLog);
}

constexpr const char* kFolderAdvice =
    "; a worker on another machine needs a folder that both can write to (--worker-folder FOLDER)";

std::string without(const std::string& opening, const std::string& text) {
  return text.starts_with(opening) ? text.substr(opening.size()) : text;
}

std::string script_of(const WorkerEntry& entry) {
  return "REMAP_WORKER_FOLDER=" + shell_word(entry.folder) +
         "; REMAP_RENDERERS=" + shell_word(renderers_folder().string()) +
         "; export REMAP_WORKER_FOLDER REMAP_RENDERERS; exec " + entry.command;
}

}  // namespace

Worker::Worker(const WorkerEntry& entry, const WorkerSettings& settings, std::filesystem::path files)
    : entry_(entry), settings_(settings), files_(std::move(files)) {
  process_ = std::make_unique<ChildProcess>(script_of(entry_));
  const std::string answer = ask(describe_line(++last_id_, settings_.threads), "describe");
  try {
    description_ = read_description(answer, last_id_, entry_.name, context("describe"));
  } catch (const Error& error) {
    fail("describe", without(context("describe") + ": ", error.what()));
  }
}

Worker::~Worker() {
  if (usable_) process_->write_line(quit_line(++last_id_));
}

std::string Worker::context(const std::string& shown) const {
  return "worker " + (entry_.name.empty() ? entry_.command : entry_.name) + ", request " + shown;
}

std::string Worker::message_of(const std::string& shown, const std::string& what) const {
  const bool concerns_files = what.find(files_.parent_path().string()) != std::string::npos;
  return plain(context(shown) + ": " + what + (concerns_files ? kFolderAdvice : ""));
}

std::string Worker::ended(const std::string& shown, const std::string& what) {
  usable_ = false;
  process_->end();
  std::string message = plain(what, kLongestWhat);
  if (const std::string log = process_->log_end(); !log.empty())
    message += "; last lines of its log: " + end_of(log);
  if (!has_answered_ && !entry_.install.empty()) message += " (install it with: " + entry_.install + ")";
  return message_of(shown, message);
}

void Worker::fail(const std::string& shown, const std::string& what) {
  throw input_error(ended(shown, what));
}

std::string Worker::next_answer(const std::string& shown) {
  const auto start = ChildProcess::Clock::now();
  const auto deadline =
      start + duration_cast<ChildProcess::Clock::duration>(duration<double>(settings_.seconds));
  std::string line;
  for (;;) {
    const auto now = ChildProcess::Clock::now();
    const auto reading = process_->read_line(std::min(deadline, now + kGlance), &line);
    if (reading == ChildProcess::Reading::kEnded) throw LostWorker(ended(shown, process_->ending()));
    if (reading == ChildProcess::Reading::kLine) {
      if (is_answer(line) || has_answered_) return line;
      process_->note(line);  // a banner, so it goes to the log
    }
    if (settings_.cancelled != nullptr && *settings_.cancelled) {
      process_->end();
      usable_ = false;
      throw Error(ErrorKind::kInterrupted, context(shown) + ": interrupted");
    }
    if (now >= deadline)
      throw LostWorker(ended(shown, "no answer within " + number_text(settings_.seconds) + " s"));
  }
}

std::string Worker::ask(const std::string& line, const std::string& shown) {
  usable_ = false;
  process_->write_line(line);  // if this fails, the process has ended and read_line reports how
  std::string answer = next_answer(shown);
  has_answered_ = usable_ = true;
  return answer;
}

Image Worker::render(const PictureRequest& request) {
  // Every request has its own file name. With one name for all, the program could read a late file of a lost
  // worker, or an old file that a shared file system has cached.
  const std::filesystem::path picture = own_file("-" + std::to_string(++last_id_) + ".f32"),
                              mesh = own_file(".ply");
  if (request.shape != Shape::kSphere && !std::filesystem::exists(mesh)) write_mesh(request.shape, mesh);
  std::vector<std::filesystem::path> maps;
  for (const auto& [name, map] : request.maps) {
    maps.push_back(own_file("-" + std::to_string(last_id_) + "-" + std::to_string(maps.size()) + ".f32"));
    write_file(maps.back(),
               {reinterpret_cast<const char*>(map->values.data()), map->values.size() * sizeof(float)},
               Flush::kNo);
  }
  const std::string answer = ask(render_line(last_id_, request, picture, mesh, maps), request.shown);
  std::error_code ignored;
  for (const std::filesystem::path& map : maps) std::filesystem::remove(map, ignored);
  std::optional<std::string> complaint;
  try {
    complaint = read_answer(answer, last_id_, context(request.shown));
  } catch (const Error& error) {
    fail(request.shown, without(context(request.shown) + ": ", error.what()));
  }
  // The worker is still usable after an error that it reported itself. After other errors, answers no longer
  // match requests.
  if (complaint) throw input_error(message_of(request.shown, plain(*complaint, kLongestWhat)));
  Image image = read_picture(request, picture);
  std::filesystem::remove(picture, ignored);
  return image;
}

std::filesystem::path Worker::own_file(const std::string& ending) const { return files_.string() + ending; }

// Opens the file before it asks for the size, because a network file system then asks its server for both.
Image Worker::read_picture(const PictureRequest& request, const std::filesystem::path& path) {
  const auto side = static_cast<std::size_t>(request.resolution);
  const auto channels = static_cast<std::size_t>(request.channels);
  const std::size_t expected = side * side * channels * sizeof(float);
  Image image{request.resolution, request.resolution, request.channels,
              std::vector<float>(expected / sizeof(float))};
  std::uintmax_t size = 0;
  try {
    const InputFile file(path);
    size = file.size();
    if (size == expected) size = file.read(0, reinterpret_cast<char*>(image.values.data()), expected);
  } catch (const Error& error) {
    fail(request.shown, std::string("the picture was not written: ") + error.what());
  }
  if (size != expected)
    fail(request.shown, "the picture has " + std::to_string(size) + " bytes (must have " +
                            std::to_string(expected) + ": " + std::to_string(side) + " x " +
                            std::to_string(side) + " pixels of " + std::to_string(channels) + " floats)");
  if (const std::string fault = picture_fault(image); !fault.empty()) fail(request.shown, fault);
  return image;
}

}  // namespace remap
