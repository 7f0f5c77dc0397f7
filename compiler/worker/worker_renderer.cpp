#include "worker/worker_renderer.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <thread>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/plain_text.hpp"
#include "look/scene.hpp"
#include "remap/error.hpp"
#include "worker/protocol.hpp"

namespace remap {
namespace {

namespace fs = std::filesystem;

// In a file of the cache, the first line is the request and the renderer's version. The second line is the
// checksum of the first line and of the picture. The picture follows as raw floats. The name of the file is a
// hash of the first line. Two requests may have the same hash, so the line is compared. The checksum covers
// every byte, so a damaged file is not used.

// Returns FNV-1a, 64 bits (Fowler, Noll, Vo 1991). Changing a single byte always changes it.
std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

std::string hexadecimal(std::uint64_t value) {
  std::string text(16, '0');
  for (std::size_t i = text.size(); i-- > 0; value >>= 4) text[i] = "0123456789abcdef"[value & 15u];
  return text;
}

constexpr std::size_t kChecksumBytes = 17;  // 16 digits and the line break

std::string checksum_line(std::string_view line, std::string_view picture) {
  return hexadecimal(hash_of(std::string(line) += picture)) + "\n";
}

// Makes a file name by which a person recognises the text.
std::string folder_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool kept = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.';
    if (kept || (!name.empty() && name.back() != '-')) name += kept ? c : '-';
  }
  return name.substr(0, 60);
}

std::size_t picture_bytes(const PictureRequest& request) {
  const auto side = static_cast<std::size_t>(request.resolution);
  return side * side * static_cast<std::size_t>(request.channels) * sizeof(float);
}

// This many processes may be lost for one picture. Each picture has its own count, because a machine that
// fails can lose many processes at once. The last attempt uses a new process. Old processes may all end after
// the same number of pictures, and then the picture is not the reason.
constexpr int kMostLosses = 3;

// A pause checks this often for an interruption.
constexpr std::chrono::milliseconds kPauseGlance{100};

unsigned core_count() { return std::max(1u, std::thread::hardware_concurrency()); }

// Replaces 0 processes by one for each core, and sets the number of threads so that all processes together
// use all cores.
WorkerSettings settled(WorkerSettings settings) {
  if (settings.processes == 0) settings.processes = core_count();
  settings.threads = std::max(1u, core_count() / settings.processes);
  return settings;
}

}  // namespace

PictureCache::PictureCache(const fs::path& folder, const std::string& worker, const std::string& renderer)
    : key_opening_("remap picture 2; protocol " + std::to_string(kWorkerProtocol) + "; " + renderer + "; "),
      worker_folder_(folder / folder_name(worker.empty() ? "unnamed" : worker)),
      folder_(worker_folder_ / (folder_name(renderer) + "-" + hexadecimal(hash_of(renderer)).substr(0, 8))) {}

fs::path PictureCache::file_of(const PictureRequest& request) const {
  const std::string name = hexadecimal(hash_of(key_opening_ + request.text));
  return folder_ / name.substr(0, 2) / (name + ".picture");
}

std::optional<Image> PictureCache::find(const PictureRequest& request, std::string& damage) const {
  const fs::path path = file_of(request);
  std::error_code failure;
  if (!fs::is_regular_file(path, failure)) return std::nullopt;
  const std::string line = key_opening_ + request.text + "\n";
  const std::size_t expected = line.size() + kChecksumBytes + picture_bytes(request);
  const auto damaged = [&](const std::string& what) {
    damage = path.string() + ": " + what;
    return std::nullopt;
  };
  std::string content;
  try {
    content = read_file(path);
  } catch (const Error& error) {
    damage = error.what();
    return std::nullopt;
  }
  const std::size_t end = content.find('\n') + 1;
  if (end == 0 || content.size() < end + kChecksumBytes) return damaged("the file is cut short");
  const std::string_view picture = std::string_view(content).substr(end + kChecksumBytes);
  if (content.compare(end, kChecksumBytes, checksum_line(content.substr(0, end), picture)) != 0)
    return damaged("its checksum does not match its content");
  if (content.compare(0, end, line) != 0) return std::nullopt;  // another request with the same hash
  if (content.size() != expected) return damaged("it has a picture of another size");
  Image image{request.resolution, request.resolution, request.channels,
              std::vector<float>(picture_bytes(request) / sizeof(float))};
  std::memcpy(image.values.data(), picture.data(), picture.size());
  if (const std::string fault = picture_fault(image); !fault.empty()) return damaged(fault);
  return image;
}

void PictureCache::keep(const PictureRequest& request, const Image& image) const {
  const std::string line = key_opening_ + request.text + "\n";
  const std::string_view picture(reinterpret_cast<const char*>(image.values.data()), picture_bytes(request));
  // Two threads never write the same picture at once (WorkerRenderer), so the temporary name is unique.
  write_file(file_of(request), line + checksum_line(line, picture) + std::string(picture), Flush::kNo);
}

std::vector<std::string> PictureCache::other_versions() const {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(worker_folder_, ignored))
    if (entry.path().filename() != folder_.filename()) names.push_back(entry.path().filename());
  std::ranges::sort(names);
  return names;
}

// A Turn is the right to render one picture. Other threads that need this picture wait for it.
class WorkerRenderer::Turn {
 public:
  Turn(const WorkerRenderer& renderer, const PictureRequest& request)
      : renderer_(renderer), key_(request.text) {
    std::unique_lock lock(renderer_.mutex_);
    renderer_.changed_.wait(lock, [&] { return !renderer_.in_work_.contains(key_); });
    renderer_.in_work_.insert(key_);
  }
  ~Turn() {
    {
      const std::lock_guard lock(renderer_.mutex_);
      renderer_.in_work_.erase(key_);
    }
    renderer_.changed_.notify_all();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  const WorkerRenderer& renderer_;
  const std::string& key_;
};

// A Lease borrows a worker for one picture: an idle worker, or a new one if none is idle.
class WorkerRenderer::Lease {
 public:
  Lease(const WorkerRenderer& renderer, bool must_be_new)
      : renderer_(renderer), worker_(renderer.idle_worker()) {
    if (must_be_new) worker_.reset();
  }
  ~Lease() { renderer_.give_back(std::move(worker_)); }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;

  Worker& worker() {
    if (worker_ == nullptr) worker_ = renderer_.start_another();
    return *worker_;
  }

 private:
  const WorkerRenderer& renderer_;
  std::unique_ptr<Worker> worker_;
};

WorkerRenderer::WorkerRenderer(WorkerEntry entry, WorkerSettings settings)
    : entry_(std::move(entry)), settings_(settled(std::move(settings))), folder_(settings_.folder) {
  if (settings_.on_start) settings_.on_start();
  std::unique_ptr<Worker> first = start();
  description_ = first->description();
  if (settings_.cache) cache_.emplace(*settings_.cache, entry_.name, description_.renderer);
  running_ = 1;
  idle_.push_back(std::move(first));
}

WorkerRenderer::~WorkerRenderer() = default;

std::unique_ptr<Worker> WorkerRenderer::start() const {
  return std::make_unique<Worker>(entry_, settings_, folder_.path() / std::to_string(next_file_++));
}

std::unique_ptr<Worker> WorkerRenderer::start_another() const {
  std::unique_ptr<Worker> worker = start();
  if (worker->description().renderer != description_.renderer)
    throw input_error("worker " + entry_.name + ": its version changed during the run, from " +
                      description_.renderer + " to " + worker->description().renderer);
  return worker;
}

std::unique_ptr<Worker> WorkerRenderer::idle_worker() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !idle_.empty() || running_ < settings_.processes; });
  if (idle_.empty()) {
    ++running_;
    return nullptr;
  }
  auto worker = std::move(idle_.back());
  idle_.pop_back();
  return worker;
}

// Takes back a worker after its use. If the worker is broken, ends it and frees its place, so that another
// worker can be started.
void WorkerRenderer::give_back(std::unique_ptr<Worker> worker) const {
  if (worker != nullptr && !worker->is_usable()) worker.reset();
  {
    const std::lock_guard lock(mutex_);
    if (worker != nullptr)
      idle_.push_back(std::move(worker));
    else
      --running_;
  }
  changed_.notify_all();
}

Image WorkerRenderer::render_anew(const PictureRequest& request) const {
  for (int losses = 1;; ++losses) {
    try {
      return Lease(*this, losses == kMostLosses).worker().render(request);
    } catch (const LostWorker& lost) {
      accept_loss(lost, losses);
    }
  }
}

// Throws if too many processes were lost for this picture. Otherwise it waits, because it may take time until
// a failed machine is noticed.
void WorkerRenderer::accept_loss(const LostWorker& lost, int losses) const {
  if (losses == kMostLosses)
    throw input_error(
        plain(std::string(lost.what()) + "; lost " + std::to_string(losses) + " processes over one picture"));
  if (lost_++ == 0) warn(std::string(lost.what()) + " (another process renders the picture)");
  const auto until = std::chrono::steady_clock::now() + losses * settings_.pause;
  do {
    if (settings_.cancelled != nullptr && *settings_.cancelled)
      throw Error(ErrorKind::kInterrupted, "worker " + entry_.name + ": interrupted");
    std::this_thread::sleep_for(std::min<std::chrono::milliseconds>(settings_.pause, kPauseGlance));
  } while (std::chrono::steady_clock::now() < until);
}

Image WorkerRenderer::render(const Material& material, const Scene& scene) const {
  require_material(material, model(material.model));
  if (scene.shape != Shape::kSphere && !description_.meshes)
    throw usage_error("worker " + entry_.name + ": renders spheres only, not a " + shape_name(scene.shape) +
                      " (use --shape sphere)");
  if (scene.environment != nullptr && !model(material.model).textures)
    throw usage_error(material.model + ": cannot be lit by an environment (choose another light)");
  const PictureRequest request = picture_request(material, scene);
  const Turn turn(*this, request);
  std::optional<Image> image = cached(request);
  if (image) {
    ++cached_;
  } else {
    image = render_anew(request);
    ++rendered_;
    keep(request, *image);
  }
  if (settings_.on_picture) settings_.on_picture();
  return std::move(*image);
}

std::optional<Image> WorkerRenderer::cached(const PictureRequest& request) const {
  if (!cache_ || !request.maps.empty()) return std::nullopt;
  std::string damage;
  std::optional<Image> image = cache_->find(request, damage);
  if (!damage.empty() && damaged_++ == 0) warn_of_cache(damage + " (the picture is rendered again)");
  return image;
}

void WorkerRenderer::keep(const PictureRequest& request, const Image& image) const {
  if (!cache_ || !keeps_ || !request.maps.empty()) return;
  try {
    cache_->keep(request, image);
  } catch (const Error& error) {
    if (keeps_.exchange(false)) warn_of_cache(std::string(error.what()) + " (further pictures are not kept)");
  }
}

void WorkerRenderer::warn(const std::string& message) const {
  if (settings_.on_warning) settings_.on_warning(message);
}

void WorkerRenderer::warn_of_cache(const std::string& message) const {
  warn("worker " + entry_.name + ": cache: " + message);
}

PictureCount WorkerRenderer::pictures() const { return {rendered_, cached_, lost_}; }

std::vector<std::string> WorkerRenderer::remarks() const {
  std::vector<std::string> remarks;
  if (lost_ > 1)
    remarks.push_back("worker " + entry_.name + ": " + std::to_string(lost_) +
                      " processes were lost; other processes rendered their pictures");
  if (!cache_) return remarks;
  if (damaged_ > 1)
    remarks.push_back("worker " + entry_.name + ": " + std::to_string(damaged_) + " pictures of the cache " +
                      settings_.cache->string() + " were damaged, and were rendered again");
  for (const std::string& version : cache_->other_versions())
    remarks.push_back("worker " + entry_.name + ": pictures of " + version + " in the cache " +
                      settings_.cache->string() + " are not used, because the renderer is now " +
                      description_.renderer);
  return remarks;
}

}  // namespace remap
