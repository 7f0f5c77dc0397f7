#include "texremap/journal.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json_field.hpp"
#include "core/plain_text.hpp"
#include "core/system.hpp"
#include "texture/content_hash.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// A journal line is far shorter; more is damage.
constexpr std::size_t kLongestLine = std::size_t{16} << 20;

struct Entry {
  std::string conversion, inputs, target;
  bool is_finished = false;
  std::uintmax_t bytes = 0;
  std::string hash;
};

// A name as the journal writes it. Names that are not UTF-8, which JSON cannot hold, have % and two digits
// for each byte that is not ASCII.
std::string journal_name(const fs::path& path, const fs::path& folder) {
  const auto absolute = [](const fs::path& name) { return fs::absolute(name).lexically_normal(); };
  const std::string name = absolute(path).lexically_relative(absolute(folder)).generic_string();
  if (is_utf8(name)) return name;
  std::string escaped;
  for (const char letter : name)
    if (static_cast<unsigned char>(letter) < 0x80)
      escaped += letter;
    else
      escaped += percent_code(letter);
  return escaped;
}

// What the lines of journals say, read anew from where reading ended.
struct Content {
  std::optional<ConversionNote> owner;
  std::map<std::string, Entry> files;  // by name, the last line counts
  std::map<std::string, std::vector<const std::string*>>
      sets;  // names of their files, which are keys of `files`
  std::map<fs::path, std::streamoff> read_bytes;

  void read(const fs::path& journal);
  // In the order in which they were written to.
  void read(const std::vector<fs::path>& journals);
  void add(const std::string& line);
};

ConversionNote note_of(const Field& field) {
  ConversionNote note;
  for (const auto& [name, text] :
       field.dictionary<std::string>([](const Field& entry) { return entry.any_text(); })) {
    if (name == "source")
      note.source = text;
    else if (name == "target")
      note.target = text;
    else if (name == "hash")
      note.hash = text;
    else
      note.details.emplace_back(name, text);
  }
  return note;
}

void Content::add(const std::string& line) {
  try {
    const Json json = parse_json(line, kJournalName);
    const Field field(json, kJournalName);
    if (field.contains("conversion") && json.find("conversion")->fields() != nullptr)
      owner = note_of(field["conversion"]);
    if (field.contains("begun"))
      for (const std::string& name :
           field["begun"].list(0, [](const Field& entry) { return entry.any_text(); })) {
        files[name] = {};
        files[name].conversion = field["conversion"].text();
      }
    if (field.contains("files")) {
      std::vector<const std::string*>& names = sets[field["set"].any_text()];
      names.clear();
      const auto read = [&](const Field& file) {
        const auto known = files.try_emplace(file["name"].any_text()).first;
        names.push_back(&known->first);
        known->second = {field["conversion"].text(),
                         field["inputs"].text(),
                         field["target"].text(),
                         true,
                         static_cast<std::uintmax_t>(file["bytes"].count()),
                         file["hash"].text()};
        return true;
      };
      field["files"].list(0, read);
    }
  } catch (const Error&) {
    // A line of a killed run, or damage: what it would say is unknown.
  }
}

void Content::read(const fs::path& journal) {
  std::ifstream stream(journal, std::ios::binary);
  if (!stream) return;
  std::streamoff& end = read_bytes[journal];
  stream.seekg(end);
  for (std::string line;
       std::getline(stream, line) && !stream.eof();) {  // without an end, a line is not whole yet
    end = stream.tellg();
    if (line.size() <= kLongestLine) add(line);
  }
}

void Content::read(const std::vector<fs::path>& journals) {
  std::vector<std::pair<fs::file_time_type, fs::path>> written;
  for (const fs::path& journal : journals) {
    std::error_code failure;
    const fs::file_time_type time = fs::last_write_time(journal, failure);
    if (!failure) written.emplace_back(time, journal);
  }
  std::ranges::sort(written);
  for (const auto& [time, journal] : written) read(journal);
}

bool is_journal(const fs::path& file) { return file.extension() == kPartJournal; }

// All journals of an output folder that there may be.
std::vector<fs::path> journals_of(const fs::path& folder) {
  std::vector<fs::path> journals = {folder / kJournalName};
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / kPartsFolder, failure))
    if (is_journal(entry.path())) journals.push_back(entry.path());
  return journals;
}

// One journal of another part, by which a part knows whose the folder is; none without one.
fs::path other_part(const fs::path& own) {
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(own.parent_path(), failure))
    if (is_journal(entry.path()) && entry.path() != own) return entry.path();
  return {};
}

bool is_as_written(const InputFile& file, const Entry& entry) {
  return entry.is_finished && file.size() == entry.bytes && hash_of_file(file) == entry.hash;
}

bool is_as_written(const fs::path& path, const Entry& entry) {
  try {
    return is_as_written(InputFile(path), entry);
  } catch (const Error&) {
    return false;
  }
}

// Of a text from a journal, which anybody may have written.
std::string shown_note(const std::string& text) {
  constexpr std::size_t kShown = 200;
  return text.empty() ? "none" : plain(text, kShown);
}

std::string details_of(const ConversionNote& note) {
  std::string text = shown_note(note.source) + " to " + shown_note(note.target);
  constexpr std::size_t kShown = 8;
  for (std::size_t i = 0; i < std::min(note.details.size(), kShown); ++i)
    if (const auto& [name, value] = note.details[i]; !value.empty())
      text += ", " + shown_note(name) + " " + shown_note(value);
  return text;
}

// `target mitsuba/ggx there, mitsuba/as here`: the first difference.
std::string difference(const ConversionNote& owner, const ConversionNote& own) {
  const auto differ = [](const std::string& what, const std::string& there, const std::string& here) {
    return what + " " + shown_note(there) + " there, " + shown_note(here) + " here";
  };
  if (owner.source != own.source) return differ("source", owner.source, own.source);
  if (owner.target != own.target) return differ("target", owner.target, own.target);
  const std::map<std::string, std::string> theirs(owner.details.begin(), owner.details.end());
  for (const auto& [name, value] : own.details) {
    const auto found = theirs.find(name);
    if (found == theirs.end() || found->second != value)
      return differ(name, found == theirs.end() ? "" : found->second, value);
  }
  return "numbers of the converter";
}

}  // namespace

struct Journal::State {
  fs::path folder, file;  // the journal that this run writes
  bool is_part = false;
  ConversionNote conversion;
  mutable std::mutex mutex;  // of `content` and of appending
  Content content;
  bool has_all = false;  // journals in `content`
  bool is_claimed = false;

  std::string name_of(const fs::path& path) const { return journal_name(path, folder); }
  const Entry* entry_of(const fs::path& path) const {
    const auto found = content.files.find(name_of(path));
    return found == content.files.end() || found->second.conversion != conversion.hash ? nullptr
                                                                                       : &found->second;
  }
  // The same after a look at what other runs have written meanwhile, where the file exists.
  const Entry* entry_of_existing(const fs::path& path) {
    if (const Entry* known = entry_of(path)) return known;
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return nullptr;
    has_all ? content.read(file) : content.read(journals_of(folder));
    has_all = true;
    return entry_of(path);
  }
  // The lock of the folder for a run that shares its journal with others.
  std::optional<FolderLock> lock() const {
    return is_part ? std::nullopt : std::make_optional<FolderLock>(folder);
  }
  void require_own() const {
    if (!content.owner || content.owner->hash == conversion.hash) return;
    throw Error(ErrorKind::kOutput,
                folder.string() + ": belongs to another conversion, " + details_of(*content.owner) + " (" +
                    difference(*content.owner, conversion) + "; choose another folder, or --force)");
  }
  void append(const Json& json) const;
};

// One write, so that lines of several processes do not mix.
void Journal::State::append(const Json& json) const {
  if (!append_to_file(file, json.dump() + '\n'))
    throw system_error(ErrorKind::kOutput, file.string() + ": cannot be written", errno);
}

Journal::Journal(const fs::path& folder, ConversionNote conversion, const std::optional<Part>& part)
    : state_(std::make_unique<State>()) {
  state_->folder = folder.lexically_normal();
  if (!state_->folder.has_filename()) state_->folder = state_->folder.parent_path();  // `out/`
  state_->conversion = std::move(conversion);
  state_->is_part = part.has_value();
  state_->has_all = !part;
  const fs::path all = state_->folder / kJournalName;
  state_->file = part ? state_->folder / kPartsFolder / (name_of(*part) + kPartJournal) : all;
  state_->content.read(part ? std::vector<fs::path>{all, other_part(state_->file), state_->file}
                            : journals_of(state_->folder));
}
Journal::~Journal() = default;

void Journal::require_own() const {
  const std::lock_guard lock(state_->mutex);
  state_->require_own();
}

void Journal::claim(bool force) {
  const std::lock_guard lock(state_->mutex);
  if (state_->is_claimed) return;
  create_parent(state_->file);
  const auto folder = state_->lock();
  state_->content.read(state_->file);
  if (!force) state_->require_own();
  state_->is_claimed = true;
  const ConversionNote& own = state_->conversion;
  if (state_->content.owner && state_->content.owner->hash == own.hash) return;
  Json note = {{"hash", own.hash}, {"source", own.source}, {"target", own.target}};
  for (const auto& [name, value] : own.details) note[name] = value;
  state_->append({{"conversion", note}});
}

bool Journal::is_own(const fs::path& path) const {
  const std::lock_guard lock(state_->mutex);
  return state_->entry_of_existing(path) != nullptr;
}

bool Journal::is_done(const std::string& inputs, const std::vector<fs::path>& files) const {
  std::vector<Entry> entries;
  {
    const std::lock_guard lock(state_->mutex);
    for (const fs::path& path : files) {
      const Entry* entry = state_->entry_of_existing(path);
      if (entry == nullptr || entry->inputs != inputs) return false;
      entries.push_back(*entry);
    }
  }
  for (std::size_t i = 0; i < files.size(); ++i)
    if (!is_as_written(files[i], entries[i])) return false;
  return true;
}

std::vector<fs::path> Journal::files_of(const std::string& set) const {
  const std::lock_guard lock(state_->mutex);
  std::vector<fs::path> files;
  const auto found = state_->content.sets.find(set);
  if (found == state_->content.sets.end()) return files;
  for (const std::string* name : found->second) files.push_back(state_->folder / *name);
  return files;
}

void Journal::begin(const std::vector<fs::path>& files) {
  create_parent(state_->file);
  Json names = Json::list();
  for (const fs::path& path : files) names.push_back(state_->name_of(path));
  const std::lock_guard lock(state_->mutex);
  state_->append({{"begun", names}, {"conversion", state_->conversion.hash}});
}

void Journal::commit(const std::string& set, const std::string& inputs,
                     const std::vector<FinishedFile>& files, bool force,
                     const std::function<void()>& rename) {
  Json line = {{"set", set},
               {"inputs", inputs},
               {"conversion", state_->conversion.hash},
               {"source", state_->conversion.source},
               {"target", state_->conversion.target},
               {"files", Json::list()}};
  for (const FinishedFile& file : files)
    line["files"].push_back(
        {{"name", state_->name_of(file.path)}, {"bytes", file.bytes}, {"hash", file.hash}});
  const std::lock_guard lock(state_->mutex);
  const auto folder = state_->lock();
  state_->content.read(state_->file);
  if (state_->is_claimed) state_->require_own();  // another run may have taken the folder by --force
  for (const FinishedFile& file : files) {
    std::error_code ignored;
    if (!force && fs::exists(file.path, ignored) && state_->entry_of_existing(file.path) == nullptr)
      throw Error(ErrorKind::kOutput,
                  file.path.string() + ": another run wrote this file meanwhile (--force overwrites)");
  }
  rename();
  state_->append(line);
}

struct JournalLookup::State {
  std::mutex mutex;
  std::map<fs::path, std::shared_ptr<const Content>> journals;  // by folder; null for none

  std::shared_ptr<const Content> of(const fs::path& folder) {
    const auto [found, is_new] = journals.try_emplace(folder);
    std::error_code ignored;
    if (is_new && (fs::is_regular_file(folder / kJournalName, ignored) ||
                   fs::is_directory(folder / kPartsFolder, ignored))) {
      const auto content = std::make_shared<Content>();
      content->read(journals_of(folder));
      found->second = content;
    }
    return found->second;
  }
};

JournalLookup::JournalLookup() : state_(std::make_unique<State>()) {}
JournalLookup::~JournalLookup() = default;

std::optional<std::string> JournalLookup::target_of(const InputFile& file) {
  std::error_code failure;
  const fs::path whole = fs::weakly_canonical(file.path(), failure);
  if (failure) return std::nullopt;
  for (fs::path folder = whole.parent_path(); !folder.empty(); folder = folder.parent_path()) {
    std::optional<Entry> entry;
    {
      const std::lock_guard lock(state_->mutex);
      if (const auto content = state_->of(folder)) {
        const auto found = content->files.find(journal_name(whole, folder));
        if (found != content->files.end()) entry = found->second;
      }
    }
    if (entry && is_as_written(file, *entry)) return entry->target;
    if (folder == folder.parent_path()) break;
  }
  return std::nullopt;
}

}  // namespace remap
