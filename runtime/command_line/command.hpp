// This file declares the commands and options of a program. Only this folder includes CLI11, because every
// object that includes it takes 5 to 10 s longer to compile.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/plain_text.hpp"
#include "remap/model.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace remap {

// Only `--help-all` shows options under this heading, and under other headings that begin with "Rare".
inline constexpr const char* kRareOptions = "Rare options";

// These are the types of values of options.
template <typename T>
concept OptionValue = std::same_as<T, std::string> || std::same_as<T, std::filesystem::path> ||
    std::same_as<T, int> || std::same_as<T, unsigned> || std::same_as<T, std::int64_t> ||
    std::same_as<T, std::size_t> || std::same_as<T, double> || std::same_as<T, std::vector<std::string>> ||
    std::same_as<T, std::vector<std::size_t>> || std::same_as<T, std::vector<double>> ||
    std::same_as<T, std::vector<std::filesystem::path>>;

// An OptionTags is a set of bits that each program defines. A tag states what follows if an option is used.
using OptionTags = unsigned;

// A Reader reads the word of an option into a value. If the word is not accepted, `read` throws kUsage with
// the option (`--type`). `choices` are the accepted words, if there are only a few.
template <typename Value>
struct Reader {
  std::function<Value(const std::string& option, const std::string& word)> read;
  std::vector<std::string> choices;
};

// Throws kUsage, because `option` was given the unknown word `word`. The message suggests `known` names, each
// of which is a `noun`.
[[noreturn]] void fail_unknown(const std::string& option, const std::string& noun, const std::string& word,
                               const std::vector<std::string>& known);

// Returns a reader for one of the names in `table`. Messages call such a name `noun`, for example `pixel
// type`.
template <typename Value, std::size_t Count>
Reader<Value> one_of(const NamedValues<Value, Count>& table, const std::string& noun) {
  return {[&table, noun](const std::string& option, const std::string& word) {
            const auto value = value_named(table, word);
            if (!value) fail_unknown(option, noun, word, names_of(table));
            return *value;
          },
          names_of(table)};
}

// Returns a reader for an entry of `table`, by its field `name`. The table must live as long as the program.
template <typename Entry>
Reader<const Entry*> one_of(std::span<const Entry> table, const std::string& noun) {
  std::vector<std::string> known;
  for (const Entry& entry : table) known.emplace_back(entry.name);
  return {[table, noun, known](const std::string& option, const std::string& word) {
            const auto found = std::ranges::find(table, word, &Entry::name);
            if (found == table.end()) fail_unknown(option, noun, word, known);
            return &*found;
          },
          known};
}

// Returns a reader for a list of items, separated by commas.
template <typename Value>
Reader<std::vector<Value>> list_of(const Reader<Value>& item) {
  return {[read = item.read](const std::string& option, const std::string& words) {
            std::vector<Value> all;
            for (const std::string& word : parts_between(words, ',')) all.push_back(read(option, word));
            return all;
          },
          item.choices};
}

// Limits the words of an option that is a list.
inline constexpr int kMostWords = 1000;

// A GivenOption is an option from the command line.
struct GivenOption {
  std::string name;                // `--type`; for words without an option, the name in the help
  std::vector<std::string> words;  // empty for a flag
  OptionTags tags = 0;
};

// An Option is one option of a command. All functions return the option, so that calls can be chained.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option* required();
  // For lists: sets the character between two items of one word.
  Option* delimiter(char character);
  // For lists: decides whether words after the first belong to the option. If not, repeat the option.
  Option* allow_extra_args(bool allowed);
  Option* expected(int min, int max);
  // For lists: an item consists of this many words.
  Option* type_size(int count);
  Option* excludes(Option* other);
  Option* needs(Option* other);
  // Sets the default that help shows.
  Option* default_text(const std::string& text);
  Option* tag(OptionTags tags);
  // Moves the option to those that `--help` shows first.
  Option* common();
  // Sets the environment variable that gives the value if the option is missing.
  Option* environment(const std::string& name);
  Option* one_of(const std::vector<std::string>& words);
  Option* positive();
  Option* range(int min, int max);
  Option* range(std::int64_t min, std::int64_t max);
  Option* range(std::size_t min, std::size_t max);

 private:
  friend class Command;
  CLI::Option* option_;
  OptionTags tags_ = 0;
};

// A Command is a program, or one of its commands, which the program owns.
class Command {
 public:
  Command(const std::string& description, const std::string& name);

  // `group` is the heading of the help under which this command is listed.
  Command* add_subcommand(const std::string& name, const std::string& description = "",
                          const std::string& group = "");
  // Adds an option. `names` is "-o,--output FILE", with the name of the value for help texts, or "fits" for
  // words without an option. Help shows the current value of the variable, unless it is an empty string, path
  // or list. `value` must live until the command has run.
  template <OptionValue T>
  Option* add_option(const std::string& names, T& value, const std::string& description = "");
  // Adds an option whose words `reader` reads. It reads them after the whole command line was found to be
  // well-formed. Help lists the choices of the reader. For a list of values, each use of the option has one
  // word.
  template <typename Value, typename Read>
  Option* add_option(const std::string& names, Value& value, const Reader<Read>& reader,
                     const std::string& description) {
    constexpr bool kIsList = std::is_same_v<Value, std::vector<Read>>;
    Option* const added = add_words(
        names,
        [&value, read = reader.read](const std::string& option, const std::string& word) {
          if constexpr (kIsList)
            value.push_back(read(option, word));
          else
            value = read(option, word);
        },
        reader.choices, description);
    if constexpr (kIsList) added->expected(1, kMostWords)->allow_extra_args(false);
    return added;
  }
  Option* add_flag(const std::string& names, bool& value, const std::string& description = "");
  // Refuses an option of earlier versions, and prints what to do instead. Help does not show it.
  void retire(const std::string& name, const std::string& remedy);
  // Refuses a command that only another package has, and prints where it is. Help does not show it.
  void retire_command(const std::string& name, const std::string& remedy);
  // Sets the heading under which the help of this command lists the options that are added from now on
  // (help_text.hpp).
  void option_group(const std::string& name);
  // Returns an option that was added before.
  Option* option(const std::string& name);
  void set_version_flag(const std::string& names, const std::string& version);
  void require_subcommand(int count);
  void footer(const std::string& text);
  void callback(std::function<void()> work);
  // Returns how often the option was given.
  std::size_t count(const std::string& option) const;
  // Returns the tags of an option by its name, such as `--type`, or 0 if there is none.
  OptionTags tags_of(const std::string& name) const;
  // Returns the options of the command line, in the order in which they were added.
  std::vector<GivenOption> given() const;

  CLI::App& app() { return *app_; }

 private:
  explicit Command(std::shared_ptr<CLI::App> app);
  Option* keep(CLI::Option* option);
  Option* add_words(const std::string& names,
                    const std::function<void(const std::string& option, const std::string& word)>& take,
                    const std::vector<std::string>& choices, const std::string& description);

  std::shared_ptr<CLI::App> app_;
  std::vector<std::unique_ptr<Command>> commands_;
  std::vector<std::unique_ptr<Option>> options_;
};

// Gives a command its work, `run(options)`. Returns the options, which live as long as the command.
template <typename Options, typename Run>
requires std::is_class_v<Run> Options& set_work(Command& command, Run run) {
  const auto options = std::make_shared<Options>();
  command.callback([options, run = std::move(run)] { run(std::as_const(*options)); });
  return *options;
}
// Accepts a function as the work. The function may have overloads.
template <typename Options>
Options& set_work(Command& command, void (*run)(const Options&)) {
  return set_work<Options>(command, [run](const Options& options) { run(options); });
}

}  // namespace remap
