#include "texremap/run/journal.hpp"

#include <algorithm>
#include <cerrno>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json_field.hpp"
#include "core/plain_text.hpp"
#include "core/system.hpp"
#include "texture/content_hash.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

struct Entry {
  std::string conversion, inputs, target;
  bool is_finished = false;
  std::uintmax_t bytes = 0;
  std::string hash;
};

// Returns a name as the journal writes it. JSON cannot hold names that are not UTF-8. They get % and two
// digits for each byte that is not ASCII.
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

// A Content is the content of journals. Each read continues where the last read ended.
struct Content {
  std::optional<ConversionNote> owner;
  std::map<std::string, Entry> files;  // keyed by name; the last line about a file is valid
  std::map<std::string, std::vector<const std::string*>>
      sets;  // names of their files, which are keys of `files`
  std::map<fs::path, std::uintmax_t> read_bytes;
  bool ends_in_line = false;  // if true, the last line has no end, because its run was killed

  // Reads the journal `name` of a folder if it exists. Throws kOutput if the file belongs to another user,
  // and kInput if a line is too long.
  void read_own(const fs::path& folder, const fs::path& name);
  // Reads journals in the order in which they were last written.
  void read_own(const fs::path& folder, const std::vector<fs::path>& names);
  void read(const InputFile& journal);
  void add(std::string_view line);
};

// Returns names of journals in a folder, in the order in which they were last written.
std::vector<fs::path> by_time(const fs::path& folder, const std::vector<fs::path>& names) {
  std::vector<std::pair<fs::file_time_type, fs::path>> written;
  for (const fs::path& name : names) {
    std::error_code failure;
    const fs::file_time_type time = fs::last_write_time(folder / name, failure);
    if (!failure) written.emplace_back(time, name);
  }
  std::ranges::sort(written);
  std::vector<fs::path> sorted;
  for (auto& [time, name] : written) sorted.push_back(std::move(name));
  return sorted;
}

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

void Content::add(std::string_view line) {
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
    // Skip the line, because its meaning is unknown. A killed run may have left it, or the journal is
    // damaged.
  }
}

void Content::read(const InputFile& journal) {
  std::uintmax_t& end = read_bytes[journal.path()];
  InputLines lines(journal, end);
  while (const std::optional<std::string_view> line = lines.next()) {
    add(*line);
    end = lines.end();
  }
  ends_in_line = !lines.rest().empty();
}

void Content::read_own(const fs::path& folder, const fs::path& name) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(folder / name, ignored))) return;
  const OwnedFile file(folder, name, OwnFile::kRead);
  if (file.exists()) read(file.content());
}

void Content::read_own(const fs::path& folder, const std::vector<fs::path>& names) {
  for (const fs::path& name : by_time(folder, names)) read_own(folder, name);
}

bool is_journal(const fs::path& file) { return file.extension() == kPartJournal; }

// Returns the names of all possible journals of an output folder.
std::vector<fs::path> journals_of(const fs::path& folder) {
  std::vector<fs::path> journals = {kJournalName};
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / kPartsFolder, failure))
    if (is_journal(entry.path())) journals.push_back(kPartsFolder / entry.path().filename());
  return journals;
}

// Returns the journal of one other part, or nothing if there is none. A new part finds in it which
// conversion owns the folder.
std::vector<fs::path> other_part(const fs::path& folder, const fs::path& own) {
  std::vector<fs::path> names = journals_of(folder);
  std::erase_if(names, [&](const fs::path& name) { return name == kJournalName || name == own; });
  if (names.size() > 1) names.resize(1);
  return names;
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

// Cleans a text of a journal, which anybody may have written.
std::string shown_note(const std::string& text) {
  constexpr std::size_t kShown = 200;
  return text.empty() ? "none" : plain(text, kShown);
}

// Returns the first difference: `target before: mitsuba/ggx, now: mitsuba/as`.
std::string difference(const ConversionNote& owner, const ConversionNote& own) {
  const auto differ = [](const std::string& what, const std::string& before, const std::string& now) {
    return what + " before: " + shown_note(before) + ", now: " + shown_note(now);
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
  fs::path folder, file;  // the journal that this run writes, below the folder
  bool is_part = false;
  ConversionNote conversion;
  mutable std::mutex mutex;  // guards `content` and appending
  Content content;
  bool has_all = false;  // `content` has all journals
  bool is_claimed = false;

  std::string name_of(const fs::path& path) const { return journal_name(path, folder); }
  const Entry* entry_of(const fs::path& path) const {
    const auto found = content.files.find(name_of(path));
    return found == content.files.end() || found->second.conversion != conversion.hash ? nullptr
                                                                                       : &found->second;
  }
  // Returns the entry of an existing file, after reading what other runs have written meanwhile.
  const Entry* entry_of_existing(const fs::path& path) {
    if (const Entry* known = entry_of(path)) return known;
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return nullptr;
    has_all ? content.read_own(folder, file) : content.read_own(folder, journals_of(folder));
    has_all = true;
    return entry_of(path);
  }
  // Locks the folder for a run that shares its journal with others. Returns null for a part.
  std::unique_ptr<FolderLock> lock() const {
    if (is_part) return nullptr;
    auto held = std::make_unique<FolderLock>(folder);
    if (held->is_held()) return held;
    throw Error(ErrorKind::kOutput,
                folder.string() +
                    ": another process has locked this folder for a minute (end that process, or "
                    "choose another folder)",
                EINTR);
  }
  void require_own() const {
    if (!content.owner || content.owner->hash == conversion.hash) return;
    throw output_error(folder.string() + ": holds results of another conversion, from " +
                       shown_note(content.owner->source) + " to " + shown_note(content.owner->target) + " (" +
                       difference(*content.owner, conversion) + "; choose another folder, or use --force)");
  }
  void append(const Json& json);
};

void Journal::State::append(const Json& json) {
  OwnedFile(folder, file, OwnFile::kAppend).append((content.ends_in_line ? "\n" : "") + json.dump() + '\n');
  content.ends_in_line = false;
}

Journal::Journal(const fs::path& folder, ConversionNote conversion, const std::optional<Part>& part)
    : state_(std::make_unique<State>()) {
  state_->folder = folder.lexically_normal();
  if (!state_->folder.has_filename()) state_->folder = state_->folder.parent_path();  // `out/`
  state_->conversion = std::move(conversion);
  state_->is_part = part.has_value();
  state_->has_all = !part;
  const fs::path all = kJournalName;
  state_->file = part ? fs::path(kPartsFolder) / (name_of(*part) + kPartJournal) : all;
  std::vector<fs::path> names = journals_of(state_->folder);
  if (part) {
    names = other_part(state_->folder, state_->file);
    names.insert(names.end(), {all, state_->file});
  }
  state_->content.read_own(state_->folder, names);
}
Journal::~Journal() = default;

void Journal::require_own() const {
  const std::lock_guard lock(state_->mutex);
  state_->require_own();
}

void Journal::claim(bool force) {
  const std::lock_guard lock(state_->mutex);
  if (state_->is_claimed) return;
  create_parent(state_->folder / state_->file);
  const auto folder = state_->lock();
  state_->content.read_own(state_->folder, state_->file);
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
  for (const std::string* name : found->second) {
    if (!fault_of_relative(*name).empty()) return {};  // this program did not write the name
    files.push_back(state_->folder / *name);
  }
  return files;
}

void Journal::begin(const std::vector<fs::path>& files) {
  create_parent(state_->folder / state_->file);
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
  state_->content.read_own(state_->folder, state_->file);
  if (state_->is_claimed) state_->require_own();  // a run with --force may own the folder now
  for (const FinishedFile& file : files) {
    std::error_code ignored;
    if (!force && fs::exists(file.path, ignored) && state_->entry_of_existing(file.path) == nullptr)
      throw output_error(file.path.string() + ": another run wrote this file meanwhile (--force overwrites)");
  }
  rename();
  state_->append(line);
}

struct JournalLookup::State {
  std::mutex mutex;
  std::map<fs::path, std::shared_ptr<const Content>> journals;  // keyed by folder; null: no journal there

  std::shared_ptr<const Content> of(const fs::path& folder) {
    const auto [found, is_new] = journals.try_emplace(folder);
    std::error_code ignored;
    if (is_new && (fs::is_regular_file(folder / kJournalName, ignored) ||
                   fs::is_directory(folder / kPartsFolder, ignored))) {
      const auto content = std::make_shared<Content>();
      for (const fs::path& name : by_time(folder, journals_of(folder))) add(folder / name, *content);
      found->second = content;
    }
    return found->second;
  }

  // Adds a journal of inputs. It is only a hint, because it belongs to whoever made these files. If it cannot
  // be read, the rest is ignored.
  static void add(const fs::path& journal, Content& content) {
    try {
      content.read(InputFile(journal));
    } catch (const Error&) {
    }
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
